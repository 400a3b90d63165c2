#pragma once
#include <detent/detail/scratch.h>

#include "math/rotation.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// A body's inverse inertia (angular_velocity.h) in world axes; zero for a body that is not dynamic. `rotation`: the
/// body's axes.
WorldInverseInertia world_inverse_inertia(const BodyProperties& properties, const Matrix3& rotation);

/// The inverse inertia in world axes, from the values about the body's axes.
WorldInverseInertia world_inverse_inertia(const Scaled (&about)[3], const Matrix3& rotation);

/// The mantissas of inverse inertia times v, in units of 2^inverse_inertia.exponent. Range: |v| < 2.
inline Vec3<Unit> multiply(const WorldInverseInertia& inverse_inertia, const Vec3<Unit>& v) {
  return {dot(inverse_inertia.row[0], v), dot(inverse_inertia.row[1], v), dot(inverse_inertia.row[2], v)};
}

/// A body's angular velocity (angular_velocity.h), m/s, world axes, times 2^power. For a kinematic body, the caller
/// passes the angular velocity as `angular_momentum`. Overflow: each component is clamped to the range of Real.
Vec3<Real> world_angular_velocity(const BodyProperties& properties, const WorldInverseInertia& inverse_inertia,
                                  const Vec3<Real>& angular_momentum, int power);

/// Sets BodyWork::angular_velocity from the angular momentum.
void renew_angular_velocity(const BodyProperties& properties, const BodyMotion& motion, BodyWork& work);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
