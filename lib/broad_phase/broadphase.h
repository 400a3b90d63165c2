#pragma once
#include "base/heap.h"
#include "base/span.h"
#include "base/team.h"
#include "broad_phase/overflow.h"
#include "broad_phase/pair_filter.h"
#include "broad_phase/resting_tree.h"

/// Finds the pairs of bodies that are near each other. Moving bodies are tested among themselves by sort and sweep.
/// Each moving body also queries the tree of resting bodies.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The order in which a full pool keeps pairs: the pair whose bounds overlap deeper comes first; of equally deep pairs,
/// the one with the lower key. The depth is the least overlap along a coordinate axis; for a half-space, it is the
/// depth of the bounds below its surface. Unit: 2^-k_coord_bits m (bounds_integer.h).
struct DeeperPair {
  Span<const BodyPose> poses;
  Span<const BodyProperties> properties;
  Span<const Bounds> bounds;

  uint64_t depth(uint64_t key) const;
  bool operator()(uint64_t a, uint64_t b) const;
};

/// The pairs of a step. If the pool has no room for all pairs, it keeps the deepest. The result does not depend on the
/// order of adding.
struct PairPool {
  Span<const BodyProperties> properties;
  PairFilter filter;
  Span<const Bounds> bounds;
  Span<uint64_t> spare;  ///< work space as large as the pool
  SmallestOf<uint64_t, DeeperPair> found;
  Overflow* overflow = nullptr;  ///< receives events for the pairs that are not kept; may be null
#if DETENT_TASKS
  Team* team = nullptr;  ///< the threads that find pairs; null: one thread
#else
  static constexpr Team* team = nullptr;
#endif
  void share([[maybe_unused]] Team* with) {
#if DETENT_TASKS
    team = with;
#endif
  }

  PairPool(Span<const BodyPose> body_poses, Span<const BodyProperties> body_properties, Span<const Bounds> body_bounds,
           Span<uint64_t> sort_space, Span<uint64_t> storage, const FilterRuleTable& rules = {},
           Span<const uint64_t> disabled_pairs = {})
      : properties(body_properties),
        filter{body_properties, rules, disabled_pairs},
        bounds(body_bounds),
        spare(sort_space),
        found{storage, {body_poses, body_properties, body_bounds}} {}

  /// The kept pairs; after sort(), in ascending order of key.
  Span<const uint64_t> pairs() const { return found.storage.first(found.count); }
  uint32_t dropped() const { return found.dropped; }

  /// Whether the pool takes a pair: at least one of the bodies is dynamic, their bounds overlap, and the filter allows
  /// the pair.
  bool takes(uint32_t a, uint32_t b) const;
  void add(uint64_t key);
  /// Adds the pair if the pool takes it.
  void consider(uint32_t a, uint32_t b);
  void sort();
  /// Prepares the pool for further pairs after sort(). Must be called before the next consider().
  void go_on();
};

/// Finds all pairs of moving bodies with each other, and of moving bodies with bodies in the tree. Pairs of moving
/// bodies are found by sort and sweep along the axis on which the moving bodies spread farthest: O(n + number of pairs
/// that overlap on this axis). `keys` and `spare` are work space with one element for each moving body.
void add_moving_pairs(Span<const uint32_t> moving, const RestingTree& resting, Span<BoundsKey> keys,
                      Span<BoundsKey> spare, PairPool& pool);

/// Receives the pairs that one thread finds. If several threads find pairs, it collects a few pairs before it adds them
/// to the pool, because only one thread at a time may do so.
class PairFinder {
 public:
  explicit PairFinder(PairPool& pool) : pool_(pool) {}
  PairFinder(const PairFinder&) = delete;
  PairFinder& operator=(const PairFinder&) = delete;
  ~PairFinder() {
    if (pool_.team != nullptr) add_all();
  }

  void consider(uint32_t a, uint32_t b) {
    if (pool_.team == nullptr) {
      pool_.consider(a, b);
    } else if (pool_.takes(a, b)) {
      if (count_ == k_pairs) add_all();
      keys_[count_++] = key_of_pair(a, b);
    }
  }

 private:
  static constexpr uint32_t k_pairs = DETENT_TASKS ? 32 : 1;

  void add_all() {
    alone(pool_.team, [&] {
      for (uint32_t i = 0; i < count_; ++i) pool_.add(keys_[i]);
    });
    count_ = 0;
  }

  PairPool& pool_;
  uint32_t count_ = 0;
  uint64_t keys_[k_pairs];
};

/// Finds all pairs of the body `slot` with bodies in the tree.
void find_resting_near(uint32_t slot, const RestingTree& resting, PairFinder& finder);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
