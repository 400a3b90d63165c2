#pragma once
#include "base/heap.h"
#include "base/span.h"
#include "broad_phase/losses.h"
#include "broad_phase/pair_filter.h"
#include "broad_phase/resting_tree.h"

/// Which bodies are near each other. Those that move are sorted and swept among themselves; each of them asks the tree
/// of those that rest.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Whether a pair is kept before another: that whose bounds overlap deeper, of equals the lower key. The depth is the
/// least overlap along an axis, or how far the bounds reach into a half-space, in steps of a coordinate (f64: 2^-20 m).
struct DeeperPair {
  Span<const BodyPose> poses;
  Span<const BodyTraits> traits;
  Span<const Bounds> bounds;

  uint64_t depth(uint64_t key) const;
  bool operator()(uint64_t a, uint64_t b) const;
};

/// The pairs of a step. Where there are more than it has room for the deepest are kept, in whatever order they come.
struct PairPool {
  Span<const BodyTraits> traits;
  PairFilter filter;
  Span<const Bounds> bounds;
  Span<uint64_t> spare;  ///< work space as large as the pool
  SmallestOf<uint64_t, DeeperPair> found;
  Losses* losses = nullptr;  ///< where those that are not kept are written down

  PairPool(Span<const BodyPose> body_poses, Span<const BodyTraits> body_traits, Span<const Bounds> body_bounds,
           Span<uint64_t> sort_space, Span<uint64_t> storage, const FilterRuleTable& rules = {},
           Span<const uint64_t> apart = {})
      : traits(body_traits),
        filter{body_traits, rules, apart},
        bounds(body_bounds),
        spare(sort_space),
        found{storage, {body_poses, body_traits, body_bounds}} {}

  /// The pairs that are kept, once sorted by key.
  Span<const uint64_t> pairs() const { return found.storage.first(found.count); }
  uint32_t dropped() const { return found.dropped; }

  /// Takes the pair if one of the two is dynamic, their bounds overlap and they may touch.
  void consider(uint32_t a, uint32_t b);
  void sort();
  /// Between sort() and the next pairs.
  void go_on();
};

/// Finds all pairs of moving bodies with each other and with those in the tree. Sort and sweep along the axis in which
/// they lie farthest apart: O(n + the pairs that overlap in it). `keys` and `spare` are work space for as many bodies
/// as move.
void find_pairs(Span<const uint32_t> moving, const RestingTree& resting, Span<BoundsKey> keys, Span<BoundsKey> spare,
                PairPool& pool);

/// Finds all pairs of a body with those in the tree.
void find_resting_near(uint32_t slot, const RestingTree& resting, PairPool& pool);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
