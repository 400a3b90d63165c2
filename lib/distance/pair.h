#pragma once
#include <detent/toi.h>

#include "math/rotation_integer.h"

/// Conversions between the number types of a configuration and the integers of lib/distance and lib/toi. Poses and
/// motions are converted nowhere else.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// A *raw* length is an integer in 2^-46 m. The fixed-point Real has the same format.
inline constexpr int k_metre_bits = 46;

/// Converts v from m to 2^-46 m. Fixed: exact. Float: rounded to nearest. Returns false, with saturated components, if
/// a component is 2^17 m or more in magnitude, infinite or NaN.
bool raw_from_real(const Vec3<Real>& v, Vec64& raw);
Real real_from_raw(int64_t raw);
/// Converts a length from m to 2^-46 m. Returns 0 unless the length is finite and below 2^17 m in magnitude.
inline int64_t raw_length(Real length) {
  Vec64 raw = {0, 0, 0};
  return raw_from_real({length, Real(0.0), Real(0.0)}, raw) ? raw.x : 0;
}
/// Sets `raw` to a - b, in 2^-46 m. Fixed-point coordinates: exact. f64: rounded to nearest. Overflow: saturates at
/// 2^17 m - 2^-10 m in magnitude. Returns false for NaN and infinity.
bool raw_difference(const Position& a, const Position& b, Vec64& raw);
/// Sets `raw` to the quaternion in Q30, normalised to length 1 within 2^-29. Returns false unless
/// | |q| - 1 | <= 2^-10.
bool raw_from_quat(const Quat& q, Quat32& raw);
Vec3<Unit> units_from_raw(const Vec32& v);
/// Sets `raw` to the unit vector along v, Q30, of length 1 within 3 2^-30. Returns false if v is zero, or if a
/// component is NaN or not within [-2, 2).
bool raw_from_direction(const Vec3<Unit>& v, Vec32& raw);

/// The greatest exponent e of a pair's unit of length, 2^e m. Even if the difference of the positions saturates in all
/// components, its length plus the core radii is below 2^19 m.
inline constexpr int k_exponent_max = 19;
/// Returns the bitwise OR of the components' magnitudes. Its leading bit is that of the largest magnitude.
DETENT_SHARED constexpr uint64_t magnitudes(const Vec64& v) {
  return magnitude_64(v.x) | magnitude_64(v.y) | magnitude_64(v.z);
}

/// Returns an upper bound of |v|, at most 1.5 above |v|. Overflow: saturates at INT64_MAX.
int64_t length_above(const Vec64& v);
/// Returns an upper bound of |v| that is cheap to compute: it exceeds |v| by at most 1.6 % plus a few ulps of a 29-bit
/// mantissa. INT64_MAX if a component is 2^60 or more in magnitude.
int64_t length_bound(const Vec64& v);
/// Returns a + b. Overflow: saturates at +-INT64_MAX.
DETENT_SHARED constexpr int64_t saturated_sum(int64_t a, int64_t b) {
  if (b > 0) return a > INT64_MAX - b ? INT64_MAX : a + b;
  return a < -INT64_MAX - b ? -INT64_MAX : a + b;
}
/// Converts a length from ulps (2^-30 of a unit of length of 2^exponent m) to 2^-46 m. Overflow: saturates.
int64_t raw_from_block(int64_t ulps, int exponent);
/// Moves a core's point `core` to the surface of its ball: by `radius` (2^-46 m) along the unit vector `normal` (Q30).
/// `core` is in 2^-30 of a unit of length of 2^exponent m. Returns the moved point in m.
Vec3<Real> surface_point(const Vec32& core, int exponent, const Vec32& normal, int64_t radius);

/// Returns the surface point of a half-space below the other body's core point `on_other`: the point at the distance
/// `gap` from `on_other`, in the direction opposite to the half-space's normal `up` (Q30). `on_other` (from the other
/// body's centre) and `gap` are in 2^-30 of a unit of length of 2^exponent m. `offset`: from the half-space's position
/// to the other body's, 2^-46 m. Result in m, relative to the half-space's position.
Vec3<Real> half_space_point(const Vec64& offset, const Vec32& on_other, int exponent, const Vec32& up, int32_t gap);

/// Returns the least e >= -14 for which the length `raw` (2^-46 m) is below 2^e m.
int raw_exponent_above(int64_t raw);
/// Returns (v.n) n, the component of v along the unit vector n (Q30).
Vec64 component_along(const Vec64& v, const Vec32& n);
/// Returns the unit vector v (Q30) times `length`. The result is in the unit of `length`.
Vec32 scaled_vector(const Vec32& v, int64_t length);
/// raw_core_radius() returns the bounding radius of the core. raw_radius() returns the radius of the ball that rounds
/// the core. Both results are in 2^-46 m.
int64_t raw_core_radius(const Convex& convex);
int64_t raw_radius(const Convex& convex);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
