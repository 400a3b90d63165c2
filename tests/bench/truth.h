#pragma once
#include <string>
#include <vector>

#include "tests/bench/measure.h"

/// What the oracle (tests/common/oracle) says of the queries.
namespace detent_bench {

struct Truth {
  double size = 0;       ///< m; the larger of the two core extents
  double start_gap = 0;  ///< m
  bool hit = false;
  double time = 1;      ///< of a hit
  double gap_min = 0;   ///< m, over the step; of a hit the depth, less than 0, as far as the oracle looked for it
  bool certain = true;  ///< the oracle is, of hit or clear
};

/// The truth of every query; of the start alone if not `moving`. Kept in the folder `cache` under `key` and taken from
/// there if it is of these very queries; an empty `cache` keeps nothing.
std::vector<Truth> truth_of(const std::vector<detent_queries::Query>& queries, bool moving, const std::string& cache,
                            const std::string& key, const Progress& progress);

}  // namespace detent_bench
