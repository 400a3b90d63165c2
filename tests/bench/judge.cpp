#include "tests/bench/judge.h"

#include <math.h>
#include <string.h>

#include <algorithm>

#include "tests/common/queries/gap.h"
#include "tests/common/queries/sets.h"
#include "tests/common/queries/solids.h"

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

/// What `part` is a part of.
Part whole_of(Part part) {
  switch (part) {
    case Part::rotating_polytopes:
      return Part::rotating;
    case Part::linear_polytopes:
      return Part::linear;
    default:
      return Part::all;
  }
}

bool belongs(Part part, const Query& query) {
  switch (part) {
    case Part::rotating:
      return detent_queries::turns(query);
    case Part::linear:
      return !detent_queries::turns(query);
    case Part::rotating_polytopes:
    case Part::linear_polytopes:
      return belongs(whole_of(part), query) && detent_queries::is_polytope(query.a) &&
             detent_queries::is_polytope(query.b);
    default:
      return true;
  }
}

const char* suffix_of(Part part) {
  switch (part) {
    case Part::rotating:
      return " rotating";
    case Part::linear:
      return " linear";
    case Part::rotating_polytopes:
      return " rotating polytopes";
    case Part::linear_polytopes:
      return " linear polytopes";
    default:
      return "";
  }
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

bool is_default(const Engine& engine) {
  return strcmp(engine.method, engine.task == Task::toi ? "default" : "closest_points") == 0;
}

/// By query, whether a default of the library answered it, in some configuration; of a run without one, any engine.
std::vector<bool> needed_answers(const Findings& findings) {
  const EngineList& engines = *findings.engines;
  const bool any = std::none_of(engines.begin(), engines.end(), is_default);
  std::vector<bool> needed(findings.measured.front().size());
  for (size_t e = 0; e < engines.size(); ++e) {
    if (!any && !is_default(engines[e])) continue;
    for (size_t q = 0; q < needed.size(); ++q) needed[q] = needed[q] || findings.measured[e][q].asked;
  }
  return needed;
}

}  // namespace

std::vector<Row> rows_of(const Findings& findings, Part part) {
  std::vector<Row> rows;
  const std::vector<bool> needed = needed_answers(findings);
  for (size_t e = 0; e < findings.measured.size(); ++e) {
    const Engine& engine = (*findings.engines)[e];
    const std::vector<Query>& queries = *findings.queries[e];
    Row row;
    row.task = engine.task;
    row.set = findings.set + suffix_of(part);
    row.method = engine.method;
    row.config = engine.config;
    std::vector<double> ns, gjk, early, errors;
    bool less = part == Part::all, turns_somewhere = false, answers_needed = true;
    for (size_t q = 0; q < queries.size(); ++q) {
      const Measured& measured = findings.measured[e][q];
      if (!belongs(part, queries[q])) {
        less = less || belongs(whole_of(part), queries[q]);
        continue;
      }
      turns_somewhere = turns_somewhere || detent_queries::turns(queries[q]);
      answers_needed = answers_needed && (measured.asked || !needed[q]);
      if (!measured.asked) continue;
      const Truth& truth = (*findings.truths[e])[q];
      ns.push_back(measured.ns);
      gjk.push_back(measured.answer.gjk_calls);
      if (engine.task == Task::toi)
        judge_toi(engine, queries[q], truth, measured.answer, row, early);
      else
        errors.push_back(fabs(measured.answer.distance - std::max(truth.start_gap, 0.0)) / truth.size);
    }
    if (ns.empty() || !less || !answers_needed) continue;
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
    compare(findings, part, !turns_somewhere, e, row);
    rows.push_back(row);
  }
  return rows;
}

}  // namespace detent_bench
