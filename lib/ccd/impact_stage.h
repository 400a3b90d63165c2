#pragma once
#include "broad_phase/pair_key.h"
#include "ccd/impact.h"
#include "ccd/impact_pair.h"
#include "motion/spin.h"
#include "shape/shape_traits.h"

/// What the files of continuous collision share: impact.cpp takes the events in their order, impact_search.cpp finds
/// when pairs meet, impact_blow.cpp lets them part, impact_sweeps.cpp keeps the bodies' sweeps.
namespace detent {
inline namespace DETENT_NAMESPACE {

// What comes next of a pair.
inline constexpr uint8_t k_next_none = 0;
inline constexpr uint8_t k_next_impact = 1;
inline constexpr uint8_t k_next_undecided = 2;  ///< up to there it is clear
inline constexpr uint8_t k_next_look = 3;       ///< it is tested again, from farther out on the ladder if it has parted

// Marks of a body's sweep, beside k_mark_jointed.
inline constexpr uint32_t k_mark_stopped = 1;  ///< it stays where it is
inline constexpr uint32_t k_mark_changed = 2;  ///< its new sweep is yet to be tested
inline constexpr uint32_t k_mark_strayed = 4;  ///< its sweep leaves the bounds that the pairs were found by
inline constexpr uint32_t k_mark_struck = 8;   ///< its momentum goes with its sweep
inline constexpr uint32_t k_mark_slept = 16;   ///< it was asleep when the tick began

/// The impacts of a tick.
struct ImpactStage {
  const StepSettings& settings;
  const AssetTable& assets;
  const FeatureTable& features;
  const ImpactPairs& known;
  const ImpactBodies& bodies;
  Span<ImpactPair> met;
  Span<ImpactHit> hits;
  ImpactProbe* probe;
  Scaled tick_rate;
  uint32_t work_left = UINT32_MAX;  ///< see k_impact_work_times; find_first() sets it
  uint32_t met_count = 0;
  uint32_t changed_count = 0;
  uint32_t changed_first = 0;  ///< no body below has changed
  Real first_approach = 0.0;   ///< of the impact that is being resolved, m/s
  ImpactReport report = {};

  SweptBody body(uint32_t slot) const { return {bodies.traits[slot], bodies.poses[slot], bodies.sweeps[slot]}; }
  bool dynamic(uint32_t slot) const { return is_dynamic(bodies.traits[slot]); }
  /// Whether pairs that cannot meet are left out.
  bool filters() const { return probe == nullptr || probe->filters; }
  /// Takes so many tests or blows from the work that is left.
  void take_work(uint32_t count) { work_left -= count < work_left ? count : work_left; }
  bool is_spent() const { return work_left == 0; }
  /// Visits the pairs that a dynamic body meets in, or has met.
  template <class Visit>
  void for_each_met(uint32_t slot, const Visit& visit) const {
    if (met_count == 0) return;
    for (uint32_t at = bodies.first_met[slot]; at != 0;) {
      ImpactPair& pair = met[at - 1];
      at = pair.more[pair_high(pair.key) == slot ? 1 : 0];
      visit(pair);
    }
  }
  /// The smaller body's smallest diameter, m.
  Real extent_of(uint64_t key) const {
    return min(shape_extent(bodies.traits[pair_low(key)]), shape_extent(bodies.traits[pair_high(key)]));
  }

  // impact_sweeps.cpp

  /// Finds the sweeps' bounds, and marks those that leave the bounds that the pairs were found by.
  void start_sweeps();
  /// The body's sweep begins anew at `time`, as it was.
  void move_to(uint32_t slot, Fraction time);
  /// The body, which has been moved to now, goes on in another way: what was found of it no longer holds.
  void change(uint32_t slot);
  /// The body stays where it is until the tick ends.
  void stop(uint32_t slot, Fraction time);
  /// Brings the momentum of the bodies that were struck to the end of the tick.
  void carry_to_end();

  // impact_search.cpp

  /// Finds what meets first, of all pairs that may. What that took, and the bodies that move, give the rest of the tick
  /// its budget of work.
  void find_first();
  /// Finds when a pair meets next, and keeps it if it does. `inset`: the rung to begin at; `entry`: the pair's, or
  /// null.
  void test(uint64_t key, Fraction time, Real inset, ImpactPair* entry);
  /// Tests the sweeps that have changed against all bodies.
  void test_all_changed(Fraction time);
  /// Whether the solver has pushed a pair apart in this tick.
  bool is_pushed(uint64_t key) const;

  // impact_blow.cpp

  /// Lets the bodies of a pair, which are at the time of its impact, part. True if they meet at a seam for the
  /// first time, and nothing changed.
  bool resolve(ImpactPair& pair, bool undecided, const BodyPose& pose_a, const BodyPose& pose_b);
  /// Passes a blow on to what the bodies of a pair touch since an impact of this tick, and back, until all part: a body
  /// between two others would else be struck to and fro without end. Pairs are taken by their keys.
  void pass_on(const ImpactPair& first, Fraction time);
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
