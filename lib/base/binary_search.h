#pragma once
#include <stdint.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The first of the indices from 0 to before `count` for which `is_before` is false; `count` if there is none. Range:
/// `is_before` is true for all smaller indices and false for all larger ones.
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
