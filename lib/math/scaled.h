#pragma once
#include <detent/numbers.h>

#include "math/root.h"

/// Numbers of a wide range: masses, densities, forces, impulses.
///
/// In fixed point, every function rounds the mantissa to nearest, ties away from zero, so that it treats positive and
/// negative numbers alike; its relative error is at most 2^-31, unless stated otherwise. Overflow: clamps to
/// +-(2 - 2^-30) 2^286. Underflow: below 2^-226 the result is 0. In float, every function is the plain expression.
namespace detent {
inline namespace DETENT_NAMESPACE {

#if DETENT_FIXED
inline constexpr int k_scaled_exponent_max = 256;

/// The same functions as below this namespace, but with integers in place of structs. A Scaled is passed as one 64-bit
/// word, because most calling conventions of 32-bit machines pass a struct of two words through memory. A Real is
/// passed as its raw integer.
namespace words {
uint64_t scaled_from_parts(bool negative, uint64_t mantissa, int exponent);
uint64_t scaled_from(int64_t raw, int frac);
uint64_t multiply(uint64_t a, uint64_t b);
uint64_t divide(uint64_t a, uint64_t b);
uint64_t add(uint64_t a, uint64_t b);
bool less(uint64_t a, uint64_t b);
uint64_t scaled_by_power(uint64_t a, int n);
uint64_t square_root(uint64_t a);
uint64_t scaled_reciprocal(int64_t raw);
int64_t multiply_raw(int64_t raw, uint64_t b);
int64_t multiply_raw(int64_t raw, uint64_t b, bool& saturated);

// Two variants, for machines with 64-bit and with 32-bit addresses. On these machines the conversions take no
// instructions.
#if UINTPTR_MAX > 0xffffffff
constexpr uint64_t word_of(Scaled a) { return __builtin_bit_cast(uint64_t, a); }
constexpr Scaled to_scaled(uint64_t word) { return __builtin_bit_cast(Scaled, word); }
#else
DETENT_PASSING constexpr uint64_t word_of(Scaled a) {
  return static_cast<uint32_t>(a.mantissa) | static_cast<uint64_t>(a.exponent) << 32;
}
DETENT_PASSING constexpr Scaled to_scaled(uint64_t word) {
  return Scaled::from_parts(static_cast<int32_t>(word), static_cast<int32_t>(word >> 32));
}
#endif
}  // namespace words

/// Returns mantissa 2^exponent, or its negative if `negative`, in canonical form. A caller that has dropped lower bits
/// of the mantissa must set its lowest bit (sticky bit).
DETENT_PASSING inline Scaled scaled_from_parts(bool negative, uint64_t mantissa, int exponent) {
  return words::to_scaled(words::scaled_from_parts(negative, mantissa, exponent));
}

DETENT_PASSING inline Scaled scaled_from(Real a) { return words::to_scaled(words::scaled_from(a.raw, k_real_frac)); }
DETENT_PASSING inline Scaled scaled_from(Unit a) { return words::to_scaled(words::scaled_from(a.raw, k_unit_frac)); }
DETENT_PASSING inline Scaled multiply(Scaled a, Scaled b) {
  return words::to_scaled(words::multiply(words::word_of(a), words::word_of(b)));
}
/// a / b. Range: b != 0.
DETENT_PASSING inline Scaled divide(Scaled a, Scaled b) {
  return words::to_scaled(words::divide(words::word_of(a), words::word_of(b)));
}
DETENT_PASSING inline Scaled add(Scaled a, Scaled b) {
  return words::to_scaled(words::add(words::word_of(a), words::word_of(b)));
}
/// a 2^n, exact.
DETENT_PASSING inline Scaled scaled_by_power(Scaled a, int n) {
#if UINTPTR_MAX > 0xffffffff
  const int exponent = a.exponent + n;
  if (a.mantissa != 0 && exponent >= -k_scaled_exponent_max && exponent <= k_scaled_exponent_max)
    return Scaled::from_parts(a.mantissa, exponent);
#endif
  return words::to_scaled(words::scaled_by_power(words::word_of(a), n));
}
/// The square root. Range: a >= 0.
DETENT_PASSING inline Scaled square_root(Scaled a) { return words::to_scaled(words::square_root(words::word_of(a))); }
DETENT_PASSING inline bool less(Scaled a, Scaled b) { return words::less(words::word_of(a), words::word_of(b)); }
constexpr bool is_positive(Scaled a) { return a.mantissa > 0; }
constexpr Scaled negate(Scaled a) { return Scaled::from_parts(-a.mantissa, a.exponent); }

/// a b as a Real. Range: |b| < 2^30. Rounding: to nearest, ties up. Overflow: wraps; none for |b| <= 1.
#if DETENT_NATIVE_WIDE
inline Real multiply(Real a, Scaled b) {
  DETENT_VERIFY_RANGE(b.mantissa == 0 || b.exponent < 0);
  const Int128 product = Int128::product(a.raw, b.mantissa);
  const int n = -b.exponent;
  if (n > 0 && n <= 64) return Real::from_raw(product.round_shift(n));
  // Two cases give 0: b = 0, the only b in range whose exponent is not negative; and n > 120, because the product is
  // below 2^95.
  return n <= 0 || n > 120 ? Real(0.0) : Real::from_raw(product.round_shift(n));
}
#else
DETENT_PASSING inline Real multiply(Real a, Scaled b) {
  return Real::from_raw(words::multiply_raw(a.raw, words::word_of(b)));
}
#endif
/// 1 / a. Range: a > 0. Rounding: relative error <= 2^-29. Overflow: none.
DETENT_PASSING inline Scaled scaled_reciprocal(Real a) { return words::to_scaled(words::scaled_reciprocal(a.raw)); }
#if DETENT_NATIVE_WIDE
/// Whether the product of `a` and any mantissa, times 2^-n, certainly fits a Real. A mantissa is below 2^31. So if |a|,
/// as a raw integer, is at most 2^(n + 31), the rounded product is at most 2^62.
constexpr bool fits_scaled(Real a, int n) {
  return n > 0 && n <= 64 && static_cast<uint64_t>((a.raw >> (n < 32 ? n + 31 : 63)) + 1) <= 1;
}
#endif
/// a b as a Real. Rounding: to nearest, ties up. Overflow: clamps to Real's range and sets `saturated` (else
/// untouched).
DETENT_PASSING inline Real multiply(Real a, Scaled b, bool& saturated) {
#if DETENT_NATIVE_WIDE
  const int n = -b.exponent;
  if (fits_scaled(a, n)) return Real::from_raw(Int128::product(a.raw, b.mantissa).round_shift(n));
#endif
  return Real::from_raw(words::multiply_raw(a.raw, words::word_of(b), saturated));
}
/// a as a Real. Rounding and overflow: as multiply(Real(1.0), a, saturated).
DETENT_PASSING inline Real to_real(Scaled a, bool& saturated) { return multiply(Real(1.0), a, saturated); }
/// a as a Unit. Range: |a| < 2. Rounding: to nearest, ties up.
Unit to_unit(Scaled a);
#else
constexpr Scaled scaled_from(Real a) { return a; }
constexpr Scaled scaled_reciprocal(Real a) { return Real(1) / a; }
constexpr Real multiply(Real a, Scaled b) { return a * b; }
constexpr Scaled add(Scaled a, Scaled b) { return a + b; }
constexpr Scaled scaled_by_power(Scaled a, int n) { return scale_by_power(a, n); }
constexpr bool less(Scaled a, Scaled b) { return a < b; }
constexpr bool is_positive(Scaled a) { return a > 0; }
constexpr Scaled negate(Scaled a) { return Scaled(0) - a; }
/// a as a Real. Overflow: clamps to +-k_real_max and sets `saturated` (else untouched).
constexpr Real to_real(Scaled a, bool& saturated) {
  if (abs(a) <= k_real_max) return a;
  saturated = true;
  return a < 0 ? -k_real_max : k_real_max;
}
constexpr Real multiply(Real a, Scaled b, bool& saturated) { return to_real(a * b, saturated); }
constexpr Unit to_unit(Scaled a) { return a; }
#endif

/// v a, by multiply(v.x, a) for each component.
DETENT_SHARED inline Vec3<Real> multiply(const Vec3<Real>& v, Scaled a) {
  return {multiply(v.x, a), multiply(v.y, a), multiply(v.z, a)};
}
/// v a, by multiply(v.x, a, saturated) for each component.
DETENT_SHARED inline Vec3<Real> multiply(const Vec3<Real>& v, Scaled a, bool& saturated) {
#if DETENT_FIXED && DETENT_NATIVE_WIDE
  const int n = -a.exponent;
  if (fits_scaled(v.x, n) && fits_scaled(v.y, n) && fits_scaled(v.z, n)) {
    const auto part = [&](Real x) { return Real::from_raw(Int128::product(x.raw, a.mantissa).round_shift(n)); };
    return {part(v.x), part(v.y), part(v.z)};
  }
#endif
  return {multiply(v.x, a, saturated), multiply(v.y, a, saturated), multiply(v.z, a, saturated)};
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
