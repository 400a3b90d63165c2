#include "tests/bench/worlds/command.h"

#include <stdio.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/bench/worlds/farm.h"

namespace detent_bench {

namespace {

constexpr const char* k_help =
    R"(Many worlds in one process (docs/worlds.md): arenas in which inputs push the players' balls among boxes. All worlds are
equal for 60 ticks; then each plays the inputs of its own seed.
  awake     bodies that take part in a step after these ticks; mean
  world, state, diff.  KB, of a world's block, of a snapshot, and of the difference of a world from the common state, 60
                       ticks after it
  create    us, of a world and its bodies
  60 ticks  us, of simulating the common start; restore: of restoring its result
  differ, undo  us, of writing a difference, and of restoring it
  tree      how many times as long a tree of inputs (81 leaves, four levels of eight ticks) takes if each leaf is
            simulated from the root, instead of each edge once
Then, of all worlds together, thousands of ticks a second of a thread's processor, and of all threads by the wall clock:
with one world for each thread, which plays one match after the other, and with 100 and 1,000 worlds at the same time, which
take turns after each tick. All play the same ticks.
Then matches verified a second of a processor and by the wall clock: in one process, one world for each thread; and by the
tool, detent verify --jobs, with a process for each recording.
All digests that must be equal are compared: exit code 1 if one differs.)";

constexpr WorldsScene k_scenes[] = {
    {"8", 2, 8, 60, 600},
    {"64", 16, 64, 30, 300},
    {"250", 16, 250, 20, 150},
};

/// Without digits that mean nothing.
double rounded(double value) { return static_cast<double>(static_cast<int64_t>(value * 100 + 0.5)) / 100; }

nlohmann::ordered_json json_of(const std::vector<WorldsVerification>& all) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const WorldsVerification& one : all) {
    rows.push_back({{"jobs", one.jobs},
                    {"matches_per_cpu_second", rounded(one.matches_per_cpu_second)},
                    {"matches_per_second", rounded(one.matches_per_second)}});
  }
  return rows;
}

nlohmann::ordered_json json_of(const WorldsRow& row, const WorldsScene& scene, const WorldsEffort& effort) {
  nlohmann::ordered_json steps = nlohmann::ordered_json::array();
  for (const WorldsSteps& one : row.steps) {
    steps.push_back({{"alive", one.alive},
                     {"threads", one.threads},
                     {"ticks_per_cpu_second", rounded(one.ticks_per_cpu_second)},
                     {"ticks_per_second", rounded(one.ticks_per_second)}});
  }
  return {{"config", row.config},
          {"scene", row.scene},
          {"bodies", row.bodies},
          {"awake", rounded(row.awake)},
          {"world_bytes", row.world_bytes},
          {"snapshot_bytes", row.snapshot_bytes},
          {"difference_bytes", row.difference_bytes},
          {"simulate_us", rounded(row.simulate)},
          {"restore_us", rounded(row.restore)},
          {"create_us", rounded(row.create)},
          {"difference_us", rounded(row.difference)},
          {"undo_us", rounded(row.undo)},
          {"tree_us", rounded(row.tree)},
          {"tree_from_root_us", rounded(row.tree_from_root)},
          {"worlds", effort.worlds},
          {"ticks", scene.ticks},
          {"steps", steps},
          {"recordings", effort.recordings},
          {"match_ticks", scene.match_ticks},
          {"recording_bytes", row.recording_bytes},
          {"verify", json_of(row.verify)},
          {"tool", json_of(row.tool)},
          {"same", row.same}};
}

void print(const WorldsRow& row, const WorldsScene& scene) {
  printf(
      "%-5s %4u bodies, %.0f awake: world %.1f KB, state %.1f, diff. %.1f; create %.0f us, 60 ticks %.0f, restore "
      "%.1f, ",
      row.config.c_str(), row.bodies, row.awake, row.world_bytes / 1e3, row.snapshot_bytes / 1e3,
      row.difference_bytes / 1e3, row.create, row.simulate, row.restore);
  printf("differ %.0f, undo %.0f; tree %.2f\n", row.difference, row.undo, row.tree_from_root / row.tree);
  for (const WorldsSteps& one : row.steps) {
    printf("      %4u worlds, %u threads: %8.2f thousand ticks/s of a processor, %8.2f by the wall clock\n", one.alive,
           one.threads, one.ticks_per_cpu_second / 1e3, one.ticks_per_second / 1e3);
  }
  const auto print_verified = [&](const char* by, const std::vector<WorldsVerification>& all) {
    for (const WorldsVerification& one : all) {
      printf("      matches of %u ticks verified by %u %s: %8.2f/s of a processor, %8.2f by the wall clock\n",
             scene.match_ticks, one.jobs, by, one.matches_per_cpu_second, one.matches_per_second);
    }
  };
  print_verified("threads", row.verify);
  print_verified("processes", row.tool);
  if (!row.same) printf("      DIGESTS DIFFER\n");
  fflush(stdout);
}

template <class Names>
bool is_wanted(const Names& names, const std::string& name) {
  return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

/// Verifies recorded matches, in this process and by the tool in turn. The best of the repetitions counts.
void measure_verification(const WorldsEngine& engine, const WorldsScene& scene, const WorldsEffort& effort,
                          WorldsRow& row) {
  const Recordings recordings = engine.record(scene, effort.recordings);
  size_t bytes = 0;
  for (const auto& recording : recordings) bytes += recording.size();
  row.recording_bytes = static_cast<uint32_t>(bytes / recordings.size());
  const Farm farm(recordings);
  const auto note = [&row](std::vector<WorldsVerification>& all, size_t i, bool good,
                           const WorldsVerification& result) {
    if (i == all.size()) all.push_back({result.jobs});
    all[i].matches_per_cpu_second = std::max(all[i].matches_per_cpu_second, result.matches_per_cpu_second);
    all[i].matches_per_second = std::max(all[i].matches_per_second, result.matches_per_second);
    row.same = row.same && good;
  };
  for (uint32_t repetition = 0; repetition < effort.repetitions; ++repetition) {
    for (size_t i = 0; i < effort.threads.size(); ++i) {
      WorldsVerification result;
      bool good = engine.verify(scene, recordings, effort.threads[i], result);
      note(row.verify, i, good, result);
      if (!has_tool()) continue;
      good = farm.verify(effort.threads[i], result);
      note(row.tool, i, good, result);
    }
  }
}

}  // namespace

CLI::App* add_worlds_command(CLI::App& app, WorldsOptions& options) {
  CLI::App* command = app.add_subcommand("worlds", k_help);
  command->add_option("--bodies", options.scenes, "Only the scenes with so many: 8, 64, 250")
      ->delimiter(',')
      ->check(CLI::IsMember({"8", "64", "250"}));
  command->add_option("--configs", options.configs, "Only these")
      ->delimiter(',')
      ->check(CLI::IsMember({"fx64", "fx32", "f32", "f64"}));
  command->add_option("--threads", options.effort.threads, "Numbers of threads")
      ->delimiter(',')
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  command->add_option("--worlds", options.effort.worlds, "Worlds that are played in each row")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command->add_option("--alive", options.effort.alive, "Of them at the same time; 1: one for each thread")
      ->delimiter(',')
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command->add_option("--recordings", options.effort.recordings, "Matches that are verified")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command->add_option("--repetitions", options.effort.repetitions, "Of each row; the best counts")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--json", options.json, "Write the rows to this file");
  return command;
}

int run_worlds(const WorldsOptions& options) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  bool good = true;
  for (const WorldsScene& scene : k_scenes) {
    if (!is_wanted(options.scenes, scene.name)) continue;
    for (const WorldsEngine& engine : all_worlds_engines()) {
      if (!is_wanted(options.configs, engine.config)) continue;
      WorldsRow row = engine.measure(scene, options.effort);
      measure_verification(engine, scene, options.effort, row);
      print(row, scene);
      rows.push_back(json_of(row, scene, options.effort));
      good = good && row.same;
    }
  }
  if (!good) fprintf(stderr, "bench: digests differ, or detent verify failed\n");
  if (!options.json.empty() && !(std::ofstream(options.json) << rows.dump(1) << "\n")) {
    fprintf(stderr, "bench: %s cannot be written\n", options.json.c_str());
    return 1;
  }
  return good ? 0 : 1;
}

}  // namespace detent_bench
