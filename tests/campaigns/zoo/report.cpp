#include "tests/campaigns/zoo/report.h"

#include <math.h>

#include <algorithm>

namespace detent_zoo {

namespace {

constexpr const char* k_tables = "## Figures\n";

std::string figure(double value) {
  char text[32];
  snprintf(text, sizeof text, value != 0 && value < 1e-3 ? "%.0e" : "%.2g", value);
  return text;
}

std::string joined(const std::set<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : " ") + name;
  return text;
}

/// The verdicts of a scene, one for each configuration.
using Scene = std::vector<const Row*>;

/// The worst value of all configurations, in bold if it fails in one.
std::string judged(const Scene& scene, const std::string& check) {
  const bool always = check == "asleep";
  if (!always && scene.front()->entry->bounds.count(check) == 0) return "";
  double worst = 0;
  bool fails = false;
  for (const Row* row : scene) {
    worst = std::max(worst, measured(row->verdict.figures, check));
    fails = fails || row->verdict.failed.count(check) != 0;
  }
  const std::string text = isinf(worst) ? "-" : always ? std::to_string(lround(worst)) : figure(worst);
  return fails ? "**" + text + "**" : text;
}

std::string asleep(const Figures& figures) {
  return figures.asleep_from == 0 ? "-" : std::to_string(figures.asleep_from);
}

}  // namespace

std::string line_of(const Row& row) {
  const Verdict& verdict = row.verdict;
  const std::string name = row.entry->scene + " " + row.config + ": ";
  if (!verdict.problem.empty()) return name + verdict.problem;
  const Figures& f = verdict.figures;
  std::string text =
      name + "gain " + figure(f.gain.value) + " (tick " + std::to_string(f.gain.tick) + "), loss " +
      figure(f.loss.value) + ", gap " + figure(f.gap.value) + " " + figure(f.gap_metres.value) + " m (" +
      verdict.gap_joint + ", tick " + std::to_string(f.gap.tick) + "), angle " + figure(f.angle.value) + ", limit " +
      figure(f.limit.value) + " (" + std::to_string(f.limit.tick) + " " + std::to_string(f.limit.index) + "), sunk " +
      figure(f.sunk.value) + " (" + verdict.sunk_body + ", tick " + std::to_string(f.sunk.tick) + "), pierced " +
      figure(f.pierced.value) + " (tick " + std::to_string(f.pierced.tick) + "), moved " + figure(f.moved.value) +
      " (" + verdict.moved_body + ", tick " + std::to_string(f.moved.tick) + "), fallen " + figure(f.fallen.value) +
      ", risen " + figure(f.risen.value) + ", lost " + figure(f.lost.value) +
      (f.lost.value == 0 ? "" : " (" + std::string(f.lost_most) + ", tick " + std::to_string(f.lost.tick) + ")") +
      ", speed " + figure(f.speed.value);
  if (row.entry->bounds.count("momentum") != 0)
    text += ", momentum " + figure(f.momentum.value) + ", angular momentum " + figure(f.angular_momentum.value);
  text += ", end " + figure(f.rest_speed) + " m/s " + figure(f.rest_angular_velocity) + " rad/s, asleep " + asleep(f) +
          ", substeps " + figure(f.substeps_mean) + "/" + std::to_string(f.substeps_max) + ", " +
          figure(f.microseconds) + " us";
  if (!verdict.failed.empty()) text += "; FAILS " + joined(verdict.failed);
  return text;
}

std::string page_of(const std::string& page, const std::vector<Row>& rows) {
  std::vector<Scene> scenes;
  std::map<std::string, size_t> good;
  for (const Row& row : rows) {
    if (scenes.empty() || scenes.back().front()->entry != row.entry) scenes.emplace_back();
    scenes.back().push_back(&row);
    good[row.config] += row.verdict.failed.empty() ? 1u : 0u;
  }
  std::string text = page.substr(0, page.find(k_tables)) + k_tables + "\nAll checks pass in";
  for (const auto& [config, count] : good) {
    text += (config == good.begin()->first ? " " : ", ") + std::to_string(count) + " of " +
            std::to_string(scenes.size()) + " scenes in `" + config + "`";
  }
  text +=
      ". Each value is the worst of the configurations; it is bold if the check fails in at least one of them.\n\n"
      "| scene | bodies, joints |";
  std::string line = "|---|---|";
  for (const char* check : k_checks) {
    text += std::string(" ") + check + " |";
    line += "---|";
  }
  text += " substeps | fails |\n" + line + "---|---|\n";
  for (const Scene& scene : scenes) {
    const Figures& first = scene.front()->verdict.figures;
    std::map<std::string, std::set<std::string>> failed;
    double mean = 0;
    uint32_t most = 0;
    for (const Row* row : scene) {
      const Figures& f = row->verdict.figures;
      failed[row->config] = row->verdict.failed;
      mean = std::max(mean, f.substeps_mean);
      most = std::max(most, f.substeps_max);
    }
    text += "| " + scene.front()->entry->scene + " | " + std::to_string(first.bodies) + ", " +
            std::to_string(first.joints) + " | ";
    for (const char* check : k_checks) text += judged(scene, check) + " | ";
    text += figure(mean) + ", " + std::to_string(most) + " | " + gaps_text(failed) + " |\n";
  }
  return text;
}

}  // namespace detent_zoo
