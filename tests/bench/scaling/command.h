#pragma once
#include <CLI/CLI.hpp>

/// `bench scaling`.
namespace detent_bench {

struct ScalingOptions {
  std::vector<std::string> scenes, configs;
  std::vector<uint32_t> threads;
  std::string json;
};

CLI::App* add_scaling_command(CLI::App& app, ScalingOptions& options);
/// The exit code.
int run_scaling(const ScalingOptions& options);

}  // namespace detent_bench
