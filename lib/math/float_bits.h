#pragma once
#include "math/bits.h"

/// Functions that compute with the bits of IEEE floats. Their results are the same on every target, whatever its
/// rounding mode, flush-to-zero mode or x87 state.
namespace detent {
inline namespace DETENT_NAMESPACE {

template <class Float>
struct FloatFormat;
template <>
struct FloatFormat<float> {
  using Bits = uint32_t;
  static constexpr int k_fraction_bits = 23;
  static constexpr int k_bias = 127;
};
template <>
struct FloatFormat<double> {
  using Bits = uint64_t;
  static constexpr int k_fraction_bits = 52;
  static constexpr int k_bias = 1023;
};

/// 2^n. Range: 2^n is a normal number (n of float: -126 to 127; of double: -1022 to 1023).
template <class Float>
constexpr Float power_of_two(int n) {
  using Format = FloatFormat<Float>;
  using Bits = typename Format::Bits;
  DETENT_VERIFY_RANGE(n > -Format::k_bias && n <= Format::k_bias);
  return __builtin_bit_cast(Float, static_cast<Bits>(static_cast<Bits>(n + Format::k_bias) << Format::k_fraction_bits));
}

/// A finite float as (-1)^negative mantissa 2^exponent, exact. Subnormals are read as 0, so that flush-to-zero in the
/// caller has no effect.
struct FloatParts {
  uint64_t mantissa;  ///< 0, or an integer whose highest set bit is bit k_fraction_bits of the format
  int exponent;
  bool negative;
  bool finite;
};
template <class Float>
constexpr FloatParts float_parts(Float value) {
  using Format = FloatFormat<Float>;
  const uint64_t bits = __builtin_bit_cast(typename Format::Bits, value);
  const int biased = static_cast<int>((bits >> Format::k_fraction_bits) & (2 * Format::k_bias + 1));
  const uint64_t fraction = bits & ((uint64_t{1} << Format::k_fraction_bits) - 1);
  const bool negative = (bits >> (8 * sizeof(Float) - 1)) != 0;
  if (biased == 0) return {0, 0, negative, true};
  return {fraction | (uint64_t{1} << Format::k_fraction_bits), biased - Format::k_bias - Format::k_fraction_bits,
          negative, biased != 2 * Format::k_bias + 1};
}

/// Returns (-1)^negative mantissa 2^exponent, rounded once, to nearest, ties to even. A caller that has dropped lower
/// bits of a mantissa must pass a mantissa of at least 2^62, and set its lowest bit (sticky bit). Overflow: gives the
/// largest finite number of this sign. Underflow: below the normal range the result is +0.
template <class Float>
constexpr Float float_from_parts(uint64_t mantissa, int exponent, bool negative) {
  using Format = FloatFormat<Float>;
  using Bits = typename Format::Bits;
  if (mantissa == 0) return Float(0);
  const int length = bit_length_64(mantissa);
  const uint64_t normal = mantissa << (64 - length);
  constexpr int k_drop = 63 - Format::k_fraction_bits;
  const uint64_t half = (uint64_t{1} << (k_drop - 1)) - 1 + ((normal >> k_drop) & 1);
  int biased = exponent + length - 1 + Format::k_bias;
  uint64_t kept = (normal >> k_drop) + (((normal & ((uint64_t{1} << k_drop) - 1)) + half) >> k_drop);
  if ((kept >> (Format::k_fraction_bits + 1)) != 0) {
    kept >>= 1;
    ++biased;
  }
  if (biased <= 0) return Float(0);
  constexpr uint64_t k_fraction_mask = (uint64_t{1} << Format::k_fraction_bits) - 1;
  uint64_t bits = (static_cast<uint64_t>(biased) << Format::k_fraction_bits) | (kept & k_fraction_mask);
  if (biased > 2 * Format::k_bias) bits = (uint64_t{2 * Format::k_bias} << Format::k_fraction_bits) | k_fraction_mask;
  if (negative) bits |= uint64_t{1} << (8 * sizeof(Float) - 1);
  return __builtin_bit_cast(Float, static_cast<Bits>(bits));
}

/// value 2^exponent. Rounding: to nearest, ties to even, once.
template <class Float>
constexpr Float float_from_integer(int64_t value, int exponent) {
  return float_from_parts<Float>(magnitude_64(value), exponent, value < 0);
}

/// value 2^frac as an integer. Rounding: to nearest, ties up. Overflow: saturates, and sets `saturated`.
template <class Float>
constexpr int64_t integer_from_float(Float value, int frac, bool& saturated) {
  const FloatParts parts = float_parts(value);
  const int shift = parts.exponent + frac;
  if (parts.mantissa == 0 || shift < -64) return 0;
  if (shift > 62 - FloatFormat<Float>::k_fraction_bits || !parts.finite) {
    saturated = true;
    return parts.negative ? INT64_MIN : INT64_MAX;
  }
  return shift_64(with_sign(parts.mantissa, parts.negative), shift);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
