#include "broad_phase/pair_filter.h"
#include "ccd/impact_response.h"
#include "ccd/impact_stage.h"
#include "math/root.h"
#include "shape/bounds.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

bool holds(const Bounds& outer, const Bounds& inner) {
  return outer.lower.x <= inner.lower.x && inner.upper.x <= outer.upper.x && outer.lower.y <= inner.lower.y &&
         inner.upper.y <= outer.upper.y && outer.lower.z <= inner.lower.z && inner.upper.z <= outer.upper.z;
}

/// The bounds of a body over a sweep. Their margin is smaller than that of the bounds with which the pairs were found.
Bounds bounds_over(const BodyProperties& properties, const BodyPose& pose, const Sweep& sweep) {
  if (is_non_colliding(properties)) return k_nowhere;
  if (is_half_space(properties)) return k_everywhere;
  const Real margin = scale_by_power(bounds_extent(properties), -8);
  Vec3<Real> motion_bound = half_bounds(properties, matrix_from(pose.rotation));
  if (!(sweep.rotation_vector == k_zero_vector)) {
    const Real ball = real_from_unit(properties.bounding_radius, properties.size_exponent);
    const Real swing = ball * min(length(sweep.rotation_vector), Real(4.0));
    motion_bound = {min(motion_bound.x + swing, ball), min(motion_bound.y + swing, ball),
                    min(motion_bound.z + swing, ball)};
  }
  motion_bound += {margin, margin, margin};
  const Vec3<Real>& displacement = sweep.displacement;
  bool beyond = false;  // clamped bounds still contain the body
  const Position& at = pose.position;
  return {{coord_advance(at.x, min(displacement.x, k_zero) - motion_bound.x, beyond),
           coord_advance(at.y, min(displacement.y, k_zero) - motion_bound.y, beyond),
           coord_advance(at.z, min(displacement.z, k_zero) - motion_bound.z, beyond)},
          {coord_advance(at.x, max(displacement.x, k_zero) + motion_bound.x, beyond),
           coord_advance(at.y, max(displacement.y, k_zero) + motion_bound.y, beyond),
           coord_advance(at.z, max(displacement.z, k_zero) + motion_bound.z, beyond)}};
}

/// Computes the bounds of the body's sweep from now on, and records the sweep in the probe.
void begin_sweep(ImpactStage& stage, uint32_t slot) {
  const BodySweep& sweep = stage.sweep_of(slot);
  const Sweep rest = rest_of(sweep, sweep.from);
  const BodyPose& pose = stage.pose_of(slot);
#if DETENT_TASKS
  if (stage.warp == nullptr) stage.moving.remove(slot, stage.bodies.bounds);
#endif
  stage.bounds_of(slot) = bounds_over(stage.bodies.properties[slot], pose, rest);
#if DETENT_TASKS
  if (WarpBody* const own = stage.own_of(slot)) {
    include(own->bounds, own->reach);
    return;
  }
  stage.moving.insert(slot, stage.bodies.bounds);
#endif
  if (stage.probe == nullptr) return;
#if DETENT_SPARSE
  if (stage.probe->reach.count != 0) include(stage.bounds_of(slot), stage.probe->reach[slot]);
  if (stage.probe->segments.count == 0) return;
#endif
  const uint32_t at = stage.probe->segment_count++;
  if (at >= stage.probe->segments.count) return;
  stage.probe->segments[at] = {slot, 0, sweep.from, pose, rest.displacement, rest.rotation_vector};
}

/// Adds to `path`, the body's motion so far, the segment of its sweep that ends at `time`. `first`: whether this is the
/// body's first segment.
void end_segment(const BodyProperties& properties, const BodySweep& sweep, Fraction time, bool first,
                 ImpactPath& path) {
  if (first) path = {k_zero_vector, k_zero_vector, k_zero};
  if (!(time > sweep.from)) return;
  const Sweep part = sweep_part({sweep.displacement, sweep.rotation_vector}, time - sweep.from);
  path.displacement += part.displacement;
  path.rotation_vector += part.rotation_vector;
  path.bound += swing_bound(properties, part.rotation_vector);
}

/// The body's rotation at the end of the tick if it keeps its current sweep.
Quat end_rotation(const ImpactStage& stage, uint32_t slot) {
  const BodySweep& sweep = stage.sweep_of(slot);
  return sweep_end_rotation(stage.pose_of(slot).rotation, rest_of(sweep, sweep.from));
}

}  // namespace

void ImpactStage::start_sweeps() {
  Team* const team = probe == nullptr || probe->segments.count == 0 ? settings.team : nullptr;
  share(team, bodies.active.words.count, 1, [&](uint32_t first, uint32_t last) {
    bodies.active.for_each_in(first, last, [&](uint32_t slot) { start_sweep(slot); });
  });
}

void ImpactStage::start_sweep(uint32_t slot) {
  BodySweep& sweep = sweep_of(slot);
  sweep.marks |= k_mark_moved;
  if (is_non_colliding(bodies.properties[slot])) {
    begin_sweep(*this, slot);
    return;
  }
  if (!is_at_rest(sweep)) {
    const Bounds found_by = bounds_of(slot);
    begin_sweep(*this, slot);
    if (!holds(found_by, bounds_of(slot))) sweep.marks |= k_mark_left_bounds;
    path_of(slot).bound = motion_bound(body(slot), sweep.from);
  }
  if (!filters() || !known.complete) sweep.marks |= k_mark_left_bounds;
}

void ImpactStage::leave_rest(uint32_t slot) {
  bodies.active.set(slot);
  if (bodies.resting.has(slot)) bodies.resting.remove(slot);
#if DETENT_TASKS
  moving.insert(slot, bodies.bounds);
#endif
}

void ImpactStage::move_to(uint32_t slot, Fraction time) {
#if DETENT_TASKS
  if (WarpBody* const own = own_of(slot))
    own->move(time);
  else
#endif
    leave_rest(slot);
  BodySweep& sweep = sweep_of(slot);
  const bool hit = (sweep.marks & k_mark_hit) != 0;
  sweep.marks |= k_mark_hit;
  // Before the first hit, the angular momentum is the solver's, which belongs to the rotation at the end of the tick.
  // After a hit, it belongs to the body's current rotation.
  const Quat from = hit ? pose_of(slot).rotation : end_rotation(*this, slot);
  end_segment(bodies.properties[slot], sweep, time, !hit, path_of(slot));
  if (time > sweep.from) {
    if (bodies.listener.ended != nullptr) bodies.listener.ended(bodies.listener.context, slot, time);
    pose_of(slot) = pose_at(body(slot), time);
  }
  sweep.from = time;
  Vec3<Real>& angular_momentum = motion_of(slot).angular_momentum;
  angular_momentum = carried_angular_momentum(bodies.properties[slot], from, pose_of(slot).rotation, angular_momentum);
}

void ImpactStage::finish_momentum() {
  bodies.active.for_each([&](uint32_t slot) {
    if ((sweep_of(slot).marks & k_mark_hit) == 0) return;
    Vec3<Real>& angular_momentum = motion_of(slot).angular_momentum;
    angular_momentum = carried_angular_momentum(bodies.properties[slot], pose_of(slot).rotation,
                                                end_rotation(*this, slot), angular_momentum);
  });
}

void ImpactStage::change(uint32_t slot) {
  BodySweep& sweep = sweep_of(slot);
  begin_sweep(*this, slot);
  if ((sweep.marks & k_mark_changed) == 0) ++changed_count;
  changed_first = slot < changed_first ? slot : changed_first;
  sweep.marks |= k_mark_changed;
  for_each_impact(slot, [this](ImpactPair& pair) {
    pair.next = k_next_none;
    touch(pair);
  });
}

void ImpactStage::stop(uint32_t slot, Fraction time) {
  BodySweep& sweep = sweep_of(slot);
  if (!dynamic(slot) || (sweep.marks & k_mark_stopped) != 0) return;
  move_to(slot, time);
  sweep.displacement = sweep.rotation_vector = k_zero_vector;
  sweep.marks |= k_mark_stopped;
  ++report.bodies_stopped;
  const Real lost = part_of(Real(1.0), k_whole_step - time);
#if DETENT_TASKS
  if (warp != nullptr) own_of(slot)->moved_untested = 1;
  if (warp != nullptr)
    warp->add_output({0, time, {}, {}, lost});
  else
#endif
    report.lost_time += lost;
  change(slot);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
