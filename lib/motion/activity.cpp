#include "motion/activity.h"

#include "motion/angular_velocity.h"
#include "shape/shape_properties.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr int k_rest_power = -5;
/// A speed, m/s, above which a body never counts as at rest. Below it, squared speeds do not overflow.
constexpr Real k_slow_max = 1024.0;

/// Whether all points of a body are slower than `slow`, m/s. The function estimates this from the kinetic energy per
/// unit mass: 2 (v . v + w . L / m) < slow^2, with the velocity v, angular velocity w, angular momentum L and mass m.
/// Therefore a slender body may rotate faster about its long axis than about the other axes. Range: slow <= k_slow_max.
bool is_slower(const Vec3<Real>& velocity, const Vec3<Real>& angular_velocity, const Vec3<Real>& angular_momentum,
               Real slow) {
  if (greatest(velocity) > slow || greatest(angular_velocity) > k_slow_max || greatest(angular_momentum) > k_slow_max)
    return false;
  return scale_by_power(dot(velocity, velocity) + dot(angular_velocity, angular_momentum), 1) < slow * slow;
}

/// Whether a body is at rest (fall_asleep() in activity.h), judged by its velocity and by its displacement and rotation
/// in the tick. A body that rotated by more than 1 rad in the tick is not at rest.
bool is_resting(const StepSettings& settings, const BodyProperties& properties, const BodyPose& pose,
                const BodySweep& sweep, const BodyMotion& motion) {
  const Real slow = scale_by_power(fall_speed(settings, shape_extent(properties)), k_rest_power);
  const Vec3<Real> angular_velocity = angular_velocity_of(properties, pose.rotation, motion.angular_momentum);
  if (!is_slower(motion.linear_velocity, angular_velocity, motion.angular_momentum, slow) ||
      greatest(sweep.rotation_vector) > Real(1.0))
    return false;
  const Real rate = divide(Real(1.0), settings.tick_time);
  const Vec3<Real> velocity = sweep.displacement * rate;
  const Vec3<Real> turning = scale_by_power(sweep.rotation_vector * rate, properties.size_exponent);
  return is_slower(velocity, turning, angular_momentum_of(properties, pose.rotation, turning), slow);
}

}  // namespace

bool is_moving(const BodyProperties& properties, const BodyMotion& motion, const BodyActivity& activity) {
  if (is_dynamic(properties)) return activity.asleep == 0;
  return is_kinematic(properties) &&
         !(motion.linear_velocity == k_zero_vector && motion.angular_momentum == k_zero_vector);
}

uint32_t wake_all_with(uint32_t slot, Span<BodyActivity> activities, BitSet active) {
  const uint32_t group = activities[slot].asleep;
  if (group == 0) return 0;
  uint32_t count = 0;
  for (uint32_t other = 0; other < activities.count; ++other) {
    BodyActivity& activity = activities[other];
    if (activity.asleep != group) continue;
    activity.asleep = 0;
    activity.still_ticks = 0;
    activity.pending_event = static_cast<uint16_t>(BodyEventType::woke);
    active.set(other);
    ++count;
  }
  return count;
}

uint32_t fall_asleep(const StepSettings& settings, Span<const BodyProperties> properties, Span<const BodyPose> poses,
                     Span<const BodySweep> sweeps, Span<const Island> islands, Span<const uint32_t> bodies,
                     Span<BodyMotion> motions, Span<BodyActivity> activities) {
  uint32_t asleep = 0;
  for (const Island& island : islands) {
    bool still = true;
    for (uint32_t i = 0; i < island.body_count; ++i) {
      const uint32_t slot = bodies[island.first_body + i];
      const bool rests = is_resting(settings, properties[slot], poses[slot], sweeps[slot], motions[slot]);
      uint16_t& ticks = activities[slot].still_ticks;
      ticks = static_cast<uint16_t>(!rests ? 0 : ticks < k_still_ticks ? ticks + 1 : ticks);
      still = still && ticks == k_still_ticks;
    }
    if (!still) continue;
    const uint32_t group = bodies[island.first_body] + 1;
    for (uint32_t i = 0; i < island.body_count; ++i) {
      const uint32_t slot = bodies[island.first_body + i];
      motions[slot].linear_velocity = motions[slot].angular_momentum = k_zero_vector;
      activities[slot].asleep = group;
      activities[slot].pending_event = static_cast<uint16_t>(BodyEventType::fell_asleep);
    }
    asleep += island.body_count;
  }
  return asleep;
}

const SleepingOps k_sleeping_ops = {fall_asleep};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
