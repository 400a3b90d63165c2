#include "tests/campaigns/zoo/random_run.h"

#include <stdio.h>
#include <unistd.h>

#include "tests/campaigns/zoo/random_list.h"
#include "tests/campaigns/zoo/report.h"

namespace detent_zoo {

namespace {

/// Counts of scenes.
struct Tally {
  uint32_t played = 0, fail = 0;
  std::map<std::string, uint32_t> checks;  ///< that fail, by check

  void take(const std::set<std::string>& failed) {
    ++played;
    fail += failed.empty() ? 0u : 1u;
    for (const std::string& check : failed) ++checks[check];
  }
};

/// The most of a count in a tick of any scene.
struct Most {
  double value = 0;
  std::string where;

  void take(const Row& row, const Worst& worst) {
    if (worst.value <= value) return;
    value = worst.value;
    where = row.entry->scene + " " + row.config + ", tick " + std::to_string(worst.tick);
  }
};

struct Summary {
  std::map<std::string, std::map<std::string, Tally>> tallies;  ///< by configuration, by ground
  Most impacts, tests;
  uint32_t fail = 0;

  void take(const Row& row) {
    const Verdict& verdict = row.verdict;
    tallies[row.config][row.entry->source].take(verdict.failed);
    tallies[row.config]["all"].take(verdict.failed);
    impacts.take(row, verdict.figures.impacts);
    tests.take(row, verdict.figures.tests);
    fail += verdict.failed.empty() ? 0u : 1u;
  }
};

void print_table(const std::string& config, const std::map<std::string, Tally>& by_ground) {
  const std::map<std::string, uint32_t>& checks = by_ground.at("all").checks;
  printf("\n%-8s %7s %7s", config.c_str(), "scenes", "fail");
  for (const auto& [check, count] : checks) printf(" %7s", check.c_str());
  printf("\n");
  for (const auto& [ground, tally] : by_ground) {
    printf("%-8s %7u %7u", ground.c_str(), tally.played, tally.fail);
    for (const auto& [check, count] : checks) {
      const auto found = tally.checks.find(check);
      printf(" %7u", found == tally.checks.end() ? 0 : found->second);
    }
    printf("\n");
  }
}

void print(const Summary& summary) {
  for (const auto& [config, by_ground] : summary.tallies) print_table(config, by_ground);
  printf("\nat most in a tick: %.0f impacts (%s), %.0f times of impact (%s)\n", summary.impacts.value,
         summary.impacts.where.c_str(), summary.tests.value, summary.tests.where.c_str());
}

/// Prints the row if a check fails, or if it is not as listed. Returns whether it is as listed.
bool judge(const Row& row, const std::string& folder) {
  const std::string surprise = surprises(*row.entry, row.config.c_str(), row.verdict);
  if (surprise.empty() && row.verdict.failed.empty()) return true;
  printf("on %s: %s\n  %sto see it: detent view %s/%s.json --config %s -o page.html\n", row.entry->source.c_str(),
         line_of(row).c_str(), surprise.empty() ? "" : "not as the list says; ", folder.c_str(),
         row.entry->scene.c_str(), row.config.c_str());
  fflush(stdout);
  return surprise.empty();
}

}  // namespace

bool run_random(const RandomRun& run, const std::vector<Engine>& engines, std::string& problem) {
  const std::vector<Entry> known = read_list(run.list_file, problem);
  std::vector<Entry> gaps;
  Summary summary;
  const bool terminal = isatty(STDERR_FILENO) == 1;
  bool good = true;
  for (uint64_t seed = run.first; seed <= run.last; ++seed) {
    Entry entry = write_random_scene(seed, run.folder, run.assets, known, problem);
    if (!problem.empty()) return false;
    if (terminal) fprintf(stderr, "\r\033[K%s, %u fail\r", entry.scene.c_str(), summary.fail);
    for (const Engine& engine : engines) {
      const Row row = {&entry, engine.config,
                       visit(entry, engine, run.folder, detent_test::Ground::own, run.variation)};
      good = judge(row, run.folder) && good;
      if (!row.verdict.problem.empty()) continue;
      summary.take(row);
      entry.gaps[engine.config] = row.verdict.failed;
    }
    if (!gaps_text(entry.gaps).empty()) gaps.push_back(entry);
  }
  if (terminal) fprintf(stderr, "\r\033[K");
  print(summary);
  if (!run.renew) return good;
  if (!write_list(run.list_file, gaps)) problem = run.list_file + " cannot be written";
  return problem.empty();
}

}  // namespace detent_zoo
