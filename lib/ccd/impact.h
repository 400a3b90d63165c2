#pragma once
#include <detent/asset.h>
#include <detent/detail/scratch.h>
#include <detent/features.h>
#include <detent/filter.h>

#include "base/bit_set.h"
#include "broad_phase/resting_tree.h"
#include "motion/step_settings.h"

/// Continuous collision: bodies that would meet on their sweeps meet at the time of impact, and what they then do is
/// resolved at once.
///
/// Events of the whole world are taken in the order of their times, ties by the pair's slots. Both bodies are moved to
/// the time of impact, an impulse lets them part, and the rest of both sweeps is tested against all others again. The
/// impulse is found twice: from the velocities of the sweeps, for the rest of the tick, and from those of the bodies'
/// state then, so that what the solver has resolved already is not resolved again. Each acts on both bodies alike.
///
/// A pair that meets again at once touches for the rest of the tick: it is tested from rung to rung of a ladder of
/// depths (impact_pair.h), so that it slides on. A body that meets more than k_impacts_max times, or for whose next
/// impact there is no room, stays where it is certain to be free until the tick ends; this lost time is reported.
///
/// A tick has a budget of work (k_impact_work_times). Once it is spent, pairs meet an eighth of the smaller body's
/// extent farther in, where contacts hold them in the next tick, and a body that comes so far stays there all the
/// sooner.
namespace detent {
inline namespace DETENT_NAMESPACE {

inline constexpr uint32_t k_impacts_max = 32;  ///< of a body in a tick
/// Once the tick's work is spent, which is so many tests of pairs and blows: so many times what the first look at all
/// pairs and bodies took, and more where these are few.
inline constexpr uint32_t k_impacts_max_spent = 16, k_impact_work_times = 8, k_impact_work_min = 512;
/// A mark of a body's sweep that joints hold, times the number of its island, from 1 on. All other marks are less.
inline constexpr uint32_t k_mark_jointed = 32;

/// For tests: what is written down of the stage, and whether pairs that cannot meet are left out.
struct ImpactProbe {
  bool filters = true;
  Span<SweepSegment> segments;  ///< of all bodies that move, in the order in which they begin; no more than fit
  uint32_t segment_count = 0;   ///< also of those that did not fit
};

struct ImpactReport {
  uint32_t impacts = 0;         ///< that changed how bodies move
  uint32_t undecided = 0;       ///< times of impact that were found in part, or could not be asked for
  uint32_t overlaps_left = 0;   ///< pairs too deep within each other to be tested
  uint32_t bodies_stopped = 0;  ///< that stayed behind until the end of the tick
  uint32_t pairs_dropped = 0;   ///< impacts for which there was no room: they stopped their bodies
  uint32_t hits_dropped = 0;    ///< impacts for which there was no room in `hits`
  uint32_t hits = 0;            ///< written
  uint32_t tests = 0;           ///< times of impact asked for
  uint32_t skipped = 0;         ///< pairs that cannot meet by their speeds
  uint32_t woke = 0;            ///< bodies that slept, and those that they slept with
  uint32_t clamped = 0;         ///< components held to their range
  Real lost_time = 0.0;         ///< sum of the parts of the tick that stopped bodies missed
};

/// Is told of each stretch of a body's sweep that ends before the tick does, while the body is still at its start.
struct StretchListener {
  void (*ended)(void* context, uint32_t slot, Fraction until) = nullptr;  ///< null: nobody listens
  void* context = nullptr;
};

/// The bodies of the stage. Their poses are those of sweep.from, and follow it.
struct ImpactBodies {
  Span<const BodyTraits> traits;
  Span<BodyPose> poses;
  Span<BodyMotion> motions;
  Span<BodySweep> sweeps;  ///< of a body that rests: zero
  Span<BodyActivity> activities;
  Span<Bounds> bounds;       ///< as the pairs were found; become the bounds of the sweeps
  RestingTree resting;       ///< what is struck leaves it
  BitSet visits;             ///< the bodies that move, and those that are struck or woken
  BitSet candidates;         ///< work space, zero before and after
  Span<uint32_t> first_met;  ///< work space: of each dynamic body, where the list of the pairs that it meets in begins
  FilterRuleTable filter_rules = {};
  StretchListener listener = {};
};

/// What the stages before know of the pairs of bodies.
struct ImpactPairs {
  Span<const uint64_t> pairs;        ///< all that may meet while both bodies stay in their bounds, ascending
  Span<const ContactWork> contacts;  ///< those with contact points at the start of the tick, likewise
  bool complete;                     ///< none of them was dropped
  Span<const uint64_t> apart;        ///< pairs that are not to meet, ascending
};

/// `met` is work space, `hits` is filled in the order of the impacts.
ImpactReport advance_to_impacts(const StepSettings& settings, const AssetTable& assets, const FeatureTable& features,
                                const ImpactPairs& pairs, const ImpactBodies& bodies, Span<ImpactPair> met,
                                Span<ImpactHit> hits, ImpactProbe* probe = nullptr);

/// For a feature table.
struct ContinuousOps {
  decltype(&advance_to_impacts) advance;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
