#include "tests/bench/report.h"

#include <stdio.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace detent_bench {

namespace {

std::string number(double value) {
  char text[32];
  if (value == 0) return "0";
  snprintf(text, sizeof text, value >= 100 ? "%.0f" : value >= 0.01 ? "%.3g" : "%.1e", value);
  return text;
}

std::string count_or_empty(bool shown, uint32_t value) { return shown ? std::to_string(value) : "-"; }
std::string number_or_empty(bool shown, double value) { return shown ? number(value) : "-"; }

}  // namespace

std::string table_of(const std::vector<Row>& rows) {
  if (rows.empty()) return "";
  const bool toi = rows.front().task == Task::toi;
  std::vector<std::vector<std::string>> cells;
  cells.push_back({"set", "method", "config", "queries"});
  if (toi)
    for (const char* name : {"hits", "FN", "deep", "FP", "undecided", "late max", "early p99", "early max"})
      cells.back().emplace_back(name);
  else
    for (const char* name : {"error p99", "error max"}) cells.back().emplace_back(name);
  for (const char* name : {"gjk", "max", "ns", "p99", "max", "ratio", "p99"}) cells.back().emplace_back(name);
  for (const Row& row : rows) {
    std::vector<std::string> line = {row.set, row.method, row.config, std::to_string(row.queries)};
    if (toi) {
      for (const uint32_t value : {row.hits, row.fn, row.fn_deep, row.fp, row.undecided})
        line.push_back(std::to_string(value));
      for (const double value : {row.late_max, row.early_p99, row.early_max}) line.push_back(number(value));
    } else {
      for (const double value : {row.error_p99, row.error_max}) line.push_back(number(value));
    }
    const bool counted = row.gjk_max > 0;
    line.push_back(number_or_empty(counted, row.gjk_mean));
    line.push_back(count_or_empty(counted, static_cast<uint32_t>(row.gjk_max)));
    for (const double value : {row.ns_mean, row.ns_p99, row.ns_max}) line.push_back(number(value));
    for (const double value : {row.ratio_mean, row.ratio_p99}) line.push_back(number_or_empty(value > 0, value));
    cells.push_back(line);
  }

  std::vector<size_t> widths(cells.front().size());
  for (const auto& line : cells) {
    for (size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
  }
  std::string text;
  for (const auto& line : cells) {
    for (size_t i = 0; i < line.size(); ++i) {
      const std::string fill(widths[i] - line[i].size(), ' ');
      text += i < 3 ? line[i] + fill : fill + line[i];
      text += i + 1 < line.size() ? "  " : "\n";
    }
  }
  return text;
}

std::string json_of(const std::vector<Row>& rows) {
  std::string text = "[";
  for (const Row& row : rows) {
    nlohmann::ordered_json json = {
        {"set", row.set}, {"method", row.method}, {"config", row.config}, {"queries", row.queries}};
    if (row.task == Task::toi) {
      json["hits"] = row.hits;
      json["fn"] = row.fn;
      json["fn_deep"] = row.fn_deep;
      json["fp"] = row.fp;
      json["late_max"] = row.late_max;
      json["early_p99"] = row.early_p99;
      json["early_max"] = row.early_max;
      json["undecided"] = row.undecided;
    } else {
      json["error_p99"] = row.error_p99;
      json["error_max"] = row.error_max;
    }
    json["gjk_mean"] = row.gjk_mean;
    json["gjk_max"] = row.gjk_max;
    json["ns_mean"] = row.ns_mean;
    json["ns_p99"] = row.ns_p99;
    json["ns_max"] = row.ns_max;
    text += (text.size() > 1 ? ",\n " : "") + json.dump();
  }
  return text + "]\n";
}

}  // namespace detent_bench
