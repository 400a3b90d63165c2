#pragma once
#include <detent/scalar.h>

/// @file
/// The number type of wide range.
namespace detent {
inline namespace DETENT_NAMESPACE {

#if DETENT_FIXED
/// A signed number of wide range, for masses, densities, forces and impulses: value = mantissa x 2^exponent.
/// Canonical: the mantissa is 0 (and then the exponent 0), or 2^30 <= |mantissa| < 2^31. |exponent| <= 256.
/// Relative resolution 2^-30. A floating-point literal converts at compile time; a run-time double by `from_host`.
struct Scaled {
  int32_t mantissa;  ///< 0, or 2^30 <= |mantissa| < 2^31
  int32_t exponent;  ///< within +-256; 0 if the mantissa is 0

  /// Not initialised; `{}` is zero.
  Scaled() = default;
  /// A literal, rounded to nearest, ties away from zero. A literal that is neither 0 nor has a magnitude in
  /// [2^-200, 2^200] does not compile.
  // NOLINTNEXTLINE(google-explicit-constructor): a literal is meant to convert
  consteval Scaled(double literal) : Scaled(from_double_bits(__builtin_bit_cast(uint64_t, literal))) {
    if (mantissa == 0 && literal != 0) __builtin_trap();  // at compile time: NaN, infinite or out of range
  }
  /// The number mantissa x 2^exponent, which must be canonical.
  static constexpr Scaled from_parts(int32_t mantissa, int32_t exponent) {
    Scaled result;
    result.mantissa = mantissa;
    result.exponent = exponent;
    return result;
  }
  /// Rounded to nearest, ties away from zero. NaN, infinity and |value| outside [2^-200, 2^200] give 0.
  static constexpr Scaled from_double_bits(uint64_t bits) {
    const int biased = static_cast<int>((bits >> 52) & 0x7ff);
    if (biased < 1023 - 200 || biased > 1023 + 200) return from_parts(0, 0);
    const uint64_t full = (bits & 0xfffffffffffffu) | 0x10000000000000u;  // 53 bits
    uint64_t magnitude = (full + (uint64_t{1} << 21)) >> 22;              // 31 bits, or 2^31 after the carry
    int32_t exponent = biased - 1023 - 30;
    if ((magnitude >> 31) != 0) {
      magnitude >>= 1;
      ++exponent;
    }
    const int32_t mantissa = static_cast<int32_t>(magnitude);
    return from_parts((bits >> 63) != 0 ? -mantissa : mantissa, exponent);
  }
  /// Equal in value.
  friend constexpr bool operator==(Scaled a, Scaled b) { return a.mantissa == b.mantissa && a.exponent == b.exponent; }
};
#else
/// A number of wide range: in float configurations a Real.
using Scaled = Real;
#endif

}  // namespace DETENT_NAMESPACE
}  // namespace detent
