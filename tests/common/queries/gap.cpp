#include "tests/common/queries/gap.h"

#include <stddef.h>

#include "tests/common/oracle/convex_distance.h"

namespace detent_queries {

namespace {

using detent_oracle::Encounter;
using detent_oracle::Separation;

Separation separation_at(const Encounter& encounter, double time) {
  const detent_oracle::Placement placement = placement_at(encounter, static_cast<long double>(time));
  const detent_oracle::Number fine = 1e-13L * encounter.size;
  const Separation coarse = separation_of(encounter.a, encounter.b, placement, {fine, 1e-2L});
  if (coarse.gap < 0) return coarse;  // a depth of round solids to more digits takes long
  return separation_of(encounter.a, encounter.b, placement, {fine, 1e-9L}, coarse.axis);
}

double gap_at(const Encounter& encounter, double time) {
  return static_cast<double>(separation_at(encounter, time).gap);
}

}  // namespace

double gap_at(const Query& query, double time) { return gap_at(detent_oracle::encounter_of(query), time); }

Triple gap_normal(const Query& query, double time) {
  const detent_oracle::Arrow axis = separation_at(detent_oracle::encounter_of(query), time).axis;
  return {static_cast<double>(axis.x), static_cast<double>(axis.y), static_cast<double>(axis.z)};
}

void keep_extreme(std::vector<Triple>& points, double slack) {
  Query query;
  query.b.kind = Kind::hull;
  for (size_t i = points.size(); i-- > 0 && points.size() > 4;) {
    query.path_a.position = points[i];
    query.b.points = points;
    query.b.points.erase(query.b.points.begin() + static_cast<ptrdiff_t>(i));
    if (gap_at(query, 0) <= slack) points = query.b.points;
  }
}

Approach closest_approach(const Query& query) {
  const Encounter encounter = detent_oracle::encounter_of(query);
  constexpr int k_samples = 24;
  constexpr double k_golden = 0.38196601125010515;
  Approach best = {0, gap_at(encounter, 0)};
  for (int i = 1; i <= k_samples; ++i) {
    const double time = static_cast<double>(i) / k_samples;
    const double gap = gap_at(encounter, time);
    if (gap < best.gap) best = {time, gap};
  }
  double low = fmax(0, best.time - 1.0 / k_samples), high = fmin(1, best.time + 1.0 / k_samples);
  Approach left = {low + k_golden * (high - low), 0}, right = {high - k_golden * (high - low), 0};
  left.gap = gap_at(encounter, left.time);
  right.gap = gap_at(encounter, right.time);
  while (high - low > 1e-9) {
    if (left.gap < right.gap) {
      high = right.time;
      right = left;
      left.time = low + k_golden * (high - low);
      left.gap = gap_at(encounter, left.time);
    } else {
      low = left.time;
      left = right;
      right.time = high - k_golden * (high - low);
      right.gap = gap_at(encounter, right.time);
    }
  }
  for (const Approach& candidate : {left, right}) {
    if (candidate.gap < best.gap) best = candidate;
  }
  return best;
}

}  // namespace detent_queries
