#pragma once
#include <stdint.h>

#include <vector>

#include "tests/common/queries/query.h"

namespace detent_bench {

/// The bytes of a `.hull` of these points in their own frame, aligned to 8; kept for the next engine that asks for the
/// same points, and freed by forget_cooked(). Empty if cooking refuses them.
struct CookedHull {
  std::vector<uint64_t> words;
  uint32_t byte_count = 0;
};
const CookedHull& cooked_hull(const std::vector<detent_queries::Triple>& points);
void forget_cooked();

}  // namespace detent_bench
