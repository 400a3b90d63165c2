#pragma once
#include "math/vector_integer.h"

/// Where corners of moving features may lie in one plane with the origin: roots of cubics, with all rounding outwards.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The part of an interval in which something may be, Q30; nowhere if from > to.
struct OpenPart {
  int64_t from, to;
};
inline constexpr int64_t k_whole = int64_t{1} << 30;
inline constexpr OpenPart k_open = {0, k_whole}, k_closed = {1, 0};

/// What is lost where corners are brought to 29 bits and a sign, so that products of two fit 64 bits and of three 128
/// (tests/proofs/feature.g).
struct Shortening {
  int shift;      ///< as many bits, to nearest
  int64_t reach;  ///< no component is larger then
  int64_t ball;   ///< with what rounding took; at most the reach and 1

  /// Of components with the bits `magnitudes`, within a ball.
  Shortening(uint64_t magnitudes, int64_t ball_before) {
    constexpr int k_bits = 29;
    const int length = bit_length_64(magnitudes | static_cast<uint64_t>(ball_before));
    shift = length > k_bits ? length - k_bits : 0;
    reach = int64_t{1} << (length - shift);
    // Rounding takes a half: the whole is rounded up once.
    const int64_t unit = int64_t{1} << shift;
    ball = (ball_before + (unit >> 1) + unit - 1) >> shift;
  }
  /// Such a ball hides all products, and their errors would overflow.
  bool is_blind() const { return 8 * ball > reach; }

  /// The most by which |(a + d) x (b + e) - a x b| differs in a component, d and e within the ball.
  int64_t moment_error() const { return 2 * ball * (2 * reach + ball); }
  /// The same of the volume of three corners p, q, r, off by d, e, f: |d.(q x r)|, |(d x e).r| and their like, and
  /// |(d x e).f|. `moments` is the sum of the components' magnitudes of the three cross products, below 2^62: a flat
  /// triangle has small ones, so what counts is its area, not its length.
  Int128 volume_error(int64_t moments) const {
    return Int128::product_narrow(moments + 18 * ball * reach + 6 * ball * ball, static_cast<int32_t>(ball));
  }
};

constexpr uint64_t magnitude_bits(const Vec64& v) { return magnitude_64(v.x) | magnitude_64(v.y) | magnitude_64(v.z); }
constexpr int64_t magnitude_sum(const Vec64& v) {
  return static_cast<int64_t>(magnitude_64(v.x) + magnitude_64(v.y) + magnitude_64(v.z));
}

/// A cubic over an interval in Bernstein form. Range: below 2^120 in magnitude.
struct Cubic {
  Int128 coefficient[4];
  Int128 error;
};
/// Where the hull of the coefficients, give or take the error, holds 0 (Bezier clipping).
OpenPart roots_of(const Cubic& cubic);

/// Three corners at the beginning of an interval, after one and two thirds of it, and at its end, where their volume
/// times `weight` is a cubic in time: the roots of that. Components below 2^63 and within `ball`; weights, Q28, from 1
/// to 32, within 2 of their last place.
OpenPart reduced_roots(const Vec64 (&corner)[4][3], const int64_t (&weight)[4], int64_t ball);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
