#pragma once
#include <detent/toi.h>

#include "math/rotation_integer.h"

/// The one place where poses and motions of a configuration become the integers of lib/distance and lib/toi.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Lengths in 2^-46 m, as fixed Real has.
inline constexpr int k_metre_bits = 46;

/// v 2^46. Fixed: exact. Float: to nearest, or saturated. NaN and infinity: false.
bool raw_from_real(const Vec3<Real>& v, Vec64& raw);
Real real_from_raw(int64_t raw);
/// Of a finite length, m, 2^-46 m.
inline int64_t raw_length(Real length) {
  Vec64 raw = {0, 0, 0};
  return raw_from_real({length, Real(0.0), Real(0.0)}, raw) ? raw.x : 0;
}
/// a - b, 2^-46 m. Fixed positions: exact within 2^17 m, saturated there. f64: to nearest. NaN and infinity: false.
bool raw_difference(const Position& a, const Position& b, Vec64& raw);
/// Q30, of length 1 within 2^-29. False unless | |q| - 1 | <= 2^-10.
bool raw_from_quat(const Quat& q, Quat32& raw);
Vec3<Unit> units_from_raw(const Vec32& v);
/// A direction, Q30, of length 1 within 3 2^-30. False for zero, and for what no unit vector is.
bool raw_from_direction(const Vec3<Unit>& v, Vec32& raw);

/// A pair's greatest exponent: differences saturated in all components, and the largest cores, lie within 2^19 m.
inline constexpr int k_exponent_max = 19;
/// Has the leading bit of the largest component.
DETENT_SHARED constexpr uint64_t magnitudes(const Vec64& v) {
  return magnitude_64(v.x) | magnitude_64(v.y) | magnitude_64(v.z);
}

/// |v|, rounded up.
int64_t length_above(const Vec64& v);
/// At least |v|, and at most 1.6 % and a few 2^-30 more; INT64_MAX where that is more than 2^62. Cheap.
int64_t length_bound(const Vec64& v);
/// Overflow: saturates at +-INT64_MAX.
DETENT_SHARED constexpr int64_t saturated_sum(int64_t a, int64_t b) {
  if (b > 0) return a > INT64_MAX - b ? INT64_MAX : a + b;
  return a < -INT64_MAX - b ? -INT64_MAX : a + b;
}
/// Ulps of a block whose unit of length is 2^exponent m, in 2^-46 m. Overflow: saturates.
int64_t raw_from_block(int64_t ulps, int exponent);
/// A point of a core, in such a block, and `radius`, 2^-46 m, along the unit vector `normal`: m.
Vec3<Real> surface_point(const Vec32& core, int exponent, const Vec32& normal, int64_t radius);

/// The point of a half-space below the other body's point `on_other`, `gap` ulps down `up`: m, from the half-space's
/// position, `offset` to the other body's.
Vec3<Real> half_space_point(const Vec64& offset, const Vec32& on_other, int exponent, const Vec32& up, int32_t gap);

/// The least e >= -14 with raw 2^-46 m < 2^e m.
int raw_exponent_above(int64_t raw);
/// (v.n) n for a unit vector n, Q30.
Vec64 component_along(const Vec64& v, const Vec32& n);
/// Of the core and of the ball, 2^-46 m.
int64_t raw_core_radius(const Convex& convex);
int64_t raw_radius(const Convex& convex);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
