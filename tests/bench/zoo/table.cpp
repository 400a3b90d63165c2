#include "tests/bench/zoo/table.h"

#include <math.h>

#include <algorithm>
#include <map>

#include "tests/bench/step_json.h"

namespace detent_zoo {

namespace {

using detent_bench::rounded;
using detent_test::Ground;
using detent_text::Cells;
using detent_text::text;

constexpr const char* k_figures = "## Figures\n";
constexpr const char* k_peers[] = {"bullet", "ode"};

bool is_peer(const std::string& engine) {
  return std::find(std::begin(k_peers), std::end(k_peers), engine) != std::end(k_peers);
}

std::string figure(double value) { return text(value < 10 ? "%.2f" : value < 100 ? "%.1f" : "%.0f", value); }

std::string joined(const std::set<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : " ") + name;
  return text;
}

std::vector<std::string> engines_of(const std::vector<SceneResults>& scenes) {
  std::vector<std::string> names;
  if (scenes.empty()) return names;
  for (const Result& result : scenes.front().results) names.push_back(result.engine);
  return names;
}

/// The faster of the peers that play it, or null.
const Result* faster_peer(const SceneResults& scene) {
  const Result* faster = nullptr;
  for (const Result& result : scene.results) {
    if (is_peer(result.engine) && result.played() && (faster == nullptr || result.times.mean < faster->times.mean))
      faster = &result;
  }
  return faster;
}

/// NaN if there is none.
double ratio_to_peer(const SceneResults& scene, const Result& result) {
  const Result* const peer = faster_peer(scene);
  return peer == nullptr || !result.played() || !(peer->times.mean > 0) ? NAN : result.times.mean / peer->times.mean;
}

std::string times_of(const Result& result) {
  if (!result.played()) return "";
  return figure(result.times.median) + ", " + figure(result.times.p99) + ", " + figure(result.times.max);
}

std::string fails_of(const Result& result) {
  return result.played() ? joined(result.verdict.failed) : "*" + result.verdict.problem + "*";
}

struct Mean {
  double logarithms = 0;
  size_t count = 0;

  void take(double ratio) {
    if (!(ratio > 0) || !isfinite(ratio)) return;
    logarithms += log(ratio);
    ++count;
  }
  std::string text() const {
    return count == 0 ? "-" : figure(exp(logarithms / static_cast<double>(count))) + " (" + std::to_string(count) + ")";
  }
};

std::string passes_text(const std::vector<SceneResults>& scenes, const std::vector<std::string>& engines) {
  size_t common = 0;
  std::map<std::string, size_t> played, passed, passed_common;
  for (const SceneResults& scene : scenes) {
    const bool all =
        std::all_of(scene.results.begin(), scene.results.end(), [](const Result& result) { return result.played(); });
    common += all ? 1u : 0u;
    for (const Result& result : scene.results) {
      played[result.engine] += result.played() ? 1u : 0u;
      passed[result.engine] += result.passed() ? 1u : 0u;
      passed_common[result.engine] += all && result.passed() ? 1u : 0u;
    }
  }
  std::vector<Cells> rows = {{"", "plays", "passes", "passes of the " + std::to_string(common) + " that all play"}};
  for (const std::string& engine : engines) {
    rows.push_back({"`" + engine + "`", std::to_string(played[engine]) + " of " + std::to_string(scenes.size()),
                    std::to_string(passed[engine]), std::to_string(passed_common[engine])});
  }
  return detent_text::table_of(rows, true);
}

std::string ratios_text(const std::vector<SceneResults>& scenes, const std::vector<std::string>& engines) {
  std::vector<std::string> peers;
  Cells head = {"mean time of a tick over that of"};
  for (const std::string& engine : engines) {
    if (is_peer(engine)) peers.push_back(engine);
  }
  if (peers.empty()) return "";
  for (const std::string& peer : peers) {
    head.push_back("`" + peer + "`");
    head.push_back("where both pass");
  }
  head.insert(head.end(), {"the faster peer", "its worst", "the longest tick, us"});
  std::vector<Cells> rows = {head};
  for (const std::string& engine : engines) {
    Cells cells = {"`" + engine + "`"};
    for (const std::string& peer : peers) {
      Mean all, passing;
      for (const SceneResults& scene : scenes) {
        const Result &own = *scene.of(engine), &other = *scene.of(peer);
        if (!own.played() || !other.played() || engine == peer) continue;
        all.take(own.times.mean / other.times.mean);
        if (own.passed() && other.passed()) passing.take(own.times.mean / other.times.mean);
      }
      cells.push_back(all.text());
      cells.push_back(passing.text());
    }
    Mean faster;
    double worst = 0, longest = 0;
    std::string worst_scene, longest_scene;
    for (const SceneResults& scene : scenes) {
      const Result& own = *scene.of(engine);
      const double ratio = ratio_to_peer(scene, own);
      if (!is_peer(engine)) faster.take(ratio);
      if (ratio > worst) {
        worst = ratio;
        worst_scene = scene.entry.scene;
      }
      if (own.times.max > longest) {
        longest = own.times.max;
        longest_scene = scene.entry.scene;
      }
    }
    cells.push_back(faster.text());
    cells.push_back(worst > 0 ? figure(worst) + " " + worst_scene : "-");
    cells.push_back(figure(longest) + " " + longest_scene);
    rows.push_back(cells);
  }
  return detent_text::table_of(rows, true);
}

std::string failures_text(const std::vector<SceneResults>& scenes, const std::vector<std::string>& engines) {
  std::map<std::string, std::map<std::string, size_t>> fails;  // by check and engine
  for (const SceneResults& scene : scenes) {
    for (const Result& result : scene.results) {
      for (const std::string& check : result.verdict.failed) ++fails[check][result.engine];
    }
  }
  if (fails.empty()) return "";
  std::vector<Cells> rows = {{"scenes that fail"}};
  for (const std::string& engine : engines) rows.front().push_back("`" + engine + "`");
  for (const char* check : k_checks) {
    if (fails.count(check) == 0) continue;
    Cells cells = {check};
    for (const std::string& engine : engines) cells.push_back(std::to_string(fails[check][engine]));
    rows.push_back(cells);
  }
  return detent_text::table_of(rows, true);
}

/// Where a peer is better.
std::string beaten_text(const std::vector<SceneResults>& scenes, const std::vector<std::string>& engines) {
  std::string text;
  for (const std::string& engine : engines) {
    if (is_peer(engine)) continue;
    std::string names;
    for (const SceneResults& scene : scenes) {
      std::string better;
      for (const Result& result : scene.results) {
        if (is_peer(result.engine) && result.passed()) better += (better.empty() ? "" : ", ") + result.engine;
      }
      if (!better.empty() && !scene.of(engine)->passed())
        names += (names.empty() ? " " : ", ") + scene.entry.scene + " (" + better + ")";
    }
    if (!names.empty()) text += "What a peer passes and `" + engine + "` does not:" + names + ".\n\n";
  }
  return text;
}

std::string reasons_text(const std::vector<SceneResults>& scenes, const std::vector<std::string>& engines) {
  std::string text;
  for (const std::string& engine : engines) {
    std::map<std::string, size_t> reasons;
    for (const SceneResults& scene : scenes) {
      const Result& result = *scene.of(engine);
      if (!result.played()) ++reasons[result.verdict.problem];
    }
    if (reasons.empty()) continue;
    text += "Not expressible in `" + engine + "`:";
    for (const auto& [reason, count] : reasons)
      text += (reason == reasons.begin()->first ? " " : ", ") + reason + " (" + std::to_string(count) + ")";
    text += ".\n\n";
  }
  return text;
}

/// A scene and its ground.
std::string name_of(const SceneResults& scene) {
  return scene.entry.scene + (scene.ground == Ground::own ? "" : std::string(", ") + ground_name(scene.ground));
}

/// The scenes that are played on that ground, with those that have none.
std::vector<SceneResults> on_ground(const std::vector<SceneResults>& scenes, Ground ground) {
  std::vector<SceneResults> result;
  std::copy_if(scenes.begin(), scenes.end(), std::back_inserter(result),
               [ground](const SceneResults& scene) { return scene.ground == ground || scene.ground == Ground::own; });
  return result;
}

std::string figures_text(const std::vector<SceneResults>& scenes) {
  const std::vector<std::string> engines = engines_of(scenes);
  return passes_text(scenes, engines) + ratios_text(scenes, engines) + failures_text(scenes, engines) +
         beaten_text(scenes, engines) + reasons_text(scenes, engines);
}

std::string scenes_text(const std::vector<SceneResults>& scenes) {
  const std::vector<std::string> engines = engines_of(scenes);
  const bool kinds =
      std::any_of(scenes.begin(), scenes.end(), [](const SceneResults& scene) { return !scene.kind.empty(); });
  Cells head = {"scene, ground"};
  if (kinds) head.insert(head.begin(), "");
  for (const std::string& engine : engines) head.push_back("`" + engine + "`, us");
  for (const std::string& engine : engines) {
    if (!is_peer(engine)) head.push_back("`" + engine + "` ratio");
  }
  head.push_back("stages");
  for (const std::string& engine : engines) head.push_back("`" + engine + "` fails");
  std::vector<Cells> rows = {head};
  for (const SceneResults& scene : scenes) {
    Cells cells = {name_of(scene)};
    if (kinds) cells.insert(cells.begin(), scene.kind);
    for (const Result& result : scene.results) cells.push_back(times_of(result));
    for (const Result& result : scene.results) {
      if (is_peer(result.engine)) continue;
      const double ratio = ratio_to_peer(scene, result);
      cells.push_back(isnan(ratio) ? "" : figure(ratio));
    }
    cells.push_back(detent_bench::stages_text(scene.results.front().stages));
    for (const Result& result : scene.results) cells.push_back(fails_of(result));
    rows.push_back(cells);
  }
  return detent_text::table_of(rows, true);
}

}  // namespace

std::string line_of(const SceneResults& scene) {
  std::string line = name_of(scene) + ":";
  for (const Result& result : scene.results) {
    line += " " + result.engine + " ";
    if (!result.played()) {
      line += "(" + result.verdict.problem + ")";
      continue;
    }
    line += times_of(result) + " us";
    if (!result.passed()) line += " FAILS " + joined(result.verdict.failed);
    line += ";";
  }
  return line;
}

std::string summary_of(const std::vector<SceneResults>& scenes, uint32_t repetitions) {
  std::string result = "Each tick's least time of " + std::to_string(repetitions) +
                       " repetitions. Means of ratios are geometric, with the number of scenes.\n\n";
  const auto has = [&scenes](Ground ground) {
    return std::any_of(scenes.begin(), scenes.end(),
                       [ground](const SceneResults& scene) { return scene.ground == ground; });
  };
  bool any = false;
  for (const Ground ground : {Ground::half_space, Ground::box}) {
    if (!has(ground)) continue;
    any = true;
    const std::vector<SceneResults> of_ground = on_ground(scenes, ground);
    result += "### On a " + std::string(ground_name(ground)) + "\n\n" + std::to_string(of_ground.size()) + " scenes, " +
              std::to_string(std::count_if(of_ground.begin(), of_ground.end(),
                                           [](const SceneResults& scene) { return scene.ground == Ground::own; })) +
              " of them without such a ground.\n\n" + figures_text(of_ground);
  }
  return any ? result : result + figures_text(scenes);
}

std::string page_of(const std::string& page, const std::vector<SceneResults>& scenes, uint32_t repetitions) {
  std::string result = page.substr(0, page.find(k_figures)) + k_figures + "\n" + summary_of(scenes, repetitions) +
                       "## Scenes\n\nUs a tick: median, 99th percentile, worst; the mean over that of the faster peer; "
                       "the two longest stages of `" +
                       engines_of(scenes).front() + "`; the checks that fail, or *what is not expressible*.\n\n" +
                       scenes_text(scenes);
  result.pop_back();  // the table's empty line
  return result;
}

std::string json_of(const std::vector<SceneResults>& scenes) {
  std::vector<nlohmann::ordered_json> rows;
  for (const SceneResults& scene : scenes) {
    for (const Result& result : scene.results) {
      nlohmann::ordered_json row = {{"scene", scene.entry.scene}, {"ground", ground_name(scene.ground)}};
      if (!scene.kind.empty()) row["kind"] = scene.kind;
      row["engine"] = result.engine;
      if (!result.played()) {
        row["cannot"] = result.verdict.problem;
        rows.push_back(row);
        continue;
      }
      add_times(row, result.times, result.stages);
      row["ticks"] = result.verdict.figures.ticks;
      row["fails"] = result.verdict.failed;
      for (const auto& [check, bound] : scene.entry.bounds) {
        const double value = measured(result.verdict.figures, check);
        if (isfinite(value)) row[check] = rounded(value, 6);
      }
      rows.push_back(row);
    }
  }
  return detent_bench::lines_of(rows);
}

}  // namespace detent_zoo
