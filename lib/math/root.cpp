#include "math/root.h"

#if !DETENT_FIXED
#include "math/float_bits.h"
#endif

namespace detent {
inline namespace DETENT_NAMESPACE {

namespace {

/// Returns the floor of the root of `value` >= 2^62. Sets `remainder` to value - root^2.
uint32_t root_of_normal(uint64_t value, uint64_t& remainder) {
  const uint32_t head = static_cast<uint32_t>(value >> 32);
  const uint32_t inverse = reciprocal_root(head);
  const uint64_t estimate = (uint64_t{head} * inverse) >> 31;
  uint32_t root = estimate >> 32 != 0 ? UINT32_MAX : static_cast<uint32_t>(estimate);
  // The estimate is off by a few units. `rest` = value - root^2, which fits in 37 bits, tells exactly by how many.
  int64_t rest = static_cast<int64_t>(value - uint64_t{root} * root);
  while (rest < 0) rest += 2 * int64_t{--root} + 1;
  while (rest > 2 * int64_t{root}) rest -= 2 * int64_t{root++} + 1;
  remainder = static_cast<uint64_t>(rest);
  return root;
}

}  // namespace

uint32_t reciprocal_root(uint32_t value) {
  DETENT_VERIFY_RANGE(value >= uint32_t{1} << 30);
  const uint32_t cubic = reciprocal_root_guess(value);
  // A third-order step y (1 + e/2 + 3 e^2/8) with e = 1 - value y^2: relative error below 2^-19.
  const uint32_t first = cubic * 2;  // Q2.30, at most 2.02
  const int32_t error =
      static_cast<int32_t>((uint64_t{1} << 30) - ((uint64_t{high_product(value, first)} * first) >> 30));
  const int32_t step = error + static_cast<int32_t>((int64_t{error} * error * 3) >> 32);  // (e + 3 e^2/4), Q30
  const uint32_t second = static_cast<uint32_t>(int64_t{first} * 2 + ((int64_t{first} * step) >> 30));  // Q1.31
  // A Newton step with the residual exact to 2^-62. The error of the result is the rounding of this step.
  const uint64_t root = uint64_t{value} * second;                                       // Q63
  const uint64_t one = (root >> 32) * second + (((root & 0xffffffff) * second) >> 32);  // Q62
  const int64_t residual = static_cast<int64_t>((uint64_t{1} << 62) - one) >> 20;       // Q42
  const int64_t third = int64_t{second} + round_shift_64(int64_t{second} * residual, 43);
  return third > int64_t{UINT32_MAX} ? UINT32_MAX : static_cast<uint32_t>(third);
}

uint32_t square_root_floor(uint64_t value) {
  if (value == 0) return 0;
  const int half_shift = (64 - bit_length_64(value)) / 2;
  uint64_t remainder = 0;
  return root_of_normal(value << (2 * half_shift), remainder) >> half_shift;
}

uint32_t square_root_nearest(uint64_t value) {
  const uint32_t root = square_root_floor(value);
  const bool up = value - uint64_t{root} * root > root;  // (root + 1/2)^2 = root^2 + root + 1/4
  return up && root != UINT32_MAX ? root + 1 : root;
}

uint64_t square_root_nearest(Words128 value) {
  if (value.high == 0) {
    const uint32_t root = square_root_floor(value.low);
    return uint64_t{root} + (value.low - uint64_t{root} * root > root ? 1 : 0);
  }
  const int half_shift = (64 - bit_length_64(value.high)) / 2;
  const int shift = 2 * half_shift;
  const uint64_t high = shift == 0 ? value.high : (value.high << shift) | (value.low >> (64 - shift));
  const uint64_t low = value.low << shift;
  // Let v = high 2^64 + low: the value, shifted left so that high >= 2^62. Let s = floor(sqrt(high)) and
  // r = high - s^2. The integer part of the root of v is s 2^32 + floor((r 2^32 + upper half of low) / (2 s)), or one
  // less.
  uint64_t rest = 0;
  const uint64_t head = root_of_normal(high, rest);
  const uint64_t numerator_high = rest >> 32;  // rest <= 2 head < 2^33: 0 or 1
  const uint64_t numerator = (rest << 32) | (low >> 32);
  // The numerator has up to 65 bits, so numerator and divisor are halved. digit_rest, the remainder, is computed from
  // the whole numerator, so it includes the bit that the halved numerator loses.
  uint64_t digit = ((numerator_high << 63) | (numerator >> 1)) / head;
  uint64_t digit_rest = numerator - digit * (2 * head);
  if (digit >> 32 != 0) {
    digit = UINT32_MAX;
    digit_rest = numerator - digit * (2 * head);
  }
  uint64_t root = (head << 32) + digit;
  // v - root^2 = digit_rest 2^32 + low digit - digit^2, as a signed number of up to 98 bits.
  const uint64_t square = digit * digit;
  const uint64_t tail = (digit_rest << 32) | (low & 0xffffffff);
  int64_t remainder_high = static_cast<int64_t>(digit_rest >> 32) - (tail < square ? 1 : 0);
  uint64_t remainder_low = tail - square;
  if (remainder_high < 0) {
    // remainder += 2 root - 1
    --root;
    const uint64_t add = root * 2 + 1;
    remainder_high += static_cast<int64_t>(root >> 63) + (remainder_low + add < add ? 1 : 0);
    remainder_low += add;
  }
  if (half_shift == 0) {
    const bool up = remainder_high > 0 || remainder_low > root;
    return up && root != UINT64_MAX ? root + 1 : root;
  }
  // The root of the unshifted value is rounded. There are no ties, because (m + 1/2)^2 is not an integer for any
  // integer m. So the highest bit that the shift drops decides whether the root is rounded up.
  return (root >> half_shift) + ((root >> (half_shift - 1)) & 1);
}

Vec3<int32_t> unit_vector_raw(const Vec3<int32_t>& v) {
  const uint64_t square = static_cast<uint64_t>(int64_t{v.x} * v.x) + static_cast<uint64_t>(int64_t{v.y} * v.y) +
                          static_cast<uint64_t>(int64_t{v.z} * v.z);
  const int half_shift = (64 - bit_length_64(square)) / 2;
  const uint64_t head = (((square << (2 * half_shift)) >> 31) + 1) >> 1;
  const int64_t inverse = reciprocal_root(static_cast<uint32_t>(head >> 32 != 0 ? UINT32_MAX : head));
  const int shift = 33 - half_shift;
  const auto component = [inverse, shift](int32_t a) {
    return static_cast<int32_t>(round_shift_64(a * inverse, shift));
  };
  return {component(v.x), component(v.y), component(v.z)};
}

#if DETENT_FIXED
namespace {

Vec3<Unit> direction(int32_t x, int32_t y, int32_t z) {
  const Vec3<int32_t> n = unit_vector_raw({x, y, z});
  return {Unit::from_raw(n.x), Unit::from_raw(n.y), Unit::from_raw(n.z)};
}

constexpr uint64_t square_of(Unit a) { return static_cast<uint64_t>(int64_t{a.raw} * a.raw); }

}  // namespace

Unit square_root(Unit a) {
  DETENT_VERIFY_RANGE(a.raw >= 0);
  return unit_from_raw(square_root_nearest(static_cast<uint64_t>(a.raw) << k_unit_frac));
}

int64_t raw::square_root(int64_t a) {
  DETENT_VERIFY_RANGE(a >= 0);
  const uint64_t size = static_cast<uint64_t>(a);
  return static_cast<int64_t>(square_root_nearest(Words128{size >> (64 - k_real_frac), size << k_real_frac}));
}

Unit length(const Vec3<Unit>& v) {
  return unit_from_raw(square_root_nearest(square_of(v.x) + square_of(v.y) + square_of(v.z)));
}

int64_t raw::length(const Vec3<Real>& v) {
  const Int128 square =
      Int128::product(v.x.raw, v.x.raw) + Int128::product(v.y.raw, v.y.raw) + Int128::product(v.z.raw, v.z.raw);
  const uint64_t root = square_root_nearest(Words128{static_cast<uint64_t>(square.high_word()), square.low_word()});
  return root > static_cast<uint64_t>(INT64_MAX) ? INT64_MAX : static_cast<int64_t>(root);
}

bool normalise(const Vec3<Unit>& v, Vec3<Unit>& n, Unit& length_of_v) {
  const uint32_t all = magnitude_32(v.x.raw) | magnitude_32(v.y.raw) | magnitude_32(v.z.raw);
  if (all == 0) return false;
  length_of_v = length(v);
  const int shift = 30 - bit_length_32(all);
  n = direction(static_cast<int32_t>(shift_64(v.x.raw, shift)), static_cast<int32_t>(shift_64(v.y.raw, shift)),
                static_cast<int32_t>(shift_64(v.z.raw, shift)));
  return true;
}

bool normalise(const Vec3<Real>& v, Vec3<Unit>& n, Real& length_of_v) {
  const uint64_t all = magnitude_64(v.x.raw) | magnitude_64(v.y.raw) | magnitude_64(v.z.raw);
  if (all == 0) return false;
  length_of_v = length(v);
  const int shift = 30 - bit_length_64(all);
  n = direction(static_cast<int32_t>(shift_64(v.x.raw, shift)), static_cast<int32_t>(shift_64(v.y.raw, shift)),
                static_cast<int32_t>(shift_64(v.z.raw, shift)));
  return true;
}
#else
namespace {

/// As float_parts(), but reads subnormals exactly, not as 0.
template <class Float>
FloatParts float_parts_with_subnormals(Float value) {
  using Format = FloatFormat<Float>;
  FloatParts parts = float_parts(value);
  const uint64_t bits = __builtin_bit_cast(typename Format::Bits, value);
  const uint64_t fraction = bits & ((uint64_t{1} << Format::k_fraction_bits) - 1);
  if (parts.mantissa != 0 || fraction == 0) return parts;
  const int shift = Format::k_fraction_bits + 1 - bit_length_64(fraction);
  parts.mantissa = fraction << shift;
  parts.exponent = 1 - Format::k_bias - Format::k_fraction_bits - shift;
  return parts;
}

}  // namespace

float square_root_portable(float a) {
  const FloatParts parts = float_parts_with_subnormals(a);
  if (parts.mantissa == 0) return a;
  // mantissa 2^shift is in [2^62, 2^64), and the exponent that remains is even. So the root has 32 bits. A nonzero
  // remainder sets a sticky bit below them.
  const int shift = ((parts.exponent & 1) != 0) ? 39 : 40;
  uint64_t remainder = 0;
  const uint64_t root = root_of_normal(parts.mantissa << shift, remainder);
  return float_from_parts<float>((root << 31) | (remainder != 0 ? 1 : 0), (parts.exponent - shift) / 2 - 31, false);
}

double square_root_portable(double a) {
  const FloatParts parts = float_parts_with_subnormals(a);
  if (parts.mantissa == 0) return a;
  const int odd = parts.exponent & 1;
  const uint64_t value = parts.mantissa << odd;  // [2^52, 2^54) with an even exponent
  // Computes the root of value 2^56 bit by bit: `root` receives its 55 bits, and `rest` stays below 2 root + 1.
  uint64_t root = 0;
  uint64_t rest = 0;
  for (int pair = 54; pair >= 0; --pair) {
    const uint64_t next = pair >= 28 ? (value >> (2 * (pair - 28))) & 3 : 0;
    rest = (rest << 2) | next;
    const uint64_t trial = (root << 2) | 1;
    root <<= 1;
    if (rest >= trial) {
      rest -= trial;
      root |= 1;
    }
  }
  return float_from_parts<double>((root << 8) | (rest != 0 ? 1 : 0), (parts.exponent - odd - 56) / 2 - 8, false);
}

bool normalise(const Vec3<Real>& v, Vec3<Unit>& n, Real& length_of_v) {
  const Real root = length(v);
  if (root == 0) return false;
  length_of_v = root;
  n = {v.x / root, v.y / root, v.z / root};
  return true;
}
#endif

}  // namespace DETENT_NAMESPACE
}  // namespace detent
