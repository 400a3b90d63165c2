#pragma once
#include <detent/detail/scratch.h>

#include "math/rotation.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// A body's gyration in world axes. Zero for what is not dynamic.
WorldGyration world_gyration(const BodyTraits& traits, const Matrix3& rotation);

/// Of a body whose gyrations about its axes are these.
WorldGyration world_gyration(const Scaled (&about)[3], const Matrix3& rotation);

/// The mantissas of gyration x v, 2^-exponent. Range: |v| < 2.
inline Vec3<Unit> multiply(const WorldGyration& gyration, const Vec3<Unit>& v) {
  return {dot(gyration.row[0], v), dot(gyration.row[1], v), dot(gyration.row[2], v)};
}

/// A body's spin, m/s, world, times 2^power; a kinematic body's momentum is its spin. Overflow: each component is held
/// to Real's range.
Vec3<Real> world_spin(const BodyTraits& traits, const WorldGyration& gyration, const Vec3<Real>& momentum, int power);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
