#pragma once
#include <CLI/CLI.hpp>

#include "tests/bench/worlds/engine.h"

/// `bench worlds`.
namespace detent_bench {

struct WorldsOptions {
  std::vector<std::string> scenes, configs;
  WorldsEffort effort;
  std::string json;
};

CLI::App* add_worlds_command(CLI::App& app, WorldsOptions& options);
/// The exit code.
int run_worlds(const WorldsOptions& options);

}  // namespace detent_bench
