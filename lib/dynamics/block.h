#pragma once
#include <detent/detail/scratch.h>

#include "math/arithmetic.h"

/// Block floating point for the rows of one contact. The numbers of a contact in a pass (speeds, or lengths) share one
/// power of two, chosen from the largest, so that a product is one of 32 by 32 bits. State stays in Real: a block's
/// answers are multiples of its ulp, added to both bodies exactly, so what a block rounds moves no momentum.
/// In float the same code works on plain numbers.
namespace detent {
inline namespace DETENT_NAMESPACE {

#if DETENT_FIXED

/// A number of a block: 2^shift steps of Real. Range: within +-2^33 unless a function says otherwise.
using Ulps = int64_t;
/// Within +-2^28.
struct Mantissas {
  int32_t x, y, z;
};
/// A sum of up to nine products of a mantissa and a Unit, 2^-30 ulps.
using UlpSum = int64_t;

inline constexpr int k_mantissa_bits = 28;
inline constexpr int k_number_bits = 31;
inline constexpr Ulps k_ulps_max = int64_t{1} << 32;
inline constexpr int k_shift_min = 8;  ///< steps finer than 2^-38 are no one's business

class Block {
 public:
  /// Makes room for `v` 2^exponent as mantissas.
  void include(const Vec3<Real>& v, int exponent) {
    const uint64_t all = magnitude_64(v.x.raw) | magnitude_64(v.y.raw) | magnitude_64(v.z.raw);
    if (all != 0) include_bits(bit_length_64(all) + exponent - k_mantissa_bits);
  }
  /// Makes room for a number.
  void include(Real value) { include_bits(bit_length_64(magnitude_64(value.raw)) - k_number_bits); }

  Mantissas mantissas(const Vec3<Real>& v, int exponent) const {
    const int n = shift_ - exponent;
    if (n > 0 && n < 64)
      return {static_cast<int32_t>(round_shift_64(v.x.raw, n)), static_cast<int32_t>(round_shift_64(v.y.raw, n)),
              static_cast<int32_t>(round_shift_64(v.z.raw, n))};
    return {static_cast<int32_t>(shift_64(v.x.raw, -n)), static_cast<int32_t>(shift_64(v.y.raw, -n)),
            static_cast<int32_t>(shift_64(v.z.raw, -n))};
  }
  /// Held to +-2^31.
  Ulps held(Real value) const {
    const int64_t ulps = value.raw >> shift_;
    constexpr int64_t k_limit = int64_t{1} << k_number_bits;
    return ulps < -k_limit ? -k_limit : ulps > k_limit ? k_limit : ulps;
  }
  /// Rounded down.
  Ulps number(Real value) const { return value.raw >> shift_; }
  Real real(Ulps ulps) const { return Real::from_raw(static_cast<int64_t>(static_cast<uint64_t>(ulps) << shift_)); }
  Real real_from_sum(UlpSum sum) const { return Real::from_raw(shift_64(sum, shift_ - k_unit_frac)); }
  /// The least power of two that makes all `parts` fit a product, so many of them: they are rounded to it.
  void coarsen(Ulps (&parts)[k_manifold_points_max]) {
    uint64_t all = 0;
    for (const Ulps part : parts) all |= magnitude_64(part);
    const int n = bit_length_64(all) - (k_number_bits - 2);
    if (n <= 0) return;
    for (Ulps& part : parts) part = round_shift_64(part, n);
    shift_ += n;
  }

 private:
  void include_bits(int shift) { shift_ = shift > shift_ ? shift : shift_; }
  int shift_ = k_shift_min;
};

inline Ulps times(Ulps a, Unit b) { return round_shift_64(a * b.raw, k_unit_frac); }
/// a b 2^exponent. Range: exponent < 30.
inline Ulps times_scaled(Ulps a, Unit b, int exponent) { return round_shift_64(a * b.raw, k_unit_frac - exponent); }
/// Held to +-2^32, so that it can be a factor.
inline Ulps held(Ulps a) { return a < -k_ulps_max ? -k_ulps_max : a > k_ulps_max ? k_ulps_max : a; }
inline UlpSum product(Ulps a, Unit b) { return a * b.raw; }
inline UlpSum dot(const Mantissas& a, const Vec3<Unit>& b) {
  return int64_t{a.x} * b.x.raw + int64_t{a.y} * b.y.raw + int64_t{a.z} * b.z.raw;
}
inline Ulps rounded(UlpSum sum) { return round_shift_64(sum, k_unit_frac); }
inline constexpr Ulps k_no_ulps = 0;

#else

using Ulps = Real;
using Mantissas = Vec3<Real>;
using UlpSum = Real;

class Block {
 public:
  void include(const Vec3<Real>&, int) {}
  void include(Real) {}
  Mantissas mantissas(const Vec3<Real>& v, int) const { return v; }
  Ulps held(Real value) const { return value; }
  Ulps number(Real value) const { return value; }
  Real real(Ulps ulps) const { return ulps; }
  Real real_from_sum(UlpSum sum) const { return sum; }
  void coarsen(Ulps (&)[k_manifold_points_max]) {}
};

inline Ulps times(Ulps a, Unit b) { return a * b; }
inline Ulps times_scaled(Ulps a, Unit b, int) { return a * b; }
inline Ulps held(Ulps a) { return a; }
inline UlpSum product(Ulps a, Unit b) { return a * b; }
inline Ulps rounded(UlpSum sum) { return sum; }
inline constexpr Ulps k_no_ulps = 0;

#endif

}  // namespace DETENT_NAMESPACE
}  // namespace detent
