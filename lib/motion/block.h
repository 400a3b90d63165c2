#pragma once
#include <detent/detail/scratch.h>
#include <detent/detail/shared.h>

#include "math/arithmetic.h"
#include "math/root.h"
#include "math/scaled.h"

/// Block floating point for one contact. When a pass of the solver processes a contact, the contact's speeds and
/// impulses, or its lengths, are integer multiples of one power of two, the *block*. The largest of these numbers
/// determines the block. The numbers have so few bits that a sum of products has at most 53 bits. A double holds such a
/// sum exactly, and lanes compute with doubles (lib/solver/lanes.h). The stored state stays in Real. An impulse is
/// rounded to the block once, and then acts on both bodies; therefore the rounding conserves linear momentum. In the
/// float configurations the same code uses plain floating-point numbers.
namespace detent {
inline namespace DETENT_NAMESPACE {

#if DETENT_FIXED

/// A number of a block. Its unit is the block's power of two: 2^shift_ ulps of Real (Block::shift_).
using Ulps = int64_t;
/// A number of a block that can be multiplied: within +-k_factor_max, unless a comment gives another range.
using Factor = int32_t;
/// A sum of products of factors and Units, in 2^-30 of the block's unit.
using UlpSum = int64_t;
struct Mantissas {
  Factor x, y, z;
};

inline constexpr int64_t k_factor_max = int64_t{1} << 26;
/// Limit of the elements of L D in the factor L D L^T of a contact's rows.
inline constexpr int64_t k_row_max = int64_t{1} << 24;
inline constexpr int k_mantissa_bits = 24;  ///< bits of a mantissa of a velocity or displacement
inline constexpr int k_number_bits = 24;    ///< bits of an impulse; a sum of four impulses is still within k_factor_max
inline constexpr int k_wrench_bits = 25;    ///< bits of each component of a wrench
/// The least shift of a block: the finest step of a block is 2^-37 m/s or m. Must exceed k_angular_velocity_power.
inline constexpr int k_shift_min = 9;
/// The solver stores angular velocities times 2^-k_angular_velocity_power, because the angular velocity of a slender
/// body exceeds the range of Real long before its angular momentum does.
inline constexpr int k_angular_velocity_power = 8;

// The magnitudes of the values for a block are collected in units of 2^k_angular_velocity_power ulps of Real. The
// dropped bits are below the finest step of a block.
inline constexpr int k_bits_power = k_angular_velocity_power - k_mantissa_bits;
inline constexpr int k_number_drop = k_number_bits + k_bits_power;
static_assert(k_angular_velocity_power <= k_shift_min - k_bits_power && k_number_drop <= k_shift_min - k_bits_power);

/// Clamps `a` to +-k_factor_max, the range of a factor.
DETENT_SHARED inline Factor held(Ulps a) {
  return static_cast<Factor>(a < -k_factor_max ? -k_factor_max : a > k_factor_max ? k_factor_max : a);
}

class Block {
 public:
  /// Makes settle() choose a block in which the components of `v` 2^exponent have at most k_mantissa_bits bits. Range:
  /// exponent from 0 to k_angular_velocity_power.
  DETENT_SHARED void include(const Vec3<Real>& v, int exponent) {
    bits_ |= (magnitude_64(v.x.raw) | magnitude_64(v.y.raw) | magnitude_64(v.z.raw)) >>
             (k_angular_velocity_power - exponent);
  }
  /// Makes settle() choose a block in which each of the first `used` values has at most k_number_bits bits.
  DETENT_SHARED void include(const Real* values, uint32_t used) {
    uint64_t all = 0;
    for (uint32_t i = 0; i < used; ++i) all |= magnitude_64(values[i].raw);
    bits_ |= all >> k_number_drop;
  }
  /// Makes settle() choose a block in which a speed has at most k_number_bits bits. This speed is `speed` 2^exponent or
  /// `most`, whichever is less. `speed` is a number of the block `from`. Range: `speed` and `most` are >= 0.
  void include_speed(Factor speed, const Block& from, int exponent, Real most) {
    if (speed == 0) return;
    const int bits = bit_length_64(static_cast<uint64_t>(speed)) + from.shift_ + exponent;
    const int bits_max = bit_length_64(static_cast<uint64_t>(most.raw));
    const int least = (bits < bits_max ? bits : bits_max) - k_number_bits;
    if (least > shift_) shift_ = least;
  }
  /// Chooses the block's power of two: the least one with which all included values fit.
  void settle() {
    const int least = bit_length_64(bits_) + k_bits_power;
    if (least > shift_) shift_ = least;
  }

  DETENT_SHARED Mantissas mantissas(const Vec3<Real>& v, int exponent) const {
    const int n = shift_ - exponent;
    if (n > 0 && n < 64)
      return {static_cast<int32_t>(round_shift_64(v.x.raw, n)), static_cast<int32_t>(round_shift_64(v.y.raw, n)),
              static_cast<int32_t>(round_shift_64(v.z.raw, n))};
    return {static_cast<int32_t>(shift_64(v.x.raw, -n)), static_cast<int32_t>(shift_64(v.y.raw, -n)),
            static_cast<int32_t>(shift_64(v.z.raw, -n))};
  }
  /// The value times 2^exponent as a number of the block, rounded down and clamped to the range of a factor. Range:
  /// -15 <= exponent <= 0.
  DETENT_SHARED Factor held(Real value, int exponent = 0) const {
    return detent::held(floor_shift_64(value.raw, shift_ - exponent));
  }
  /// The value as a number of the block, rounded down.
  DETENT_SHARED Ulps number(Real value) const { return floor_shift_64(value.raw, shift_); }
  Real real(Ulps ulps) const { return Real::from_raw(static_cast<int64_t>(static_cast<uint64_t>(ulps) << shift_)); }
  /// Converts a number of block `from`, times 2^exponent, to a number of this block, clamped to the range of a factor.
  DETENT_SHARED Factor converted(Factor ulps, const Block& from, int exponent) const {
    const int n = from.shift_ + exponent - shift_;
    if (n < 0) return detent::held(round_shift_64(ulps, n < -63 ? 63 : -n));
    return detent::held(int64_t{ulps} << (n < 31 ? n : 31));
  }
  /// v times share times 2^exponent, converted from the block to Real.
  DETENT_SHARED Vec3<Real> real(const Mantissas& v, Scaled share, int exponent) const {
    const int64_t x = int64_t{v.x} * share.mantissa, y = int64_t{v.y} * share.mantissa,
                  z = int64_t{v.z} * share.mantissa;
    const int n = -(shift_ + share.exponent + exponent);
    if (n > 0 && n < 64)
      return {Real::from_raw(round_shift_64(x, n)), Real::from_raw(round_shift_64(y, n)),
              Real::from_raw(round_shift_64(z, n))};
    return {Real::from_raw(shift_64(x, -n)), Real::from_raw(shift_64(y, -n)), Real::from_raw(shift_64(z, -n))};
  }
  /// Increases the block's power of two until all `parts`, the components of a wrench, have at most k_wrench_bits bits,
  /// and rounds the parts to multiples of it.
  template <unsigned count>
  void coarsen(Ulps (&parts)[count]) {
    uint64_t all = 0;
    for (const Ulps part : parts) all |= magnitude_64(part);
    const int n = bit_length_64(all) - k_wrench_bits;
    if (n <= 0) return;
    for (Ulps& part : parts) part = round_shift_64(part, n);
    shift_ += n;
  }

 private:
  uint64_t bits_ = 0;  ///< the bits of the magnitudes of all included values, combined by `or`
  int shift_ = k_shift_min;
};

/// The number of fraction bits of the Units that are multiplied by factors: these Units are rounded to 2^-24.
inline constexpr int k_fine_frac = 24;
/// Rounds to a multiple of 2^-24. Range: |value| <= 1.
inline Unit fine(Unit value) {
  constexpr int32_t k_step = 1 << (k_unit_frac - k_fine_frac);
  return Unit::from_raw((value.raw + k_step / 2) & -k_step);
}
/// Rounds the components of an arm to multiples of 2^-23, so that they have at most 24 bits. Range: |arm| < 2 - 2^-23.
inline Vec3<Unit> fine_arm(const Vec3<Unit>& arm) {
  constexpr int32_t k_step = 2 << (k_unit_frac - k_fine_frac);
  const auto part = [](Unit value) {
    constexpr int32_t k_most = INT32_MAX - k_step;
    return Unit::from_raw(((value.raw < k_most ? value.raw : k_most) + k_step / 2) & -k_step);
  };
  return {part(arm.x), part(arm.y), part(arm.z)};
}
inline Vec3<Unit> fine(const Vec3<Unit>& v) { return {fine(v.x), fine(v.y), fine(v.z)}; }
/// Rounds the mantissa to 24 bits.
inline Scaled fine(Scaled value) {
  if (value.mantissa == 0) return value;
  constexpr int64_t k_step = 128;
  const int64_t mantissa = (int64_t{value.mantissa} + k_step / 2) & -k_step;
  if (mantissa == int64_t{1} << 31) return Scaled::from_parts(1 << 30, value.exponent + 1);
  return Scaled::from_parts(static_cast<int32_t>(mantissa), value.exponent);
}

inline UlpSum product(Factor a, Unit b) { return int64_t{a} * b.raw; }
inline UlpSum whole(Factor a) { return int64_t{a} << k_unit_frac; }
/// Whether a double holds the sum exactly, as lanes need it.
inline bool fits_double(int64_t sum) {
  return sum == 0 || bit_length_64(magnitude_64(sum)) - __builtin_ctzll(static_cast<uint64_t>(sum)) <= 53;
}
/// The sum times 2^-n, rounded to nearest, ties up. Range: fits_double(); 1 <= n <= 63.
DETENT_SHARED inline Ulps rounded_shift(int64_t sum, int n) {
  DETENT_VERIFY_RANGE(fits_double(sum));
  return round_shift_64(sum, n);
}
DETENT_SHARED inline Ulps rounded(UlpSum sum) { return rounded_shift(sum, k_unit_frac); }
DETENT_SHARED inline Ulps times(Factor a, Unit b) { return rounded(product(a, b)); }
/// a times b times 2^exponent. Range: exponent < 30.
inline Ulps times_scaled(Factor a, Unit b, int exponent) {
  return rounded_shift(product(a, b), k_unit_frac - exponent);
}
/// sum_from() converts a number to a sum of products; rounded() converts such a sum back to a number. The Units in the
/// products are mantissas of values with the exponent `exponent`. Range: exponent < 30.
inline UlpSum sum_from(Ulps a, int exponent) {
  return static_cast<int64_t>(static_cast<uint64_t>(a) << (k_unit_frac - exponent));
}
inline Ulps rounded(UlpSum sum, int exponent) { return rounded_shift(sum, k_unit_frac - exponent); }
/// a times b. Range: b >= 0.
DETENT_SHARED inline Factor times(Factor a, Scaled b) {
  if (b.exponent >= 0) return b.mantissa == 0 ? 0 : held(shift_64(a, 32));
  return b.exponent < -63 ? 0 : held(round_shift_64(int64_t{a} * b.mantissa, -b.exponent));
}
DETENT_SHARED inline UlpSum dot(const Mantissas& a, const Vec3<Unit>& b) {
  return product(a.x, b.x) + product(a.y, b.y) + product(a.z, b.z);
}
DETENT_SHARED inline Mantissas rounded(UlpSum x, UlpSum y, UlpSum z) {
  return {static_cast<Factor>(rounded(x)), static_cast<Factor>(rounded(y)), static_cast<Factor>(rounded(z))};
}
inline constexpr Ulps k_no_ulps = 0;

/// Scales v down to the length `limit` if v is longer. Range: limit >= 0.
DETENT_SHARED inline void clamp_to_circle(Factor (&v)[2], Factor limit) {
  const uint64_t x = magnitude_32(v[0]), y = magnitude_32(v[1]), radius = static_cast<uint32_t>(limit);
  if (x + y <= radius) return;
  const uint64_t square = x * x + y * y;
  if (square <= radius * radius) return;
  const uint64_t size = uint64_t{square_root_floor(square)} + 1;
  const Unit factor =
      Unit::from_raw(static_cast<int32_t>((radius << k_fine_frac) / size) << (k_unit_frac - k_fine_frac));
  v[0] = static_cast<Factor>(times(v[0], factor));
  v[1] = static_cast<Factor>(times(v[1], factor));
}

#else

using Ulps = Real;
using Factor = Real;
using UlpSum = Real;
using Mantissas = Vec3<Real>;

inline constexpr int k_angular_velocity_power = 0;

class Block {
 public:
  void include(const Vec3<Real>&, int) {}
  void include(const Real*, uint32_t) {}
  void include_speed(Factor, const Block&, int, Real) {}
  void settle() {}
  Mantissas mantissas(const Vec3<Real>& v, int) const { return v; }
  Factor held(Real value, int exponent = 0) const { return scale_by_power(value, exponent); }
  Ulps number(Real value) const { return value; }
  Real real(Ulps ulps) const { return ulps; }
  Vec3<Real> real(const Mantissas& v, Scaled share, int) const { return {v.x * share, v.y * share, v.z * share}; }
  Factor converted(Factor value, const Block&, int exponent) const { return scale_by_power(value, exponent); }
  template <unsigned count>
  void coarsen(Ulps (&)[count]) {}
};

inline Unit fine(Unit value) { return value; }
inline Vec3<Unit> fine(const Vec3<Unit>& v) { return v; }
inline Vec3<Unit> fine_arm(const Vec3<Unit>& v) { return v; }

inline Factor held(Ulps a) { return a; }
inline UlpSum product(Ulps a, Unit b) { return a * b; }
inline UlpSum whole(Factor a) { return a; }
inline Ulps rounded(UlpSum sum) { return sum; }
inline Ulps times(Ulps a, Unit b) { return a * b; }
inline Ulps times_scaled(Ulps a, Unit b, int) { return a * b; }
inline UlpSum sum_from(Ulps a, int) { return a; }
inline Ulps rounded(UlpSum sum, int) { return sum; }
inline Mantissas rounded(UlpSum x, UlpSum y, UlpSum z) { return {x, y, z}; }
inline constexpr Ulps k_no_ulps = 0;

inline void clamp_to_circle(Factor (&v)[2], Factor limit) {
  if (abs(v[0]) + abs(v[1]) <= limit) return;
  const Real square = v[0] * v[0] + v[1] * v[1];
  if (square <= limit * limit) return;
  const Real factor = limit / square_root(square);
  v[0] = v[0] * factor;
  v[1] = v[1] * factor;
}

#endif

inline bool any(bool mask) { return mask; }
template <class T>
T select(bool mask, T a, T b) {
  return mask ? a : b;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
