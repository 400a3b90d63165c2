#include "toi/feature_cubic.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// value times 2^-n, rounded down. Range: the result fits 64 bits.
int64_t floor_shift(Int128 value, int n) {
  if (n == 0) return value.low_signed();
  return (value - Int128::from(1).shift_left(n - 1)).round_shift(n);
}

int longest_of(const Int128 (&value)[4], Int128 error) {
  int length = bit_length_128(magnitude_128(error));
  for (const Int128& v : value) {
    const int bits = bit_length_128(magnitude_128(v));
    if (bits > length) length = bits;
  }
  return length;
}

/// The least x, Q30, rounded down, at which the lower convex hull of the Bernstein coefficients is not above 0. The
/// result is above 1 if the hull is above 0 everywhere. Range: coefficients below 2^31.
int64_t first_descent(const int64_t (&c)[4]) {
  if (c[0] <= 0) return 0;
  int64_t first = 3 * (k_whole + 1);
  for (int i = 0; i < 3; ++i) {
    if (c[i] <= 0) continue;
    for (int j = i + 1; j < 4; ++j) {
      if (c[j] > 0) continue;
      const int64_t crossing = i * k_whole + (j - i) * ((c[i] << 30) / (c[i] - c[j]));
      if (crossing < first) first = crossing;
    }
  }
  return first / 3;
}

}  // namespace

OpenPart roots_of(const Cubic& cubic) {
  const int length = longest_of(cubic.coefficient, cubic.error);
  const int n = length > 29 ? length - 29 : 0;
  OpenPart part = k_open;
  for (int sign = 0; sign < 2; ++sign) {
    int64_t ahead[4], back[4];
    for (int i = 0; i < 4; ++i) {
      const Int128 c = sign == 0 ? cubic.coefficient[i] : -cubic.coefficient[i];
      ahead[i] = back[3 - i] = floor_shift(c - cubic.error, n);
    }
    const int64_t from = first_descent(ahead), to = k_whole - first_descent(back);
    if (from > part.from) part.from = from;
    if (to < part.to) part.to = to;
  }
  return part;
}

OpenPart reduced_roots(const Vec64 (&corner)[4][3], const int64_t (&weight)[4], int64_t ball) {
  uint64_t magnitudes = 0;
  for (const auto& corners : corner) {
    for (const Vec64& c : corners) magnitudes |= magnitude_bits(c);
  }
  const Shortening shortening(magnitudes, ball);
  if (shortening.is_blind()) return k_open;
  Int128 volume[4];
  int64_t moments_most = 0, weight_most = 0;
  for (int i = 0; i < 4; ++i) {
    const Vec32 p = round_shift(corner[i][0], shortening.shift), q = round_shift(corner[i][1], shortening.shift),
                r = round_shift(corner[i][2], shortening.shift);
    const Vec64 far = cross(q, r);
    volume[i] = dot(far, p);
    const int64_t moments = magnitude_sum(far) + magnitude_sum(cross(p, q)) + magnitude_sum(cross(r, p));
    if (moments > moments_most) moments_most = moments;
    if (weight[i] > weight_most) weight_most = weight[i];
  }
  // Volumes of 58 bits keep the weighted sums far within 128 bits. The shift rounds each volume and the error bound
  // down by less than 1 each; the "+ 2" below covers both.
  const Int128 volume_error = shortening.volume_error(moments_most);
  const int length = longest_of(volume, volume_error), n = length > 58 ? length - 58 : 0;
  const auto weighted = [&](int i, int64_t factor) {
    return Int128::product(floor_shift(volume[i], n), factor * weight[i]);
  };
  // The error of a weighted volume, times the largest sum of factors in a coefficient of the cubic. The second term is
  // due to the weights, each of which is off by less than 2 units in its last place.
  constexpr int64_t k_factors = 5 + 18 + 9 + 2;
  const Int128 error = Int128::product(floor_shift(volume_error, n) + 2, k_factors * weight_most) +
                       Int128::from(2 * k_factors).shift_left(length - n);
  // The Bernstein coefficients, times six, of the cubic that has these weighted volumes at 0, 1/3, 2/3 and 1.
  return roots_of({{weighted(0, 6), weighted(0, -5) + weighted(1, 18) + weighted(2, -9) + weighted(3, 2),
                    weighted(0, 2) + weighted(1, -9) + weighted(2, 18) + weighted(3, -5), weighted(3, 6)},
                   error});
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
