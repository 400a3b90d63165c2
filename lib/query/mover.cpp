#include <detent/body.h>
#include <detent/mover.h>
#include <detent/world.h>

#include "base/bytes.h"
#include "base/float_environment.h"
#include "motion/angular_velocity.h"
#include "query/mover_motion.h"
#include "shape/sweep.h"
#include "state/ranges.h"
#include "state/view.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr Real k_displacement_max = 256.0;
/// Limit of the mover's distance from the centre of a rotating ground, per axis, m.
constexpr Real k_arm_max = 16384.0;
#if defined(DETENT_FX32)
constexpr Real k_radius_min = 0x1p-4;
#else
constexpr Real k_radius_min = 0x1p-10;
#endif

bool are_settings(const MoverSettings& settings) {
  const Real radius = settings.radius;
  return within(radius, k_radius_min, Real(1024.0)) && within(settings.half_length, k_zero, Real(1024.0)) &&
         scale_by_power(settings.half_length, -10) <= radius &&
         within(settings.gap, scale_by_power(radius, -7), scale_by_power(radius, -2)) &&
         within(settings.step_height, k_zero, Real(256.0)) && within(settings.snap, k_zero, Real(256.0)) &&
         settings.slope_cosine >= Unit(0.125) && settings.slope_cosine <= Unit(1.0) &&
         is_between(settings.push_force, Scaled(0.0), Scaled(0x1p60));
}

Status check_mover(const Mover& mover) {
  Quat rotation;
  if (!is_position(mover.position) || !is_position(mover.ground_pose.position)) return Status::out_of_range;
  return normalise_input(mover.ground_pose.rotation, rotation) ? Status::ok : Status::not_normalised;
}

/// The displacement, m, of the mover's position by the ground's motion since the last call; zero if it exceeds
/// k_displacement_max.
Vec3<Real> displacement_of_ground(const Mover& mover, const Pose& now) {
  const Pose& then = mover.ground_pose;
  Vec3<Real> displacement = real_difference(now.position, then.position);
  if (!within(displacement, k_displacement_max)) return k_zero_vector;
  if (!(now.rotation == then.rotation)) {
    const Vec3<Real> arm = real_difference(mover.position, then.position);
    if (!within(arm, k_arm_max)) return k_zero_vector;
    displacement += rotate(normalise(multiply(now.rotation, conjugate(then.rotation))), arm) - arm;
  }
  return within(displacement, k_displacement_max) ? displacement : k_zero_vector;
}

/// The impulse, N s, by which the mover pushes the body of a contact: along the contact normal, it gives the body the
/// speed of the requested displacement, but it is at most push_force times the duration of a tick. It is zero for a
/// floor, for a body that is not dynamic, and for a body that already moves away at least as fast as the displacement.
Vec3<Scaled> impulse_of(const World& world, const MoverSettings& settings, const MoverContact& contact,
                        const Vec3<Real>& displacement) {
  const StateView<const uint8_t> state = view_of(world);
  const uint32_t slot = contact.body.slot - 1;
  const Scaled none = 0.0;
  const Vec3<Scaled> nothing = {none, none, none};
  const BodyProperties& properties = state.properties[slot];
  const Vec3<Unit> up = matrix_from(settings.rotation).column[1];
  Vec3<Real> velocity;
  if (!is_dynamic(properties) || dot(contact.normal, up) >= settings.slope_cosine ||
      get_velocity_at(world, contact.body, real_difference(contact.point, state.poses[slot].position), velocity) !=
          Status::ok)
    return nothing;
  const Real time = state.world.tick_time;
  const Real speed = divide(-dot(displacement, contact.normal), time) + dot(velocity, contact.normal);
  if (speed <= k_zero) return nothing;
  const Scaled wanted = multiply(properties.mass, scaled_from(speed));
  const Scaled most = multiply(settings.push_force, scaled_from(time));
  const Scaled size = less(wanted, most) ? wanted : most;
  return {multiply(size, scaled_from(-contact.normal.x)), multiply(size, scaled_from(-contact.normal.y)),
          multiply(size, scaled_from(-contact.normal.z))};
}

}  // namespace

Status move_mover(const World& world, const MoverSettings& asked, const Vec3<Real>& displacement, Mover& mover,
                  MoverReport& report) {
  const FloatEnvironment environment;
  MoverSettings settings = asked;
  if (!are_settings(asked) || !within(displacement, k_displacement_max)) return Status::out_of_range;
  if (!normalise_input(asked.rotation, settings.rotation)) return Status::not_normalised;
  if (const Status status = check_mover(mover); status != Status::ok) return status;

  MoverReport made;
  MoverMotion motion(world, settings, mover.position, made);
  const Vec3<Unit> up = motion.up();
  const Real rise = dot(displacement, up);

  Pose ground;
  const bool stood = get_pose(world, mover.ground, ground) == Status::ok;
  if (stood) {
    motion.pass(mover.ground);
    motion.slide(displacement_of_ground(mover, ground), MoverGait::fall);
    motion.pass({});
  }
  made.contact_count = made.contacts_dropped = 0;  // contacts made while the ground carried the mover do not count
  const Position carried = motion.position();
  motion.recover();
  const Position start = motion.position();

  const Vec3<Real> rest = motion.slide(displacement - up * rise, MoverGait::walk);
  const bool rests = stood && rise <= k_zero;
  if (rests && !within(rest, k_mover_still)) made.stepped = motion.climb(rest);

  const MoverPlane* floor = rests ? motion.descend() : nullptr;
  if (floor == nullptr) {
    motion.slide(up * rise, MoverGait::fall);
    floor = motion.find_floor();
    if (rise > k_zero) floor = nullptr;
  }
  if (motion.status() != Status::ok) return motion.status();

  made.carried = real_difference(carried, mover.position);
  made.recovered = real_difference(start, carried);
  made.moved = real_difference(motion.position(), start);
  Mover next;
  next.position = motion.position();
  if (floor != nullptr && get_pose(world, floor->body, next.ground_pose) == Status::ok) {
    next.ground = floor->body;
    made.on_ground = true;
    made.ground_normal = floor->normal;
  }
  for (uint32_t i = 0; i < made.contact_count; ++i)
    made.contacts[i].impulse = impulse_of(world, settings, made.contacts[i], displacement);
  mover = next;
  report = made;
  return Status::ok;
}

namespace {

template <class T>
uint8_t* put(uint8_t* at, const T& value, uint32_t width) {
  memcpy(at, &value, sizeof value);
  if (k_big_endian) swap_words(at, width, sizeof value / width);
  return at + sizeof value;
}
template <class T>
const uint8_t* take(const uint8_t* at, T& value, uint32_t width) {
  uint8_t bytes[sizeof value];
  memcpy(bytes, at, sizeof value);
  if (k_big_endian) swap_words(bytes, width, sizeof value / width);
  memcpy(&value, bytes, sizeof value);
  return at + sizeof value;
}

}  // namespace

void save_mover(const Mover& mover, uint8_t (&bytes)[k_mover_bytes]) {
  uint8_t* at = put(bytes, mover.position, sizeof(Coord));
  at = put(at, mover.ground, sizeof(uint32_t));
  at = put(at, mover.ground_pose.position, sizeof(Coord));
  put(at, mover.ground_pose.rotation, sizeof(Unit));
}

Status load_mover(const uint8_t (&bytes)[k_mover_bytes], Mover& mover) {
  const FloatEnvironment environment;
  Mover read;
  const uint8_t* at = take(bytes, read.position, sizeof(Coord));
  at = take(at, read.ground, sizeof(uint32_t));
  at = take(at, read.ground_pose.position, sizeof(Coord));
  take(at, read.ground_pose.rotation, sizeof(Unit));
  if (const Status status = check_mover(read); status != Status::ok) return status;
  mover = read;
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
