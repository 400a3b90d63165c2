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

/// All pairs of live bodies, one of them dynamic, whose bounds overlap, sorted by key. Sort and sweep along the axis in
/// which the bodies lie farthest apart: O(n + the pairs that overlap in it). `keys` and `spare` are work space for as
/// many bodies as there are alive, `pair_spare` for as many pairs as `pairs`.
PairCount find_pairs(Span<const BodyTraits> traits, Span<const Bounds> bounds, Span<BoundsKey> keys,
                     Span<BoundsKey> spare, Span<uint64_t> pair_spare, Span<uint64_t> pairs);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
