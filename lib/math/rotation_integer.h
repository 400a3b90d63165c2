#pragma once
#include "math/vector_integer.h"

/// Integer rotations, Q2.30. The fixed-point configurations use them for their Quat; lib/distance and lib/toi use them
/// in every configuration.
namespace detent {
inline namespace DETENT_NAMESPACE {

struct Quat32 {
  int32_t x, y, z, w;
};

/// A rotation matrix; its columns are the images of the local axes.
struct Matrix32 {
  Vec32 column[3];
};

constexpr int32_t round_30(int64_t sum) { return static_cast<int32_t>((sum + (int64_t{1} << 29)) >> 30); }

/// The product a b: the rotation b followed by the rotation a. Rounding: each component once.
DETENT_SHARED constexpr Quat32 multiply(const Quat32& a, const Quat32& b) {
  const int64_t aw = a.w, ax = a.x, ay = a.y, az = a.z;
  return {round_30(aw * b.x + ax * b.w + ay * b.z - az * b.y), round_30(aw * b.y - ax * b.z + ay * b.w + az * b.x),
          round_30(aw * b.z + ax * b.y - ay * b.x + az * b.w), round_30(aw * b.w - ax * b.x - ay * b.y - az * b.z)};
}

/// Scales q to length 1. Range: | |q|^2 - 1 | < 2^-8.
DETENT_SHARED constexpr Quat32 normalise(const Quat32& q) {
  // 1 / sqrt(1 + d) = 1 - (d/2 - 3 d^2/8) + O(d^3)
  const uint64_t square = static_cast<uint64_t>(int64_t{q.x} * q.x) + static_cast<uint64_t>(int64_t{q.y} * q.y) +
                          static_cast<uint64_t>(int64_t{q.z} * q.z) + static_cast<uint64_t>(int64_t{q.w} * q.w);
  const int64_t d = round_shift_64(static_cast<int64_t>(square - (uint64_t{1} << 60)), 30);
  DETENT_VERIFY_RANGE(-(1 << 22) <= d && d <= 1 << 22);
  const int64_t factor = (int64_t{1} << 31) - d + round_shift_64(3 * d * d, 32);  // Q31
  const auto scaled = [factor](int32_t a) { return static_cast<int32_t>(round_shift_64(a * factor, 31)); };
  return {scaled(q.x), scaled(q.y), scaled(q.z), scaled(q.w)};
}

/// Normalises a rotation given by the user. If | |q| - 1 | > 2^-10, returns false and leaves q unchanged.
DETENT_SHARED constexpr bool normalise_input(Quat32& q) {
  constexpr uint64_t k_low = uint64_t{(1 << 20) - (1 << 10)} * ((1 << 20) - (1 << 10));
  constexpr uint64_t k_high = uint64_t{(1 << 20) + (1 << 10)} * ((1 << 20) + (1 << 10));
  // The squares are divided by 4, so that the sum of the four is always below 2^63.
  const auto quarter = [](int64_t a) { return static_cast<uint64_t>(a * a) >> 2; };
  const uint64_t sum = quarter(q.x) + quarter(q.y) + quarter(q.z) + quarter(q.w);
  if (sum < k_low << 18 || sum > k_high << 18) return false;
  q = normalise(normalise(q));
  return true;
}

DETENT_SHARED constexpr Matrix32 matrix_from(const Quat32& q) {
  const int64_t x = q.x, y = q.y, z = q.z, w = q.w;
  constexpr int64_t k_half = int64_t{1} << 59;  // 1/2 in Q60; entry() doubles it together with the products
  const auto entry = [](int64_t half) { return static_cast<int32_t>((half + (int64_t{1} << 28)) >> 29); };
  const int64_t xx = x * x, yy = y * y, zz = z * z, xy = x * y, xz = x * z, yz = y * z, wx = w * x, wy = w * y,
                wz = w * z;
  return {{{entry(k_half - yy - zz), entry(xy + wz), entry(xz - wy)},
           {entry(xy - wz), entry(k_half - xx - zz), entry(yz + wx)},
           {entry(xz + wy), entry(yz - wx), entry(k_half - xx - yy)}}};
}

/// The product m v, exact; it has 30 fraction bits more than v. Range: |v| < 2^32.
DETENT_SHARED constexpr Vec64 multiply(const Matrix32& m, const Vec32& v) {
  const Vec32* c = m.column;
  return {dot(v, Vec32{c[0].x, c[1].x, c[2].x}), dot(v, Vec32{c[0].y, c[1].y, c[2].y}),
          dot(v, Vec32{c[0].z, c[1].z, c[2].z})};
}
/// v rotated by the inverse of m. Rounding: to nearest, ties up.
DETENT_SHARED constexpr Vec32 rotate_inverse(const Matrix32& m, const Vec32& v) {
  return {round_30(dot(v, m.column[0])), round_30(dot(v, m.column[1])), round_30(dot(v, m.column[2]))};
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
