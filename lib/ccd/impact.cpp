#include "ccd/impact.h"

#include "ccd/impact_response.h"
#include "ccd/impact_stage.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

#if DETENT_TASKS
/// If the first search makes fewer entries than this, all entries are visited to find each event.
constexpr uint32_t k_many_entries = 64;
#endif

/// The pair with the earliest event; among events at the same time, the pair with the lowest key; null if no pair has
/// an event.
ImpactPair* next(ImpactStage& stage) {
#if DETENT_TASKS
  if (stage.heads.is_made())
    return stage.heads.earliest(stage.impacts.first(stage.impact_count),
                                [](const ImpactPair& pair) { return pair.next != k_next_none; });
#endif
  ImpactPair* best = nullptr;
  for (ImpactPair& pair : stage.impacts.first(stage.impact_count)) {
    if (pair.next == k_next_none) continue;
    if (best == nullptr || is_earlier(pair, *best)) best = &pair;
  }
  return best;
}

/// The shrink depth, m, for a pair that has collided at a seam: 1/64 of the extent or twice the penetration of resting
/// bodies, whichever is more, but at most the shrink depth of a pair that is in contact without overlap.
Real seam_shrink_depth(const ImpactStage& stage, uint64_t key) {
  const Real extent = stage.extent_of(key);
  return min(max(scale_by_power(extent, -6), scale_by_power(stage.settings.sunk, 1)),
             contact_shrink_depth(extent, k_zero));
}

/// Processes the event of a pair.
void go_on(ImpactStage& stage, ImpactPair& pair) {
  const Fraction time = pair.time;
  const bool undecided = pair.next == k_next_undecided;
  if (pair.next == k_next_test) {
    stage.test(pair.key, time, k_zero, &pair);
    stage.test_all_changed(time);
    return;
  }
  const uint32_t slots[2] = {pair_low(pair.key), pair_high(pair.key)};
  if (stage.is_spent() && pair.farther_in == 0) {
    pair.farther_in = 1;  // test() now starts at extent / 8; shallower overlaps are left to the contacts
    stage.test(pair.key, time, k_zero, &pair);
    return;
  }
  pair.next = k_next_none;
  stage.touch(pair);
  pair.last = time;
  stage.report.undecided += undecided ? 1 : 0;
  for (const uint32_t slot : slots) {
    if (!stage.dynamic(slot)) continue;
    stage.move_to(slot, time);
    stage.report.clamped +=
        clamp_rotation(stage.bodies.properties[slot], stage.settings.tick_time, stage.sweep_of(slot));
  }
  const BodyPose pose_a = pose_at(stage.body(slots[0]), time), pose_b = pose_at(stage.body(slots[1]), time);
  stage.first_approach = k_zero;
  if (stage.resolve(pair, undecided, pose_a, pose_b)) {
    pair.farther_in = 1;  // both bodies continue on their sweeps: this is not an impact
    stage.test(pair.key, time, seam_shrink_depth(stage, pair.key), &pair);
    stage.test_all_changed(time);
    return;
  }
  if (stage.first_approach > k_zero) stage.pass_on(pair, time);
  const uint32_t impacts_max = stage.is_spent() ? k_impacts_max_spent : k_impacts_max;
  if (pair.impacts == 0) pair.impacts = 1;
  for (const uint32_t slot : slots) {
    if (!stage.dynamic(slot)) continue;
    BodySweep& sweep = stage.sweep_of(slot);
    if (++sweep.impacts >= impacts_max) stage.stop(slot, time);
    if ((sweep.marks & k_mark_changed) == 0) stage.change(slot);
  }
  stage.test_all_changed(time);
}

#if DETENT_TASKS
/// Up to this number of entries of the first search, groups cost more than they save.
constexpr uint32_t k_entries_for_groups = 64;

/// Processes all events, in groups if that is faster.
void process_all(ImpactStage& stage) {
  const ImpactProbe* const probe = stage.probe;
  ImpactOrder order = probe == nullptr ? ImpactOrder::automatic : probe->order;
  if (order == ImpactOrder::automatic) {
    const Team* const team = stage.settings.team;
    const bool pays = team != nullptr && stage.impact_count > team->few(k_entries_for_groups);
    order = pays ? ImpactOrder::optimistic : ImpactOrder::global;
  }
  // The listener is called, and the segments are written, in the order of the events.
  if (stage.bodies.listener.ended != nullptr || (probe != nullptr && probe->segments.count != 0))
    order = ImpactOrder::global;
  WarpCount none;
  if (order == ImpactOrder::global || !process_in_groups(stage, order, probe == nullptr ? none : stage.probe->warp))
    stage.process_events();
}
#endif

}  // namespace

#if DETENT_TASKS
void ImpactStage::process_events() {
  if (impact_count >= k_many_entries) heads.make(impacts.count, warp == nullptr ? spare : warp->spare);
  while (ImpactPair* pair = next(*this)) {
    if (warp != nullptr) warp->begin_event(*pair);
    if (gives_up()) return;
    go_on(*this, *pair);
  }
}
#endif

ImpactReport advance_to_impacts(const StepSettings& settings, const AssetTable& assets, const FeatureTable& features,
                                const ImpactPairs& pairs, const ImpactBodies& bodies, Span<ImpactPair> impacts,
                                Span<ImpactHit> hits, ImpactProbe* probe) {
  ImpactStage stage = {settings, assets, features,
                       pairs,    bodies, impacts,
                       hits,     probe,  divide(Scaled(1.0), scaled_from(settings.tick_time))};
  stage.start_sweeps();
  stage.find_first();
  stage.test_all_changed(Fraction(0.0));
#if DETENT_TASKS
  process_all(stage);
#else
  while (ImpactPair* pair = next(stage)) go_on(stage, *pair);
#endif
  stage.finish_momentum();
#if DETENT_SPARSE
  if (probe != nullptr) {
    probe->use.entries = stage.impact_count;
    probe->use.work = k_impact_work_min + probe->use.budget - stage.work_left;
  }
#endif
  return stage.report;
}

const ContinuousOps k_continuous_ops = {advance_to_impacts};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
