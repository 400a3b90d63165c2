#pragma once
#include <detent/config.h>

/// @file
/// Fixed-point numbers.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The result of fixed_from_double_bits(): a double converted to fixed point.
struct FromDouble {
  int64_t raw;    ///< value 2^frac, rounded to nearest, ties away from zero
  bool in_range;  ///< false for NaN, infinity and |value| 2^frac >= 2^(int_bits-1): raw is then 0
};
/// Converts an IEEE double, given by its bits, to a fixed-point number with `frac` fraction bits. Uses only integer
/// arithmetic, so the caller's rounding mode and flush-to-zero have no effect. Range: 0 <= frac <= 62. `int_bits`: the
/// number of bits of the integer that stores the result, sign included, at most 64.
constexpr FromDouble fixed_from_double_bits(uint64_t bits, int frac, int int_bits) {
  const bool negative = (bits >> 63) != 0;
  const int biased = static_cast<int>((bits >> 52) & 0x7ff);
  if (biased == 0x7ff) return {0, false};
  if (biased == 0) return {0, true};  // zero and subnormals: below half a step of every format
  const uint64_t mantissa = (bits & 0xfffffffffffffu) | 0x10000000000000u;
  const int shift = biased - 1075 + frac;  // value 2^frac = mantissa 2^shift
  uint64_t magnitude = 0;
  if (shift >= 11) return {0, false};
  if (shift >= 0)
    magnitude = mantissa << shift;
  else if (shift >= -53)
    magnitude = (mantissa + (uint64_t{1} << (-shift - 1))) >> -shift;
  if ((magnitude >> (int_bits - 1)) != 0) return {0, false};
  return {negative ? -static_cast<int64_t>(magnitude) : static_cast<int64_t>(magnitude), true};
}

/// A two's complement fixed-point number: value = raw 2^-Frac.
/// Sums that overflow wrap (the ranges in SPEC.md exclude overflow); no operation saturates.
/// A floating-point literal converts at compile time, rounded to nearest. Only the functions of convert.h convert a
/// double at run time.
template <class Int, int Frac>
struct alignas(sizeof(Int)) Fixed {  // alignas: some targets align 8-byte members to less than 8
  /// The number of fraction bits.
  static constexpr int k_frac = Frac;
  /// The number of all bits, sign included.
  static constexpr int k_bits = static_cast<int>(sizeof(Int) * 8);
  /// The underlying integer type.
  using Raw = Int;
  /// The number times 2^Frac.
  Int raw;

  /// Not initialised; `{}` is zero.
  Fixed() = default;
  /// From a literal, rounded to nearest, ties away from zero. A literal out of range does not compile.
  // NOLINTNEXTLINE(google-explicit-constructor): a literal is meant to convert
  consteval Fixed(double literal) : raw(literal_raw(literal)) {}
  /// The number raw_value 2^-Frac.
  static constexpr Fixed from_raw(Int raw_value) {
    Fixed result;
    result.raw = raw_value;
    return result;
  }

  /// Compares the values; exact.
  /// @{
  friend constexpr bool operator==(Fixed a, Fixed b) { return a.raw == b.raw; }
  friend constexpr bool operator<(Fixed a, Fixed b) { return a.raw < b.raw; }
  friend constexpr bool operator>(Fixed a, Fixed b) { return a.raw > b.raw; }
  friend constexpr bool operator<=(Fixed a, Fixed b) { return a.raw <= b.raw; }
  friend constexpr bool operator>=(Fixed a, Fixed b) { return a.raw >= b.raw; }
  /// @}
  /// Sums and differences: exact within the format's range. Overflow: wraps.
  /// @{
  friend constexpr Fixed operator+(Fixed a, Fixed b) { return wrapped(bits(a) + bits(b)); }
  friend constexpr Fixed operator-(Fixed a, Fixed b) { return wrapped(bits(a) - bits(b)); }
  friend constexpr Fixed operator-(Fixed a) { return wrapped(uint64_t{0} - bits(a)); }
  constexpr Fixed& operator+=(Fixed b) { return *this = *this + b; }
  constexpr Fixed& operator-=(Fixed b) { return *this = *this - b; }
  /// @}

 private:
  static constexpr uint64_t bits(Fixed a) { return static_cast<uint64_t>(static_cast<int64_t>(a.raw)); }
  static constexpr Fixed wrapped(uint64_t value) { return from_raw(static_cast<Int>(value)); }
  static constexpr Int literal_raw(double literal) {
    const FromDouble converted = fixed_from_double_bits(__builtin_bit_cast(uint64_t, literal), Frac, k_bits);
    if (!converted.in_range) __builtin_trap();  // at compile time: this literal is outside the format's range
    return static_cast<Int>(converted.raw);
  }
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
