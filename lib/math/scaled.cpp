#include "math/scaled.h"

#if DETENT_FIXED
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace words {

uint64_t scaled_from_parts(bool negative, uint64_t mantissa, int exponent) {
  if (mantissa == 0) return 0;
  const int drop = bit_length_64(mantissa) - 31;
  // Ties away from zero. If rounding gives 2^31, the mantissa becomes 2^30, and the exponent increases by 1.
  uint64_t rounded = drop <= 0 ? mantissa << -drop : ((mantissa >> (drop - 1)) + 1) >> 1;
  exponent += drop;
  if (rounded >> 31 != 0) {
    rounded >>= 1;
    ++exponent;
  }
  if (exponent < -k_scaled_exponent_max) return 0;
  if (exponent > k_scaled_exponent_max) {
    rounded = INT32_MAX;
    exponent = k_scaled_exponent_max;
  }
  const int32_t size = static_cast<int32_t>(rounded);
  return word_of(Scaled::from_parts(negative ? -size : size, exponent));
}

uint64_t scaled_from(int64_t raw, int frac) { return scaled_from_parts(raw < 0, magnitude_64(raw), -frac); }

uint64_t multiply(uint64_t a_word, uint64_t b_word) {
  const Scaled a = to_scaled(a_word), b = to_scaled(b_word);
  const int64_t product = int64_t{a.mantissa} * b.mantissa;
  return scaled_from_parts(product < 0, magnitude_64(product), a.exponent + b.exponent);
}

uint64_t divide(uint64_t a_word, uint64_t b_word) {
  const Scaled a = to_scaled(a_word), b = to_scaled(b_word);
  DETENT_VERIFY_RANGE(b.mantissa != 0);
  const uint64_t numerator = uint64_t{magnitude_32(a.mantissa)} << 32;
  const uint64_t divisor = magnitude_32(b.mantissa);
  const uint64_t quotient = numerator / divisor;  // 0 or at least 2^31, so one sticky bit can stand for the remainder
  const uint64_t sticky = quotient * divisor != numerator ? 1 : 0;
  return scaled_from_parts((a.mantissa < 0) != (b.mantissa < 0), (quotient << 1) | sticky,
                           a.exponent - b.exponent - 33);
}

uint64_t add(uint64_t a_word, uint64_t b_word) {
  const Scaled a = to_scaled(a_word), b = to_scaled(b_word);
  if (a.mantissa == 0) return b_word;
  if (b.mantissa == 0) return a_word;
  const Scaled large = a.exponent < b.exponent ? b : a;
  const Scaled small = a.exponent < b.exponent ? a : b;
  const int shift = large.exponent - small.exponent;
  if (shift > 33) return word_of(large);
  // The sum is computed with 31 fraction bits more than the mantissa of the larger number has. The last of these bits
  // is sticky: it also stands for the lower bits that the smaller number loses in the shift.
  const int64_t head = int64_t{small.mantissa} * (int64_t{1} << 31);
  const int64_t shifted = head >> shift;
  const int64_t sticky = shifted * (int64_t{1} << shift) != head ? 1 : 0;
  const int64_t sum = int64_t{large.mantissa} * (int64_t{1} << 31) + (shifted | sticky);
  return scaled_from_parts(sum < 0, magnitude_64(sum), large.exponent - 31);
}

uint64_t scaled_by_power(uint64_t a_word, int n) {
  const Scaled a = to_scaled(a_word);
  return scaled_from_parts(a.mantissa < 0, magnitude_32(a.mantissa), a.exponent + n);
}

uint64_t square_root(uint64_t a_word) {
  const Scaled a = to_scaled(a_word);
  DETENT_VERIFY_RANGE(a.mantissa >= 0);
  const int shift = (a.exponent & 1) != 0 ? 33 : 32;
  const uint64_t square = static_cast<uint64_t>(a.mantissa) << shift;
  const uint64_t root = square_root_floor(square);  // 0 or at least 2^31
  const uint64_t sticky = root * root != square ? 1 : 0;
  return scaled_from_parts(false, (root << 1) | sticky, (a.exponent - shift) / 2 - 1);
}

bool less(uint64_t a_word, uint64_t b_word) {
  const Scaled a = to_scaled(a_word), b = to_scaled(b_word);
  const bool a_negative = a.mantissa < 0;
  const bool same_sign = a.mantissa != 0 && b.mantissa != 0 && a_negative == (b.mantissa < 0);
  if (same_sign && a.exponent != b.exponent) return (a.exponent < b.exponent) != a_negative;
  return a.mantissa < b.mantissa;
}

uint64_t scaled_reciprocal(int64_t raw) {
  DETENT_VERIFY_RANGE(raw > 0);
  const uint64_t size = static_cast<uint64_t>(raw);
  const int length = bit_length_64(size);
  const uint64_t head = length > 32 ? size >> (length - 32) : size << (32 - length);  // [2^31, 2^32)
  const uint64_t quotient = (uint64_t{1} << 62) / head;                               // (2^30, 2^31]
  constexpr int k_exponent = k_real_frac + 32 - 62;
  if (quotient >> 31 != 0) return word_of(Scaled::from_parts(1 << 30, k_exponent - length + 1));
  return word_of(Scaled::from_parts(static_cast<int32_t>(quotient), k_exponent - length));
}

#if !DETENT_NATIVE_WIDE
int64_t multiply_raw(int64_t raw, uint64_t b_word) {
  const Scaled b = to_scaled(b_word);
  DETENT_VERIFY_RANGE(b.mantissa == 0 || b.exponent < 0);
  const int n = -b.exponent;
  // The product is high 2^32 + low, as in PortableInt128::product_narrow(). Only the part that the result needs is
  // computed.
  const int64_t low_product = static_cast<int64_t>(static_cast<uint32_t>(raw)) * b.mantissa;
  const int64_t high = (raw >> 32) * b.mantissa + (low_product >> 32);
  if (n > 32) return shift_64(high, 32 - n);
  if (n <= 0) return 0;  // in the range of this function, only b = 0 has an exponent that is not negative
  const int64_t low = low_product & 0xffffffff;
  return static_cast<int64_t>(static_cast<uint64_t>(high) << (32 - n)) + round_shift_64(low, n);
}
#endif

int64_t multiply_raw(int64_t raw, uint64_t b_word, bool& saturated) {
  const Scaled b = to_scaled(b_word);
  // An upper bound of the bit length of the integer part of the product. If it shows that the product fits, the exact
  // test below is not needed.
  const int most = bit_length_64(magnitude_64(raw)) + 31 + b.exponent;
  if (most <= 62 && b.exponent < 0 && b.exponent >= -120)
    return Int128::product_narrow(raw, b.mantissa).round_shift(-b.exponent);
  const Int128 product = Int128::product_narrow(raw, b.mantissa);
  const Words128 size = magnitude_128(product);
  const int length = bit_length_128(size);
  if (length == 0 || b.exponent < -127) return 0;
  const bool negative = product < Int128::from(0);
  if (length + b.exponent <= 63) {
    const int64_t rounded =
        b.exponent >= 0 ? product.shift_left(b.exponent).low_signed() : product.round_shift(-b.exponent);
    if ((rounded < 0) == negative || rounded == 0) return rounded;  // else it was rounded up to 2^63
  }
  saturated = true;
  return negative ? -INT64_MAX : INT64_MAX;
}

}  // namespace words

Unit to_unit(Scaled a) { return unit_from_raw(shift_64(a.mantissa, a.exponent + k_unit_frac)); }

}  // namespace DETENT_NAMESPACE
}  // namespace detent
#endif
