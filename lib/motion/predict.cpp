#include "motion/predict.h"

#include "broad_phase/pair_filter.h"
#include "motion/angular_velocity.h"
#include "motion/block.h"
#include "motion/inverse_inertia.h"
#include "shape/bounds.h"
#include "shape/shape_properties.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// The fraction of a velocity that remains after `time`, s, of implicit damping at `rate`, 1/s: 1 / (1 + rate time).
Scaled kept(Scaled rate, Real time) {
  const Scaled one = 1.0;
  return is_positive(rate) ? divide(one, add(one, multiply(rate, scaled_from(time)))) : one;
}

}  // namespace

Real start_body(const StepSettings& settings, const BodyProperties& properties, const BodyPose& pose,
                const BodyMotion& motion, BodyWork& work) {
  const Real zero = 0.0;
  const Vec3<Real> none = {zero, zero, zero};
  work.colours = 0;
  work.joint_body = UINT32_MAX;
  work.rotation = pose.rotation;
  work.displacement = none;
  work.rotation_vector = none;
  work.axes = matrix_from(pose.rotation);
  work.inverse_inertia = world_inverse_inertia(properties, work.axes);
  work.free_rotation = free_rotation_of(properties);
  renew_angular_velocity(properties, motion, work);
  const Real angular_velocity = scale_by_power(absolute_sum(work.angular_velocity), k_angular_velocity_power);
  if (!is_non_colliding(properties)) {  // only contacts read the members set here
    work.extent = shape_extent(properties);
    work.fall = fall_speed(settings, work.extent);
    work.speed = absolute_sum(motion.linear_velocity) + angular_velocity;
  }
  return angular_velocity;
}

void predict(const StepSettings& settings, Span<const BodyProperties> properties, Span<const uint32_t> bodies,
             Span<BodyMotion> motions, Span<BodyWork> work) {
  const Real zero = 0.0;
  const Vec3<Real> none = {zero, zero, zero};
  const Vec3<Real> gravity_push = settings.gravity * settings.time;
  for (const uint32_t slot : bodies) {
    const BodyProperties& body = properties[slot];
    BodyMotion& motion = motions[slot];
    BodyWork& now = work[slot];
    now.push = multiply(gravity_push, body.gravity_scale);
    now.twist = none;
    if (!(motion.pending_velocity == none)) now.push += multiply(motion.pending_velocity, settings.share);
    if (!(motion.pending_angular_momentum == none))
      now.twist = multiply(motion.pending_angular_momentum, settings.share);
    motion.pending_velocity = motion.pending_angular_momentum = none;
    now.linear_kept = kept(body.linear_damping, settings.time);
    now.angular_kept = kept(body.angular_damping, settings.time);
  }
}

void bound(const StepSettings& settings, Span<const BodyPose> poses, Span<const BodyProperties> properties,
           Span<const BodyMotion> motions, Span<const uint32_t> bodies, Span<BodyWork> work, Span<Bounds> bounds) {
  const Vec3<Real> fall = settings.gravity * (settings.tick_time * settings.tick_time);
  for (const uint32_t slot : bodies) {
    const BodyProperties& body = properties[slot];
    const Real angular_velocity = start_body(settings, body, poses[slot], motions[slot], work[slot]);
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
    const Real margin = bounds_extent(body) * settings.contact_margin;
    Vec3<Real> motion_bound = {half.x + margin, half.y + margin, half.z + margin};
    Vec3<Real> move = motion.linear_velocity * settings.tick_time;
    if (is_dynamic(body)) move += fall;
    if (!(motion.angular_momentum == Vec3<Real>{Real(0.0), Real(0.0), Real(0.0)})) {
      // A rotating body stays within its bounding sphere.
      const Real ball = real_from_unit(body.bounding_radius, body.size_exponent) + margin;
      const Real swing = angular_velocity * settings.tick_time;
      motion_bound = {min(motion_bound.x + swing, ball), min(motion_bound.y + swing, ball),
                      min(motion_bound.z + swing, ball)};
    }
    const Real zero = 0.0;
    const Position& at = poses[slot].position;
    bool beyond = false;  // ignored: clamped bounds still contain the body
    bounds[slot].lower = {coord_advance(at.x, min(move.x, zero) - motion_bound.x, beyond),
                          coord_advance(at.y, min(move.y, zero) - motion_bound.y, beyond),
                          coord_advance(at.z, min(move.z, zero) - motion_bound.z, beyond)};
    bounds[slot].upper = {coord_advance(at.x, max(move.x, zero) + motion_bound.x, beyond),
                          coord_advance(at.y, max(move.y, zero) + motion_bound.y, beyond),
                          coord_advance(at.z, max(move.z, zero) + motion_bound.z, beyond)};
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
