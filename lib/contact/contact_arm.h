#pragma once
#include "math/arithmetic.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The longest arm of a contact point, in its body's unit of length: what an arm, a gyration and the arm again make of
/// an impulse then has room in a Unit. A body reaches to 1, and half a gap beyond that; only the middle of a deep
/// overlap with a much larger body lies farther off, and is held here.
inline constexpr Unit k_arm_max = 1.25;

/// A point, whose unit is 2^power of the body's, as an arm. Overflow: held to k_arm_max in length.
Vec3<Unit> arm_of_point(const Vec3<Unit>& point, int power);
/// Likewise of a way in m, for a body whose unit is 2^exponent m.
Vec3<Unit> arm_of_way(const Vec3<Real>& way, int32_t exponent);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
