#pragma once
#include "math/arithmetic.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The greatest length of an arm: the vector from the centre of mass to a contact point, in the body's unit of length.
/// To compute an impulse, the solver multiplies arm, inverse inertia and arm; with this limit the product fits a Unit.
/// The body's own points are at most 1 from the centre of mass, and a contact point is at most half the gap farther
/// out. Only the midpoint of a deep overlap with a much larger body can lie beyond the limit. The arm to such a
/// midpoint is clamped to the limit.
inline constexpr Unit k_arm_max = 1.25;

/// Converts a point to an arm. The point is relative to the centre of mass, in a unit of length that is 2^power times
/// the body's. Overflow: the length is clamped to k_arm_max.
Vec3<Unit> arm_of_point(const Vec3<Unit>& point, int power);
/// Converts a displacement in m to an arm, for a body whose unit is 2^exponent m. Overflow: the length is clamped to
/// k_arm_max.
Vec3<Unit> arm_of_offset(const Vec3<Real>& offset, int32_t exponent);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
