#pragma once
#include "broad_phase/pair_key.h"
#include "ccd/event_heads.h"
#include "ccd/impact.h"
#include "ccd/impact_pair.h"
#include "ccd/moving_tree.h"
#include "ccd/warp_group.h"
#include "motion/angular_velocity.h"
#include "shape/shape_properties.h"

/// Declarations that the files of continuous collision share. impact.cpp processes the impacts in the order of their
/// times; time_warp.cpp processes them in groups. impact_search.cpp finds when pairs collide. impact_solve.cpp resolves
/// impacts. impact_sweeps.cpp updates the sweeps of the bodies.
namespace detent {
inline namespace DETENT_NAMESPACE {

// Values of ImpactPair::next: the kind of a pair's next event.
inline constexpr uint8_t k_next_none = 0;
inline constexpr uint8_t k_next_impact = 1;
/// The search for an impact stopped early: the bodies do not collide before ImpactPair::time.
inline constexpr uint8_t k_next_undecided = 2;
/// The pair is tested again at ImpactPair::time, from the smallest shrink depth on, because it may have separated.
inline constexpr uint8_t k_next_test = 3;

// Marks of a body's sweep, in addition to k_mark_jointed.
inline constexpr uint32_t k_mark_stopped = 1;      ///< the body stays where it is until the tick ends
inline constexpr uint32_t k_mark_changed = 2;      ///< the new sweep has not been tested yet
inline constexpr uint32_t k_mark_left_bounds = 4;  ///< the sweep leaves the bounds that the pairs were found with
/// The body was moved to an impact: its angular momentum belongs to its current rotation, not to that at the tick's
/// end.
inline constexpr uint32_t k_mark_hit = 8;
inline constexpr uint32_t k_mark_slept = 16;  ///< the body was asleep when the tick began
inline constexpr uint32_t k_mark_moved = 32;  ///< awake or moving when the tick began: pairs of this body were tested
inline constexpr uint32_t k_mark_near = BodySweep::k_mark_near;
static_assert(k_mark_moved < k_mark_near && k_mark_near < k_mark_jointed);

#if DETENT_TASKS
/// The members of ImpactReport that each thread counts for itself; their sums over the threads are the counts of the
/// tick.
inline constexpr uint32_t ImpactReport::*k_impact_numbers[] = {
    &ImpactReport::impacts, &ImpactReport::undecided, &ImpactReport::overlaps_left, &ImpactReport::bodies_stopped,
    &ImpactReport::tests,   &ImpactReport::skipped,   &ImpactReport::kept_apart,    &ImpactReport::clamped};

/// The entries in `impacts` at the start of the tick, while several threads make them.
struct FoundPairs {
  Span<ImpactPair> pairs;
  uint32_t count = 0;  ///< if it exceeds pairs.count, one thread must test all pairs in order

  ImpactPair* take() {
    const uint32_t place = Team::take(count, 1);
    return place < pairs.count ? &pairs[place] : nullptr;
  }
};
#endif

/// The state of continuous collision during a tick.
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
  uint32_t work_left = UINT32_MAX;  ///< rest of the budget of work (k_impact_work_times); set by find_first()
  uint32_t impact_count = 0;
  uint32_t changed_count = 0;
  uint32_t changed_first = 0;  ///< no body with a lower slot has k_mark_changed
  Real first_approach = 0.0;   ///< closing speed of the impact that is being resolved, m/s
  ImpactReport report = {};
#if DETENT_TASKS
  SpareMemory spare = {bodies.spare};
  MovingTree moving = {};
  EventHeads heads = {};
  FoundPairs* found = nullptr;  ///< not null: several threads make entries
  WarpRun* warp = nullptr;      ///< not null: this is a group of Time Warp, which sees its own copies of bodies
#endif

  // The data of a body at the present point of the tick. In a group of Time Warp, they are those of the group's copy.
  BodyPose& pose_of(uint32_t slot) const { return own_of(slot) ? own_of(slot)->pose : bodies.poses[slot]; }
  BodyMotion& motion_of(uint32_t slot) const { return own_of(slot) ? own_of(slot)->motion : bodies.motions[slot]; }
  BodySweep& sweep_of(uint32_t slot) const { return own_of(slot) ? own_of(slot)->sweep : bodies.sweeps[slot]; }
  ImpactPath& path_of(uint32_t slot) const { return own_of(slot) ? own_of(slot)->path : bodies.paths[slot]; }
  Bounds& bounds_of(uint32_t slot) const { return own_of(slot) ? own_of(slot)->bounds : bodies.bounds[slot]; }
  uint32_t& first_impact_of(uint32_t slot) const {
    return own_of(slot) ? own_of(slot)->first_impact : bodies.first_impact[slot];
  }
#if DETENT_TASKS
  WarpBody* own_of(uint32_t slot) const { return warp == nullptr ? nullptr : warp->body(slot); }
  const BitSet& candidates() const { return warp == nullptr ? bodies.candidates : warp->part.candidates; }
  /// The bodies that may have k_mark_changed.
  const BitSet& changeable() const { return warp == nullptr ? bodies.active : warp->part.own; }
  /// Whether the body may be part of an entry in `impacts`. In a group, only bodies that the group has copied have
  /// entries.
  bool may_have_entries(uint32_t slot) const { return warp == nullptr || warp->body(slot) != nullptr; }
  /// Whether a group has met a case that must be processed in the order of time over the whole world
  /// (ImpactOrder::global). The group's result is then discarded.
  bool gives_up() const { return warp != nullptr && warp->has_failed(); }
#else
  static constexpr const void* found = nullptr;
  static constexpr WarpBody* own_of(uint32_t) { return nullptr; }
  const BitSet& candidates() const { return bodies.candidates; }
  const BitSet& changeable() const { return bodies.active; }
  static constexpr bool may_have_entries(uint32_t) { return true; }
  static constexpr bool gives_up() { return false; }
#endif
  SweptBody body(uint32_t slot) const { return {bodies.properties[slot], pose_of(slot), sweep_of(slot)}; }
  bool dynamic(uint32_t slot) const { return is_dynamic(bodies.properties[slot]); }
  /// Whether pairs that cannot collide are skipped.
  bool filters() const { return probe == nullptr || probe->filters; }
  /// Subtracts `count` units from the work that is left. A unit is one computed time of impact, or one attempt to
  /// resolve an impact.
  void take_work(uint32_t count) { work_left -= count < work_left ? count : work_left; }
  bool is_spent() const { return work_left == 0; }
  /// Visits the entries of a dynamic body in `impacts`: pairs of the body that have a coming event, or had one in this
  /// tick.
  template <class Visit>
  void for_each_impact(uint32_t slot, const Visit& visit) const {
    if (impact_count == 0 || !may_have_entries(slot)) return;
    for (uint32_t at = first_impact_of(slot); at != 0;) {
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

#if DETENT_TASKS
  // impact.cpp

  /// Processes all events in the order of their times, and events at the same time in the order of their keys.
  void process_events();
#endif

  // impact_sweeps.cpp

  /// Computes the bounds of all sweeps. Sets k_mark_left_bounds for a sweep that leaves the bounds with which the
  /// body's pairs were found.
  void start_sweeps();
  void start_sweep(uint32_t slot);
  /// Adds the body to the moving bodies and removes it from the tree of resting ones.
  void leave_rest(uint32_t slot);
  /// Moves the body to `time` along its sweep. The sweep starts again there, with the same velocity.
  void move_to(uint32_t slot, Fraction time);
  /// Updates the bounds of a body whose sweep has changed, marks it for testing and discards its coming impacts. The
  /// body has been moved to the current time.
  void change(uint32_t slot);
  /// Stops the body at `time` until the tick ends. Does nothing if the body is not dynamic or has stopped before.
  void stop(uint32_t slot, Fraction time);
  /// Carries the angular momentum of the bodies that were hit on to the end of the tick (carried_angular_momentum()).
  void finish_momentum();

  // impact_search.cpp

  /// Finds the first impact of every pair that may collide. Sets the budget of work for the rest of the tick
  /// (k_impact_work_times).
  void find_first();
  /// Finds when a pair collides next, and stores its next event if there is one. Stops both bodies if there is no room
  /// for an impact, or if they would pass through each other. `shrink_depth`: the first shrink depth, m. `entry`: the
  /// pair's entry in `impacts`, or null.
  void test(uint64_t key, Fraction time, Real shrink_depth, ImpactPair* entry);
  /// Makes the entry of a pair in `impacts`. Returns null if there is no room.
  ImpactPair* add_entry(uint64_t key);
#if DETENT_TASKS
  /// Makes room in the group for the entry of the pair `key`, and makes the group's copies of the pair's dynamic
  /// bodies. Returns false if there is no memory.
  bool make_room_for(uint64_t key);
#endif
  /// Adds an entry to the lists of entries of its dynamic bodies. `place`: the entry's index in `impacts` + 1.
  void link(ImpactPair& entry, uint32_t place) const;
  /// Does the first part of find_first() with several threads: tests the pairs in `known`. Returns false, and changes
  /// nothing, if the pairs must be tested in order by one thread.
  bool find_first_shared();
#if DETENT_TASKS
  /// Tests the new sweep of a body against another body, if their bounds overlap and they may touch.
  void test_if_near(uint32_t slot, uint32_t other, Fraction time);
#endif
  /// Tests the sweeps that have changed against all other bodies.
  void test_all_changed(Fraction time);
  /// An estimate, m, of how far the rotations of both bodies bend the relative path of two of their points in the tick.
  Real bend_of(uint64_t key) const;
  /// Whether the solver pushed the pair apart in this tick.
  bool is_pushed(uint64_t key) const;

  // impact_solve.cpp

  void add_hit(const ImpactHit& hit);
  /// Separates the bodies of a pair. The bodies must be at the time of the impact. Returns true, with both sweeps
  /// unchanged, if the bodies collide at a seam (the edge between two bodies with level faces) and the shrink depth of
  /// the pair was not increased yet.
  bool resolve(ImpactPair& pair, bool undecided, const BodyPose& pose_a, const BodyPose& pose_b);
  /// Propagates the impulse of the pair `first` to the pairs that share a body with it and have collided in this tick,
  /// and from them back to `first`, until no pair approaches or the limit of rounds is reached. Without this, a body
  /// between two others would be hit back and forth without end. A round processes the other pairs in the order of
  /// their keys, then `first`.
  void pass_on(ImpactPair& first, Fraction time);
};

#if DETENT_TASKS
/// Processes all events in groups of bodies, with the same result as ImpactStage::process_events(). Returns false, and
/// changes no body, if process_events() must process them.
bool process_in_groups(ImpactStage& stage, ImpactOrder order, WarpCount& count);
#endif

}  // namespace DETENT_NAMESPACE
}  // namespace detent
