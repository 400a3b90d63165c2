#pragma once
#include <CLI/CLI.hpp>

/// `bench motions`.
namespace detent_bench {

struct MotionsOptions {
  std::string json, plot;
};

CLI::App* add_motions_command(CLI::App& app, MotionsOptions& options);
/// The exit code.
int run_motions(const MotionsOptions& options);

}  // namespace detent_bench
