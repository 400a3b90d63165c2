#include "tests/bench/zoo/table.h"

#include <math.h>
#include <stdlib.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

namespace detent_zoo {

namespace {

constexpr const char* k_figures = "## Figures\n";
constexpr const char* k_peers[] = {"bullet", "ode"};

bool is_peer(const std::string& engine) {
  return std::find(std::begin(k_peers), std::end(k_peers), engine) != std::end(k_peers);
}

std::string figure(double value) {
  char text[32];
  snprintf(text, sizeof text, value < 10 ? "%.2f" : value < 100 ? "%.1f" : "%.0f", value);
  return text;
}

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
    if (is_peer(result.engine) && result.played() && (faster == nullptr || result.mean < faster->mean))
      faster = &result;
  }
  return faster;
}

/// NaN if there is none.
double ratio_to_peer(const SceneResults& scene, const Result& result) {
  const Result* const peer = faster_peer(scene);
  return peer == nullptr || !result.played() || !(peer->mean > 0) ? NAN : result.mean / peer->mean;
}

std::string times_of(const Result& result) {
  return result.played() ? figure(result.mean) + ", " + figure(result.max) : "";
}

std::string fails_of(const Result& result) {
  return result.played() ? joined(result.verdict.failed) : "*" + result.verdict.problem + "*";
}

/// To six digits: more are noise.
double rounded(double value) {
  char text[32];
  snprintf(text, sizeof text, "%.6g", value);
  return strtod(text, nullptr);
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

std::string row_of(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text += " " + cell + " |";
  return text + "\n";
}
std::string head_of(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (size_t i = 0; i < cells.size(); ++i) line += "---|";
  return row_of(cells) + line + "\n";
}

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
  std::vector<std::string> head = {"", "plays", "passes", "passes of the " + std::to_string(common) + " that all play"};
  std::string text = head_of(head);
  for (const std::string& engine : engines) {
    text += row_of({"`" + engine + "`", std::to_string(played[engine]) + " of " + std::to_string(scenes.size()),
                    std::to_string(passed[engine]), std::to_string(passed_common[engine])});
  }
  return text;
}

std::string ratios_text(const std::vector<SceneResults>& scenes, const std::vector<std::string>& engines) {
  std::vector<std::string> peers, head = {"time a tick over that of"};
  for (const std::string& engine : engines) {
    if (is_peer(engine)) peers.push_back(engine);
  }
  if (peers.empty()) return "";
  for (const std::string& peer : peers) {
    head.push_back("`" + peer + "`");
    head.push_back("where both pass");
  }
  head.insert(head.end(), {"the faster peer", "its worst", "the longest tick, us"});
  std::string text = "\n" + head_of(head);
  for (const std::string& engine : engines) {
    std::vector<std::string> cells = {"`" + engine + "`"};
    for (const std::string& peer : peers) {
      Mean all, passing;
      for (const SceneResults& scene : scenes) {
        const Result &own = *scene.of(engine), &other = *scene.of(peer);
        if (!own.played() || !other.played() || engine == peer) continue;
        all.take(own.mean / other.mean);
        if (own.passed() && other.passed()) passing.take(own.mean / other.mean);
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
      if (own.max > longest) {
        longest = own.max;
        longest_scene = scene.entry.scene;
      }
    }
    cells.push_back(faster.text());
    cells.push_back(worst > 0 ? figure(worst) + " " + worst_scene : "-");
    cells.push_back(figure(longest) + " " + longest_scene);
    text += row_of(cells);
  }
  return text;
}

std::string failures_text(const std::vector<SceneResults>& scenes, const std::vector<std::string>& engines) {
  std::map<std::string, std::map<std::string, size_t>> fails;  // by check and engine
  for (const SceneResults& scene : scenes) {
    for (const Result& result : scene.results) {
      for (const std::string& check : result.verdict.failed) ++fails[check][result.engine];
    }
  }
  if (fails.empty()) return "";
  std::vector<std::string> head = {"scenes that fail"};
  for (const std::string& engine : engines) head.push_back("`" + engine + "`");
  std::string text = "\n" + head_of(head);
  for (const char* check : k_checks) {
    if (fails.count(check) == 0) continue;
    std::vector<std::string> cells = {check};
    for (const std::string& engine : engines) cells.push_back(std::to_string(fails[check][engine]));
    text += row_of(cells);
  }
  return text;
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
    if (!names.empty()) text += "\nWhat a peer passes and `" + engine + "` does not:" + names + ".\n";
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
    text += "\nNot expressible in `" + engine + "`:";
    for (const auto& [reason, count] : reasons)
      text += (reason == reasons.begin()->first ? " " : ", ") + reason + " (" + std::to_string(count) + ")";
    text += ".\n";
  }
  return text;
}

}  // namespace

std::string line_of(const SceneResults& scene) {
  std::string text = scene.entry.scene + ":";
  for (const Result& result : scene.results) {
    text += " " + result.engine + " ";
    if (!result.played()) {
      text += "(" + result.verdict.problem + ")";
      continue;
    }
    text += figure(result.mean) + " us, " + figure(result.max);
    if (!result.passed()) text += " FAILS " + joined(result.verdict.failed);
    text += ";";
  }
  return text;
}

std::string summary_of(const std::vector<SceneResults>& scenes, uint32_t repetitions) {
  const std::vector<std::string> engines = engines_of(scenes);
  return std::to_string(scenes.size()) + " scenes; each tick's least time of " + std::to_string(repetitions) +
         " repetitions. Means of ratios are geometric, with the number of scenes.\n\n" + passes_text(scenes, engines) +
         ratios_text(scenes, engines) + failures_text(scenes, engines) + beaten_text(scenes, engines) +
         reasons_text(scenes, engines);
}

std::string page_of(const std::string& page, const std::vector<SceneResults>& scenes, uint32_t repetitions) {
  const std::vector<std::string> engines = engines_of(scenes);
  std::string text =
      page.substr(0, page.find(k_figures)) + k_figures + "\n" + summary_of(scenes, repetitions) +
      "\n## Scenes\n\nUs a tick: mean, worst; over the mean of the faster peer; the checks that fail, or "
      "*what is not expressible*.\n\n";
  std::vector<std::string> head = {"scene"};
  for (const std::string& engine : engines) head.push_back("`" + engine + "`, us");
  for (const std::string& engine : engines) {
    if (!is_peer(engine)) head.push_back("`" + engine + "` ratio");
  }
  for (const std::string& engine : engines) head.push_back("`" + engine + "` fails");
  text += head_of(head);
  for (const SceneResults& scene : scenes) {
    std::vector<std::string> cells = {scene.entry.scene};
    for (const Result& result : scene.results) cells.push_back(times_of(result));
    for (const Result& result : scene.results) {
      if (is_peer(result.engine)) continue;
      const double ratio = ratio_to_peer(scene, result);
      cells.push_back(isnan(ratio) ? "" : figure(ratio));
    }
    for (const Result& result : scene.results) cells.push_back(fails_of(result));
    text += row_of(cells);
  }
  return text;
}

std::string json_of(const std::vector<SceneResults>& scenes) {
  std::string rows;
  const auto add = [&rows](const nlohmann::ordered_json& row) { rows += (rows.empty() ? "" : ",\n") + row.dump(); };
  for (const SceneResults& scene : scenes) {
    for (const Result& result : scene.results) {
      nlohmann::ordered_json row = {{"scene", scene.entry.scene}, {"engine", result.engine}};
      if (!result.played()) {
        row["cannot"] = result.verdict.problem;
        add(row);
        continue;
      }
      row["us_mean"] = rounded(result.mean);
      row["us_max"] = rounded(result.max);
      row["ticks"] = result.verdict.figures.ticks;
      row["fails"] = result.verdict.failed;
      for (const auto& [check, bound] : scene.entry.bounds) {
        const double value = measured(result.verdict.figures, check);
        if (isfinite(value)) row[check] = rounded(value);
      }
      add(row);
    }
  }
  return "[\n" + rows + "\n]\n";
}

}  // namespace detent_zoo
