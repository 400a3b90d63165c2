#include "motion/predict.h"

#include "broad_phase/pair_filter.h"
#include "motion/block.h"
#include "motion/gyration.h"
#include "motion/spin.h"
#include "shape/bounds.h"
#include "shape/shape_traits.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// 1 / (1 + rate time): implicit damping.
Scaled kept(Scaled rate, Real time) {
  const Scaled one = 1.0;
  return is_positive(rate) ? divide(one, add(one, multiply(rate, scaled_from(time)))) : one;
}

}  // namespace

Real start_body(const StepSettings& settings, const BodyTraits& traits, const BodyPose& pose, const BodyMotion& motion,
                BodyWork& work) {
  const Real zero = 0.0;
  const Vec3<Real> none = {zero, zero, zero};
  Real spin = zero;
  work.joint_body = UINT32_MAX;
  work.rotation = pose.rotation;
  work.displacement = none;
  work.turn = none;
  work.axes = matrix_from(pose.rotation);
  work.gyration = world_gyration(traits, work.axes);
  work.free_turn = free_turn_of(traits);
  if (!is_non_colliding(traits)) {  // only contacts read these
    work.extent = shape_extent(traits);
    work.fall = fall_speed(settings, work.extent);
    if (!(motion.momentum == none)) spin = absolute_sum(spin_of(traits, pose.rotation, motion.momentum));
    work.speed = absolute_sum(motion.velocity) + spin;
  }
  work.spin = world_spin(traits, work.gyration, motion.momentum, -k_spin_power);
  return spin;
}

void predict(const StepSettings& settings, Span<const BodyTraits> traits, Span<const uint32_t> bodies,
             Span<BodyMotion> motions, Span<BodyWork> work) {
  const Real zero = 0.0;
  const Vec3<Real> none = {zero, zero, zero};
  const Vec3<Real> gravity_push = settings.gravity * settings.time;
  for (const uint32_t slot : bodies) {
    const BodyTraits& body = traits[slot];
    BodyMotion& motion = motions[slot];
    BodyWork& now = work[slot];
    now.push = multiply(gravity_push, body.gravity_scale);
    now.twist = none;
    if (!(motion.pending_velocity == none)) now.push += multiply(motion.pending_velocity, settings.share);
    if (!(motion.pending_momentum == none)) now.twist = multiply(motion.pending_momentum, settings.share);
    motion.pending_velocity = motion.pending_momentum = none;
    now.linear_kept = kept(body.linear_damping, settings.time);
    now.angular_kept = kept(body.angular_damping, settings.time);
  }
}

void bound(const StepSettings& settings, Span<const BodyPose> poses, Span<const BodyTraits> traits,
           Span<const BodyMotion> motions, Span<const uint32_t> bodies, Span<BodyWork> work, Span<Bounds> bounds) {
  const Vec3<Real> fall = settings.gravity * (settings.tick_time * settings.tick_time);
  for (const uint32_t slot : bodies) {
    const BodyTraits& body = traits[slot];
    const Real spin = start_body(settings, body, poses[slot], motions[slot], work[slot]);
    if (is_non_colliding(body)) {
      bounds[slot] = k_nowhere;
      continue;
    }
    if (is_half_space(body)) {
      bounds[slot] = k_everywhere;
      continue;
    }
    const BodyMotion& motion = motions[slot];
    const Vec3<Real> half = half_bounds(body, work[slot].axes);
    const Real margin = bounds_extent(body) * settings.breaking;
    Vec3<Real> reach = {half.x + margin, half.y + margin, half.z + margin};
    Vec3<Real> move = motion.velocity * settings.tick_time;
    if (is_dynamic(body)) move += fall;
    if (!(motion.momentum == Vec3<Real>{Real(0.0), Real(0.0), Real(0.0)})) {
      // A rotating body stays in its bounding sphere.
      const Real ball = real_from_unit(body.bounding_radius, body.size_exponent) + margin;
      const Real swing = spin * settings.tick_time;
      reach = {min(reach.x + swing, ball), min(reach.y + swing, ball), min(reach.z + swing, ball)};
    }
    const Real zero = 0.0;
    const Position& at = poses[slot].position;
    bool beyond = false;  // clamped bounds still contain the body
    bounds[slot].lower = {coord_advance(at.x, min(move.x, zero) - reach.x, beyond),
                          coord_advance(at.y, min(move.y, zero) - reach.y, beyond),
                          coord_advance(at.z, min(move.z, zero) - reach.z, beyond)};
    bounds[slot].upper = {coord_advance(at.x, max(move.x, zero) + reach.x, beyond),
                          coord_advance(at.y, max(move.y, zero) + reach.y, beyond),
                          coord_advance(at.z, max(move.z, zero) + reach.z, beyond)};
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
