#pragma once
#include "math/arithmetic.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The greatest length of an arm, from the centre of mass to a contact point, in the body's unit of length. With this
/// limit, the product of arm, inverse inertia and arm, which an impulse needs, fits a Unit. The body lies within 1, and
/// a contact point at most half the gap beyond that. Only the midpoint of a deep overlap with a much larger body is
/// farther away; its arm is clamped to this length.
inline constexpr Unit k_arm_max = 1.25;

/// Converts a point, given in 2^power of the body's unit, to an arm. Overflow: the length is clamped to k_arm_max.
Vec3<Unit> arm_of_point(const Vec3<Unit>& point, int power);
/// Converts a displacement in m to an arm, for a body whose unit is 2^exponent m. Overflow: the length is clamped to
/// k_arm_max.
Vec3<Unit> arm_of_offset(const Vec3<Real>& offset, int32_t exponent);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
