#pragma once
#include <detent/detail/scratch.h>

#include "base/unroll.h"
#include "math/arithmetic.h"
#include "math/scaled.h"

/// What a body that no more than two points hold shows at their anchors: 3 x 3 instead of 6 x 6. Arms lie within the
/// body's unit.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// gyration x (arm x force) for the three unit forces. Not in Units: what a row held by others has left of its response
/// must not be their rounding.
struct TurnByForce {
  Vec3<Real> by[3];

  TurnByForce(const WorldGyration& gyration, const Vec3<Unit>& arm) {
    const Vec3<Unit>(&row)[3] = gyration.row;  // symmetric: the columns
    const auto turned = [](const Vec3<Unit>& p, Unit q, const Vec3<Unit>& r, Unit s) {
      return Vec3<Real>{difference(p.x, q, r.x, s), difference(p.y, q, r.y, s), difference(p.z, q, r.z, s)};
    };
    by[0] = turned(row[1], arm.z, row[2], arm.y);
    by[1] = turned(row[2], arm.x, row[0], arm.z);
    by[2] = turned(row[0], arm.y, row[1], arm.x);
  }

 private:
  static Real difference(Unit p, Unit q, Unit r, Unit s) {
#if DETENT_FIXED
    constexpr int k_spare = 2 * Unit::k_frac - Real::k_frac;
    return Real::from_raw(round_shift_64(static_cast<int64_t>(unit_product(p, q) - unit_product(r, s)), k_spare));
#else
    return p * q - r * s;
#endif
  }
};

/// Velocities at an anchor for the three unit forces at the same or another one.
template <unsigned rows, unsigned columns>
inline void show_at(const TurnByForce& turn, const Vec3<Unit>& arm, Real share, Scaled turn_share,
                    Real (&shown)[rows][columns]) {
  DETENT_UNROLL
  for (int i = 0; i < 3; ++i) {
    const Vec3<Real> at = cross(turn.by[i], arm);
    shown[i][0] = multiply(at.x, turn_share);
    shown[i][1] = multiply(at.y, turn_share);
    shown[i][2] = multiply(at.z, turn_share);
    shown[i][i] += share;
  }
}
/// p q - r s.
inline Real minor_of(Real p, Unit q, Real r, Unit s) {
#if DETENT_FIXED
  return Real::from_raw(Int128::narrow_sum<Unit::k_frac>(p.raw, q.raw, r.raw, -s.raw));
#else
  return p * q - r * s;
#endif
}
/// The lower half of it where both anchors are one: it is symmetric.
template <unsigned rows, unsigned columns>
inline void show_at_itself(const TurnByForce& turn, const Vec3<Unit>& arm, Real share, Scaled turn_share,
                           Real (&shown)[rows][columns]) {
  const Vec3<Real> x = cross(turn.by[0], arm);
  const Vec3<Real>(&by)[3] = turn.by;
  shown[0][0] = multiply(x.x, turn_share) + share;
  shown[1][0] = multiply(x.y, turn_share);
  shown[2][0] = multiply(x.z, turn_share);
  shown[1][1] = multiply(minor_of(by[1].z, arm.x, by[1].x, arm.z), turn_share) + share;
  shown[2][1] = multiply(minor_of(by[1].x, arm.y, by[1].y, arm.x), turn_share);
  shown[2][2] = multiply(minor_of(by[2].x, arm.y, by[2].y, arm.x), turn_share) + share;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
