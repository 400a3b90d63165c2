#pragma once
#include "math/vector_integer.h"

/// Finds the times at which corners of moving features may be coplanar with the origin: roots of cubics. All rounding
/// is outwards.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The part of an interval that may hold a root or a contact, Q30; empty if from > to.
struct OpenPart {
  int64_t from, to;
};
inline constexpr int64_t k_whole = int64_t{1} << 30;
inline constexpr OpenPart k_open = {0, k_whole}, k_closed = {1, 0};

/// How corners are rounded to 29 bits and a sign, and a bound on their error. Products of two such components fit 64
/// bits, products of three fit 128 bits (tests/guards/proofs/feature.g).
struct Shortening {
  int shift;             ///< the number of bits dropped; rounding is to nearest
  int64_t distance_max;  ///< bound on every component after the shift
  int64_t ball;          ///< error radius after the shift, rounding included; at most distance_max + 1

  /// `magnitudes`: the bitwise or of all component magnitudes. `ball_before`: the error radius before the shift.
  Shortening(uint64_t magnitudes, int64_t ball_before) {
    constexpr int k_bits = 29;
    const int length = bit_length_64(magnitudes | static_cast<uint64_t>(ball_before));
    shift = length > k_bits ? length - k_bits : 0;
    distance_max = int64_t{1} << (length - shift);
    // Rounding to nearest adds half a unit; the sum is rounded up once.
    const int64_t unit = int64_t{1} << shift;
    ball = (ball_before + (unit >> 1) + unit - 1) >> shift;
  }
  /// Whether the error radius is so large that products carry no information and their error bounds would overflow.
  bool is_blind() const { return 8 * ball > distance_max; }

  /// Bound on every component of (a + d) x (b + e) - a x b, the error of the cross product of two corners a and b. d
  /// and e are the errors of the corners, at most `ball`.
  int64_t moment_error() const { return 2 * ball * (2 * distance_max + ball); }
  /// The error bound of the volume p . (q x r) of three corners p, q, r whose errors are d, e, f. It bounds |d.(q x
  /// r)|, |(d x e).r|, their permutations, and |(d x e).f|. `moments` is the sum of the component magnitudes of the
  /// three cross products, below 2^62. A flat triangle has small cross products, so the bound depends on its area and
  /// not on its length.
  Int128 volume_error(int64_t moments) const {
    return Int128::product_narrow(moments + 18 * ball * distance_max + 6 * ball * ball, static_cast<int32_t>(ball));
  }
};

constexpr uint64_t magnitude_bits(const Vec64& v) { return magnitude_64(v.x) | magnitude_64(v.y) | magnitude_64(v.z); }
constexpr int64_t magnitude_sum(const Vec64& v) {
  return static_cast<int64_t>(magnitude_64(v.x) + magnitude_64(v.y) + magnitude_64(v.z));
}

/// A cubic over an interval in Bernstein form. Range: coefficients below 2^120 in magnitude.
struct Cubic {
  Int128 coefficient[4];
  Int128 error;
};
/// The part of the interval in which the convex hull of the coefficients, widened by the error, contains 0 (Bezier
/// clipping).
OpenPart roots_of(const Cubic& cubic);

/// The part of an interval in which the volume of three corners may be 0. The volume times `weight` is a cubic in time.
/// The corners and weights are given at the beginning of the interval, after one and two thirds of it, and at its end.
/// Components are below 2^63 in magnitude, with an error of at most `ball`. Weights, Q28, are from 1 to 32, with an
/// error below 2 units in the last place.
OpenPart reduced_roots(const Vec64 (&corner)[4][3], const int64_t (&weight)[4], int64_t ball);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
