#include <stdio.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fstream>
#include <iterator>

#include "tests/bench/ground_option.h"
#include "tests/bench/zoo/games.h"
#include "tests/bench/zoo/peers.h"
#include "tests/bench/zoo/script.h"
#include "tests/bench/zoo/table.h"

using namespace detent_zoo;

namespace {

constexpr int k_exit_good = 0, k_exit_bad = 1, k_exit_usage = 2;

constexpr const char* k_help =
    R"(Plays the scenes of the zoo in this library and in its peers, with the same checks (docs/zoo.md), and times them.
  us     of a tick: median, 99th percentile and worst, over each tick's least time of the repetitions; nothing but the
         step is timed
  ratio  of the means, to the faster peer that plays the scene
  stages the two that take most of this library's step, from the run with the checks
A scene that a peer cannot express it does not play; why is said. The engines play in turn, scene by scene.)";

struct Options {
  std::vector<std::string> scenes, engines = {"fx64", "f32", "bullet", "ode"};
  bool games = false;
  std::string ground = "both";
  uint32_t repetitions = 3;
  std::string json, markdown;
};

constexpr const char* k_scenes = DETENT_ROOT "/tests/campaigns/zoo/scenes";

bool wanted(const std::vector<std::string>& prefixes, const std::string& name) {
  return prefixes.empty() || std::any_of(prefixes.begin(), prefixes.end(), [&](const std::string& prefix) {
           return name.compare(0, prefix.size(), prefix) == 0;
         });
}

int fail(int code, const std::string& what) {
  fprintf(stderr, "bench: %s\n", what.c_str());
  return code;
}

/// Those named, in that order. One that this build has not is said.
std::vector<Engine> chosen(const std::vector<std::string>& names) {
  std::vector<Engine> all = all_engines(), result;
  for (const Engine& peer : all_peers()) all.push_back(peer);
  for (const std::string& name : names) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const Engine& each) { return name == each.config; });
    if (found != all.end())
      result.push_back(*found);
    else
      fprintf(stderr, "bench: goes without %s, which this build has not (Debian: libbullet-dev libode-dev)\n",
              name.c_str());
  }
  return result;
}

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// What is to be measured: the scenes that are wanted, each on its grounds.
std::vector<SceneResults> scenes_of(const Options& options, std::string& problem) {
  const std::vector<Entry> entries = read_list(DETENT_ROOT "/tests/campaigns/zoo/zoo.csv", problem);
  if (!problem.empty()) return {};
  std::vector<Game> played;
  if (options.games) {
    played = read_games(DETENT_ROOT "/tests/bench/zoo/games.csv", entries, problem);
  } else {
    for (const Entry& entry : entries) played.push_back({"", entry});
  }
  std::vector<SceneResults> scenes;
  for (const Game& game : played) {
    if (!wanted(options.scenes, game.entry.scene)) continue;
    const bool grounded = has_ground(std::string(k_scenes) + "/" + game.entry.scene + ".json");
    for (const detent_test::Ground ground : detent_test::grounds_of(options.ground, grounded))
      scenes.push_back({game.entry, game.kind, ground, {}});
  }
  return scenes;
}

int run(const Options& options) {
  std::string problem;
  std::vector<SceneResults> scenes = scenes_of(options, problem);
  if (!problem.empty()) return fail(k_exit_bad, problem);
  if (scenes.empty()) return fail(k_exit_usage, "no scene's name starts so");
  const std::vector<Engine> engines = chosen(options.engines);
  if (engines.empty()) return fail(k_exit_usage, "no engine is left");
  const bool terminal = isatty(STDERR_FILENO) == 1;
  for (size_t i = 0; i < scenes.size(); ++i) {
    const auto progress = [&](const std::string& what) {
      if (terminal) fprintf(stderr, "\r\x1b[K%zu of %zu, %s", i + 1, scenes.size(), what.c_str());
    };
    measure_scene(scenes[i], engines, options.repetitions, k_scenes, progress);
    if (terminal) fputs("\r\x1b[K", stderr);
    printf("%s\n", line_of(scenes[i]).c_str());
    fflush(stdout);
    if (!terminal && (i + 1) % 20 == 0) fprintf(stderr, "bench: %zu of %zu scenes\n", i + 1, scenes.size());
  }
  printf("\n%s", summary_of(scenes, options.repetitions).c_str());
  if (!options.json.empty() && !(std::ofstream(options.json) << json_of(scenes)))
    return fail(k_exit_bad, options.json + " cannot be written");
  if (!options.markdown.empty()) {
    const std::string page = page_of(text_of(options.markdown), scenes, options.repetitions);
    if (!(std::ofstream(options.markdown) << page)) return fail(k_exit_bad, options.markdown + " cannot be written");
  }
  return k_exit_good;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(k_help, "bench");
  app.require_subcommand(1);
  Options options;
  CLI::App* const zoo = app.add_subcommand("zoo", k_help);
  zoo->add_option("--scenes", options.scenes, "Only those whose names start so, separated by commas")->delimiter(',');
  zoo->add_flag("--games", options.games, "Only those of tests/bench/zoo/games.csv: what games do");
  detent_bench::add_ground_option(*zoo, options.ground);
  zoo->add_option("--engines", options.engines, "Of fx64, fx32, f32, f64, bullet, ode; separated by commas")
      ->delimiter(',')
      ->check(CLI::IsMember({"fx64", "fx32", "f32", "f64", "bullet", "ode"}))
      ->capture_default_str();
  zoo->add_option("--repetitions", options.repetitions, "Timed runs of each scene and engine")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  zoo->add_option("--json", options.json, "Write the rows to this file");
  zoo->add_option("--markdown", options.markdown,
                  "Write the tables into this page, after its text: docs/bench/zoo.md or games.md");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? k_exit_good : k_exit_usage;
  }
  return run(options);
}
