#pragma once
#include <detent/detail/shared.h>
#include <detent/numbers.h>

#include "math/wide.h"
#if !DETENT_FIXED
#include "math/float_bits.h"
#endif

/// Products, quotients and vectors of the number types, with the same names in all configurations.
///
/// In the fixed-point configurations, every function forms its sum of products exactly and rounds it once, to nearest,
/// ties up. A result outside the range of its type wraps, unless the function says that it saturates. Builds with
/// DETENT_VERIFY trap if a Unit result would wrap. In the float configurations, every function is the plain expression,
/// evaluated from left to right; each operation rounds to nearest, ties to even.
namespace detent {
inline namespace DETENT_NAMESPACE {

inline constexpr Real k_zero = 0.0;
inline constexpr Vec3<Real> k_zero_vector = {k_zero, k_zero, k_zero};
inline constexpr Vec3<Unit> k_no_direction = {Unit(0.0), Unit(0.0), Unit(0.0)};
inline constexpr Real k_two_pi = 6.28318530717958647693;

#if DETENT_FIXED
inline constexpr int k_unit_frac = Unit::k_frac;
inline constexpr int k_real_frac = Real::k_frac;
inline constexpr Real k_real_max = Real::from_raw(INT64_MAX);
inline constexpr Unit k_unit_max = Unit::from_raw(INT32_MAX);

/// Returns the Unit with the raw value `raw`. Overflow: wraps; every caller ensures that the Unit is within (-2, 2).
constexpr Unit unit_from_raw(int64_t raw) {
  DETENT_VERIFY_RANGE(raw == static_cast<int32_t>(raw));
  return Unit::from_raw(static_cast<int32_t>(raw));
}
/// Converts a sum of products of Units, Q4.60, to a Unit.
constexpr Unit unit_from_product(uint64_t sum) {
  return unit_from_raw(static_cast<int64_t>(sum + (uint64_t{1} << (k_unit_frac - 1))) >> k_unit_frac);
}
constexpr uint64_t unit_product(Unit a, Unit b) { return static_cast<uint64_t>(int64_t{a.raw} * b.raw); }

/// a b. Range: |a b| < 2.
DETENT_SHARED constexpr Unit operator*(Unit a, Unit b) { return unit_from_product(unit_product(a, b)); }

/// The functions of this file that have a Real as their result, but with raw integers instead of Reals. The reason:
/// most calling conventions of 32-bit machines return an integer in registers, but a struct in memory.
namespace raw {
DETENT_SHARED constexpr int64_t multiply(int64_t a, int32_t unit) { return Int128::narrow_sum<k_unit_frac>(a, unit); }
DETENT_SHARED constexpr int64_t multiply(int64_t a, int64_t b) {
  return Int128::product(a, b).round_shift<k_real_frac>();
}
DETENT_SHARED constexpr int64_t dot(const Vec3<Real>& a, const Vec3<Unit>& b) {
  return Int128::narrow_sum<k_unit_frac>(a.x.raw, b.x.raw, a.y.raw, b.y.raw, a.z.raw, b.z.raw);
}
DETENT_SHARED constexpr int64_t dot(const Vec3<Real>& a, const Vec3<Real>& b) {
  return (Int128::product(a.x.raw, b.x.raw) + Int128::product(a.y.raw, b.y.raw) + Int128::product(a.z.raw, b.z.raw))
      .round_shift<k_real_frac>();
}
DETENT_SHARED constexpr int64_t min(int64_t a, int64_t b) { return b < a ? b : a; }
DETENT_SHARED constexpr int64_t max(int64_t a, int64_t b) { return a < b ? b : a; }
/// |a|. Computed without a branch, which would be mispredicted for random signs. Overflow: INT64_MIN wraps to itself.
DETENT_SHARED constexpr int64_t abs(int64_t a) { return subtract_wrapped(a ^ (a >> 63), a >> 63); }
int64_t divide(int64_t a, int64_t b);
/// The difference a - b of two raw coordinates, as a raw Real; see real_difference().
DETENT_SHARED constexpr int64_t difference(Coord::Raw a, Coord::Raw b) {
  constexpr int k_shift = k_real_frac - Coord::k_frac;
  const int64_t difference = subtract_wrapped(a, b);
  constexpr int64_t k_limit = INT64_MAX >> k_shift;
  // If the difference of the raw coordinates has wrapped, it has the wrong sign.
  if (a < b) return difference >= 0 || difference < -k_limit ? -INT64_MAX : difference * (int64_t{1} << k_shift);
  return difference < 0 || difference > k_limit ? INT64_MAX : difference << k_shift;
}
}  // namespace raw

DETENT_PASSING constexpr Real operator*(Real a, Unit b) { return Real::from_raw(raw::multiply(a.raw, b.raw)); }
DETENT_PASSING constexpr Real operator*(Unit a, Real b) { return b * a; }
DETENT_PASSING constexpr Real operator*(Real a, Real b) { return Real::from_raw(raw::multiply(a.raw, b.raw)); }
#else
inline constexpr Real k_real_max = Real(131072.0);  ///< the range is that of the fixed configurations
#endif

/// A *step* is the resolution of a Unit just below 1: 2^k_unit_step. Comments state errors of Unit results in steps
/// (docs/numbers.md).
#if DETENT_FIXED
inline constexpr int k_unit_step = -30;
#elif defined(DETENT_F32)
inline constexpr int k_unit_step = -24;
#else
inline constexpr int k_unit_step = -53;
#endif

/// Functions for arguments of one number type. min() and max() return `a` if both arguments are equal, so that the sign
/// of a zero is the same on all targets.
template <class T>
constexpr T min(T a, T b) {
  return b < a ? b : a;
}
template <class T>
constexpr T max(T a, T b) {
  return a < b ? b : a;
}
#if DETENT_FIXED
DETENT_PASSING constexpr Real min(Real a, Real b) { return Real::from_raw(raw::min(a.raw, b.raw)); }
DETENT_PASSING constexpr Real max(Real a, Real b) { return Real::from_raw(raw::max(a.raw, b.raw)); }
#endif
template <class T>
constexpr T clamp(T value, T low, T high) {
  return min(max(value, low), high);
}
/// |a|; +0 for both zeros. Overflow: the most negative fixed number wraps to itself.
template <class T>
constexpr T abs(T a) {
  return T(0.0) < a ? a : T(0.0) - a;
}

#if DETENT_FIXED
DETENT_PASSING constexpr Real abs(Real a) { return Real::from_raw(raw::abs(a.raw)); }
#else
// These functions only clear the sign bit. The comparison in the template above would be a branch, which is
// mispredicted for random signs.
constexpr float abs(float a) { return __builtin_fabsf(a); }
constexpr double abs(double a) { return __builtin_fabs(a); }
#endif

template <class T>
DETENT_SHARED constexpr Vec3<T> operator+(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
DETENT_SHARED constexpr Vec3<T> operator-(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
DETENT_SHARED constexpr Vec3<T> operator-(const Vec3<T>& a) {
  return {-a.x, -a.y, -a.z};
}
template <class T>
DETENT_SHARED constexpr Vec3<T>& operator+=(Vec3<T>& a, const Vec3<T>& b) {
  return a = a + b;
}
template <class T>
DETENT_SHARED constexpr Vec3<T>& operator-=(Vec3<T>& a, const Vec3<T>& b) {
  return a = a - b;
}
template <class A, class B>
DETENT_SHARED constexpr auto operator*(const Vec3<A>& a, B b) -> Vec3<decltype(a.x * b)> {
  return {a.x * b, a.y * b, a.z * b};
}
template <class T>
DETENT_SHARED constexpr Vec3<T> abs(const Vec3<T>& a) {
  return {abs(a.x), abs(a.y), abs(a.z)};
}

#if DETENT_FIXED
/// The dot product. Range: |result| < 2.
DETENT_SHARED constexpr Unit dot(const Vec3<Unit>& a, const Vec3<Unit>& b) {
  return unit_from_product(unit_product(a.x, b.x) + unit_product(a.y, b.y) + unit_product(a.z, b.z));
}
DETENT_PASSING constexpr Real dot(const Vec3<Real>& a, const Vec3<Unit>& b) { return Real::from_raw(raw::dot(a, b)); }
DETENT_PASSING constexpr Real dot(const Vec3<Unit>& a, const Vec3<Real>& b) { return dot(b, a); }
DETENT_PASSING constexpr Real dot(const Vec3<Real>& a, const Vec3<Real>& b) { return Real::from_raw(raw::dot(a, b)); }

/// The cross product. Range: each component of the result is below 2 in magnitude.
DETENT_SHARED constexpr Vec3<Unit> cross(const Vec3<Unit>& a, const Vec3<Unit>& b) {
  return {unit_from_product(unit_product(a.y, b.z) - unit_product(a.z, b.y)),
          unit_from_product(unit_product(a.z, b.x) - unit_product(a.x, b.z)),
          unit_from_product(unit_product(a.x, b.y) - unit_product(a.y, b.x))};
}
DETENT_SHARED constexpr Vec3<Real> cross(const Vec3<Real>& a, const Vec3<Unit>& b) {
  constexpr int n = k_unit_frac;
  return {Real::from_raw(Int128::narrow_sum<n>(a.y.raw, b.z.raw, a.z.raw, -b.y.raw)),
          Real::from_raw(Int128::narrow_sum<n>(a.z.raw, b.x.raw, a.x.raw, -b.z.raw)),
          Real::from_raw(Int128::narrow_sum<n>(a.x.raw, b.y.raw, a.y.raw, -b.x.raw))};
}
DETENT_SHARED constexpr Vec3<Real> cross(const Vec3<Unit>& a, const Vec3<Real>& b) {
  constexpr int n = k_unit_frac;
  return {Real::from_raw(Int128::narrow_sum<n>(b.z.raw, a.y.raw, b.y.raw, -a.z.raw)),
          Real::from_raw(Int128::narrow_sum<n>(b.x.raw, a.z.raw, b.z.raw, -a.x.raw)),
          Real::from_raw(Int128::narrow_sum<n>(b.y.raw, a.x.raw, b.x.raw, -a.y.raw))};
}
DETENT_SHARED constexpr Vec3<Real> cross(const Vec3<Real>& a, const Vec3<Real>& b) {
  const auto difference = [](Real p, Real q, Real r, Real s) {
    return Real::from_raw((Int128::product(p.raw, q.raw) - Int128::product(r.raw, s.raw)).round_shift<k_real_frac>());
  };
  return {difference(a.y, b.z, a.z, b.y), difference(a.z, b.x, a.x, b.z), difference(a.x, b.y, a.y, b.x)};
}

/// a / b. Range: b != 0. Overflow: saturates to +-131072.
DETENT_PASSING inline Real divide(Real a, Real b) { return Real::from_raw(raw::divide(a.raw, b.raw)); }
/// a / b. Range: b != 0, |a / b| < 2.
Unit divide(Unit a, Unit b);
/// 1 / a. Range: a != 0. Overflow: saturates.
DETENT_PASSING inline Real reciprocal(Real a) { return divide(Real(1.0), a); }

/// x 2^n. Rounding: to nearest, ties up. Overflow: wraps.
DETENT_PASSING constexpr Real scale_by_power(Real x, int n) { return Real::from_raw(shift_64(x.raw, n)); }
/// x 2^n. Range: |x 2^n| < 2.
DETENT_PASSING constexpr Unit scale_by_power(Unit x, int n) { return unit_from_raw(shift_64(x.raw, n)); }

/// The smallest e >= -46 with |x| < 2^e.
DETENT_SHARED constexpr int exponent_above(Real x) { return bit_length_64(magnitude_64(x.raw)) - k_real_frac; }

/// u 2^e. Range: |u 2^e| < 2^17; beyond it the result wraps. Rounding: to nearest, ties up.
DETENT_PASSING constexpr Real real_from_unit(Unit u, int e) {
  return Real::from_raw(shift_64(u.raw, e + k_real_frac - k_unit_frac));
}
/// r 2^-e. Range: |r 2^-e| < 2. Rounding: to nearest, ties up.
DETENT_PASSING constexpr Unit unit_from_real(Real r, int e) {
  return unit_from_raw(shift_64(r.raw, k_unit_frac - k_real_frac - e));
}

/// (a - b) 2^-e from the exact difference. Range: |result| < 2. Rounding: to nearest, ties up.
DETENT_SHARED constexpr Unit unit_difference(Coord a, Coord b, int e) {
  const int n = e + Coord::k_frac - k_unit_frac;
  if (n < 2) return unit_from_raw(shift_64(subtract_wrapped(a.raw, b.raw), -n));
  // The coordinates are halved before the subtraction, because their 64-bit difference can overflow. The lowest bit of
  // the difference, which is thereby lost, cannot change the rounding.
  const int64_t half = (int64_t{a.raw} >> 1) - (int64_t{b.raw} >> 1) - (int64_t{b.raw} & ~int64_t{a.raw} & 1);
  return unit_from_raw(shift_64(half, 1 - n));
}
/// a - b, m. Exact within +-131072 m. Overflow: saturates there.
DETENT_PASSING constexpr Real real_difference(Coord a, Coord b) {
  return Real::from_raw(raw::difference(a.raw, b.raw));
}
namespace raw {
DETENT_SHARED constexpr Coord::Raw advance(Coord::Raw c, int64_t d, bool& saturated) {
  using Raw = Coord::Raw;
  const int64_t step = round_shift_64(d, k_real_frac - Coord::k_frac);
  const int64_t sum = add_wrapped(c, step);
  if constexpr (sizeof(Raw) == 8) {
    if (((c ^ sum) & (step ^ sum)) < 0) {
      saturated = true;
      return static_cast<Raw>(step < 0 ? INT64_MIN : INT64_MAX);
    }
  } else if (sum != static_cast<Raw>(sum)) {
    saturated = true;
    return static_cast<Raw>(sum < 0 ? INT32_MIN : INT32_MAX);
  }
  return static_cast<Raw>(sum);
}
}  // namespace raw
/// c + d, m. Rounding: to nearest, ties up. Overflow: clamps to Coord's range and sets `saturated` (else untouched).
DETENT_PASSING constexpr Coord coord_advance(Coord c, Real d, bool& saturated) {
  return Coord::from_raw(raw::advance(c.raw, d.raw, saturated));
}
#else
constexpr Real dot(const Vec3<Real>& a, const Vec3<Real>& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3<Real> cross(const Vec3<Real>& a, const Vec3<Real>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
constexpr Real divide(Real a, Real b) { return a / b; }
constexpr Real reciprocal(Real a) { return Real(1) / a; }

/// x 2^n. Range: 2^n is a normal number.
constexpr Real scale_by_power(Real x, int n) { return x * power_of_two<Real>(n); }
/// The smallest e >= -46 with |x| < 2^e.
DETENT_SHARED constexpr int exponent_above(Real x) {
  const FloatParts parts = float_parts(x);
  const int e = parts.exponent + FloatFormat<Real>::k_fraction_bits + 1;
  return parts.mantissa == 0 || e < -46 ? -46 : e;
}
/// u 2^e.
constexpr Real real_from_unit(Unit u, int e) { return scale_by_power(u, e); }
/// r 2^-e.
constexpr Unit unit_from_real(Real r, int e) { return scale_by_power(r, -e); }

#if defined(DETENT_F32)
/// (a - b) 2^e from the exact difference, rounded once.
constexpr float scaled_difference(Coord a, Coord b, int e) {
  const bool negative = a < b;
  const uint64_t magnitude = negative ? static_cast<uint64_t>(b.raw) - static_cast<uint64_t>(a.raw)
                                      : static_cast<uint64_t>(a.raw) - static_cast<uint64_t>(b.raw);
  return float_from_parts<float>(magnitude, e - Coord::k_frac, negative);
}
constexpr Unit unit_difference(Coord a, Coord b, int e) { return scaled_difference(a, b, -e); }
constexpr Real real_difference(Coord a, Coord b) { return scaled_difference(a, b, 0); }
/// c + d, m. Rounding: to nearest, ties up. Overflow: clamps to Coord's range and sets `saturated` (else untouched).
constexpr Coord coord_advance(Coord c, Real d, bool& saturated) {
  const int64_t step = integer_from_float(d, Coord::k_frac, saturated);
  const int64_t sum = add_wrapped(c.raw, step);
  if (((c.raw ^ sum) & (step ^ sum)) < 0) {
    saturated = true;
    return Coord::from_raw(step < 0 ? INT64_MIN : INT64_MAX);
  }
  return Coord::from_raw(sum);
}
#else
/// The largest |coordinate|, m.
inline constexpr Coord k_coord_max = 2147483648.0;
constexpr Unit unit_difference(Coord a, Coord b, int e) { return scale_by_power(a - b, -e); }
constexpr Real real_difference(Coord a, Coord b) { return a - b; }
/// c + d, m. Overflow: clamps to +-k_coord_max and sets `saturated` (else untouched).
constexpr Coord coord_advance(Coord c, Real d, bool& saturated) {
  const Coord sum = c + d;
  if (abs(sum) <= k_coord_max) return sum;
  saturated = true;
  return sum < 0 ? -k_coord_max : k_coord_max;
}
#endif
#endif

/// a - b, m: real_difference() of each component.
DETENT_SHARED constexpr Vec3<Real> real_difference(const Position& a, const Position& b) {
  return {real_difference(a.x, b.x), real_difference(a.y, b.y), real_difference(a.z, b.z)};
}

/// real_from_unit() and unit_from_real() of each component.
DETENT_SHARED constexpr Vec3<Real> real_from_unit(const Vec3<Unit>& u, int e) {
  return {real_from_unit(u.x, e), real_from_unit(u.y, e), real_from_unit(u.z, e)};
}
DETENT_SHARED constexpr Vec3<Unit> unit_from_real(const Vec3<Real>& r, int e) {
  return {unit_from_real(r.x, e), unit_from_real(r.y, e), unit_from_real(r.z, e)};
}

/// v 2^n: scale_by_power() of each component.
template <class T>
DETENT_SHARED constexpr Vec3<T> scale_by_power(const Vec3<T>& v, int n) {
  return {scale_by_power(v.x, n), scale_by_power(v.y, n), scale_by_power(v.z, n)};
}
/// |x| + |y| + |z|.
DETENT_SHARED constexpr Real absolute_sum(const Vec3<Real>& v) { return abs(v.x) + abs(v.y) + abs(v.z); }
/// The greatest of the magnitudes of the components.
DETENT_SHARED constexpr Real greatest(const Vec3<Real>& v) { return max(abs(v.x), max(abs(v.y), abs(v.z))); }

}  // namespace DETENT_NAMESPACE
}  // namespace detent
