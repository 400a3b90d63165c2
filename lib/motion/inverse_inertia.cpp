#include "motion/inverse_inertia.h"

#include "motion/angular_velocity.h"
#include "motion/block.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

WorldInverseInertia world_inverse_inertia(const Scaled (&about)[3], const Matrix3& rotation) {
  const Unit zero = 0.0;
  WorldInverseInertia world = {{{zero, zero, zero}, {zero, zero, zero}, {zero, zero, zero}}, 0};
#if DETENT_FIXED
  for (const Scaled& axis : about) {
    if (axis.mantissa == 0) continue;
    const int above = axis.exponent + 31;
    world.exponent = above > world.exponent ? above : world.exponent;
  }
#endif
  const auto mantissa = [&](Scaled value) { return to_unit(scaled_by_power(value, -world.exponent)); };
  if (about[0] == about[1] && about[1] == about[2]) {
    world.row[0].x = world.row[1].y = world.row[2].z = mantissa(about[0]);
    return world;
  }
  Unit xx = zero, yy = zero, zz = zero, yz = zero, zx = zero, xy = zero;
  for (int i = 0; i < 3; ++i) {
    const Vec3<Unit>& axis = rotation.column[i];
    const Vec3<Unit> part = axis * mantissa(about[i]);
    xx += part.x * axis.x;
    yy += part.y * axis.y;
    zz += part.z * axis.z;
    yz += part.y * axis.z;
    zx += part.z * axis.x;
    xy += part.x * axis.y;
  }
  world.row[0] = {xx, xy, zx};
  world.row[1] = {xy, yy, yz};
  world.row[2] = {zx, yz, zz};
  return world;
}

WorldInverseInertia world_inverse_inertia(const BodyProperties& properties, const Matrix3& rotation) {
  const Scaled none = 0.0, locked[3] = {none, none, none};
  return world_inverse_inertia(is_dynamic(properties) ? properties.inverse_inertia : locked, rotation);
}

Vec3<Real> world_angular_velocity(const BodyProperties& properties, const WorldInverseInertia& inverse_inertia,
                                  const Vec3<Real>& angular_momentum, int power) {
  const bool turns = is_dynamic(properties);
  if (turns) power += inverse_inertia.exponent;
#if DETENT_FIXED
  // Rounded down: with a limit that was rounded up, the result of scale_by_power() could overflow.
  const Real limit = Real::from_raw(k_real_max.raw >> (power > 0 ? power : 0));
#else
  const Real limit = k_real_max;  // exponents are 0 in float
#endif
  const auto part = [&](Real own, const Vec3<Unit>& row) {
    return scale_by_power(clamp(turns ? dot(angular_momentum, row) : own, -limit, limit), power);
  };
  return {part(angular_momentum.x, inverse_inertia.row[0]), part(angular_momentum.y, inverse_inertia.row[1]),
          part(angular_momentum.z, inverse_inertia.row[2])};
}

void renew_angular_velocity(const BodyProperties& properties, const BodyMotion& motion, BodyWork& work) {
  work.angular_velocity =
      world_angular_velocity(properties, work.inverse_inertia, motion.angular_momentum, -k_angular_velocity_power);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
