#include "tests/bench/rollback/command.h"

#include <stdio.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/bench/rollback/engine.h"

namespace detent_bench {

namespace {

constexpr const char* k_help =
    R"(What rollback costs: the pit of scene S4 with as many bodies, after 300 ticks, all awake.
  kB        kept of a tick: what is in use; whole: of save(), which depends on the capacity; delta: save_delta() against
            the tick before
  save, restore  us, of SnapshotRing; whole: of save() and restore(); delta: of save_delta() and restore_delta()
  step      us, of a tick
  resim8    us, of going back eight ticks and making them again, each kept; steps: that, in steps
  digest    us, of digest()
--sparse: a session with RollbackDef::sparse and one without play the same match: 16 players, 1,000 bodies, and in each
frame the input of one player is eight ticks late. "apart": heaps of 50 bodies; "one island": a heap between walls.
  bodies    simulated in a tick that is made again; whole: the fraction of ticks in which all bodies are simulated
  again     us, of going back eight ticks and making them again, sparse and of all bodies; ratio: of both
  forward   us, of a new tick
  kB        of the session's memory for each tick of its window
Medians. The states at the end are compared (--sparse: every state that is made again): exit code 1 if one differs,
or if anything was allocated.)";

/// us, without digits that mean nothing.
double rounded(double us) { return static_cast<double>(static_cast<int64_t>(us * 1000 + 0.5)) / 1000; }

nlohmann::ordered_json json_of(const RollbackRow& row) {
  return {{"config", row.config},
          {"bodies", row.bodies},
          {"contacts", row.contacts},
          {"bytes", row.bytes},
          {"snapshot_bytes", row.snapshot_bytes},
          {"delta_bytes", row.delta_bytes},
          {"save_us", rounded(row.save)},
          {"restore_us", rounded(row.restore)},
          {"resim8_us", rounded(row.resim8)},
          {"step_us", rounded(row.step)},
          {"whole_save_us", rounded(row.whole_save)},
          {"whole_restore_us", rounded(row.whole_restore)},
          {"save_delta_us", rounded(row.save_delta)},
          {"restore_delta_us", rounded(row.restore_delta)},
          {"digest_us", rounded(row.digest)},
          {"allocations", row.allocations},
          {"exact", row.exact}};
}

nlohmann::ordered_json json_of(const SparseRow& row) {
  return {{"config", row.config},
          {"scene", row.scene},
          {"bodies", rounded(row.bodies)},
          {"whole", rounded(row.whole)},
          {"sparse_us", rounded(row.again[0])},
          {"all_us", rounded(row.again[1])},
          {"sparse_forward_us", rounded(row.forward[0])},
          {"all_forward_us", rounded(row.forward[1])},
          {"sparse_bytes", row.bytes_per_tick[0]},
          {"all_bytes", row.bytes_per_tick[1]},
          {"allocations", row.allocations},
          {"exact", row.exact}};
}

void print(const SparseRow& row) {
  printf("%-5s %-10s %7.1f %6.2f %9.0f %9.0f %6.3f %9.0f %9.0f %8.1f %8.1f\n", row.config, row.scene, row.bodies,
         row.whole, row.again[0], row.again[1], row.again[0] / row.again[1], row.forward[0], row.forward[1],
         row.bytes_per_tick[0] / 1e3, row.bytes_per_tick[1] / 1e3);
  fflush(stdout);
}

void print(const RollbackRow& row) {
  printf("%-5s %6u %8u %7.1f %8.1f %7.1f %8.2f %8.2f %9.2f %9.2f %9.2f %9.2f %8.1f %9.1f %6.2f %8.2f\n", row.config,
         row.bodies, row.contacts, row.bytes / 1e3, row.snapshot_bytes / 1e3, row.delta_bytes / 1e3, row.save,
         row.restore, row.whole_save, row.whole_restore, row.save_delta, row.restore_delta, row.step, row.resim8,
         row.resim8 / row.step, row.digest);
  fflush(stdout);
}

}  // namespace

CLI::App* add_rollback_command(CLI::App& app, RollbackOptions& options) {
  CLI::App* command = app.add_subcommand("rollback", k_help);
  command->add_option("--bodies", options.bodies, "That move in the pit, separated by commas")
      ->delimiter(',')
      ->check(CLI::Range(1, 20000))
      ->capture_default_str();
  command->add_option("--configs", options.configs, "Only these")
      ->delimiter(',')
      ->check(CLI::IsMember({"fx64", "fx32", "f32", "f64"}));
  command->add_option("--repetitions", options.repetitions, "Rollbacks")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command->add_flag("--sparse", options.sparse, "Measure sparse rollback instead");
  command->add_option("--json", options.json, "Write the rows to this file");
  return command;
}

int run_rollback(const RollbackOptions& options) {
  const Clock clock = calibrated_clock([] {
    const uint64_t start = ticks();
    return ticks() - start;
  });
  if (options.sparse)
    printf("%-5s %-10s %7s %6s %9s %9s %6s %9s %9s %8s %8s\n", "", "scene", "bodies", "whole", "again", "of all",
           "ratio", "forward", "of all", "kB", "of all");
  else
    printf("%-5s %6s %8s %7s %8s %7s %8s %8s %9s %9s %9s %9s %8s %9s %6s %8s\n", "", "bodies", "contacts", "kB",
           "whole", "delta", "save", "restore", "w. save", "w. rest.", "d. save", "d. rest.", "step", "resim8", "steps",
           "digest");
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  bool good = true;
  for (const RollbackEngine& engine : all_rollback_engines()) {
    if (!options.configs.empty() &&
        std::find(options.configs.begin(), options.configs.end(), engine.config) == options.configs.end())
      continue;
    for (const bool apart : {true, false}) {
      if (!options.sparse) continue;
      const SparseRow row = engine.measure_sparse(apart, options.repetitions, clock);
      print(row);
      rows.push_back(json_of(row));
      good = good && row.exact && row.allocations == 0;
    }
    for (const uint32_t bodies : options.bodies) {
      if (options.sparse) continue;
      const char* problem = nullptr;
      const RollbackRow row = engine.measure(bodies, options.repetitions, clock, problem);
      if (problem != nullptr) {
        fprintf(stderr, "bench: %s\n", problem);
        return 1;
      }
      print(row);
      rows.push_back(json_of(row));
      good = good && row.exact && row.allocations == 0;
    }
  }
  if (!good) fprintf(stderr, "bench: a state that was made again differs, or memory was allocated\n");
  if (!options.json.empty() && !(std::ofstream(options.json) << rows.dump(1) << "\n")) {
    fprintf(stderr, "bench: %s cannot be written\n", options.json.c_str());
    return 1;
  }
  return good ? 0 : 1;
}

}  // namespace detent_bench
