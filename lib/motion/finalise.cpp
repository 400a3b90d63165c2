#include "motion/finalise.h"

#include "broad_phase/pair_filter.h"
#include "motion/angular_velocity.h"
#include "shape/sweep.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// Angular velocity in the body's axes. Overflow: clamps to the range of Real.
Vec3<Real> local_angular_velocity(const BodyProperties& properties, const Vec3<Real>& angular_momentum) {
  bool saturated = false;
  return {multiply(angular_momentum.x, properties.inverse_inertia[0], saturated),
          multiply(angular_momentum.y, properties.inverse_inertia[1], saturated),
          multiply(angular_momentum.z, properties.inverse_inertia[2], saturated)};
}

/// The largest number of passes of the loop in clamp_speeds(). It is enough, because inverse inertias are far below
/// 4^64.
constexpr int k_quarterings_max = 64;

/// Whether the angular velocity is far below its limit for any orientation of the body.
bool is_slow(const BodyProperties& properties, const Vec3<Real>& angular_momentum) {
  Scaled most = properties.inverse_inertia[0];
  for (int axis = 1; axis < 3; ++axis)
    most = less(most, properties.inverse_inertia[axis]) ? properties.inverse_inertia[axis] : most;
  bool saturated = false;
  const Real angular_velocity = multiply(greatest(angular_momentum), most, saturated);
  return !saturated && angular_velocity < scale_by_power(k_angular_velocity_max, -3);
}

}  // namespace

uint32_t clamp_speeds(const BodyProperties& properties, const Quat& rotation, BodyMotion& motion) {
  uint32_t clamped = clamp_vector(motion.linear_velocity, k_speed_max) +
                     clamp_vector(motion.angular_momentum, k_angular_velocity_work_max);
  if (is_slow(properties, motion.angular_momentum)) return clamped;
  const bool turned = !is_isotropic(properties);
  Vec3<Real> local, angular_velocity;
  // Joints and impacts may leave an angular velocity beyond the range of Real. If a component in the body's axes is
  // more than twice the limit, then a component in world axes exceeds the limit. Each pass scales the momentum so that
  // the greatest component comes down to the limit. If that component has saturated at the range of Real, the pass
  // divides the momentum by about 4.
  for (int quartering = 0; quartering < k_quarterings_max; ++quartering) {
    local = turned ? rotate_inverse(rotation, motion.angular_momentum) : motion.angular_momentum;
    angular_velocity = local_angular_velocity(properties, local);
    const Real fastest = greatest(angular_velocity);
    if (!(fastest > scale_by_power(k_angular_velocity_max, 1))) break;
    motion.angular_momentum = motion.angular_momentum * divide(k_angular_velocity_max, fastest);
    ++clamped;
  }
  if (turned) angular_velocity = rotate(rotation, angular_velocity);
  const Real fastest = greatest(angular_velocity);
  if (fastest > k_angular_velocity_max) {
    motion.angular_momentum = motion.angular_momentum * divide(k_angular_velocity_max, fastest);
    ++clamped;
  }
  return clamped;
}

uint32_t make_sweeps(Span<const uint32_t> slots, Span<const BodyProperties> properties, Span<const BodyWork> work,
                     Span<const BodyPose> poses, Span<BodySweep> sweeps) {
  uint32_t clamped = 0;
  for (const uint32_t slot : slots) {
    const BodyWork& now = work[slot];
    bool turns_clamped = false;
    const int exponent = properties[slot].size_exponent;
    const Vec3<Real> rotation_vector = {angle_of(now.rotation_vector.x, exponent, turns_clamped),
                                        angle_of(now.rotation_vector.y, exponent, turns_clamped),
                                        angle_of(now.rotation_vector.z, exponent, turns_clamped)};
    const Sweep sweep = sweep_between(poses[slot].rotation, now.rotation, now.displacement, rotation_vector);
    sweeps[slot] = {};
    sweeps[slot].displacement = sweep.displacement;
    sweeps[slot].rotation_vector = sweep.rotation_vector;
    if (!is_non_colliding(properties[slot])) sweeps[slot].speed = now.speed;
    sweeps[slot].marks = (now.colours & k_has_near) != 0 ? BodySweep::k_mark_near : 0;
    clamped += turns_clamped ? 1 : 0;
  }
  return clamped;
}

uint32_t finalise_body(const BodyProperties& properties, const BodySweep& sweep, BodyPose& pose, BodyMotion& motion) {
  const Sweep rest = rest_of_tick(sweep);
  pose.rotation = sweep_end_rotation(pose.rotation, rest);
  const uint32_t clamped = sweep_end_position(pose, rest);
  if (!is_dynamic(properties)) return clamped;
  motion.angular_momentum = without_locked(properties, pose.rotation, motion.angular_momentum);
  return clamped + clamp_speeds(properties, pose.rotation, motion);
}

void store_contacts(Span<const ContactWork> work, Span<const ManifoldState> manifold_work, uint32_t awake_count,
                    uint32_t before, Span<ContactState> contacts, Span<ManifoldState> manifolds, Span<uint32_t> awake) {
  const bool has_manifolds = manifolds.count != 0;
  const auto move = [&](uint32_t from, uint32_t to) {
    contacts[to] = contacts[from];
    if (has_manifolds) manifolds[to] = manifolds[from];
  };
  const auto put = [&](uint32_t from, uint32_t to) {
    contacts[to] = work[from].state;
    if (has_manifolds) manifolds[to] = manifold_work[from];
  };
  const auto precedes = [](const ContactState& a, const ContactState& b) {
    const uint64_t key_a = key_of(a), key_b = key_of(b);
    return key_a < key_b || (key_a == key_b && a.part < b.part);
  };
  // The awake contacts before the first new or removed one keep their indices.
  uint32_t same = 0;
  for (; same < work.count && same < awake_count; ++same) {
    const ContactState& state = work[same].state;
    const ContactState& place = contacts[awake[same]];
    if (place.body_a != state.body_a || place.body_b != state.body_b || place.part != state.part) break;
    put(same, awake[same]);
  }
  // Moves the later contacts of sleeping bodies together, beginning at the index of the first awake contact that is new
  // or was removed.
  uint32_t kept = same < awake_count ? awake[same] : before;
  for (uint32_t i = same; i < awake_count; ++i) {
    const uint32_t end = i + 1 < awake_count ? awake[i + 1] : before;
    for (uint32_t place = awake[i] + 1; place < end; ++place) move(place, kept++);
  }
  const uint32_t count = kept + (work.count - same);
  uint32_t left = work.count;
  for (uint32_t place = count; left > same; --place) {
    const ContactState& state = work[left - 1].state;
    if (kept > 0 && precedes(state, contacts[kept - 1])) {
      move(--kept, place - 1);
      continue;
    }
    put(--left, place - 1);
    awake[left] = place - 1;
  }
  for (uint32_t i = count; i < before; ++i) {
    contacts[i] = ContactState{};
    if (has_manifolds) manifolds[i] = ManifoldState{};
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
