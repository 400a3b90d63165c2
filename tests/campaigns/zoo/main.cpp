#include <stdio.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>

#include "tests/campaigns/zoo/random_list.h"
#include "tests/campaigns/zoo/random_run.h"
#include "tests/campaigns/zoo/report.h"

using namespace detent_zoo;

namespace {

constexpr int k_exit_good = 0, k_exit_bad = 1;
constexpr unsigned long long k_seeds_max = 1000000;
constexpr const char* k_folder = DETENT_ROOT "/tests/campaigns/zoo/scenes";

struct Options {
  std::vector<std::string> scenes, configs;
  std::string list_file, markdown, random, folder = DETENT_RANDOM_SCENES;
  bool list = false, renew = false;
  uint32_t vary = 0;
  Variation variation;
};

bool wanted(const std::vector<std::string>& names, const std::string& name) {
  return names.empty() || std::any_of(names.begin(), names.end(),
                                      [&](const std::string& each) { return name.compare(0, each.size(), each) == 0; });
}

int cannot(const std::string& what) {
  fprintf(stderr, "detent_zoo: %s\n", what.c_str());
  return k_exit_bad;
}

bool write_page(const std::string& path, const std::vector<Row>& rows) {
  std::ifstream file(path);
  const std::string page = {std::istreambuf_iterator<char>(file), {}};
  return static_cast<bool>(std::ofstream(path) << page_of(page, rows));
}

/// Plays variations of a scene, whose gravity differs by 2^-16 each, and prints how many of them fail. Returns false if
/// one could not be played.
bool vary(const Entry& entry, const Engine& engine, uint32_t count, Variation variation) {
  const double gravity = variation.gravity;
  uint32_t fails = 0;
  std::map<std::string, uint32_t> checks;
  for (uint32_t number = 1; number <= count; ++number) {
    variation.gravity = gravity * (1 + number * 0x1p-16);
    const Verdict verdict = visit(entry, engine, k_folder, detent_test::Ground::own, variation);
    if (!verdict.problem.empty()) return cannot(entry.scene + ": " + verdict.problem) == k_exit_good;
    fails += verdict.failed.empty() ? 0u : 1u;
    for (const std::string& check : verdict.failed) ++checks[check];
  }
  printf("%s %s: %u of %u fail", entry.scene.c_str(), engine.config, fails, count);
  for (const auto& [check, times] : checks) printf(", %s %u", check.c_str(), times);
  printf("\n");
  fflush(stdout);
  return true;
}

std::vector<Engine> engines_of(const Options& options) {
  std::vector<Engine> engines;
  for (const Engine& engine : all_engines()) {
    if (options.configs.empty() || std::count(options.configs.begin(), options.configs.end(), engine.config) != 0)
      engines.push_back(engine);
  }
  return engines;
}

std::string list_file_of(const Options& options) {
  if (!options.list_file.empty()) return options.list_file;
  return std::string(DETENT_ROOT "/tests/campaigns/zoo/") + (options.random.empty() ? "zoo.csv" : "random.csv");
}

int play_random(const Options& options) {
  RandomRun run;
  unsigned long long first = 0, last = 0;
  char rest = 0;
  if (sscanf(options.random.c_str(), "%llu:%llu%c", &first, &last, &rest) != 2 || first > last)
    return cannot("--random needs FIRST:LAST");
  if (last - first >= k_seeds_max) return cannot("--random takes at most " + std::to_string(k_seeds_max) + " seeds");
  if (options.renew && (first != 1 || last != k_seeds_tested))
    return cannot("the list has the seeds of the test: --random 1:" + std::to_string(k_seeds_tested));
  run.first = first;
  run.last = last;
  run.folder = options.folder;
  run.assets = k_folder;
  run.list_file = list_file_of(options);
  run.renew = options.renew;
  run.variation = options.variation;
  std::string problem;
  const bool good = run_random(run, engines_of(options), problem);
  if (!problem.empty()) return cannot(problem);
  return good ? k_exit_good : k_exit_bad;
}

int run(const Options& options) {
  std::string problem;
  const std::string list_file = list_file_of(options);
  std::vector<Entry> entries = read_list(list_file, problem);
  if (!problem.empty()) return cannot(problem);
  const std::vector<Engine> engines = engines_of(options);
  std::vector<Row> rows;
  bool good = true;
  const bool terminal = isatty(STDERR_FILENO) == 1;
  const auto start = std::chrono::steady_clock::now();
  for (Entry& entry : entries) {
    if (!wanted(options.scenes, entry.scene)) continue;
    if (options.list) {
      printf("%-28s %-40s %s\n", entry.scene.c_str(), entry.source.c_str(), entry.wants.c_str());
      continue;
    }
    for (const Engine& engine : engines) {
      if (terminal) fprintf(stderr, "\r\033[K%s %s", entry.scene.c_str(), engine.config);
      if (options.vary != 0) {
        if (terminal) fprintf(stderr, "\r\033[K");
        good = vary(entry, engine, options.vary, options.variation) && good;
        continue;
      }
      const Row row = {&entry, engine.config,
                       visit(entry, engine, k_folder, detent_test::Ground::own, options.variation)};
      const std::string surprise = surprises(entry, engine.config, row.verdict);
      if (terminal) fprintf(stderr, "\r\033[K");
      printf("%s\n", line_of(row).c_str());
      if (!surprise.empty()) {
        printf("  not as the list says: %s  to see it: detent view %s/%s.json --config %s -o page.html\n",
               surprise.c_str(), k_folder, entry.scene.c_str(), engine.config);
      }
      fflush(stdout);
      good = good && surprise.empty();
      if (!row.verdict.problem.empty()) continue;
      entry.gaps[engine.config] = row.verdict.failed;
      rows.push_back(row);
    }
  }
  if (options.list || options.vary != 0) return good ? k_exit_good : k_exit_bad;
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  fprintf(stderr, "%zu runs, %.1f s\n", rows.size(), seconds.count());
  if (options.renew && !write_list(list_file, entries)) return cannot(list_file + " cannot be written");
  if (!options.markdown.empty() && !write_page(options.markdown, rows)) {
    return cannot(options.markdown + " cannot be written");
  }
  return good || options.renew ? k_exit_good : k_exit_bad;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Plays the scenes of tests/campaigns/zoo and checks them tick by tick (docs/zoo.md)", "detent_zoo");
  Options options;
  CLI::Option* const scenes =
      app.add_option("--scenes", options.scenes, "Only those whose names start so, separated by commas")
          ->delimiter(',');
  CLI::Option* const configs = app.add_option("--configs", options.configs, "Only these")->delimiter(',');
  CLI::Option* const random =
      app.add_option("--random", options.random, "Play random scenes instead, with the seeds FIRST:LAST")
          ->excludes(scenes);
  app.add_option("--folder", options.folder, "Write the random scenes there, for detent view")
      ->needs(random)
      ->capture_default_str();
  app.add_option("--list-file", options.list_file, "Instead of zoo.csv, or random.csv, in tests/campaigns/zoo");
  app.add_flag("--list", options.list, "List the scenes")->excludes(random);
  CLI::Option* const renew =
      app.add_flag("--renew", options.renew, "Write the list anew: what failed in this run are the known gaps");
  CLI::Option* const markdown =
      app.add_option("--markdown", options.markdown, "Write the table of all into this page: docs/zoo.md")
          ->excludes(scenes)
          ->excludes(configs)
          ->excludes(random);
  app.add_option("--vary", options.vary,
                 "Play each scene so often, each time with a slightly stronger gravity, and count the failures")
      ->check(CLI::Range(1u, 1000u))
      ->excludes(renew)
      ->excludes(random)
      ->excludes(markdown);
  app.add_option("--gravity", options.variation.gravity, "Multiply the gravity of the scenes by this factor")
      ->excludes(renew)
      ->excludes(markdown);
  app.add_option(
         "--tick", options.variation.tick,
         "Multiply the tick of the scenes by this factor: 2 for 30 Hz instead of 60. They take as long as before")
      ->check(CLI::Range(1.0 / 64, 64.0))
      ->excludes(renew)
      ->excludes(markdown);
  CLI11_PARSE(app, argc, argv);
  if (engines_of(options).empty()) return cannot("no such configuration in this build");
  return options.random.empty() ? run(options) : play_random(options);
}
