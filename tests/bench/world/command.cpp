#include "tests/bench/world/command.h"

#include <stdio.h>

#include <algorithm>
#include <fstream>

#include "tests/bench/draw.h"
#include "tests/bench/ground_option.h"
#include "tests/bench/terminal.h"
#include "tests/bench/world/engines.h"
#include "tests/bench/world/measure.h"
#include "tests/common/support/ground.h"

namespace detent_bench {

namespace {

constexpr int k_exit_good = 0;
constexpr int k_exit_bad = 1;
constexpr int k_exit_usage = 2;

constexpr const char* k_help =
    R"(The whole step: this library against Bullet and ODE on the scenes of the stress tests, one thread, 60 Hz.
  us        of a step: the median, 99th percentile and maximum over the ticks, of each tick's least time of the
            repetitions
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
  error     of a study, m: the root mean square, over ticks and bodies, of the distance of a body's points from those of
            the exact motion, or of that in f64 with a 64th of the tick; reference: how far this moves when its steps
            are twice as long
  stages    shares of the time of this library's step, from a run that is not timed
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
  return names.empty() || std::any_of(names.begin(), names.end(), [&](const std::string& wanted) {
           return name == wanted || name.rfind(wanted + "-", 0) == 0;
         });
}

/// As they are, and for a study by the knobs that each engine has.
std::vector<Contestant> contestants_of(const WorldEngineList& engines, const WorldOptions& options) {
  std::vector<Contestant> result;
  for (const WorldEngine& engine : engines) {
    const bool own = std::string(engine.engine) == "detent";
    result.push_back({engine, {}});
    if (own && (options.study || options.accuracy)) {
      for (const uint32_t penetration : {8u, 32u, 512u, 2048u}) result.push_back({engine, {0, 0, penetration}});
    }
    if (!options.study) continue;
    for (const uint32_t substeps : {1u, 2u, 4u, 8u, 16u, 32u}) result.push_back({engine, {substeps, 0, 0}});
    if (own) continue;
    for (const uint32_t iterations : {2u, 5u, 10u, 20u, 40u, 80u}) result.push_back({engine, {0, iterations, 0}});
  }
  return result;
}

/// What is to be measured, and against what.
struct Task {
  WorldScene scene;
  const WorldStudy* study = nullptr;
};

std::vector<Task> tasks_of(const WorldOptions& options) {
  std::vector<Task> tasks;
  if (options.growth) {
    for (const uint32_t bodies : options.bodies) tasks.push_back({growth_scene(bodies)});
    return tasks;
  }
  if (options.study) {
    for (const WorldStudy& study : world_studies()) {
      if (scene_chosen(options.scenes, study.scene.name)) tasks.push_back({study.scene, &study});
    }
    return tasks;
  }
  for (const WorldScene& scene : world_scenes()) {
    if (scene_chosen(options.scenes, scene.name)) tasks.push_back({scene});
  }
  return tasks;
}

/// Only what is an error in this scene, the error of the motion first.
void keep_errors(const WorldStudy& study, WorldRow& row) {
  std::vector<std::pair<std::string, double>> kept;
  const auto keep = [&](const std::string& name) {
    const auto found = std::find_if(row.measures.begin(), row.measures.end(),
                                    [&name](const auto& measure) { return measure.first == name; });
    if (found != row.measures.end()) kept.push_back(*found);
  };
  keep("error");
  for (const char* name : study.errors) keep(name);
  keep("reference");
  row.measures = kept;
}

void tell_of(const WorldFindings& findings, const std::string& scene) {
  for (const std::string& reason : findings.left_out)
    fprintf(stderr, "bench: scene %s goes without %s\n", scene.c_str(), reason.c_str());
  const uint64_t asked = findings.interruptions.asked(), interrupted = findings.interruptions.interrupted();
  if (interrupted * 100 > asked)
    fprintf(stderr, "bench: scene %s: other processes took the core during %llu of %llu steps\n", scene.c_str(),
            static_cast<unsigned long long>(interrupted), static_cast<unsigned long long>(asked));
}

std::vector<WorldRow> run_task(const Task& task, detent_test::Ground ground, const WorldOptions& options,
                               const WorldEngineList& all, const WorldEngineList& engines) {
  WorldPlan plan;
  plan.ground = ground;
  plan.repetitions = options.repetitions;
  if (options.steps != 0) plan.ticks_max = options.steps;
  plan.measures = !options.growth;
  std::unique_ptr<Reference> reference;
  std::string problem;
  const std::string name = task.scene.name + " " + detent_test::ground_name(ground);
  if (task.study != nullptr) {
    reference = make_reference(*task.study, on_ground(task.scene.stage(), ground), all, problem);
    if (reference == nullptr) fprintf(stderr, "bench: %s: %s\n", name.c_str(), problem.c_str());
    plan.reference = reference.get();
  }
  Line line("scene " + name);
  WorldFindings findings = measure_world(task.scene, contestants_of(engines, options), plan,
                                         [&line](uint64_t done, uint64_t total) { line.show(done, total); });
  tell_of(findings, name);
  for (WorldRow& row : findings.rows) {
    if (task.study != nullptr) keep_errors(*task.study, row);
  }
  return findings.rows;
}

}  // namespace

CLI::App* add_world_command(CLI::App& app, WorldOptions& options) {
  CLI::App* command = app.add_subcommand("world", k_help);
  std::vector<std::string> names;
  for (const WorldScene& scene : world_scenes()) names.push_back(scene.name);
  for (const WorldStudy& study : world_studies()) {
    if (std::find(names.begin(), names.end(), study.scene.name) == names.end()) names.push_back(study.scene.name);
  }
  command
      ->add_option(
          "--scenes", options.scenes,
          "Only these, separated by commas; S10 stands for S10-asleep and S10-one-awake too; a study has scenes "
          "of its own, S1 to roll (default: all)")
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
  add_ground_option(*command, options.ground);
  CLI::Option* const study = command->add_flag(
      "--study", options.study,
      "Time against error over 1 to 32 substeps, of peers 1 to 32 steps a tick and 2 to 80 iterations, and with "
      "--accuracy; --ground box");
  command->add_flag("--accuracy", options.accuracy,
                    "Detent also with a resting_penetration of 1/8, 1/32, 1/512 and 1/2048 (default: 1/144)");
  CLI::Option* const growth = command->add_flag(
      "--growth", options.growth, "The pit of S4 with more and more bodies, as deep but wider; --ground box");
  growth->excludes(study);
  command->add_option("--bodies", options.bodies, "Of --growth")
      ->delimiter(',')
      ->check(CLI::Range(64, 65536))
      ->capture_default_str();
  command->add_option("--json", options.json, "Write the rows to this file");
  command->add_option("--plot", options.plot, "Draw the rows (SVG) into this folder");
  return command;
}

int run_world(WorldOptions options) {
  if (options.ground.empty()) options.ground = options.study || options.growth ? "box" : "both";
  std::string problem;
  const WorldEngineList all = all_world_engines(problem), engines = chosen(all, options);
  if (!problem.empty()) fprintf(stderr, "bench: a peer is left out: %s\n", problem.c_str());
  if (engines.empty()) {
    fprintf(stderr, "bench: this build has no such engine and configuration\n");
    return k_exit_usage;
  }

  std::vector<WorldRow> rows;
  for (const Task& task : tasks_of(options)) {
    printf("%s: %s\n", task.scene.name.c_str(), task.scene.text.c_str());
    for (const detent_test::Ground ground : detent_test::grounds_of(options.ground, has_ground(task.scene.stage()))) {
      const std::vector<WorldRow> of_scene = run_task(task, ground, options, all, engines);
      printf("%s", world_table_of(of_scene).c_str());
      fflush(stdout);
      rows.insert(rows.end(), of_scene.begin(), of_scene.end());
    }
  }
  if (rows.empty()) {
    fprintf(stderr, "bench: nothing was timed\n");
    return k_exit_bad;
  }
  if (options.growth)
    printf("ns a body and step, medians\n%s", growth_table_of(rows).c_str());
  else
    printf("ratios of the medians\n%s", world_summary_of(rows).c_str());
  const std::string json = world_json_of(rows, options.study);
  if (!options.json.empty() && !(std::ofstream(options.json) << json)) {
    fprintf(stderr, "bench: %s cannot be written\n", options.json.c_str());
    return k_exit_bad;
  }
  const char* const name = options.study ? "world-study.json" : options.growth ? "world-growth.json" : "world.json";
  if (!options.plot.empty() && !draw(options.plot, name, json)) {
    fprintf(stderr, "bench: the plots could not be drawn (Debian: python3-matplotlib)\n");
    return k_exit_bad;
  }
  const bool lost = std::any_of(rows.begin(), rows.end(), [](const WorldRow& row) { return row.losses != 0; });
  if (lost) fprintf(stderr, "bench: a world lost contacts or values: see losses\n");
  return k_exit_good;
}

}  // namespace detent_bench
