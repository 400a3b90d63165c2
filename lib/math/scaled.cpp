#include "math/scaled.h"

#if DETENT_FIXED
namespace detent {
inline namespace DETENT_NAMESPACE {

Scaled scaled_from_parts(bool negative, uint64_t mantissa, int exponent) {
  if (mantissa == 0) return Scaled::from_parts(0, 0);
  const int drop = bit_length_64(mantissa) - 31;
  // Ties away from zero; a carry to 2^31 is 2^30 with the next exponent.
  uint64_t rounded = drop <= 0 ? mantissa << -drop : ((mantissa >> (drop - 1)) + 1) >> 1;
  exponent += drop;
  if (rounded >> 31 != 0) {
    rounded >>= 1;
    ++exponent;
  }
  if (exponent < -k_scaled_exponent_max) return Scaled::from_parts(0, 0);
  if (exponent > k_scaled_exponent_max) {
    rounded = INT32_MAX;
    exponent = k_scaled_exponent_max;
  }
  const int32_t size = static_cast<int32_t>(rounded);
  return Scaled::from_parts(negative ? -size : size, exponent);
}

Scaled scaled_from(Real a) { return scaled_from_parts(a.raw < 0, magnitude_64(a.raw), -k_real_frac); }

Scaled scaled_from(Unit a) { return scaled_from_parts(a.raw < 0, magnitude_32(a.raw), -k_unit_frac); }

Scaled multiply(Scaled a, Scaled b) {
  const int64_t product = int64_t{a.mantissa} * b.mantissa;
  return scaled_from_parts(product < 0, magnitude_64(product), a.exponent + b.exponent);
}

Scaled divide(Scaled a, Scaled b) {
  DETENT_VERIFY_RANGE(b.mantissa != 0);
  const uint64_t numerator = uint64_t{magnitude_32(a.mantissa)} << 32;
  const uint64_t divisor = magnitude_32(b.mantissa);
  const uint64_t quotient = numerator / divisor;  // 0 or at least 2^31: its last bit may stand for the remainder
  const uint64_t sticky = quotient * divisor != numerator ? 1 : 0;
  return scaled_from_parts((a.mantissa < 0) != (b.mantissa < 0), (quotient << 1) | sticky,
                           a.exponent - b.exponent - 33);
}

Scaled add(Scaled a, Scaled b) {
  if (a.mantissa == 0) return b;
  if (b.mantissa == 0) return a;
  const Scaled large = a.exponent < b.exponent ? b : a;
  const Scaled small = a.exponent < b.exponent ? a : b;
  const int shift = large.exponent - small.exponent;
  if (shift > 33) return large;
  // 31 fraction bits and a last one that stands for what the smaller number lost beyond them.
  const int64_t head = int64_t{small.mantissa} * (int64_t{1} << 31);
  const int64_t shifted = head >> shift;
  const int64_t sticky = shifted * (int64_t{1} << shift) != head ? 1 : 0;
  const int64_t sum = int64_t{large.mantissa} * (int64_t{1} << 31) + (shifted | sticky);
  return scaled_from_parts(sum < 0, magnitude_64(sum), large.exponent - 31);
}

Scaled square_root(Scaled a) {
  DETENT_VERIFY_RANGE(a.mantissa >= 0);
  const int shift = (a.exponent & 1) != 0 ? 33 : 32;
  const uint64_t square = static_cast<uint64_t>(a.mantissa) << shift;
  const uint64_t root = square_root_floor(square);  // 0 or at least 2^31
  const uint64_t sticky = root * root != square ? 1 : 0;
  return scaled_from_parts(false, (root << 1) | sticky, (a.exponent - shift) / 2 - 1);
}

bool less(Scaled a, Scaled b) {
  const bool a_negative = a.mantissa < 0;
  const bool same_sign = a.mantissa != 0 && b.mantissa != 0 && a_negative == (b.mantissa < 0);
  if (same_sign && a.exponent != b.exponent) return (a.exponent < b.exponent) != a_negative;
  return a.mantissa < b.mantissa;
}

Scaled scaled_reciprocal(Real a) {
  DETENT_VERIFY_RANGE(a.raw > 0);
  const uint64_t raw = static_cast<uint64_t>(a.raw);
  const int length = bit_length_64(raw);
  const uint64_t head = length > 32 ? raw >> (length - 32) : raw << (32 - length);  // [2^31, 2^32)
  const uint64_t quotient = (uint64_t{1} << 62) / head;                             // (2^30, 2^31]
  constexpr int k_exponent = k_real_frac + 32 - 62;
  if (quotient >> 31 != 0) return Scaled::from_parts(1 << 30, k_exponent - length + 1);
  return Scaled::from_parts(static_cast<int32_t>(quotient), k_exponent - length);
}

#if !DETENT_NATIVE_WIDE
Real multiply(Real a, Scaled b) {
  DETENT_VERIFY_RANGE(b.mantissa == 0 || b.exponent < 0);
  const int n = -b.exponent;
  // a b = high 2^32 + low, as in PortableInt128::product_narrow; only the wanted word is formed.
  const int64_t low_product = static_cast<int64_t>(static_cast<uint32_t>(a.raw)) * b.mantissa;
  const int64_t high = (a.raw >> 32) * b.mantissa + (low_product >> 32);
  if (n > 32) return Real::from_raw(shift_64(high, 32 - n));
  if (n <= 0) return Real(0.0);  // only 0 has such an exponent here
  const int64_t low = low_product & 0xffffffff;
  return Real::from_raw(static_cast<int64_t>(static_cast<uint64_t>(high) << (32 - n)) + round_shift_64(low, n));
}
#endif

Real multiply(Real a, Scaled b, bool& saturated) {
  // The most that the product can be long; what is far from the limits is not looked at closer.
  const int most = bit_length_64(magnitude_64(a.raw)) + 31 + b.exponent;
  if (most <= 62 && b.exponent < 0 && b.exponent >= -120)
    return Real::from_raw(Int128::product_narrow(a.raw, b.mantissa).round_shift(-b.exponent));
  const Int128 product = Int128::product_narrow(a.raw, b.mantissa);
  const Words128 size = magnitude_128(product);
  const int length = bit_length_128(size);
  if (length == 0 || b.exponent < -127) return Real(0.0);
  const bool negative = product < Int128::from(0);
  if (length + b.exponent <= 63) {
    const int64_t raw =
        b.exponent >= 0 ? product.shift_left(b.exponent).low_signed() : product.round_shift(-b.exponent);
    if ((raw < 0) == negative || raw == 0) return Real::from_raw(raw);  // else it was rounded up to 2^63
  }
  saturated = true;
  return negative ? -k_real_max : k_real_max;
}

Real to_real(Scaled a, bool& saturated) { return multiply(Real(1.0), a, saturated); }

Unit to_unit(Scaled a) { return unit_from_raw(shift_64(a.mantissa, a.exponent + k_unit_frac)); }

}  // namespace DETENT_NAMESPACE
}  // namespace detent
#endif
