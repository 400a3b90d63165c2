#pragma once
#include "math/bits.h"

/// 128-bit integers for exact products, in two representations with one interface. NativeInt128 is the compiler's own
/// type. PortableInt128, for targets without such a type, uses products of 32 x 32 bits with results of 64 bits. Tests
/// compare the results of both. No function calls a 128-bit routine of the compiler's support library: some targets
/// lack them.
namespace detent {
inline namespace DETENT_NAMESPACE {

struct PortableInt128 {
  uint64_t low;
  int64_t high;

  static constexpr PortableInt128 from(int64_t value) { return {static_cast<uint64_t>(value), value >> 63}; }
  static constexpr PortableInt128 from_words(int64_t high, uint64_t low) { return {low, high}; }

  /// a b, exact.
  DETENT_SHARED static constexpr PortableInt128 product(int64_t a, int64_t b) {
    const uint32_t a_low = static_cast<uint32_t>(a);
    const uint32_t b_low = static_cast<uint32_t>(b);
    const int32_t a_high = static_cast<int32_t>(a >> 32);
    const int32_t b_high = static_cast<int32_t>(b >> 32);
    const uint64_t low_low = uint64_t{a_low} * b_low;
    // |a_high b_low| < 2^63, and the carries added to it stay below 2^32: no overflow.
    const int64_t high_low = int64_t{a_high} * b_low + static_cast<int64_t>(low_low >> 32);
    const int64_t low_high = int64_t{b_high} * a_low + static_cast<int64_t>(high_low & 0xffffffff);
    return {(static_cast<uint64_t>(low_high) << 32) | (low_low & 0xffffffff),
            int64_t{a_high} * b_high + (high_low >> 32) + (low_high >> 32)};
  }
  /// a b, exact. Takes half the work of product().
  DETENT_SHARED static constexpr PortableInt128 product_narrow(int64_t a, int32_t b) {
    const int64_t tail = static_cast<int64_t>(static_cast<uint32_t>(a)) * b;
    const int64_t head = (a >> 32) * b + (tail >> 32);  // |.| < 2^62 + 2^31
    return {(static_cast<uint64_t>(head) << 32) | (static_cast<uint64_t>(tail) & 0xffffffff), head >> 32};
  }

  /// (a0 b0 + a1 b1 + a2 b2) 2^-n as 64 bits. Range: b0, b1, b2 != -2^31. Rounding: to nearest, ties up. Overflow:
  /// wraps.
  template <int n>
  static constexpr int64_t narrow_sum(int64_t a0, int32_t b0, int64_t a1, int32_t b1, int64_t a2, int32_t b2) {
    // Each a is split: a = high 2^32 + low with a signed low half. So the magnitude of each product low b is below
    // 2^62, and a sum of two of them fits in 64 bits. The products high b have the factor 2^32: they need no rounding,
    // and they may wrap, because the result is computed modulo 2^64.
    static_assert(n >= 1 && n <= 32);
    constexpr int64_t k_mask = (int64_t{1} << n) - 1;
    const int64_t low_01 = low_product(a0, b0) + low_product(a1, b1);
    const int64_t low_2 = low_product(a2, b2);
    const int64_t fraction = (low_01 & k_mask) + (low_2 & k_mask) + (int64_t{1} << (n - 1));
    const uint64_t high_sum = high_product(a0, b0) + high_product(a1, b1) + high_product(a2, b2);
    return static_cast<int64_t>((high_sum << (32 - n)) + static_cast<uint64_t>(low_01 >> n) +
                                static_cast<uint64_t>(low_2 >> n) + static_cast<uint64_t>(fraction >> n));
  }
  template <int n>
  static constexpr int64_t narrow_sum(int64_t a0, int32_t b0, int64_t a1, int32_t b1) {
    static_assert(n >= 1 && n <= 32);
    const int64_t low_sum = low_product(a0, b0) + low_product(a1, b1) + (int64_t{1} << (n - 1));
    const uint64_t high_sum = high_product(a0, b0) + high_product(a1, b1);
    return static_cast<int64_t>((high_sum << (32 - n)) + static_cast<uint64_t>(low_sum >> n));
  }
  template <int n>
  static constexpr int64_t narrow_sum(int64_t a0, int32_t b0) {
    static_assert(n >= 1 && n <= 32);
    const int64_t low_sum = static_cast<int64_t>(static_cast<uint32_t>(a0)) * b0 + (int64_t{1} << (n - 1));
    const uint64_t high_sum = static_cast<uint64_t>((a0 >> 32) * b0);
    return static_cast<int64_t>((high_sum << (32 - n)) + static_cast<uint64_t>(low_sum >> n));
  }

  DETENT_SHARED friend constexpr PortableInt128 operator+(const PortableInt128& a, const PortableInt128& b) {
    const uint64_t sum = a.low + b.low;
    const uint64_t carry = sum < a.low ? 1 : 0;
    return {sum, static_cast<int64_t>(static_cast<uint64_t>(a.high) + static_cast<uint64_t>(b.high) + carry)};
  }
  DETENT_SHARED friend constexpr PortableInt128 operator-(const PortableInt128& a, const PortableInt128& b) {
    const uint64_t borrow = a.low < b.low ? 1 : 0;
    return {a.low - b.low,
            static_cast<int64_t>(static_cast<uint64_t>(a.high) - static_cast<uint64_t>(b.high) - borrow)};
  }
  DETENT_SHARED friend constexpr PortableInt128 operator-(const PortableInt128& a) { return PortableInt128{0, 0} - a; }
  DETENT_SHARED friend constexpr bool operator==(const PortableInt128& a, const PortableInt128& b) {
    return a.high == b.high && a.low == b.low;
  }
  DETENT_SHARED friend constexpr bool operator<(const PortableInt128& a, const PortableInt128& b) {
    return a.high < b.high || (a.high == b.high && a.low < b.low);
  }

  constexpr int64_t high_word() const { return high; }
  constexpr uint64_t low_word() const { return low; }
  constexpr int64_t low_signed() const { return static_cast<int64_t>(low); }

  /// value 2^n. Range: 0 <= n <= 127. Overflow: wraps.
  DETENT_SHARED constexpr PortableInt128 shift_left(int n) const {
    if (n == 0) return *this;
    if (n >= 64) return {0, static_cast<int64_t>(low << (n - 64))};
    return {low << n, static_cast<int64_t>((static_cast<uint64_t>(high) << n) | (low >> (64 - n)))};
  }
  /// The low 64 bits of value 2^-n. Range: 1 <= n <= 127. Rounding: to nearest, ties up. Overflow: wraps.
  DETENT_SHARED constexpr int64_t round_shift(int n) const {
    if (n > 64) return round_shift_64(high, n - 64);
    const uint64_t half = (low >> (n - 1)) & 1;
    if (n == 64) return static_cast<int64_t>(static_cast<uint64_t>(high) + half);
    return static_cast<int64_t>(((low >> n) | (static_cast<uint64_t>(high) << (64 - n))) + half);
  }
  /// As round_shift(n). Range: 1 <= n <= 64.
  template <int n>
  constexpr int64_t round_shift() const {
    static_assert(n >= 1 && n <= 64);
    return round_shift(n);
  }

 private:
  static constexpr int64_t low_product(int64_t a, int32_t b) { return int64_t{static_cast<int32_t>(a)} * b; }
  static constexpr uint64_t high_product(int64_t a, int32_t b) {
    const int32_t carry = static_cast<int32_t>(a) < 0 ? b : 0;
    return static_cast<uint64_t>((a >> 32) * b + carry);
  }
};

#if defined(__SIZEOF_INT128__)
struct NativeInt128 {
  __extension__ typedef __int128 Value;
  __extension__ typedef unsigned __int128 Bits;
  Value value;

  static constexpr NativeInt128 from(int64_t value) { return {value}; }
  static constexpr NativeInt128 from_words(int64_t high, uint64_t low) {
    return {static_cast<Value>((static_cast<Bits>(static_cast<uint64_t>(high)) << 64) | low)};
  }
  static constexpr NativeInt128 product(int64_t a, int64_t b) { return {static_cast<Value>(a) * b}; }
  static constexpr NativeInt128 product_narrow(int64_t a, int32_t b) { return product(a, b); }

  /// As PortableInt128::narrow_sum().
  template <int n>
  static constexpr int64_t narrow_sum(int64_t a0, int32_t b0, int64_t a1, int32_t b1, int64_t a2, int32_t b2) {
    return rounded<n>(static_cast<Value>(a0) * b0 + static_cast<Value>(a1) * b1 + static_cast<Value>(a2) * b2);
  }
  template <int n>
  static constexpr int64_t narrow_sum(int64_t a0, int32_t b0, int64_t a1, int32_t b1) {
    return rounded<n>(static_cast<Value>(a0) * b0 + static_cast<Value>(a1) * b1);
  }
  template <int n>
  static constexpr int64_t narrow_sum(int64_t a0, int32_t b0) {
    return rounded<n>(static_cast<Value>(a0) * b0);
  }

  friend constexpr NativeInt128 operator+(NativeInt128 a, NativeInt128 b) {
    return {static_cast<Value>(static_cast<Bits>(a.value) + static_cast<Bits>(b.value))};
  }
  friend constexpr NativeInt128 operator-(NativeInt128 a, NativeInt128 b) {
    return {static_cast<Value>(static_cast<Bits>(a.value) - static_cast<Bits>(b.value))};
  }
  friend constexpr NativeInt128 operator-(NativeInt128 a) {
    return {static_cast<Value>(Bits{0} - static_cast<Bits>(a.value))};
  }
  friend constexpr bool operator==(NativeInt128 a, NativeInt128 b) { return a.value == b.value; }
  friend constexpr bool operator<(NativeInt128 a, NativeInt128 b) { return a.value < b.value; }

  constexpr int64_t high_word() const { return static_cast<int64_t>(value >> 64); }
  constexpr uint64_t low_word() const { return static_cast<uint64_t>(value); }
  constexpr int64_t low_signed() const { return static_cast<int64_t>(value); }

  constexpr NativeInt128 shift_left(int n) const { return {static_cast<Value>(static_cast<Bits>(value) << n)}; }
  constexpr int64_t round_shift(int n) const {
    if (n > 64) return round_shift_64(high_word(), n - 64);
    // The value is shifted up, so that the high word of `up` is the result before rounding.
    const Bits up = static_cast<Bits>(value) << ((64 - n) & 63);
    return static_cast<int64_t>(static_cast<uint64_t>(up >> 64) + (static_cast<uint64_t>(up) >> 63));
  }
  template <int n>
  constexpr int64_t round_shift() const {
    static_assert(n >= 1 && n <= 64);
    return static_cast<int64_t>((static_cast<Bits>(value) + (Bits{1} << (n - 1))) >> n);
  }

 private:
  template <int n>
  static constexpr int64_t rounded(Value sum) {
    return static_cast<int64_t>((sum + (Value{1} << (n - 1))) >> n);
  }
};
#endif

// wasm has the type, but calls a library function for products.
#if defined(__SIZEOF_INT128__) && !defined(__wasm__) && !defined(DETENT_PORTABLE_WIDE)
#define DETENT_NATIVE_WIDE 1
using Int128 = NativeInt128;
#else
#define DETENT_NATIVE_WIDE 0
using Int128 = PortableInt128;
#endif

/// An unsigned 128-bit number in two words: high 2^64 + low.
struct Words128 {
  uint64_t high;
  uint64_t low;
};

/// |value|; -2^127 gives 2^127.
template <class Wide>
constexpr Words128 magnitude_128(Wide value) {
  const Wide positive = value < Wide::from(0) ? -value : value;
  return {static_cast<uint64_t>(positive.high_word()), positive.low_word()};
}
constexpr int bit_length_128(Words128 value) {
  return value.high != 0 ? 64 + bit_length_64(value.high) : bit_length_64(value.low);
}

/// Returns the floor of numerator / divisor, and sets `remainder`. Range: numerator.high < divisor, so that the
/// quotient fits. Source: Knuth, TAOCP vol. 2, 4.3.1 algorithm D, on two digits of 32 bits.
uint64_t divide_128_by_64(Words128 numerator, uint64_t divisor, uint64_t& remainder);

/// Returns numerator / divisor, or its negative if `negative`. Range: divisor != 0. Rounding: to nearest, ties up.
/// Overflow: saturates.
int64_t divide_rounded(bool negative, Words128 numerator, uint64_t divisor);
template <class Wide>
int64_t divide_rounded(Wide numerator, int64_t divisor) {
  const bool negative = (numerator < Wide::from(0)) != (divisor < 0);
  return divide_rounded(negative, magnitude_128(numerator), magnitude_64(divisor));
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
