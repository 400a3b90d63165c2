#include "math/scaled.h"

#if DETENT_FIXED
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace words {
namespace {

constexpr Result words_of(int32_t mantissa, int32_t exponent) {
#if UINTPTR_MAX > 0xffffffff
  return Scaled::from_parts(mantissa, exponent);
#else
  return static_cast<uint32_t>(mantissa) | static_cast<uint64_t>(exponent) << 32;
#endif
}

}  // namespace

Result scaled_from_parts(bool negative, uint64_t mantissa, int exponent) {
  if (mantissa == 0) return words_of(0, 0);
  const int drop = bit_length_64(mantissa) - 31;
  // Ties away from zero; a carry to 2^31 is 2^30 with the next exponent.
  uint64_t rounded = drop <= 0 ? mantissa << -drop : ((mantissa >> (drop - 1)) + 1) >> 1;
  exponent += drop;
  if (rounded >> 31 != 0) {
    rounded >>= 1;
    ++exponent;
  }
  if (exponent < -k_scaled_exponent_max) return words_of(0, 0);
  if (exponent > k_scaled_exponent_max) {
    rounded = INT32_MAX;
    exponent = k_scaled_exponent_max;
  }
  const int32_t size = static_cast<int32_t>(rounded);
  return words_of(negative ? -size : size, exponent);
}

Result scaled_from(int64_t raw, int frac) { return scaled_from_parts(raw < 0, magnitude_64(raw), -frac); }

Result multiply(int32_t a, int32_t a_exponent, int32_t b, int32_t b_exponent) {
  const int64_t product = int64_t{a} * b;
  return scaled_from_parts(product < 0, magnitude_64(product), a_exponent + b_exponent);
}

Result divide(int32_t a, int32_t a_exponent, int32_t b, int32_t b_exponent) {
  DETENT_VERIFY_RANGE(b != 0);
  const uint64_t numerator = uint64_t{magnitude_32(a)} << 32;
  const uint64_t divisor = magnitude_32(b);
  const uint64_t quotient = numerator / divisor;  // 0 or at least 2^31: its last bit may stand for the remainder
  const uint64_t sticky = quotient * divisor != numerator ? 1 : 0;
  return scaled_from_parts((a < 0) != (b < 0), (quotient << 1) | sticky, a_exponent - b_exponent - 33);
}

Result add(int32_t a, int32_t a_exponent, int32_t b, int32_t b_exponent) {
  if (a == 0) return words_of(b, b_exponent);
  if (b == 0) return words_of(a, a_exponent);
  if (a_exponent < b_exponent) return add(b, b_exponent, a, a_exponent);
  const int shift = a_exponent - b_exponent;
  if (shift > 33) return words_of(a, a_exponent);
  // 31 fraction bits and a last one that stands for what the smaller number lost beyond them.
  const int64_t head = int64_t{b} * (int64_t{1} << 31);
  const int64_t shifted = head >> shift;
  const int64_t sticky = shifted * (int64_t{1} << shift) != head ? 1 : 0;
  const int64_t sum = int64_t{a} * (int64_t{1} << 31) + (shifted | sticky);
  return scaled_from_parts(sum < 0, magnitude_64(sum), a_exponent - 31);
}

bool less(int32_t a, int32_t a_exponent, int32_t b, int32_t b_exponent) {
  const bool a_negative = a < 0;
  const bool same_sign = a != 0 && b != 0 && a_negative == (b < 0);
  if (same_sign && a_exponent != b_exponent) return (a_exponent < b_exponent) != a_negative;
  return a < b;
}

Result scaled_by_power(int32_t a, int32_t exponent, int n) {
  return scaled_from_parts(a < 0, magnitude_32(a), exponent + n);
}

Result square_root(int32_t a, int32_t exponent) {
  DETENT_VERIFY_RANGE(a >= 0);
  const int shift = (exponent & 1) != 0 ? 33 : 32;
  const uint64_t square = static_cast<uint64_t>(a) << shift;
  const uint64_t root = square_root_floor(square);  // 0 or at least 2^31
  const uint64_t sticky = root * root != square ? 1 : 0;
  return scaled_from_parts(false, (root << 1) | sticky, (exponent - shift) / 2 - 1);
}

Result scaled_reciprocal(int64_t raw) {
  DETENT_VERIFY_RANGE(raw > 0);
  const uint64_t size = static_cast<uint64_t>(raw);
  const int length = bit_length_64(size);
  const uint64_t head = length > 32 ? size >> (length - 32) : size << (32 - length);  // [2^31, 2^32)
  const uint64_t quotient = (uint64_t{1} << 62) / head;                               // (2^30, 2^31]
  constexpr int k_exponent = k_real_frac + 32 - 62;
  if (quotient >> 31 != 0) return words_of(1 << 30, k_exponent - length + 1);
  return words_of(static_cast<int32_t>(quotient), k_exponent - length);
}

#if !DETENT_NATIVE_WIDE
int64_t multiply(int64_t raw, int32_t b, int32_t b_exponent) {
  DETENT_VERIFY_RANGE(b == 0 || b_exponent < 0);
  const int n = -b_exponent;
  // a b = high 2^32 + low, as in PortableInt128::product_narrow; only the wanted word is formed.
  const int64_t low_product = static_cast<int64_t>(static_cast<uint32_t>(raw)) * b;
  const int64_t high = (raw >> 32) * b + (low_product >> 32);
  if (n > 32) return shift_64(high, 32 - n);
  if (n <= 0) return 0;  // only 0 has such an exponent here
  const int64_t low = low_product & 0xffffffff;
  return static_cast<int64_t>(static_cast<uint64_t>(high) << (32 - n)) + round_shift_64(low, n);
}
#endif

int64_t multiply(int64_t raw, int32_t b, int32_t b_exponent, bool& saturated) {
  const Int128 product = Int128::product_narrow(raw, b);
  const Words128 size = magnitude_128(product);
  const int length = bit_length_128(size);
  if (length == 0 || b_exponent < -127) return 0;
  const bool negative = product < Int128::from(0);
  if (length + b_exponent <= 63) {
    const int64_t rounded =
        b_exponent >= 0 ? product.shift_left(b_exponent).low_signed() : product.round_shift(-b_exponent);
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
