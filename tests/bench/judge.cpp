#include "tests/bench/judge.h"

#include <math.h>
#include <string.h>

#include <algorithm>

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

/// How deep the solids come in between, m, at the samples: one who reports the end has let them do so, even if by then
/// they are apart again.
double depth_between(const Query& query, double start, double end) {
  constexpr int k_samples = 16;
  double depth = 0;
  for (int i = 1; i <= k_samples; ++i)
    depth = std::max(depth, -detent_queries::gap_at(query, start + (end - start) * i / k_samples));
  return depth;
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
  const double late =
      truth.hit && answer.time > truth.time ? depth_between(query, truth.time, answer.time) / truth.size : 0;
  if (late > k_resolution)
    row.late_max = std::max(row.late_max, late);
  else if (truth.hit || truth.gap_min <= tolerance * truth.size)
    early.push_back(std::max(gap, 0.0));
}

/// Where nothing turns, Bullet's linear cast.
bool is_reference(const Engine& engine, bool linear) {
  if (strcmp(engine.config, "bullet-double") != 0) return false;
  if (engine.task == Task::distance) return true;
  return strcmp(engine.method, linear ? "btSubsimplexConvexCast" : "btContinuousConvexCollision") == 0;
}

void compare(const Findings& findings, Part part, bool linear, size_t e, Row& row) {
  for (size_t r = 0; r < findings.measured.size(); ++r) {
    if (!is_reference((*findings.engines)[r], linear)) continue;
    std::vector<double> ns, reference;
    for (size_t q = 0; q < findings.measured[e].size(); ++q) {
      const Measured &one = findings.measured[e][q], &other = findings.measured[r][q];
      if (!one.asked || !other.asked || !belongs(part, (*findings.queries[e])[q])) continue;
      ns.push_back(one.ns);
      reference.push_back(other.ns);
    }
    if (ns.empty()) return;
    row.ratio_mean = mean(ns) / mean(reference);
    row.ratio_p99 = p99(ns) / p99(reference);
    return;
  }
}

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
    compare(findings, part, part == Part::linear || !some_turn, e, row);
    rows.push_back(row);
  }
  return rows;
}

}  // namespace detent_bench
