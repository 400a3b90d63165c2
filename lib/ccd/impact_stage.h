#pragma once
#include "broad_phase/pair_key.h"
#include "ccd/event_heads.h"
#include "ccd/impact.h"
#include "ccd/impact_pair.h"
#include "ccd/moving_tree.h"
#include "motion/angular_velocity.h"
#include "shape/shape_properties.h"

/// Declarations that the files of continuous collision share. impact.cpp processes the impacts in the order of their
/// times. impact_search.cpp finds when pairs collide. impact_solve.cpp resolves impacts. impact_sweeps.cpp updates the
/// sweeps of the bodies.
namespace detent {
inline namespace DETENT_NAMESPACE {

// ImpactPair::next: the next event of a pair.
inline constexpr uint8_t k_next_none = 0;
inline constexpr uint8_t k_next_impact = 1;
inline constexpr uint8_t k_next_undecided = 2;  ///< the pair is clear up to that time
/// The pair is tested again; if it has separated, at a smaller shrink depth.
inline constexpr uint8_t k_next_test = 3;

// Marks of a body's sweep, in addition to k_mark_jointed.
inline constexpr uint32_t k_mark_stopped = 1;      ///< the body stays where it is until the tick ends
inline constexpr uint32_t k_mark_changed = 2;      ///< the new sweep has not been tested yet
inline constexpr uint32_t k_mark_left_bounds = 4;  ///< the sweep leaves the bounds that the pairs were found with
inline constexpr uint32_t k_mark_hit = 8;          ///< the body was hit: its angular momentum follows its sweep
inline constexpr uint32_t k_mark_slept = 16;       ///< the body was asleep when the tick began
inline constexpr uint32_t k_mark_moved = 32;       ///< the body was active when the tick began: its pairs were searched
inline constexpr uint32_t k_mark_sliver = BodySweep::k_mark_sliver;
static_assert(k_mark_moved < k_mark_sliver && k_mark_sliver < k_mark_jointed);

/// The pairs whose search finds anything at the start of the tick, while several threads search for them.
struct FoundPairs {
  Span<ImpactPair> pairs;  ///< their keys
  uint32_t count = 0;
  /// Not 0 if there are too many pairs, or if a body must be stopped: the pairs must then be searched in order.
  uint32_t in_order = 0;
  ImpactReport report = {};  ///< of the pairs without an impact

  void add(uint64_t key, bool is_stopped) {
    const uint32_t place = Team::take(count, 1);
    if (place < pairs.count) pairs[place].key = key;
    if (place >= pairs.count || is_stopped) Team::take(in_order, 1);
  }
};

/// The state of the stage during a tick.
struct ImpactStage {
  const StepSettings& settings;
  const AssetTable& assets;
  const FeatureTable& features;
  const ImpactPairs& known;
  const ImpactBodies& bodies;
  Span<ImpactPair> impacts;
  Span<ImpactHit> hits;
  ImpactProbe* probe;
  Scaled tick_rate;
  uint32_t work_left = UINT32_MAX;  ///< see k_impact_work_times; set by find_first()
  uint32_t impact_count = 0;
  uint32_t changed_count = 0;
  uint32_t changed_first = 0;  ///< no body with a lower slot has k_mark_changed
  Real first_approach = 0.0;   ///< closing speed of the impact that is being resolved, m/s
  ImpactReport report = {};
#if DETENT_TASKS
  SpareMemory spare = {bodies.spare};
  MovingTree moving = {};
  EventHeads heads = {};
  FoundPairs* found = nullptr;  ///< not null: test() only lists the pair, if its search finds anything
#else
  static constexpr FoundPairs* found = nullptr;
#endif

  SweptBody body(uint32_t slot) const { return {bodies.properties[slot], bodies.poses[slot], bodies.sweeps[slot]}; }
  bool dynamic(uint32_t slot) const { return is_dynamic(bodies.properties[slot]); }
  /// Whether pairs that cannot collide are skipped.
  bool filters() const { return probe == nullptr || probe->filters; }
  /// Subtracts `count` times of impact, or attempts to resolve an impact, from the work that is left.
  void take_work(uint32_t count) { work_left -= count < work_left ? count : work_left; }
  bool is_spent() const { return work_left == 0; }
  /// Visits the entries in `impacts` of a dynamic body: its pairs with a coming impact, and those that have had one.
  template <class Visit>
  void for_each_impact(uint32_t slot, const Visit& visit) const {
    if (impact_count == 0) return;
    for (uint32_t at = bodies.first_impact[slot]; at != 0;) {
      ImpactPair& pair = impacts[at - 1];
      at = pair.more[pair_high(pair.key) == slot ? 1 : 0];
      visit(pair);
    }
  }
  /// To be called when the event of an entry in `impacts` has changed.
  void touch([[maybe_unused]] const ImpactPair& pair) {
#if DETENT_TASKS
    heads.touch(static_cast<uint32_t>(&pair - impacts.data));
#endif
  }
  /// The smaller body's smallest diameter, m.
  Real extent_of(uint64_t key) const {
    return min(shape_extent(bodies.properties[pair_low(key)]), shape_extent(bodies.properties[pair_high(key)]));
  }

  // impact_sweeps.cpp

  /// Computes the bounds of the sweeps, and marks the sweeps that leave the bounds that the pairs were found with.
  void start_sweeps();
  void start_sweep(uint32_t slot);
  /// Moves the body to `time` along its sweep. The sweep starts again there, with the same velocity.
  void move_to(uint32_t slot, Fraction time);
  /// Updates the bounds of a body whose sweep has changed, marks it for testing and discards its coming impacts. The
  /// body has been moved to the current time.
  void change(uint32_t slot);
  /// Stops the body at `time` until the tick ends. Does nothing if the body is not dynamic or has stopped before.
  void stop(uint32_t slot, Fraction time);
  /// Moves the angular momentum of the bodies that were hit to the end of the tick.
  void finish_momentum();

  // impact_search.cpp

  /// Finds the first impact of every pair that may collide. Sets the budget of work for the rest of the tick from the
  /// number of moving bodies and the number of pairs that were tested or skipped.
  void find_first();
  /// Finds when a pair collides next, and stores its next event if there is one. Stops both bodies if there is no room
  /// for an impact, or if the pair would pass through. `shrink_depth`: the first shrink depth, m. `entry`: the pair's
  /// entry in `impacts`, or null.
  void test(uint64_t key, Fraction time, Real shrink_depth, ImpactPair* entry);
  /// As the first part of find_first(): the pairs in `known`. Several threads search. Returns false, and changes
  /// nothing, if the pairs must be searched in order.
  bool find_first_shared();
  /// Tests the sweeps that have changed against all other bodies.
  void test_all_changed(Fraction time);
  /// Whether the solver pushed the pair apart in this tick.
  bool is_pushed(uint64_t key) const;

  // impact_solve.cpp

  /// Separates the bodies of a pair. The bodies must be at the time of the impact. Returns true, with both sweeps
  /// unchanged, if the bodies collide at a seam and the shrink depth of the pair was not increased yet.
  bool resolve(ImpactPair& pair, bool undecided, const BodyPose& pose_a, const BodyPose& pose_b);
  /// Propagates the impulse of the pair `first` to the pairs that share a body with it and have collided in this tick,
  /// and back, until no pair approaches, in a limited number of rounds. Without this, a body between two others would
  /// be hit back and forth without end. The pairs are processed in the order of their keys.
  void pass_on(const ImpactPair& first, Fraction time);
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
