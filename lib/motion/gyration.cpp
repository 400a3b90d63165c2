#include "motion/gyration.h"

#include "motion/spin.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

WorldGyration world_gyration(const Scaled (&about)[3], const Matrix3& rotation) {
  const Unit zero = 0.0;
  WorldGyration world = {{{zero, zero, zero}, {zero, zero, zero}, {zero, zero, zero}}, 0};
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

WorldGyration world_gyration(const BodyTraits& traits, const Matrix3& rotation) {
  const Scaled none = 0.0, locked[3] = {none, none, none};
  return world_gyration(is_dynamic(traits) ? traits.gyration : locked, rotation);
}

Vec3<Real> world_spin(const BodyTraits& traits, const WorldGyration& gyration, const Vec3<Real>& momentum, int power) {
  const bool turns = is_dynamic(traits);
  if (turns) power += gyration.exponent;
#if DETENT_FIXED
  // not rounded up: such a limit would overflow when scaled
  const Real limit = Real::from_raw(k_real_max.raw >> (power > 0 ? power : 0));
#else
  const Real limit = k_real_max;  // exponents are 0 in float
#endif
  const auto part = [&](Real own, const Vec3<Unit>& row) {
    return scale_by_power(clamp(turns ? dot(momentum, row) : own, -limit, limit), power);
  };
  return {part(momentum.x, gyration.row[0]), part(momentum.y, gyration.row[1]), part(momentum.z, gyration.row[2])};
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
