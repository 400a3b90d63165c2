#pragma once
#include <detent/detail/scratch.h>

#include "base/span.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// A pair of body slots as one sortable word: the lower slot in the high half.
constexpr uint64_t pair_key(uint32_t low, uint32_t high) { return (uint64_t{low} << 32) | high; }
constexpr uint32_t pair_low(uint64_t key) { return static_cast<uint32_t>(key >> 32); }
constexpr uint32_t pair_high(uint64_t key) { return static_cast<uint32_t>(key); }

struct PairCount {
  uint32_t kept;
  uint32_t dropped;  ///< pairs beyond the span: those with the largest keys
};

/// All pairs of live bodies, one of them dynamic, whose bounds overlap, sorted by key. `order` is work space for as
/// many slots as there are bodies alive. Sort and sweep along x: O(n log n + the pairs that overlap in x).
PairCount find_pairs(Span<const BodyTraits> traits, Span<const Bounds> bounds, Span<uint32_t> order,
                     Span<uint64_t> pairs);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
