#pragma once
#include <detent/config.h>
#include <detent/detail/shared.h>

#include "base/check.h"

/// Integer functions that lib/math and the floors above it share. They rely on C++20: signed shifts are arithmetic, and
/// conversions to signed integers wrap.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// |value| as an unsigned integer, so that it cannot overflow.
constexpr uint32_t magnitude_32(int32_t value) {
  return value < 0 ? uint32_t{0} - static_cast<uint32_t>(value) : static_cast<uint32_t>(value);
}
constexpr uint64_t magnitude_64(int64_t value) {
  return value < 0 ? uint64_t{0} - static_cast<uint64_t>(value) : static_cast<uint64_t>(value);
}

/// The value with this magnitude and sign. Overflow: wraps.
constexpr int64_t with_sign(uint64_t magnitude, bool negative) {
  return static_cast<int64_t>(negative ? uint64_t{0} - magnitude : magnitude);
}

/// The upper 32 bits of the 64-bit product.
constexpr uint32_t high_product(uint32_t a, uint32_t b) { return static_cast<uint32_t>((uint64_t{a} * b) >> 32); }

/// The number of bits of the value: 0 for 0, else the n with 2^(n-1) <= value < 2^n.
constexpr int bit_length_32(uint32_t value) {
  if (value == 0) return 0;
  if constexpr (sizeof(unsigned) == 4)
    return 32 - __builtin_clz(value);
  else
    return 64 - __builtin_clzll(value);
}
DETENT_SHARED constexpr int bit_length_64(uint64_t value) { return value == 0 ? 0 : 64 - __builtin_clzll(value); }

/// value 2^-n. Range: 1 <= n <= 64, value < 2^63 - 1 for n = 1. Rounding: to nearest, ties up. Overflow: none.
DETENT_SHARED constexpr int64_t round_shift_64(int64_t value, int n) { return ((value >> (n - 1)) + 1) >> 1; }

/// value 2^n for any n. Rounding: to nearest, ties up. Overflow: wraps.
DETENT_SHARED constexpr int64_t shift_64(int64_t value, int n) {
  if (n >= 0) return n > 63 ? 0 : static_cast<int64_t>(static_cast<uint64_t>(value) << n);
  return n < -64 ? 0 : round_shift_64(value, -n);
}

/// value 2^-n. Range: 0 <= n <= 63. Rounding: down.
DETENT_SHARED constexpr int64_t floor_shift_64(int64_t value, int n) { return value >> n; }

constexpr int64_t add_wrapped(int64_t a, int64_t b) {
  return static_cast<int64_t>(static_cast<uint64_t>(a) + static_cast<uint64_t>(b));
}
constexpr int64_t subtract_wrapped(int64_t a, int64_t b) {
  return static_cast<int64_t>(static_cast<uint64_t>(a) - static_cast<uint64_t>(b));
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
