#include "tests/bench/world/command.h"

#include <stdio.h>

#include <algorithm>
#include <fstream>

#include "tests/bench/draw.h"
#include "tests/bench/terminal.h"
#include "tests/bench/world/engines.h"
#include "tests/bench/world/measure.h"

namespace detent_bench {

namespace {

constexpr int k_exit_good = 0;
constexpr int k_exit_bad = 1;
constexpr int k_exit_usage = 2;

constexpr const char* k_help =
    R"(The whole step: this library against Bullet and ODE on the scenes of the stress tests, one thread, 60 Hz.
  us        of a step: the median, 99th percentile and maximum of all timed steps of all repetitions
  ratio     of the medians, to Bullet in double
  contacts  contact points, the mean over the window; ns each: the median by them
  kB        this library: the world's block; a peer: what its heap holds
  allocs    calls of malloc and its kin while steps were timed
  losses    contacts and values lost to full pools since the start, where the engine tells
  drift     m, the farthest that a body went along the floor (dominoes: sideways); sag: likewise, downwards
  penetration  m, of the exact shapes of the pairs that overlap, by this library's contact points
  stretch   of a chain: how much longer it is than its links, over their length; at most, and late: the mean of the
            last third
  speed     m/s, of the bodies, mean over the window
  energy    J/kg, of motion and height, gained since the start by the window's end
Of a step during which another process had the core, the thread's own time counts.
The engines run one after another, in an order that rotates from repetition to repetition, each in a world of its own
from the first tick on. What is measured but time comes from a run of its own.)";

bool named(const std::vector<std::string>& names, const std::string& name) {
  return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

/// An engine of whose configurations none is named takes part with all of them: so `--configs fx64` has its peers.
WorldEngineList chosen(const WorldEngineList& engines, const WorldOptions& options) {
  WorldEngineList result;
  for (const WorldEngine& engine : engines) {
    const bool any = std::any_of(engines.begin(), engines.end(), [&](const WorldEngine& other) {
      return std::string(other.engine) == engine.engine && named(options.configs, other.config);
    });
    if (named(options.engines, engine.engine) && (!any || named(options.configs, engine.config)))
      result.push_back(engine);
  }
  return result;
}

bool scene_chosen(const std::vector<std::string>& names, const std::string& name) {
  return std::any_of(names.begin(), names.end(),
                     [&](const std::string& wanted) { return name == wanted || name.rfind(wanted + "-", 0) == 0; });
}

/// As they are, and for a study as they might be.
std::vector<Contestant> contestants_of(const WorldEngineList& engines, bool study) {
  std::vector<Contestant> result;
  for (const WorldEngine& engine : engines) {
    result.push_back({engine, {}});
    if (!study) continue;
    const bool peer = std::string(engine.engine) != "detent";
    if (peer) {
      for (const uint32_t iterations : {2u, 5u, 10u, 20u, 40u, 80u}) result.push_back({engine, {0, iterations}});
      continue;
    }
    for (const uint32_t iterations : {1u, 2u, 4u}) {
      for (const uint32_t substeps : {1u, 2u, 4u, 8u, 16u, 32u}) result.push_back({engine, {substeps, iterations}});
    }
  }
  return result;
}

}  // namespace

CLI::App* add_world_command(CLI::App& app, WorldOptions& options) {
  CLI::App* command = app.add_subcommand("world", k_help);
  std::vector<std::string> names;
  for (const WorldScene& scene : world_scenes()) names.emplace_back(scene.name);
  command
      ->add_option("--scenes", options.scenes,
                   "Only these, separated by commas; S10 stands for S10-asleep and S10-one-awake too (default: all; of "
                   "a study S1 and S6)")
      ->delimiter(',')
      ->check(CLI::IsMember(names));
  command->add_option("--engines", options.engines, "Only these")
      ->delimiter(',')
      ->check(CLI::IsMember({"detent", "bullet", "ode"}));
  command->add_option("--configs", options.configs, "Only these, of an engine that has one of them")
      ->delimiter(',')
      ->check(CLI::IsMember({"fx64", "fx32", "f32", "f64", "double", "float"}));
  command->add_option("--repetitions", options.repetitions, "Timed runs of each engine and scene")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command
      ->add_option("--steps", options.steps,
                   "Stop each scene after this many ticks; a window that is over by then ends there")
      ->check(CLI::Range(1, 1000000));
  command->add_flag("--study", options.study, "Time against error over 1, 2, 4 iterations and 1 to 32 substeps");
  command->add_option("--json", options.json, "Write the rows to this file");
  command->add_option("--plot", options.plot, "Draw the rows (SVG) into this folder");
  return command;
}

int run_world(WorldOptions options) {
  if (options.scenes.empty()) {
    for (const WorldScene& scene : world_scenes()) options.scenes.emplace_back(scene.name);
    if (options.study) options.scenes = {"S1", "S6"};
  }
  std::string problem;
  const WorldEngineList engines = chosen(all_world_engines(problem), options);
  if (!problem.empty()) fprintf(stderr, "bench: a peer is left out: %s\n", problem.c_str());
  if (engines.empty()) {
    fprintf(stderr, "bench: this build has no such engine and configuration\n");
    return k_exit_usage;
  }

  std::vector<WorldRow> rows;
  for (const WorldScene& scene : world_scenes()) {
    if (!scene_chosen(options.scenes, scene.name)) continue;
    WorldFindings findings;
    {
      Line line(std::string("scene ") + scene.name);
      findings = measure_world(scene, contestants_of(engines, options.study), options.repetitions,
                               options.steps != 0 ? options.steps : UINT32_MAX,
                               [&line](uint64_t done, uint64_t total) { line.show(done, total); });
    }
    for (const std::string& reason : findings.left_out)
      fprintf(stderr, "bench: scene %s goes without %s\n", scene.name, reason.c_str());
    if (findings.interrupted * 100 > findings.asked)
      fprintf(stderr,
              "bench: scene %s: other processes took the core during %llu of %llu steps: the times are not the best\n",
              scene.name, static_cast<unsigned long long>(findings.interrupted),
              static_cast<unsigned long long>(findings.asked));
    printf("%s: %s\n%s\n", scene.name, scene.text, world_table_of(findings.rows, options.study).c_str());
    fflush(stdout);
    rows.insert(rows.end(), findings.rows.begin(), findings.rows.end());
  }
  if (rows.empty()) {
    fprintf(stderr, "bench: nothing was timed\n");
    return k_exit_bad;
  }
  printf("ratios of the medians\n%s", world_summary_of(rows).c_str());
  const std::string json = world_json_of(rows, options.study);
  if (!options.json.empty() && !(std::ofstream(options.json) << json)) {
    fprintf(stderr, "bench: %s cannot be written\n", options.json.c_str());
    return k_exit_bad;
  }
  if (!options.plot.empty() && !draw(options.plot, options.study ? "world-study.json" : "world.json", json)) {
    fprintf(stderr, "bench: the plots could not be drawn (Debian: python3-matplotlib)\n");
    return k_exit_bad;
  }
  const bool lost = std::any_of(rows.begin(), rows.end(), [](const WorldRow& row) { return row.losses != 0; });
  if (lost) fprintf(stderr, "bench: a world lost contacts or values: see losses\n");
  return k_exit_good;
}

}  // namespace detent_bench
