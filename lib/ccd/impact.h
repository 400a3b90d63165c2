#pragma once
#include <detent/asset.h>
#include <detent/body.h>
#include <detent/detail/scratch.h>
#include <detent/features.h>

#include "base/bit_set.h"
#include "broad_phase/resting_tree.h"
#include "motion/step_settings.h"

/// Continuous collision: finds the times of impact of bodies whose sweeps collide, and resolves each impact at its
/// time.
///
/// The impacts of the whole world are processed in the order of their times. Impacts at the same time are processed in
/// the order of the pairs' slots. For each impact, both bodies move to the time of impact, an impulse separates them,
/// and the rest of both sweeps is tested against all other bodies again. The impulse is computed twice. One impulse is
/// computed from the velocities of the sweeps, and changes the sweeps for the rest of the tick. The other impulse is
/// computed from the velocities in the bodies' state, and changes those velocities. Therefore an approach that the
/// solver has already resolved is not resolved again. Each impulse acts on both bodies with opposite sign.
///
/// If the bodies of a pair still touch after their impact, the pair is in contact for the rest of the tick. It is then
/// tested with shrunken cores, which are its shapes made smaller by increasing shrink depths (impact_pair.h), so that
/// the bodies can slide on. A body stops until the end of the tick if it reaches k_impacts_max impacts, or if the list
/// of impacts has no room for its next impact. It then stays at its last pose that is known to be free of collisions.
/// The time that it loses is reported.
///
/// The work of a tick has a budget (k_impact_work_times). Once the budget is spent, pairs are tested with cores that
/// are shrunk by an eighth of the smaller body's smallest diameter. Shallower collisions are left to the contacts of
/// the next tick. The limit of impacts per body is then k_impacts_max_spent.
namespace detent {
inline namespace DETENT_NAMESPACE {

inline constexpr uint32_t k_impacts_max = 32;  ///< limit of the impacts of a body in a tick
/// `k_impacts_max_spent`: limit of impacts per body and tick once the budget of work is spent. The unit of work is one
/// computed time of impact, or one attempt to resolve an impact. The budget is
///
///     k_impact_work_min + k_impact_work_times (moving bodies + tests + skipped + kept_apart)
///
/// where `tests`, `skipped` and `kept_apart` are the counts in ImpactReport after the first test of all pairs.
inline constexpr uint32_t k_impacts_max_spent = 16, k_impact_work_times = 8, k_impact_work_min = 768;
/// BodySweep::marks of a jointed body contains k_mark_jointed times the number of the body's island, counted from 1.
/// All other marks are bits below k_mark_jointed.
inline constexpr uint32_t k_mark_jointed = 128;

/// What a step used of the pools and budgets of continuous collision, which all islands share.
struct ImpactUse {
  uint32_t entries = 0;  ///< entries in the pool of impacts
  uint32_t work = 0;     ///< units of work that were done
  uint32_t budget = 0;   ///< the budget of work without k_impact_work_min

  bool is_spent() const { return work >= k_impact_work_min + budget; }
};

#if DETENT_TASKS
/// In which order impacts are processed. The order does not change the results.
enum class ImpactOrder : uint8_t {
  automatic,     ///< `optimistic` if there are threads and enough impacts, else `global`
  global,        ///< in the order of their times over the whole world
  conservative,  ///< in groups of bodies that first impacts or ImpactPairs::pairs connect (time_warp.cpp)
  optimistic,    ///< in groups of bodies that first impacts connect
};

/// What Time Warp did: it processes impacts in groups of bodies in parallel, and rolls groups back (time_warp.cpp).
struct WarpCount {
  uint32_t ticks = 0;         ///< ticks for which groups were tried
  uint32_t speculations = 0;  ///< runs of groups
  uint32_t rollbacks = 0;     ///< runs whose result was discarded
  uint32_t rounds = 0;
  uint32_t returns = 0;  ///< ticks that were processed in the order of time after all (ImpactOrder::global)
};
#endif

/// In tests, records the sweeps, and can switch off the filter that skips pairs which cannot collide. In a rollback,
/// records the region that each body reaches.
struct ImpactProbe {
  bool filters = true;
  /// Receives the segments of all moving bodies, in the order in which they begin. Segments that do not fit are left
  /// out.
  Span<SweepSegment> segments;
  uint32_t segment_count = 0;  ///< includes segments that did not fit
#if DETENT_TASKS
  ImpactOrder order = ImpactOrder::automatic;
  WarpCount warp = {};
#endif
#if DETENT_SPARSE
  Span<Bounds> reach = {};  ///< by slot: receives the bounds of all sweeps of the body; may be empty
  ImpactUse use = {};
#endif
};

struct ImpactReport {
  uint32_t impacts = 0;         ///< impacts that changed a body's motion
  uint32_t undecided = 0;       ///< searches for a time of impact that stopped early, or that were impossible
  uint32_t overlaps_left = 0;   ///< pairs that overlap too deeply to be tested
  uint32_t bodies_stopped = 0;  ///< bodies stopped until the end of the tick
  uint32_t pairs_dropped = 0;   ///< impacts that had no room in `impacts`; their bodies are stopped
  uint32_t hits_dropped = 0;    ///< impacts that had no room in `hits`
  uint32_t hits = 0;            ///< entries written to `hits`
  uint32_t tests = 0;           ///< times of impact computed
  uint32_t skipped = 0;         ///< pairs skipped because they are too slow to collide in this tick
  uint32_t kept_apart = 0;      ///< pairs not tested because their contacts keep them apart
  uint32_t woke = 0;            ///< sleeping bodies that were woken, with their islands
  uint32_t clamped = 0;         ///< values that were clamped to their range
  Real lost_time = 0.0;         ///< sum of the fractions of the tick that stopped bodies lost
};

/// Callback for each segment of a body's sweep that ends before the tick does. Called while the body is still at the
/// start of the segment.
struct SweepListener {
  void (*ended)(void* context, uint32_t slot, Fraction until) = nullptr;  ///< null: no listener
  void* context = nullptr;
};

/// The bodies of the stage. The pose of a body is that at the time `from` of its sweep. Pose and sweep are updated
/// together.
struct ImpactBodies {
  Span<const BodyProperties> properties;
  Span<BodyPose> poses;
  Span<BodyMotion> motions;
  Span<BodySweep> sweeps;  ///< zero for a body at rest
  Span<ImpactPath> paths;  ///< work space
  Span<BodyActivity> activities;
  /// In: the bounds that the pairs were found with. Out: the bounds of the sweeps.
  Span<Bounds> bounds;
  RestingTree resting;  ///< bodies that are hit are removed from it
  BitSet active;        ///< the moving bodies, and those that are hit or woken
  BitSet candidates;    ///< work space, empty before and after
  /// Work space: for each dynamic body, the head of the list of its entries in `impacts`: the entry's index + 1, or 0.
  Span<uint32_t> first_impact;
  FilterRuleTable filter_rules = {};
  SweepListener listener = {};
#if DETENT_TASKS
  Span<uint64_t> spare = {};  ///< work space; with less of it, the stage takes longer
#endif
};

/// The pairs and contacts that earlier stages found.
struct ImpactPairs {
  /// The keys of all pairs that may touch while both bodies stay within their bounds, ascending.
  Span<const uint64_t> pairs;
  /// The contacts that had points at the start of the tick, ascending by pair.
  Span<const ContactWork> contacts;
  bool complete;                        ///< true if no pair and no contact was dropped
  Span<const uint64_t> disabled_pairs;  ///< keys of the disabled pairs, ascending
};

/// Finds and resolves the impacts of a tick. `impacts` is work space. `hits` is filled in the order of the impacts.
ImpactReport advance_to_impacts(const StepSettings& settings, const AssetTable& assets, const FeatureTable& features,
                                const ImpactPairs& pairs, const ImpactBodies& bodies, Span<ImpactPair> impacts,
                                Span<ImpactHit> hits, ImpactProbe* probe = nullptr);

/// FeatureTable points to these functions if the feature is linked.
struct ContinuousOps {
  decltype(&advance_to_impacts) advance;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
