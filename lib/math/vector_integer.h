#pragma once
#include <detent/detail/shared.h>
#include <detent/numbers.h>

#include "math/wide.h"

/// Vectors of integers, whose functions are exact unless stated otherwise. lib/distance and lib/toi compute with them,
/// in the same way in every configuration.
namespace detent {
inline namespace DETENT_NAMESPACE {

using Vec32 = Vec3<int32_t>;
using Vec64 = Vec3<int64_t>;

/// The number 1 in Q30, the format of unit vectors, rotations and fractions.
inline constexpr int32_t k_one = 1 << 30;
inline constexpr int64_t k_one_64 = k_one;

DETENT_SHARED constexpr Vec32 add(const Vec32& a, const Vec32& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
DETENT_SHARED constexpr Vec32 subtract(const Vec32& a, const Vec32& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
DETENT_SHARED constexpr Vec64 add(const Vec64& a, const Vec64& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
DETENT_SHARED constexpr Vec32 negate(const Vec32& a) { return {-a.x, -a.y, -a.z}; }
DETENT_SHARED constexpr Vec64 negate(const Vec64& a) { return {-a.x, -a.y, -a.z}; }
DETENT_SHARED constexpr bool is_zero(const Vec32& a) { return (a.x | a.y | a.z) == 0; }
DETENT_SHARED constexpr bool is_zero(const Vec64& a) { return (a.x | a.y | a.z) == 0; }

/// The dot product, exact. Range: |a| |b| < 2^63.
DETENT_SHARED constexpr int64_t dot(const Vec32& a, const Vec32& b) {
  return int64_t{a.x} * b.x + int64_t{a.y} * b.y + int64_t{a.z} * b.z;
}
/// The cross product, exact. Range: |a| |b| < 2^63.
DETENT_SHARED constexpr Vec64 cross(const Vec32& a, const Vec32& b) {
  return {int64_t{a.y} * b.z - int64_t{a.z} * b.y, int64_t{a.z} * b.x - int64_t{a.x} * b.z,
          int64_t{a.x} * b.y - int64_t{a.y} * b.x};
}
/// The dot product, exact. Range: |a| |b| < 2^127.
DETENT_SHARED constexpr Int128 dot(const Vec64& a, const Vec64& b) {
  return Int128::product(a.x, b.x) + Int128::product(a.y, b.y) + Int128::product(a.z, b.z);
}
DETENT_SHARED constexpr Int128 dot(const Vec64& a, const Vec32& b) {
  return Int128::product_narrow(a.x, b.x) + Int128::product_narrow(a.y, b.y) + Int128::product_narrow(a.z, b.z);
}
/// The sign of `value`: -1, 0 or 1.
constexpr int sign_of(Int128 value) {
  return value.high_word() < 0 ? -1 : (static_cast<uint64_t>(value.high_word()) | value.low_word()) != 0 ? 1 : 0;
}

/// v 2^-n, each component rounded to nearest, ties up. Range: 0 <= n <= 63.
DETENT_SHARED constexpr Vec32 round_shift(const Vec64& v, int n) {
  const int64_t half = n == 0 ? 0 : int64_t{1} << (n - 1);
  return {static_cast<int32_t>((v.x + half) >> n), static_cast<int32_t>((v.y + half) >> n),
          static_cast<int32_t>((v.z + half) >> n)};
}

/// v times the power of two that brings its largest component to [2^29, 2^30] in magnitude. Range: v != 0.
/// Rounding: to nearest.
DETENT_SHARED constexpr Vec32 scaled_to_30_bits(const Vec64& v) {
  const int length = bit_length_64(magnitude_64(v.x) | magnitude_64(v.y) | magnitude_64(v.z));
  if (length > 30) return round_shift(v, length - 30);
  const int n = 30 - length;
  return {static_cast<int32_t>(v.x << n), static_cast<int32_t>(v.y << n), static_cast<int32_t>(v.z << n)};
}
DETENT_SHARED constexpr Vec32 scaled_to_30_bits(const Vec32& v) { return scaled_to_30_bits(Vec64{v.x, v.y, v.z}); }

}  // namespace DETENT_NAMESPACE
}  // namespace detent
