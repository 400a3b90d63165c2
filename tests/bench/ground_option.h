#pragma once
#include <CLI/CLI.hpp>
#include <string>

/// The option --ground, for every benchmark that steps a world.
namespace detent_bench {

inline void add_ground_option(CLI::App& command, std::string& ground) {
  command
      .add_option("--ground", ground,
                  "The ground of scenes that have a level one: half-space, box (200 m wide), or both, one after the "
                  "other (default: both); scenes without one are played as they are")
      ->check(CLI::IsMember({"half-space", "box", "both"}));
}

}  // namespace detent_bench
