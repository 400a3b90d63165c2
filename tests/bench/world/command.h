#pragma once
#include <CLI/CLI.hpp>

/// `bench world`.
namespace detent_bench {

struct WorldOptions {
  std::vector<std::string> scenes, engines, configs;
  std::string ground;  ///< empty: box for a study and for growth, else both
  uint32_t repetitions = 3, steps = 0;
  bool study = false, growth = false, accuracy = false;
  std::vector<uint32_t> bodies = {250, 500, 1000, 2000, 4000, 8000, 16000};
  std::string json, plot;
};

CLI::App* add_world_command(CLI::App& app, WorldOptions& options);
/// The exit code.
int run_world(WorldOptions options);

}  // namespace detent_bench
