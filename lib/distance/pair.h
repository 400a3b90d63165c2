#pragma once
#include <detent/toi.h>

#include "math/rotation_integer.h"

/// The only place where a configuration's poses and motions are converted to the integers of lib/distance and lib/toi.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Raw lengths are in 2^-46 m, as in the fixed Real.
inline constexpr int k_metre_bits = 46;

/// Converts v from m to 2^-46 m. Fixed: exact. Float: rounded to nearest. Returns false, with saturated components, if
/// a component is 2^17 m or more in magnitude, infinite or NaN.
bool raw_from_real(const Vec3<Real>& v, Vec64& raw);
Real real_from_raw(int64_t raw);
/// Converts a length from m to 2^-46 m. 0 unless it is finite and below 2^17 m in magnitude.
inline int64_t raw_length(Real length) {
  Vec64 raw = {0, 0, 0};
  return raw_from_real({length, Real(0.0), Real(0.0)}, raw) ? raw.x : 0;
}
/// a - b, 2^-46 m. Fixed-point coordinates: exact. f64: rounded to nearest. Overflow: saturates at 2^17 m - 2^-10 m in
/// magnitude. False for NaN and infinity.
bool raw_difference(const Position& a, const Position& b, Vec64& raw);
/// The quaternion in Q30, of length 1 within 2^-29. False unless | |q| - 1 | <= 2^-10.
bool raw_from_quat(const Quat& q, Quat32& raw);
Vec3<Unit> units_from_raw(const Vec32& v);
/// The unit vector along v, Q30, of length 1 within 3 2^-30. False if v is zero or a component is NaN or not within
/// [-2, 2).
bool raw_from_direction(const Vec3<Unit>& v, Vec32& raw);

/// The greatest exponent of a pair. Even if the difference of the positions saturates in all components, its length
/// plus the core radii is below 2^19 m.
inline constexpr int k_exponent_max = 19;
/// The OR of the components' magnitudes: its leading bit is that of the largest magnitude.
DETENT_SHARED constexpr uint64_t magnitudes(const Vec64& v) {
  return magnitude_64(v.x) | magnitude_64(v.y) | magnitude_64(v.z);
}

/// |v|, rounded up.
int64_t length_above(const Vec64& v);
/// An upper bound of |v|, cheap to compute: at most 1.6 % and a few ulps of a 29-bit mantissa too large. INT64_MAX if a
/// component is 2^60 or more in magnitude.
int64_t length_bound(const Vec64& v);
/// a + b. Overflow: saturates at +-INT64_MAX.
DETENT_SHARED constexpr int64_t saturated_sum(int64_t a, int64_t b) {
  if (b > 0) return a > INT64_MAX - b ? INT64_MAX : a + b;
  return a < -INT64_MAX - b ? -INT64_MAX : a + b;
}
/// Converts ulps of a block, whose unit of length is 2^exponent m, to 2^-46 m. Overflow: saturates.
int64_t raw_from_block(int64_t ulps, int exponent);
/// Returns the point `core` of a block with this exponent, moved by `radius` (2^-46 m) along the unit vector `normal`
/// (Q30). Result in m.
Vec3<Real> surface_point(const Vec32& core, int exponent, const Vec32& normal, int64_t radius);

/// Returns the point of the half-space below the other body's point `on_other` (in the block): the point that lies
/// `gap` ulps from `on_other`, against `up`. Result in m, relative to the half-space's position. `offset` (2^-46 m)
/// runs from the half-space's position to the other body's position.
Vec3<Real> half_space_point(const Vec64& offset, const Vec32& on_other, int exponent, const Vec32& up, int32_t gap);

/// The least e >= -14 with raw 2^-46 m < 2^e m.
int raw_exponent_above(int64_t raw);
/// (v.n) n for a unit vector n, Q30.
Vec64 component_along(const Vec64& v, const Vec32& n);
/// Returns the unit vector v (Q30) times `length`, in the unit of `length`.
Vec32 scaled_vector(const Vec32& v, int64_t length);
/// raw_core_radius(): the core radius. raw_radius(): the rounding radius. Both in 2^-46 m.
int64_t raw_core_radius(const Convex& convex);
int64_t raw_radius(const Convex& convex);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
