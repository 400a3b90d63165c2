#include <detent/body.h>
#include <detent/world.h>

#include "base/float_environment.h"
#include "state/ranges.h"
#include "world/body_change.h"
#include "world/body_parts.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// Sets `speed` to impulse / (mass 2^exponent), m/s. For an impulse, N s, `exponent` is 0. For an angular impulse, N m
/// s, it is the body's size_exponent. Returns false if the result leaves Real's range.
bool speed_from(const Vec3<Scaled>& impulse, Scaled mass, int exponent, Vec3<Real>& speed) {
  bool saturated = false;
  const Scaled over = scaled_by_power(mass, exponent);
  speed = {to_real(divide(impulse.x, over), saturated), to_real(divide(impulse.y, over), saturated),
           to_real(divide(impulse.z, over), saturated)};
  return !saturated;
}

/// A pending change of a dynamic body's motion, which is checked before it is stored.
struct BodyPush {
  StateView<uint8_t> state;
  uint32_t slot = 0;
  BodyMotion motion = {};

  Status find(BodyId id, const Vec3<Scaled>& cause) {
    if (!find_body(state, id, slot)) return Status::bad_id;
    if (!is_dynamic(state.properties[slot])) return Status::bad_argument;
    if (!is_number(cause)) return Status::out_of_range;
    motion = state.motions[slot];
    return Status::ok;
  }
  const BodyProperties& properties() const { return state.properties[slot]; }
  /// Adds the effect of an impulse to `velocity` and `angular_momentum`. `speed`: impulse / mass, m/s. `arm`: from the
  /// centre of mass to the point at which the impulse acts, m. Both are in world axes.
  /// Errors: out_of_range.
  Status push_at(const Vec3<Real>& speed, const Vec3<Real>& arm, Vec3<Real>& velocity,
                 Vec3<Real>& angular_momentum) const {
    const int exponent = properties().size_exponent;
    if (!within(arm, real_from_unit(properties().bounding_radius, exponent + 1))) return Status::out_of_range;
    if (!within(speed, k_speed_work_max)) return Status::out_of_range;
    // The arm is halved and stored in the body's unit of length, so that an arm of twice the bounding radius fits a
    // Unit.
    const Vec3<Unit> arm_halved = unit_from_real(arm, exponent + 1);
    const Vec3<Real> change_of_rotation = cross(arm_halved, speed);
    velocity += speed;
    angular_momentum += scale_by_power(change_of_rotation, 1);
    return Status::ok;
  }
  Vec3<Real> arm_to(const Position& point) const { return real_difference(point, state.poses[slot].position); }
  bool fits() {
    const Quat& rotation = state.poses[slot].rotation;
    motion.angular_momentum = without_locked(properties(), rotation, motion.angular_momentum);
    motion.pending_angular_momentum = without_locked(properties(), rotation, motion.pending_angular_momentum);
    const BodyMotion pending = {motion.pending_velocity, motion.pending_angular_momentum, k_zero_vector, k_zero_vector};
    return speeds_fit(properties(), rotation, motion) && speeds_fit(properties(), rotation, pending);
  }
  void make() {
    state.motions[slot] = motion;
    wake_slot(state, slot);
  }
  Status commit() {
    if (!fits()) return Status::out_of_range;
    make();
    return Status::ok;
  }
};

Vec3<Scaled> over_tick(const Vec3<Scaled>& force, const WorldState& world) {
  const Scaled time = scaled_from(world.tick_time);
  return {multiply(force.x, time), multiply(force.y, time), multiply(force.z, time)};
}

Status impulse_at(BodyPush& push, const Vec3<Scaled>& impulse, const Vec3<Real>& arm) {
  Vec3<Real> speed;
  if (!speed_from(impulse, push.properties().mass, 0, speed)) return Status::out_of_range;
  const Status status = push.push_at(speed, arm, push.motion.linear_velocity, push.motion.angular_momentum);
  return status == Status::ok ? push.commit() : status;
}

Status force_at(BodyPush& push, const Vec3<Scaled>& force, const Vec3<Real>& arm) {
  Vec3<Real> speed;
  if (!speed_from(over_tick(force, push.state.world), push.properties().mass, 0, speed)) return Status::out_of_range;
  const Status status = push.push_at(speed, arm, push.motion.pending_velocity, push.motion.pending_angular_momentum);
  return status == Status::ok ? push.commit() : status;
}

/// The impulse of an explosion on a dynamic body, N s; zero if the explosion does not reach the body. `offset`: from
/// the centre of the explosion to the body, m.
Vec3<Scaled> blast(const Explosion& explosion, const BodyProperties& properties, const Vec3<Real>& offset) {
  const Scaled none = 0.0, pi = 3.14159265358979323846;
  const Real zero = 0.0, ball = real_from_unit(properties.bounding_radius, properties.size_exponent);
  Vec3<Unit> direction;
  Real distance = zero;
  // The components are tested before normalise() computes the length, because a long vector's length could exceed the
  // range of Real.
  if (!within(offset, explosion.radius + ball) || !normalise(offset, direction, distance)) return {none, none, none};
  const Real gap = max(distance - ball, zero);
  if (gap >= explosion.radius) return {none, none, none};
  const Scaled area = multiply(pi, multiply(scaled_from(ball), scaled_from(ball)));
  const Scaled share = divide(scaled_from(explosion.radius - gap), scaled_from(explosion.radius));
  const Scaled size = multiply(multiply(explosion.impulse, area), share);
  return {multiply(size, scaled_from(direction.x)), multiply(size, scaled_from(direction.y)),
          multiply(size, scaled_from(direction.z))};
}

}  // namespace

Status apply_force(World& world, BodyId id, const Vec3<Scaled>& force) {
  const FloatEnvironment environment;
  BodyPush push = {view_of(world)};
  if (const Status status = push.find(id, force); status != Status::ok) return status;
  Vec3<Real> speed;
  if (!speed_from(over_tick(force, push.state.world), push.properties().mass, 0, speed)) return Status::out_of_range;
  push.motion.pending_velocity += speed;
  return push.commit();
}

Status apply_torque(World& world, BodyId id, const Vec3<Scaled>& torque) {
  const FloatEnvironment environment;
  BodyPush push = {view_of(world)};
  if (const Status status = push.find(id, torque); status != Status::ok) return status;
  Vec3<Real> speed;
  const int exponent = push.properties().size_exponent;
  if (!speed_from(over_tick(torque, push.state.world), push.properties().mass, exponent, speed))
    return Status::out_of_range;
  push.motion.pending_angular_momentum += speed;
  return push.commit();
}

Status apply_impulse(World& world, BodyId id, const Vec3<Scaled>& impulse) {
  const Vec3<Real> centre = {0.0, 0.0, 0.0};
  return apply_impulse_at(world, id, impulse, centre);
}

Status apply_impulse_at(World& world, BodyId id, const Vec3<Scaled>& impulse, const Vec3<Real>& arm) {
  const FloatEnvironment environment;
  BodyPush push = {view_of(world)};
  if (const Status status = push.find(id, impulse); status != Status::ok) return status;
  return impulse_at(push, impulse, arm);
}

Status apply_impulse_at_point(World& world, BodyId id, const Vec3<Scaled>& impulse, const Position& point) {
  const FloatEnvironment environment;
  BodyPush push = {view_of(world)};
  if (const Status status = push.find(id, impulse); status != Status::ok) return status;
  return is_position(point) ? impulse_at(push, impulse, push.arm_to(point)) : Status::out_of_range;
}

Status apply_force_at(World& world, BodyId id, const Vec3<Scaled>& force, const Vec3<Real>& arm) {
  const FloatEnvironment environment;
  BodyPush push = {view_of(world)};
  if (const Status status = push.find(id, force); status != Status::ok) return status;
  return force_at(push, force, arm);
}

Status apply_force_at_point(World& world, BodyId id, const Vec3<Scaled>& force, const Position& point) {
  const FloatEnvironment environment;
  BodyPush push = {view_of(world)};
  if (const Status status = push.find(id, force); status != Status::ok) return status;
  return is_position(point) ? force_at(push, force, push.arm_to(point)) : Status::out_of_range;
}

Status apply_angular_impulse(World& world, BodyId id, const Vec3<Scaled>& impulse) {
  const FloatEnvironment environment;
  BodyPush push = {view_of(world)};
  if (const Status status = push.find(id, impulse); status != Status::ok) return status;
  Vec3<Real> speed;
  if (!speed_from(impulse, push.properties().mass, push.properties().size_exponent, speed)) return Status::out_of_range;
  push.motion.angular_momentum += speed;
  return push.commit();
}

Status explode(World& world, const Explosion& explosion) {
  const FloatEnvironment environment;
  if (!is_position(explosion.centre) || !within(explosion.radius, Real(0x1p-14), Real(0x1p14)) ||
      !is_number(explosion.impulse)) {
    return Status::out_of_range;
  }
  const StateView<uint8_t> state = view_of(world);
  // The first round checks that all speeds stay in range; the second round applies the impulses.
  for (int round = 0; round < 2; ++round) {
    for (uint32_t slot = 0; slot < state.world.slots_used; ++slot) {
      const BodyProperties& properties = state.properties[slot];
      if (!is_dynamic(properties)) continue;
      BodyPush push = {state, slot, state.motions[slot]};
      const Vec3<Scaled> impulse = blast(explosion, properties, -push.arm_to(explosion.centre));
      if (impulse == Vec3<Scaled>{Scaled(0.0), Scaled(0.0), Scaled(0.0)}) continue;
      Vec3<Real> speed;
      if (!speed_from(impulse, properties.mass, 0, speed) || !within(speed, k_speed_work_max))
        return Status::out_of_range;
      push.motion.linear_velocity += speed;
      if (!push.fits()) return Status::out_of_range;
      if (round == 1) push.make();
    }
  }
  return Status::ok;
}

Status move_kinematic(World& world, BodyId id, const Position& position, const Quat& rotation) {
  const FloatEnvironment environment;
  StateView<uint8_t> state = view_of(world);
  uint32_t slot = 0;
  if (!find_body(state, id, slot)) return Status::bad_id;
  const BodyProperties& properties = state.properties[slot];
  if (!is_kinematic(properties)) return Status::bad_argument;
  BodyPose target{};
  if (const Status status = make_pose(position, rotation, target); status != Status::ok) return status;
  const BodyPose& pose = state.poses[slot];
  Vec3<Real> offset = real_difference(position, pose.position);
#if defined(DETENT_FX32)
  const auto rest = [&](int i) {
    return Real::from_raw(static_cast<int64_t>(pose.remainder[i]) << (Real::k_frac - 32));
  };
  offset -= Vec3<Real>{rest(0), rest(1), rest(2)};
#endif
  const Quat change_of_rotation = multiply(target.rotation, conjugate(pose.rotation));
  const Vec3<Real> angle = target.rotation == pose.rotation ? k_zero_vector : rotation_vector_from(change_of_rotation);
  const auto over_time = [&](const Vec3<Real>& v) {
    const Real time = state.world.tick_time;
    return Vec3<Real>{divide(v.x, time), divide(v.y, time), divide(v.z, time)};
  };
  BodyMotion motion = state.motions[slot];
  const Status status = make_motion(properties, pose.rotation, over_time(offset), over_time(angle), motion);
  if (status != Status::ok) return status;
  state.motions[slot] = motion;
  wake_slot(state, slot);
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
