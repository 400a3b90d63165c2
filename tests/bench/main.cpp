#include <stdio.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>

#include "tests/bench/cooked.h"
#include "tests/bench/draw.h"
#include "tests/bench/engines.h"
#include "tests/bench/motions/command.h"
#include "tests/bench/report.h"
#include "tests/bench/rollback/command.h"
#include "tests/bench/scaling/command.h"
#include "tests/bench/terminal.h"
#include "tests/bench/world/command.h"
#include "tests/bench/worlds/command.h"
#include "tests/common/queries/sets.h"

namespace {

using namespace detent_bench;
using detent_queries::Query;

constexpr int k_exit_good = 0;
constexpr int k_exit_bad = 1;
constexpr int k_exit_usage = 2;

constexpr const char* k_help =
    R"(Times this library's narrow phase and its peers on seeded sets of queries, side by side, and judges each answer
by an oracle of higher precision. Gaps and errors are in units of size, the larger core extent of the pair.
  queries    of the set, or of the part of it, that the engine had an answer to
  hits       of those, in truth
  FN         hits called clear or undecided; deep: those of them that are deeper than 1e-3
  FP         hits or undecided where the truth stays farther off than 1e-6 and the ulps of position
  late       how deep they come by the reported time of a hit, at most
  early      the gap at the reported time of a hit that is one, or comes within the tolerance
  gjk        GJK calls (distance: support points) of a query
  ns         of a query: the least of its repetitions, each right after a run that is not timed
  ratio      of the mean times and of their 99th percentiles, to btContinuousConvexCollision in double; where nothing
             turns to btSubsimplexConvexCast, of distances to btGjkPairDetector
A set's queries are also shown by whether they turn (rotating) or not (linear), and those of two polytopes (boxes, hulls,
triangles, none rounded) apart from the others: not every method knows other shapes. An engine has a row only where it
answers all that this library's default does, so that rows can be read side by side; of a run without the default, all
that any engine does. fx32 is asked, and judged, about positions rounded to its grid.)";

struct Options {
  Task task = Task::toi;
  std::vector<std::string> sets, methods, configs;
  uint32_t count = 4000, repetitions = 5;
  uint64_t seed = 1;
  std::string json, plot, hulls, cache;
};

bool wanted(const std::vector<std::string>& filters, const std::string& name) {
  return filters.empty() || std::any_of(filters.begin(), filters.end(), [&name](const std::string& filter) {
           return name.find(filter) != std::string::npos;
         });
}

/// The queries as an engine sees them and their truth: one for each grid of positions.
struct Variant {
  double position_step = 0;
  std::vector<Query> queries;
  std::vector<Truth> truths;
};

std::vector<Row> run_set(const detent_queries::Set& set, const Options& options, const EngineList& engines,
                         const detent_queries::Sources& sources) {
  const std::string name = std::string("set ") + set.name;
  std::vector<Query> queries;
  {
    Line line(name + ", making queries");
    for (uint32_t i = 0; i < options.count; ++i) {
      queries.push_back(make_query(set, options.seed, i, sources));
      line.show(i + 1, options.count);
    }
  }

  std::vector<Variant> variants;
  for (const Engine& engine : engines) {
    const auto same = [&engine](const Variant& variant) { return variant.position_step == engine.position_step; };
    if (std::any_of(variants.begin(), variants.end(), same)) continue;
    Variant variant;
    variant.position_step = engine.position_step;
    for (const Query& query : queries) variant.queries.push_back(seen_by(engine, query));
    const std::string key = std::string(options.task == Task::toi ? "toi" : "distance") + "-" + set.name + "-" +
                            std::to_string(options.seed) + "-" + std::to_string(options.count) +
                            (engine.position_step == 0 ? "" : "-grid");
    Line line(name + ", truth");
    variant.truths = truth_of(variant.queries, options.task == Task::toi, options.cache, key,
                              [&line](size_t done, size_t total) { line.show(done, total); });
    const auto uncertain = [](const Truth& truth) { return !truth.certain; };
    const auto count = std::count_if(variant.truths.begin(), variant.truths.end(), uncertain);
    if (count != 0)
      fprintf(stderr, "bench: %s: the oracle is not certain of %d queries%s\n", name.c_str(), static_cast<int>(count),
              engine.position_step == 0 ? "" : " on the grid");
    variants.push_back(std::move(variant));
  }

  Findings findings;
  findings.set = set.name;
  findings.engines = &engines;
  for (const Engine& engine : engines) {
    for (const Variant& variant : variants) {
      if (variant.position_step != engine.position_step) continue;
      findings.queries.push_back(&variant.queries);
      findings.truths.push_back(&variant.truths);
    }
  }
  {
    Line line(name + ", engines");
    findings.measured =
        measure(engines, queries, options.repetitions, [&line](size_t done, size_t total) { line.show(done, total); });
  }
  forget_cooked();

  std::vector<Row> rows;
  for (const Part part : k_parts) {
    if (options.task == Task::distance && part != Part::all) continue;
    for (Row& row : rows_of(findings, part)) rows.push_back(std::move(row));
  }
  return rows;
}

int run(const Options& options) {
  std::string problem;
  EngineList engines;
  for (const Engine& engine : all_engines(problem)) {
    if (engine.task == options.task && wanted(options.methods, engine.method) && wanted(options.configs, engine.config))
      engines.push_back(engine);
  }
  if (!problem.empty()) fprintf(stderr, "bench: a peer is left out: %s\n", problem.c_str());
  if (engines.empty()) {
    fprintf(stderr, "bench: no engine has such a method and configuration\n");
    return k_exit_usage;
  }

  detent_queries::Sources sources;
  if (!options.hulls.empty() && !read_game_hulls(options.hulls, sources.game_hulls)) {
    fprintf(stderr, "bench: %s cannot be read as point clouds\n", options.hulls.c_str());
    return k_exit_bad;
  }
  std::vector<Row> rows;
  for (const detent_queries::Set& set : detent_queries::all_sets()) {
    if (!options.sets.empty() && std::count(options.sets.begin(), options.sets.end(), set.name) == 0) continue;
    if (options.task == Task::toi && !set.moves) continue;
    if (std::string(set.name) == "game" && sources.game_hulls.empty()) {
      fprintf(stderr, "bench: set game is left out: no hulls (--hulls)\n");
      continue;
    }
    const std::vector<Row> of_set = run_set(set, options, engines, sources);
    printf("%s: %s\n%s\n", set.name, set.text, table_of(of_set).c_str());
    fflush(stdout);
    rows.insert(rows.end(), of_set.begin(), of_set.end());
  }
  if (!options.json.empty() && !(std::ofstream(options.json) << json_of(rows))) {
    fprintf(stderr, "bench: %s cannot be written\n", options.json.c_str());
    return k_exit_bad;
  }
  if (!options.plot.empty() && !draw(options.plot, "rows.json", json_of(rows))) {
    fprintf(stderr, "bench: the plots could not be drawn (Debian: python3-matplotlib)\n");
    return k_exit_bad;
  }
  return k_exit_good;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(k_help, "bench");
  app.require_subcommand(1);
  Options options;
  CLI::App* toi = app.add_subcommand("toi", "Time of impact");
  CLI::App* distance = app.add_subcommand("distance", "Distance, of the poses at the start");
  CLI::App* list = app.add_subcommand("sets", "List the sets");
  WorldOptions world_options;
  CLI::App* world = add_world_command(app, world_options);
  RollbackOptions rollback_options;
  CLI::App* rollback = add_rollback_command(app, rollback_options);
  ScalingOptions scaling_options;
  CLI::App* scaling = add_scaling_command(app, scaling_options);
  WorldsOptions worlds_options;
  CLI::App* worlds = add_worlds_command(app, worlds_options);
  MotionsOptions motions_options;
  CLI::App* motions = add_motions_command(app, motions_options);
  std::vector<std::string> names;
  for (const detent_queries::Set& set : detent_queries::all_sets()) names.emplace_back(set.name);
  for (CLI::App* command : {toi, distance}) {
    command->add_option("--sets", options.sets, "Only these, separated by commas")
        ->delimiter(',')
        ->check(CLI::IsMember(names));
    command->add_option("--count", options.count, "Queries a set")
        ->check(CLI::Range(1, 10000000))
        ->capture_default_str();
    command->add_option("--seed", options.seed, "Of the sets")->capture_default_str();
    command->add_option("--methods", options.methods, "Only those whose name holds one of these")->delimiter(',');
    command->add_option("--configs", options.configs, "Only those whose name holds one of these")->delimiter(',');
    command->add_option("--repetitions", options.repetitions, "Timed runs of each query")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    command->add_option("--json", options.json, "Write the rows to this file");
    command->add_option("--plot", options.plot, "Draw time against error (SVG) into this folder");
    command->add_option("--hulls", options.hulls, "Point clouds of the set game");
    command->add_option("--cache", options.cache, "Keep the oracle's answers in this folder");
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? k_exit_good : k_exit_usage;
  }
  if (world->parsed()) return run_world(world_options);
  if (rollback->parsed()) return run_rollback(rollback_options);
  if (scaling->parsed()) return run_scaling(scaling_options);
  if (worlds->parsed()) return run_worlds(worlds_options);
  if (motions->parsed()) return run_motions(motions_options);
  if (list->parsed()) {
    for (const detent_queries::Set& set : detent_queries::all_sets()) printf("%-5s %s\n", set.name, set.text);
    return k_exit_good;
  }
  options.task = toi->parsed() ? Task::toi : Task::distance;
  return run(options);
}
