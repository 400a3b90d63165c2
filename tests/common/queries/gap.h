#pragma once
#include "tests/common/queries/query.h"

/// The gap of a query's solids as the generators need it: by the oracle (tests/common/oracle), to 1e-13 of the size or
/// 1e-9 of the gap; of a depth only to a hundredth.
namespace detent_queries {

/// Distance of the surfaces at `time` of the step, m; less than 0 if they overlap.
double gap_at(const Query& query, double time);

/// The direction in which to move B so that the gap at `time` grows fastest, of length 1. The solids must be apart.
Triple gap_normal(const Query& query, double time);

/// Drops every point that lies within `slack`, m, of the hull of the others.
void keep_extreme(std::vector<Triple>& points, double slack);

struct Approach {
  double time = 0;
  double gap = 0;  ///< m
};
/// The least gap over the step, as found by samples and a search between them: a narrower dip may be missed.
Approach closest_approach(const Query& query);

}  // namespace detent_queries
