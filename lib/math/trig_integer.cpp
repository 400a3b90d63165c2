#include "math/trig_integer.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

SineCosineRaw sine_cosine_raw(int64_t phase) {
  // The number of the nearest quarter turn, and the rest t of the angle, in [-1/2, 1/2) quarter turns, Q32.
  const uint32_t quarter = static_cast<uint32_t>((phase + 0x80000000) >> 32) & 3;
  const int64_t t = static_cast<int32_t>(phase);
  const uint64_t square = static_cast<uint64_t>(t * t);  // Q64
  const uint32_t s = static_cast<uint32_t>(square >> 32);

  // sin = t pi/2 - t s R(s) with s = t^2. R is a minimax polynomial of degree 3, Q32; before the rounding of its
  // coefficients, the error of the sine is 2^-38.6. The leading term is computed separately, with 64 bits.
  const uint32_t r = 0xa55de72b - high_product(s, 0x1466bb96 - high_product(s, 0x132c9fd - high_product(s, 0xa5cf6)));
  const int64_t lead = t * (int64_t{1} << 30) + ((t * 0x921fb544) >> 2);            // Q62
  const int64_t sine = round_shift_64(lead - ((t * high_product(s, r)) >> 2), 32);  // Q30

  // cos = 1 - s Q(s). Q is a minimax polynomial of degree 4, Q31; before the rounding of its coefficients, the error of
  // the cosine is 2^-43.9.
  const uint32_t q =
      0x9de9e64e -
      high_product(s, 0x20783e0f - high_product(s, 0x2aba777 - high_product(s, 0x1e1e86 - high_product(s, 0xd084))));
  // s Q(s), Q63, computed with all 64 bits of t^2.
  const uint64_t versed = uint64_t{s} * q + high_product(static_cast<uint32_t>(square), q);
  const int64_t cosine = round_shift_64((int64_t{1} << 62) - static_cast<int64_t>(versed >> 1), 32);

  const int32_t a = static_cast<int32_t>(sine);
  const int32_t b = static_cast<int32_t>(cosine);
  if (quarter == 0) return {a, b};
  if (quarter == 1) return {b, -a};
  if (quarter == 2) return {-a, -b};
  return {-b, a};
}

uint32_t arc_tangent_raw(int32_t y, int32_t x) {
  const uint64_t y_size = magnitude_32(y);
  const uint64_t x_size = magnitude_32(x);
  const bool steep = y_size > x_size;
  const uint64_t large = steep ? y_size : x_size;
  const uint64_t small = steep ? x_size : y_size;
  if (large == 0) return 0;
  // If small / large > tan(pi/8) = 0x6a09e668 2^-32, the angle is computed as
  // 1/8 turn - atan((large - small) / (large + small)).
  const bool turned = (small << 32) > 0x6a09e668 * large;
  const uint64_t numerator = turned ? large - small : small;
  const uint64_t denominator = turned ? large + small : large;
  const uint32_t z = static_cast<uint32_t>(((numerator << 32) + denominator / 2) / denominator);
  const uint32_t s = high_product(z, z);

  // atan(z) / 2 pi = z / 2 pi - z s B(s) with s = z^2. B is a minimax polynomial of degree 5, Q36; before the rounding
  // of its coefficients, the error is 2^-40 turns.
  const uint32_t b =
      0xd94cae95 -
      high_product(
          s, 0x8260f883 -
                 high_product(
                     s, 0x5d18cea5 -
                            high_product(s, 0x47ec1822 - high_product(s, 0x36dedb7f - high_product(s, 0x1e342657)))));
  const uint64_t product = uint64_t{z} * 0xa2f9836e - ((uint64_t{z} * high_product(s, b)) >> 2);  // Q66
  const uint32_t part = static_cast<uint32_t>((product + (uint64_t{1} << 33)) >> 34);

  uint32_t angle = turned ? (uint32_t{1} << 29) - part : part;
  if (steep) angle = (uint32_t{1} << 30) - angle;
  if (x < 0) angle = (uint32_t{1} << 31) - angle;
  return y < 0 ? uint32_t{0} - angle : angle;
}

int64_t turns_from_radians_raw(int64_t angle, int extra_bits) {
  constexpr int64_t k_inverse_two_pi = 2935890503282001226;  // Q64
  return Int128::product(angle, k_inverse_two_pi).round_shift(64 + 46 - 32 - extra_bits);
}

int64_t radians_raw(int32_t turns, int frac) {
  constexpr int64_t k_two_pi_q60 = 7244019458077122842;  // Q60
  return Int128::product_narrow(k_two_pi_q60, turns).round_shift(60 + 32 - frac);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
