#include <stdio.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <optional>

#include "tests/campaigns/joint_fuzz/engines.h"
#include "tests/campaigns/joint_fuzz/random_scene.h"
#include "tests/campaigns/joint_fuzz/report.h"
#include "tests/campaigns/joint_fuzz/turn.h"

using namespace detent_joint_fuzz;

namespace {

constexpr int k_exit_good = 0, k_exit_grows = 1, k_exit_usage = 2;

struct Options {
  uint32_t count = 2000, ticks = 600, worst = 20;
  uint64_t seed = 1;
  std::optional<uint64_t> seed_only;
  std::vector<std::string> configs, kinds;
  Settings settings;
  bool markdown = false;
  std::string list;
};

bool has(const std::vector<std::string>& names, const std::string& name) {
  return names.empty() || std::count(names.begin(), names.end(), name) != 0;
}

void print_scene(const Scene& scene) {
  printf("seed %llu: %s, gravity %g, extent %g m, %s\n", static_cast<unsigned long long>(scene.seed),
         name_of(scene.kind), scene.gravity, scene.extent, types_of(scene));
  for (size_t i = 0; i < scene.bodies.size(); ++i) {
    const SceneBody& body = scene.bodies[i];
    constexpr const char* k_solids[] = {"sphere", "box", "capsule"};
    printf("body %zu: %s %g %g %g, %s %g kg, at %g %g %g, %.3g m/s, %.3g rad/s\n", i,
           k_solids[static_cast<uint32_t>(body.solid)], body.size[0], body.size[1], body.size[2],
           body.fixed ? "fixed" : "of", body.fixed ? 0 : body.mass, body.position[0], body.position[1],
           body.position[2], length(body.linear_velocity), length(body.angular_velocity));
  }
  for (const SceneJoint& joint : scene.joints) {
    printf("%s %u to %u: arms %.3g and %.3g m", name_of(joint.hold), joint.a, joint.b, length(joint.anchor_a),
           length(joint.anchor_b));
    for (const SceneAxis* axis : {&joint.axis, &joint.second}) {
      if (axis->limited) printf(", limits %.3g to %.3g", axis->lower, axis->upper);
      if (axis->frequency > 0) printf(", spring %.3g Hz to %.3g", axis->frequency, axis->target);
      if (axis->force_max > 0) printf(", speed %.3g, at most %.3g", axis->speed, axis->force_max);
    }
    printf("\n");
  }
}

/// Replays one scene, with one line for each tick.
int follow(const Options& options, const Engine& engine) {
  const Scene scene = random_scene(*options.seed_only);
  print_scene(scene);
  printf("%s\n%6s %14s %12s %12s %10s %8s %8s %9s\n", engine.config.c_str(), "tick", "energy, J", "given, J",
         "of scale", "gap, m", "rad", "substeps", "saturated");
  double start = 0;
  const Verdict verdict = play(scene, engine, options.settings, {options.ticks}, [&](const Moment& moment) {
    if (moment.tick == 0) start = moment.energy;
    printf("%6u %14.8g %12.5g %12.5g %10.3g %8.2g %8u %9u\n", moment.tick, moment.energy, moment.given,
           (moment.energy - moment.given - start) / moment.scale, moment.gap.length, moment.gap.angle,
           moment.counts.substeps_max, moment.counts.saturations);
  });
  if (!verdict.problem.empty()) fprintf(stderr, "detent_joint_fuzz: %s\n", verdict.problem.c_str());
  if (!verdict.problem.empty()) return k_exit_usage;
  return verdict.grows() ? k_exit_grows : k_exit_good;
}

int run(const Options& options, const Engine& engine) {
  std::vector<Verdict> verdicts;
  uint32_t grow = 0;
  for (uint64_t seed = options.seed; verdicts.size() < options.count; ++seed) {
    if (!has(options.kinds, name_of(kind_of(seed)))) continue;
    verdicts.push_back(play(random_scene(seed), engine, options.settings, {options.ticks}));
    const Verdict& last = verdicts.back();
    if (!last.problem.empty()) {
      fprintf(stderr, "detent_joint_fuzz: %s\n", last.problem.c_str());
      return k_exit_usage;
    }
    grow += last.grows();
    if (verdicts.size() % 50 == 0)
      fprintf(stderr, "\r%s: %zu of %u, %u grow ", engine.config.c_str(), verdicts.size(), options.count, grow);
  }
  fprintf(stderr, "\n");
  printf("%s, %u scenes of %u ticks, seeds from %llu on\n\n%s%s", engine.config.c_str(), options.count, options.ticks,
         static_cast<unsigned long long>(options.seed), tables_of(verdicts, options.markdown).c_str(),
         worst_of(verdicts, options.worst).c_str());
  fflush(stdout);
  if (!options.list.empty()) {
    std::ofstream file(options.list, std::ios::app);
    file << lines_of(verdicts, engine.config);
    if (!file) {
      fprintf(stderr, "detent_joint_fuzz: %s cannot be written\n", options.list.c_str());
      return k_exit_usage;
    }
  }
  return grow != 0 ? k_exit_grows : k_exit_good;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Throws random graphs of joints at the library and says which of them gain energy", "detent_joint_fuzz");
  Options options;
  app.add_option("--count", options.count, "Scenes")->capture_default_str();
  app.add_option("--seed", options.seed, "Of the first scene")->capture_default_str();
  app.add_option("--seed-only", options.seed_only, "Replay the scene of this seed, a line a tick");
  app.add_option("--ticks", options.ticks, "Of each scene")->capture_default_str();
  app.add_option("--configs", options.configs, "Only these, separated by commas")->delimiter(',');
  app.add_option("--kinds", options.kinds, "Only these: pair,tree,loop,net,rope,taut,contact,ground,drive")
      ->delimiter(',');
  app.add_option("--substeps", options.settings.substeps, "Of each tick, instead of those that the world chooses");
  app.add_option("--worst", options.worst, "How many of those that grow are named")->capture_default_str();
  app.add_flag("--markdown", options.markdown, "Tables as in documents");
  app.add_option("--list", options.list, "Append a line a scene to this file, as CSV");
  CLI11_PARSE(app, argc, argv);
  for (const std::string& kind : options.kinds) {
    bool known = false;
    for (uint32_t i = 0; i < k_kinds; ++i) known = known || kind == name_of(static_cast<Kind>(i));
    if (known) continue;
    fprintf(stderr, "detent_joint_fuzz: no kind %s\n", kind.c_str());
    return k_exit_usage;
  }
  int result = k_exit_usage;
  for (const Engine& engine : all_engines()) {
    if (!has(options.configs, engine.config)) continue;
    const int one = options.seed_only ? follow(options, engine) : run(options, engine);
    if (one == k_exit_usage) return one;
    result = result == k_exit_usage ? one : std::max(result, one);
  }
  if (result == k_exit_usage) fprintf(stderr, "detent_joint_fuzz: no such configuration in this build\n");
  return result;
}
