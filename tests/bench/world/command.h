#pragma once
#include <CLI/CLI.hpp>

/// `bench world`.
namespace detent_bench {

struct WorldOptions {
  std::vector<std::string> scenes, engines, configs;
  uint32_t repetitions = 3, steps = 0;
  bool study = false;
  std::string json, plot;
};

CLI::App* add_world_command(CLI::App& app, WorldOptions& options);
/// The exit code.
int run_world(WorldOptions options);

}  // namespace detent_bench
