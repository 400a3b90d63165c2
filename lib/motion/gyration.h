#pragma once
#include <detent/detail/scratch.h>

#include "math/rotation.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// A body's inverse inertia (spin.h) in world axes. Zero for a body that is not dynamic.
WorldGyration world_gyration(const BodyTraits& traits, const Matrix3& rotation);

/// The inverse inertia in world axes, from the values about the body's axes.
WorldGyration world_gyration(const Scaled (&about)[3], const Matrix3& rotation);

/// The mantissas of inverse inertia times v; their unit is 2^gyration.exponent. Range: |v| < 2.
inline Vec3<Unit> multiply(const WorldGyration& gyration, const Vec3<Unit>& v) {
  return {dot(gyration.row[0], v), dot(gyration.row[1], v), dot(gyration.row[2], v)};
}

/// A body's angular velocity (spin.h), m/s, world axes, times 2^power. The momentum of a kinematic body is its angular
/// velocity. Overflow: each component is clamped to the range of Real.
Vec3<Real> world_spin(const BodyTraits& traits, const WorldGyration& gyration, const Vec3<Real>& momentum, int power);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
