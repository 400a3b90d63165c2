#pragma once
#include <stdint.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Returns the least index in [0, count) for which is_before(index) is false; `count` if there is none. Range:
/// `is_before` is true for all indices below the result, and false for all others.
template <class IsBefore>
inline uint32_t partition_point(uint32_t count, const IsBefore& is_before) {
  uint32_t low = 0, high = count;
  while (low < high) {
    const uint32_t middle = low + (high - low) / 2;
    if (is_before(middle))
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
