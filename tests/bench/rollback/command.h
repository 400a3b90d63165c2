#pragma once
#include <CLI/CLI.hpp>

/// `bench rollback`.
namespace detent_bench {

struct RollbackOptions {
  std::vector<uint32_t> bodies = {10, 200, 1000, 5000};
  std::vector<std::string> configs;
  uint32_t repetitions = 40;
  bool sparse = false;
  std::string json;
};

CLI::App* add_rollback_command(CLI::App& app, RollbackOptions& options);
/// The exit code.
int run_rollback(const RollbackOptions& options);

}  // namespace detent_bench
