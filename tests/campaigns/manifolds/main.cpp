#include <stdio.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <optional>

#include "tests/campaigns/manifolds/engines.h"
#include "tests/campaigns/manifolds/report.h"

using namespace detent_manifolds;

namespace {

constexpr int k_exit_good = 0, k_exit_usage = 2;

struct Options {
  uint32_t count = 10000, worst = 5;
  uint64_t seed = 1;
  std::optional<uint64_t> seed_only;
  std::vector<std::string> configs, kinds;
  std::string markdown, list;
};

bool has(const std::vector<std::string>& names, const std::string& name) {
  return names.empty() || std::count(names.begin(), names.end(), name) != 0;
}

void print_solid(const char* name, const Solid& solid) {
  printf("%s: %s", name, name_of(solid));
  if (solid.kind == SolidKind::box)
    printf(" %.9g %.9g %.9g", solid.half_extents[0], solid.half_extents[1], solid.half_extents[2]);
  else if (solid.kind != SolidKind::hull)
    printf(" radius %.9g, half length %.9g", solid.radius, solid.half_length);
  printf("\n");
  for (const Triple& point : solid.points) printf("    %.9g %.9g %.9g\n", point[0], point[1], point[2]);
}
void print_pose(const char* name, const Pose& pose) {
  printf("  %s at %.12g %.12g %.12g, rotation %.12g %.12g %.12g %.12g\n", name, pose.position[0], pose.position[1],
         pose.position[2], pose.rotation[0], pose.rotation[1], pose.rotation[2], pose.rotation[3]);
}

/// Prints one pair in full.
void print(uint64_t seed, const Engine& engine) {
  const Scene scene = random_scene(seed);
  printf("%s, seed %llu: %s, %s, %s, gap %g m, lean %g rad, tolerance %g m, mesh of %u cells\n", engine.config.c_str(),
         static_cast<unsigned long long>(seed), name_of(scene.kind), name_of(scene.motion), scene.shapes().c_str(),
         scene.gap, scene.lean, scene.tolerance, scene.mesh_cells);
  print_solid("A", scene.a);
  print_solid("B", scene.b);
  const Followed followed = engine.follow(scene);
  if (!followed.problem.empty()) printf("%s\n", followed.problem.c_str());
  judge(scene, followed, [](uint32_t index, const Tick& tick, const Reading& reading) {
    printf("tick %u%s%s%s, gap %.9g m of %g m, normal %.6Lf %.6Lf %.6Lf in A's axes, patch %g m^2\n", index,
           tick.stepped.reused ? ", reused" : "", tick.stepped.seam ? ", seam" : "",
           tick.stepped.capped ? ", capped" : "", reading.gap, tick.distance_max, reading.normal.x, reading.normal.y,
           reading.normal.z, reading.patch_area);
    for (uint32_t i = 0; i < k_measures; ++i) printf("  %s %.3g", name_of(static_cast<Measure>(i)), reading.value[i]);
    printf("%s%s\n", reading.lost ? "  LOST" : "", reading.idle ? "  IDLE" : "");
    print_pose("A", tick.a);
    print_pose("B", tick.b);
    printf("  normal %.9f %.9f %.9f\n", tick.stepped.normal[0], tick.stepped.normal[1], tick.stepped.normal[2]);
    for (size_t i = 0; i < tick.stepped.points.size(); ++i) {
      const FoundPoint& point = tick.stepped.points[i];
      printf("    %.9f %.9f %.9f from A, separation %.9g m, feature %llx", point.from_a[0], point.from_a[1],
             point.from_a[2], point.separation, static_cast<unsigned long long>(point.feature));
      if (i < reading.points.size())
        printf("; gap %.9g m, %.3g m beyond", reading.points[i].gap, reading.points[i].outside);
      printf("\n");
    }
  });
}

bool run(const Options& options, const Engine& engine) {
  std::vector<Verdict> verdicts;
  for (uint64_t seed = options.seed; verdicts.size() < options.count; ++seed) {
    if (!has(options.kinds, name_of(kind_of(seed)))) continue;
    const Scene scene = random_scene(seed);
    verdicts.push_back(judge(scene, engine.follow(scene)));
    if (!verdicts.back().problem.empty()) fprintf(stderr, "detent_manifolds: %s\n", verdicts.back().problem.c_str());
    if (verdicts.size() % 100 == 0)
      fprintf(stderr, "\r%s: %zu of %u ", engine.config.c_str(), verdicts.size(), options.count);
  }
  fprintf(stderr, "\n");
  const auto tables = [&](bool markdown) {
    return tables_of(verdicts, markdown) + worst_of(verdicts, options.worst, markdown);
  };
  printf("%s, %u pairs of %u ticks, seeds from %llu on\n\n%s", engine.config.c_str(), options.count, k_ticks,
         static_cast<unsigned long long>(options.seed), tables(false).c_str());
  fflush(stdout);
  const auto append = [](const std::string& path, const std::string& what) {
    return path.empty() || static_cast<bool>(std::ofstream(path, std::ios::app) << what);
  };
  return append(options.markdown, "### " + engine.config + "\n\n" + tables(true)) &&
         append(options.list, lines_of(verdicts, engine.config));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Measures the contact points of pairs that rest and slide against an oracle", "detent_manifolds");
  Options options;
  app.add_option("--count", options.count, "Pairs")->capture_default_str();
  app.add_option("--seed", options.seed, "Of the first pair")->capture_default_str();
  app.add_option("--seed-only", options.seed_only, "Print the pair of this seed in full");
  app.add_option("--configs", options.configs, "Only these, separated by commas")->delimiter(',');
  app.add_option("--kinds", options.kinds,
                 "Only these: aligned,turned,overhang,leaning,edge,along,crossing,corner,rim,large,mesh")
      ->delimiter(',');
  app.add_option("--worst", options.worst, "How many pairs of each measure are named")->capture_default_str();
  app.add_option("--markdown", options.markdown, "Append the tables to this file");
  app.add_option("--list", options.list, "Append a line a pair to this file, as CSV");
  CLI11_PARSE(app, argc, argv);
  for (const std::string& kind : options.kinds) {
    bool known = false;
    for (uint32_t i = 0; i < k_kinds; ++i) known = known || kind == name_of(static_cast<Kind>(i));
    if (known) continue;
    fprintf(stderr, "detent_manifolds: no kind %s\n", kind.c_str());
    return k_exit_usage;
  }
  bool any = false;
  for (const Engine& engine : all_engines()) {
    if (!has(options.configs, engine.config)) continue;
    any = true;
    if (options.seed_only)
      print(*options.seed_only, engine);
    else if (!run(options, engine)) {
      fprintf(stderr, "detent_manifolds: a file cannot be written\n");
      return k_exit_usage;
    }
  }
  if (!any) fprintf(stderr, "detent_manifolds: no such configuration in this build\n");
  return any ? k_exit_good : k_exit_usage;
}
