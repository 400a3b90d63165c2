#pragma once
#include "math/arithmetic.h"

/// Square roots and lengths.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The integer part of the square root, exact.
uint32_t square_root_floor(uint64_t value);
/// The integer nearest to the square root. Overflow: saturates at 2^32 - 1.
uint32_t square_root_nearest(uint64_t value);
/// The integer nearest to the square root of a 128-bit number. Overflow: saturates at 2^64 - 1.
/// Source: Zimmermann, "Karatsuba Square Root", INRIA RR-3805, 1999 (one step).
uint64_t square_root_nearest(Words128 value);

/// An approximation of 2^47 / sqrt(value), which is 1 / sqrt(value 2^-32) in Q1.31. Range: value in [2^30, 2^32).
/// Overflow: saturates at 2^32 - 1. Error: k_reciprocal_root_error.
uint32_t reciprocal_root(uint32_t value);
/// Largest error of reciprocal_root(), in units of 2^-31. The result of reciprocal_root() is in (1, 2].
inline constexpr double k_reciprocal_root_error = 1.0;

/// The unit vector along v, Q2.30. Range: the largest component of v within [2^29, 2^30] in magnitude.
/// Rounding: each component within k_normalise_error; the length within k_normalise_length_error.
Vec3<int32_t> unit_vector_raw(const Vec3<int32_t>& v);

/// A minimax cubic approximation of 1/sqrt(value 2^-32), Q3.29. Relative error: below 2^-7.1.
/// Range: value in [2^30, 2^32).
constexpr uint32_t reciprocal_root_guess(uint32_t value) {
  const auto high = [value](uint32_t b) { return static_cast<uint32_t>((uint64_t{value} * b) >> 32); };
  return 0x639898a5 - high(0xbd264567 - high(0xc75be3d4 - high(0x4e07e417)));
}
/// A cheap upper bound of the square root. It exceeds the root by at most 1.6 % of the root plus 2. Overflow: none for
/// value < 2^62.
DETENT_SHARED constexpr uint32_t square_root_bound(uint64_t value) {
  if (value == 0) return 0;
  const int half_shift = (64 - bit_length_64(value)) / 2;
  const uint32_t head = static_cast<uint32_t>((value << (2 * half_shift)) >> 32);
  const uint64_t root = (uint64_t{head} * reciprocal_root_guess(head)) >> 29;  // Q32, within 2^-7.1
  return static_cast<uint32_t>((root + (root >> 7) + 1) >> half_shift) + 1;
}

#if DETENT_FIXED
namespace raw {
int64_t square_root(int64_t a);
int64_t length(const Vec3<Real>& v);
}  // namespace raw
/// The square root. Range: a >= 0. Rounding: to nearest. Overflow: none.
Unit square_root(Unit a);
DETENT_PASSING inline Real square_root(Real a) { return Real::from_raw(raw::square_root(a.raw)); }
/// |v|. Range: |v| < 2. Rounding: the root of the exact sum of squares, to nearest.
Unit length(const Vec3<Unit>& v);
/// |v|, m. Rounding: the root of the exact sum of squares, to nearest. Overflow: saturates to +131072.
DETENT_PASSING inline Real length(const Vec3<Real>& v) { return Real::from_raw(raw::length(v)); }

/// Sets n = v / |v| and `length` = |v|. Returns false, with the outputs untouched, if v is zero. n is as precise for a
/// short v as for a long one. Rounding: each component of n is within k_normalise_error of the true direction,
/// | |n| - 1 | <= k_normalise_length_error, and `length` is rounded to nearest. Overflow: as length().
bool normalise(const Vec3<Unit>& v, Vec3<Unit>& n, Unit& length);
bool normalise(const Vec3<Real>& v, Vec3<Unit>& n, Real& length);
#else
/// The square root, correctly rounded (to nearest, ties to even), also for subnormals. Uses only integer arithmetic.
/// Range: a >= 0 and not NaN.
float square_root_portable(float a);
double square_root_portable(double a);

// Use the compiler's square root only where it is known to be one instruction: elsewhere it would call libm.
#if defined(__SSE2_MATH__) || defined(__aarch64__) || defined(__riscv_fdiv) || defined(__s390x__) || \
    (defined(__mips_hard_float) && !defined(__mips_single_float)) || defined(__wasm__) ||            \
    (defined(__ARM_FP) && !defined(__SOFTFP__) && (__ARM_FP & 4) && (defined(DETENT_F32) || (__ARM_FP & 8)))
#define DETENT_HARDWARE_SQUARE_ROOT 1
#else
#define DETENT_HARDWARE_SQUARE_ROOT 0
#endif

/// The square root, correctly rounded. Range: a >= 0 and not NaN.
inline Real square_root(Real a) {
#if !DETENT_HARDWARE_SQUARE_ROOT
  return square_root_portable(a);
#elif defined(DETENT_F32)
  return __builtin_sqrtf(a);
#else
  return __builtin_sqrt(a);
#endif
}
/// |v|. Range: each component is 0, or its magnitude is in [2^-46, 2^40), so that its square neither underflows nor
/// overflows.
inline Real length(const Vec3<Real>& v) { return square_root(dot(v, v)); }
/// Sets n = v / |v| and `length` = |v|. Returns false, with the outputs untouched, if v is zero. The errors of n are at
/// most k_normalise_error and k_normalise_length_error.
bool normalise(const Vec3<Real>& v, Vec3<Unit>& n, Real& length);
#endif

inline constexpr double k_normalise_error = 2.5;         ///< error of a component of n, in steps (k_unit_step)
inline constexpr double k_normalise_length_error = 3.0;  ///< error of |n|, in steps

}  // namespace DETENT_NAMESPACE
}  // namespace detent
