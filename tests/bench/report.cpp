#include "tests/bench/report.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/queries/gap.h"
#include "tests/queries/sets.h"

namespace detent_bench {

using detent_queries::Query;

namespace {

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

/// The least of the values that 99 in 100 do not exceed.
double p99(std::vector<double> values) {
  if (values.empty()) return 0;
  const size_t index = (values.size() * 99 + 99) / 100 - 1;
  std::nth_element(values.begin(), values.begin() + static_cast<ptrdiff_t>(index), values.end());
  return values[index];
}

double greatest(const std::vector<double>& values) {
  return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
}

bool belongs(Part part, const Query& query) {
  return part == Part::all || detent_queries::turns(query) == (part == Part::rotating);
}

void judge_toi(const Engine& engine, const Query& query, const Truth& truth, const Answer& answer, Row& row,
               std::vector<double>& early) {
  row.hits += truth.hit ? 1u : 0u;
  row.undecided += answer.outcome == Outcome::undecided ? 1u : 0u;
  const double tolerance = k_tolerance + engine.slack / truth.size;
  if (truth.hit && answer.outcome != Outcome::hit) {
    ++row.fn;
    row.fn_deep += truth.gap_min < -k_deep * truth.size ? 1u : 0u;
  }
  if (!truth.hit && (answer.outcome == Outcome::undecided ||
                     (answer.outcome == Outcome::hit && truth.gap_min > tolerance * truth.size)))
    ++row.fp;
  if (answer.outcome != Outcome::hit) return;
  const double gap = detent_queries::gap_at(query, answer.time) / truth.size;
  if (gap < -k_resolution) row.late_max = std::max(row.late_max, -gap);
  if (truth.hit || truth.gap_min <= tolerance * truth.size) early.push_back(std::max(gap, 0.0));
}

/// Where nothing turns, Bullet's linear cast.
bool is_reference(const Engine& engine, bool linear) {
  if (strcmp(engine.config, "bullet-double") != 0) return false;
  if (engine.task == Task::distance) return true;
  return strcmp(engine.method, linear ? "btSubsimplexConvexCast" : "btContinuousConvexCollision") == 0;
}

/// The mean time of engine `e` by that of the reference.
double ratio_of(const Findings& findings, Part part, bool linear, size_t e) {
  for (size_t r = 0; r < findings.measured.size(); ++r) {
    if (!is_reference((*findings.engines)[r], linear)) continue;
    double sum = 0, reference = 0;
    for (size_t q = 0; q < findings.measured[e].size(); ++q) {
      const Measured &one = findings.measured[e][q], &other = findings.measured[r][q];
      if (!one.asked || !other.asked || !belongs(part, (*findings.queries[e])[q])) continue;
      sum += one.ns;
      reference += other.ns;
    }
    return reference > 0 ? sum / reference : 0;
  }
  return 0;
}

std::string number(double value) {
  char text[32];
  if (value == 0) return "0";
  snprintf(text, sizeof text, value >= 100 ? "%.0f" : value >= 0.01 ? "%.3g" : "%.1e", value);
  return text;
}

std::string count_or_empty(bool shown, uint32_t value) { return shown ? std::to_string(value) : "-"; }
std::string number_or_empty(bool shown, double value) { return shown ? number(value) : "-"; }

}  // namespace

std::vector<Row> rows_of(const Findings& findings, Part part) {
  std::vector<Row> rows;
  for (size_t e = 0; e < findings.measured.size(); ++e) {
    const Engine& engine = (*findings.engines)[e];
    const std::vector<Query>& queries = *findings.queries[e];
    Row row;
    row.task = engine.task;
    row.set = findings.set + (part == Part::all ? "" : part == Part::rotating ? " rotating" : " linear");
    row.method = engine.method;
    row.config = engine.config;
    std::vector<double> ns, gjk, early, errors;
    bool whole = true, some_turn = false, turn_asked = false;
    for (size_t q = 0; q < queries.size(); ++q) {
      const Measured& measured = findings.measured[e][q];
      whole = whole && belongs(part, queries[q]);
      some_turn = some_turn || detent_queries::turns(queries[q]);
      turn_asked = turn_asked || (measured.asked && detent_queries::turns(queries[q]));
      if (!measured.asked || !belongs(part, queries[q])) continue;
      const Truth& truth = (*findings.truths[e])[q];
      ns.push_back(measured.ns);
      gjk.push_back(measured.answer.gjk_calls);
      if (engine.task == Task::toi)
        judge_toi(engine, queries[q], truth, measured.answer, row, early);
      else
        errors.push_back(fabs(measured.answer.distance - std::max(truth.start_gap, 0.0)) / truth.size);
    }
    if (ns.empty() || (part != Part::all && whole)) continue;
    if (part == Part::all && some_turn && !turn_asked) continue;  // a linear cast: not to be read beside the others
    row.queries = static_cast<uint32_t>(ns.size());
    row.early_p99 = p99(early);
    row.early_max = greatest(early);
    row.error_p99 = p99(errors);
    row.error_max = greatest(errors);
    row.gjk_mean = mean(gjk);
    row.gjk_max = greatest(gjk);
    row.ns_mean = mean(ns);
    row.ns_p99 = p99(ns);
    row.ns_max = greatest(ns);
    row.ratio = ratio_of(findings, part, part == Part::linear || !some_turn, e);
    rows.push_back(row);
  }
  return rows;
}

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
  for (const char* name : {"gjk", "max", "ns", "p99", "max", "ratio"}) cells.back().emplace_back(name);
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
    line.push_back(number_or_empty(row.ratio > 0, row.ratio));
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
