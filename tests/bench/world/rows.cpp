#include "tests/bench/world/rows.h"

#include <stdio.h>
#include <stdlib.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace detent_bench {

namespace {

constexpr const char* k_configs[] = {"fx64", "f32", "f64", "fx32"};

std::string number(double value) {
  char text[32];
  const double size = value < 0 ? -value : value;
  if (value == 0) return "0";
  snprintf(text, sizeof text, size >= 100 ? "%.0f" : size >= 0.01 ? "%.3g" : "%.1e", value);
  return text;
}

std::string fixed(const char* format, double value) {
  char text[32];
  snprintf(text, sizeof text, format, value);
  return text;
}

/// Words to the left in the first `words` columns, numbers to the right in the others.
std::string aligned(const std::vector<std::vector<std::string>>& cells, size_t words) {
  std::vector<size_t> widths(cells.front().size());
  for (const auto& line : cells) {
    for (size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
  }
  std::string text;
  for (const auto& line : cells) {
    for (size_t i = 0; i < line.size(); ++i) {
      const std::string fill(widths[i] - line[i].size(), ' ');
      text += i < words ? line[i] + fill : fill + line[i];
      text += i + 1 < line.size() ? "  " : "\n";
    }
  }
  return text;
}

std::string ratio(const WorldRow* row, const WorldRow* reference) {
  if (row == nullptr || reference == nullptr || reference->us_median <= 0) return "-";
  const double value = row->us_median / reference->us_median;
  return fixed(value < 0.01 ? "%.1g" : "%.2f", value);
}

/// Without digits that mean nothing.
double rounded(double value, const char* format) { return strtod(fixed(format, value).c_str(), nullptr); }

std::string effort_text(const Effort& effort) {
  std::string text;
  if (effort.substeps != 0) text += std::to_string(effort.substeps) + " substeps";
  if (effort.iterations != 0) text += (text.empty() ? "" : ", ") + std::to_string(effort.iterations) + " iterations";
  return text.empty() ? "default" : text;
}

}  // namespace

const WorldRow* find_row(const std::vector<WorldRow>& rows, const std::string& scene, const std::string& engine,
                         const std::string& config) {
  for (const WorldRow& row : rows) {
    if (row.scene == scene && row.engine == engine && row.config == config && row.effort.substeps == 0 &&
        row.effort.iterations == 0)
      return &row;
  }
  return nullptr;
}

std::string world_table_of(const std::vector<WorldRow>& rows, bool study) {
  if (rows.empty()) return "";
  std::vector<std::string> head = {"scene", "engine", "config"};
  if (study) head.emplace_back("effort");
  const size_t words = head.size();
  for (const char* name : {"us", "p99", "max", "p99/us", "ratio", "contacts", "ns each", "kB", "allocs", "losses"})
    head.emplace_back(name);
  for (const auto& measure : rows.front().measures) head.push_back(measure.first);
  std::vector<std::vector<std::string>> cells = {head};
  for (const WorldRow& row : rows) {
    std::vector<std::string> line = {row.scene, row.engine, row.config};
    if (study) line.push_back(effort_text(row.effort));
    for (const double value : {row.us_median, row.us_p99, row.us_max}) line.push_back(number(value));
    line.push_back(row.us_median > 0 ? fixed("%.2f", row.us_p99 / row.us_median) : "-");
    line.push_back(ratio(&row, find_row(rows, row.scene, "bullet", "double")));
    line.push_back(std::to_string(row.contacts));
    line.push_back(row.contacts > 0 ? fixed("%.0f", 1000 * row.us_median / row.contacts) : "-");
    for (const uint64_t value : {(row.bytes + 999) / 1000, row.allocs, row.losses})
      line.push_back(std::to_string(value));
    for (const auto& measure : row.measures) line.push_back(number(measure.second));
    cells.push_back(line);
  }
  return aligned(cells, words);
}

std::string world_summary_of(const std::vector<WorldRow>& rows) {
  std::vector<std::vector<std::string>> cells = {{"scene", "bullet double, us"}};
  for (const char* config : k_configs) cells.front().push_back(std::string(config) + " / bullet");
  for (const char* name : {"bullet float / double", "ode / bullet", "fx64 / f32", "fx64 p99/us"})
    cells.front().emplace_back(name);
  std::vector<std::string> scenes;
  for (const WorldRow& row : rows) {
    if (std::find(scenes.begin(), scenes.end(), row.scene) == scenes.end()) scenes.push_back(row.scene);
  }
  for (const std::string& scene : scenes) {
    const auto row = [&](const char* engine, const char* config) { return find_row(rows, scene, engine, config); };
    const WorldRow *bullet = row("bullet", "double"), *fx64 = row("detent", "fx64");
    std::vector<std::string> line = {scene, bullet != nullptr ? number(bullet->us_median) : "-"};
    for (const char* config : k_configs) line.push_back(ratio(row("detent", config), bullet));
    line.push_back(ratio(row("bullet", "float"), bullet));
    line.push_back(ratio(row("ode", "double"), bullet));
    line.push_back(ratio(fx64, row("detent", "f32")));
    line.push_back(fx64 != nullptr && fx64->us_median > 0 ? fixed("%.2f", fx64->us_p99 / fx64->us_median) : "-");
    cells.push_back(line);
  }
  return aligned(cells, 1);
}

std::string world_json_of(const std::vector<WorldRow>& rows, bool study) {
  const auto us = [](double value) { return rounded(value, "%.3f"); };
  std::string text = "[";
  for (const WorldRow& row : rows) {
    nlohmann::ordered_json json = {{"scene", row.scene},       {"engine", row.engine},
                                   {"config", row.config},     {"us_median", us(row.us_median)},
                                   {"us_p99", us(row.us_p99)}, {"us_max", us(row.us_max)},
                                   {"contacts", row.contacts}, {"bytes", row.bytes},
                                   {"allocs", row.allocs},     {"measures", nlohmann::ordered_json::object()},
                                   {"settings", row.settings}};
    for (const auto& [name, value] : row.measures) json["measures"][name] = rounded(value, "%.5g");
    if (study) {
      json["substeps"] = row.effort.substeps;
      json["iterations"] = row.effort.iterations;
    }
    text += (text.size() > 1 ? ",\n " : "") + json.dump();
  }
  return text + "]\n";
}

}  // namespace detent_bench
