#include <stdio.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>

#include "tests/campaigns/stress/engines.h"
#include "tests/campaigns/stress/report.h"

using namespace detent_stress;

namespace {

constexpr int k_exit_good = 0, k_exit_bad = 1, k_exit_usage = 2;

struct Options {
  std::vector<std::string> scenes, configs;
  std::vector<double> scales = {1};
  uint32_t seeds = 1, first_seed = 0;
  bool list = false, gaps = false;
  Settings settings;
  Effort effort = Effort::brief;
  std::string markdown, json;
};

/// Selects a group by its full name, a scene by a prefix of its name; S5 does not select S52.
bool wanted(const std::vector<std::string>& names, const Case& which) {
  if (names.empty()) return !which.extra;
  return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
    if (name == which.group) return !which.extra;
    return which.extra ? which.name == name : which.name.compare(0, name.size(), name) == 0;
  });
}

bool write(const std::string& path, const std::string& text) {
  if (path.empty() || std::ofstream(path) << text) return true;
  fprintf(stderr, "detent_stress: %s cannot be written\n", path.c_str());
  return false;
}

int run(const Options& options) {
  std::vector<Row> rows;
  for (const Case& which : all_cases()) {
    if (!wanted(options.scenes, which)) continue;
    for (const double scale : options.scales) {
      for (const Engine& engine : all_engines()) {
        if (!options.configs.empty() && std::count(options.configs.begin(), options.configs.end(), engine.config) == 0)
          continue;
        for (uint64_t seed = options.first_seed; seed < options.first_seed + uint64_t{options.seeds}; ++seed) {
          const Trial trial = {engine, options.settings, scale, seed, options.effort};
          rows.push_back({which.group, which.name, engine.config, scale, seed, run_case(which, trial)});
          printf("%s\n", line_of(rows.back()).c_str());
          fflush(stdout);
        }
      }
    }
  }
  if (rows.empty()) {
    fprintf(stderr, "detent_stress: no such scene and configuration (--list)\n");
    return k_exit_usage;
  }
  if (options.gaps) printf("\n%s", gaps_of(rows).c_str());
  return write(options.markdown, markdown_of(rows)) && write(options.json, json_of(rows)) ? k_exit_good : k_exit_bad;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Runs the stress scenes and says what is wanted of each and what was measured", "detent_stress");
  Options options;
  app.add_option("--scenes", options.scenes, "Groups (S1 ... S12) or names or how they start, separated by commas")
      ->delimiter(',');
  app.add_option("--configs", options.configs, "Only these")->delimiter(',');
  app.add_option("--scales", options.scales, "Times the scenes' lengths, e.g. 1,0.01,100")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--seeds", options.seeds, "How many")->capture_default_str();
  app.add_option("--first-seed", options.first_seed, "0 is a scene as written where it has no noise of its own")
      ->capture_default_str();
  app.add_option("--substeps", options.settings.substeps, "Instead of the library's default");
  app.add_option("--iterations", options.settings.iterations, "Instead of the library's default");
  app.add_option("--reuse", options.settings.contact_recycle_distance,
                 "Instead of the library's default; 0: contact points always anew");
  app.add_option("--reduction", options.settings.reduction, "1 projected extremes, 2 deepest and area");
  app.add_flag(
      "--full", [&options](int64_t) { options.effort = Effort::full; },
      "The scenes as long and as large as they are written; otherwise a fraction of them");
  app.add_flag("--gaps", options.gaps, "Print what misses what is wanted as rows for bounds.h");
  app.add_flag("--list", options.list, "List the scenes");
  app.add_option("--markdown", options.markdown, "Write a table to this file");
  app.add_option("--json", options.json, "Write the rows to this file");
  CLI11_PARSE(app, argc, argv);
  if (options.list) {
    for (const Case& which : all_cases())
      printf("%-4s %s%s\n", which.group.c_str(), which.name.c_str(), which.extra ? " (only by its name)" : "");
    return k_exit_good;
  }
  return run(options);
}
