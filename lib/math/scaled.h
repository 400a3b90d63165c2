#pragma once
#include <detent/scaled.h>

#include "math/root.h"

/// Numbers of wide range: masses, densities, forces, impulses.
///
/// Fixed. Rounding: the mantissa to nearest, ties away from zero (so that -a mirrors a); relative error of every
/// function
/// <= 2^-31. Overflow: clamps to +-(2 - 2^-30) 2^286; below 2^-226: 0.
/// Float: the plain expression.
namespace detent {
inline namespace DETENT_NAMESPACE {

#if DETENT_FIXED
inline constexpr int k_scaled_exponent_max = 256;

/// mantissa 2^exponent in canonical form. A caller that dropped lower bits sets the mantissa's lowest bit.
Scaled scaled_from_parts(bool negative, uint64_t mantissa, int exponent);

Scaled scaled_from(Real a);
Scaled scaled_from(Unit a);
Scaled multiply(Scaled a, Scaled b);
/// Range: b != 0.
Scaled divide(Scaled a, Scaled b);
Scaled add(Scaled a, Scaled b);
/// a 2^n, exact.
inline Scaled scaled_by_power(Scaled a, int n) {
  const int exponent = a.exponent + n;
  if (a.mantissa != 0 && exponent >= -k_scaled_exponent_max && exponent <= k_scaled_exponent_max)
    return Scaled::from_parts(a.mantissa, exponent);
  return scaled_from_parts(a.mantissa < 0, magnitude_32(a.mantissa), exponent);
}
/// Range: a >= 0.
Scaled square_root(Scaled a);
bool less(Scaled a, Scaled b);
constexpr bool is_positive(Scaled a) { return a.mantissa > 0; }
constexpr Scaled negate(Scaled a) { return Scaled::from_parts(-a.mantissa, a.exponent); }

/// a b. Range: |b| < 2^30. Rounding: to nearest, ties up. Overflow: wraps; none for |b| <= 1.
#if DETENT_NATIVE_WIDE
inline Real multiply(Real a, Scaled b) {
  DETENT_VERIFY_RANGE(b.mantissa == 0 || b.exponent < 0);
  // The product is below 2^95; only 0 has an exponent of 0 here.
  if (b.exponent >= 0 || b.exponent < -120) return Real(0.0);
  return Real::from_raw(Int128::product(a.raw, b.mantissa).round_shift(-b.exponent));
}
#else
Real multiply(Real a, Scaled b);
#endif
/// 1 / a. Range: a > 0. Rounding: relative error <= 2^-29. Overflow: none.
Scaled scaled_reciprocal(Real a);
/// a b. Rounding: to nearest, ties up. Overflow: clamps to Real's range and sets `saturated` (else untouched).
Real multiply(Real a, Scaled b, bool& saturated);
/// As multiply(Real(1.0), a, saturated).
Real to_real(Scaled a, bool& saturated);
/// Range: |a| < 2. Rounding: to nearest, ties up.
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
/// Clamps to +-k_real_max and sets `saturated` (else untouched).
constexpr Real to_real(Scaled a, bool& saturated) {
  if (abs(a) <= k_real_max) return a;
  saturated = true;
  return a < 0 ? -k_real_max : k_real_max;
}
constexpr Real multiply(Real a, Scaled b, bool& saturated) { return to_real(a * b, saturated); }
constexpr Unit to_unit(Scaled a) { return a; }
#endif

}  // namespace DETENT_NAMESPACE
}  // namespace detent
