#pragma once
#include <detent/detail/scratch.h>

#include "base/unroll.h"
#include "math/arithmetic.h"

/// What a body that no more than two points hold shows at their anchors: 3 x 3 instead of 6 x 6. Arms lie within the
/// body's unit.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// p q - r s.
inline Real minor_of(Real p, Unit q, Real r, Unit s) {
#if DETENT_FIXED
  return Real::from_raw(Int128::narrow_sum<Unit::k_frac>(p.raw, q.raw, r.raw, -s.raw));
#else
  return p * q - r * s;
#endif
}

/// The spin that a body gets from each of the three unit forces at an arm. Not in Units: what a row held by others has
/// left of its response must not be their rounding.
struct TurnByForce {
  Vec3<Real> by[3];

  TurnByForce(const JointBody& body, const Vec3<Unit>& arm) {
    const auto turned = [](const Vec3<Real>& p, Unit q, const Vec3<Real>& r, Unit s) {
      return Vec3<Real>{minor_of(p.x, q, r.x, s), minor_of(p.y, q, r.y, s), minor_of(p.z, q, r.z, s)};
    };
    by[0] = turned(body.turned[1], arm.z, body.turned[2], arm.y);
    by[1] = turned(body.turned[2], arm.x, body.turned[0], arm.z);
    by[2] = turned(body.turned[0], arm.y, body.turned[1], arm.x);
  }
};

/// Velocities at an anchor for the three unit forces at another one.
template <unsigned rows, unsigned columns>
inline void show_at(const JointBody& body, const TurnByForce& turn, const Vec3<Unit>& arm,
                    Real (&shown)[rows][columns]) {
  DETENT_UNROLL
  for (int i = 0; i < 3; ++i) {
    const Vec3<Real> at = cross(turn.by[i], arm);
    shown[i][0] = at.x;
    shown[i][1] = at.y;
    shown[i][2] = at.z;
    shown[i][i] += body.pushed;
  }
}
/// The lower half of it where both anchors are one: it is symmetric.
template <unsigned rows, unsigned columns>
inline void show_at_itself(const JointBody& body, const TurnByForce& turn, const Vec3<Unit>& arm,
                           Real (&shown)[rows][columns]) {
  const Vec3<Real>(&by)[3] = turn.by;
  shown[0][0] = minor_of(by[0].y, arm.z, by[0].z, arm.y) + body.pushed;
  shown[1][0] = minor_of(by[0].z, arm.x, by[0].x, arm.z);
  shown[2][0] = minor_of(by[0].x, arm.y, by[0].y, arm.x);
  shown[1][1] = minor_of(by[1].z, arm.x, by[1].x, arm.z) + body.pushed;
  shown[2][1] = minor_of(by[1].x, arm.y, by[1].y, arm.x);
  shown[2][2] = minor_of(by[2].x, arm.y, by[2].y, arm.x) + body.pushed;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
