#pragma once
#include "math/arithmetic.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The greatest length of an arm: the vector from the centre of mass to a contact point, in the body's unit of length.
/// With this limit, the product of arm, inverse inertia and arm, which an impulse needs, fits a Unit. The body lies
/// within length 1, and a contact point at most half the gap farther out. Only the midpoint of a deep overlap with a
/// much larger body can exceed the limit; its arm is clamped to this length.
inline constexpr Unit k_arm_max = 1.25;

/// Converts a point to an arm. The point is in units of 2^power times the body's unit. Overflow: the length is clamped
/// to k_arm_max.
Vec3<Unit> arm_of_point(const Vec3<Unit>& point, int power);
/// Converts a displacement in m to an arm, for a body whose unit is 2^exponent m. Overflow: the length is clamped to
/// k_arm_max.
Vec3<Unit> arm_of_offset(const Vec3<Real>& offset, int32_t exponent);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
