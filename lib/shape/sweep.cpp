#include "shape/sweep.h"

#include "math/arithmetic.h"
#include "math/root.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// An angle, rad. If the angle estimate of sweep_between() is not longer than this, the shortest rotation vector is the
/// one nearest to the estimate.
constexpr Real k_half_turn_limit = 3.0;
constexpr int32_t k_turns_max = 1 << 14;

/// The nearest integer to a / b for b > 0, clamped to +-k_turns_max. Uses binary long division, which needs no
/// conversion to integers.
int32_t nearest_multiple(Real a, Real b) {
  const bool negative = a < Real(0.0);
  Real rest = abs(a) + scale_by_power(b, -1);
  int32_t count = 0;
  for (int step = 14; step >= 0; --step) {
    const Real part = scale_by_power(b, step);
    if (rest >= part) {
      rest -= part;
      count += 1 << step;
    }
  }
  count = count > k_turns_max ? k_turns_max : count;
  return negative ? -count : count;
}

Real multiple(Real value, int32_t count) {
  Real sum = 0.0;
  const uint32_t magnitude = static_cast<uint32_t>(count < 0 ? -count : count);
  for (int bit = 0; bit <= 14; ++bit) {
    if ((magnitude >> bit & 1) != 0) sum += scale_by_power(value, bit);
  }
  return count < 0 ? -sum : sum;
}

}  // namespace

Sweep sweep_between(const Quat& start, const Quat& end, const Vec3<Real>& displacement,
                    const Vec3<Real>& angle_estimate) {
  const Real zero = 0.0;
  const Real bound = abs(angle_estimate.x) + abs(angle_estimate.y) + abs(angle_estimate.z);
  if (bound == zero && start == end) return {displacement, {zero, zero, zero}};
  Vec3<Real> rotation_vector = rotation_vector_from(multiply(end, conjugate(start)));
  if (bound > k_half_turn_limit) {
    Vec3<Unit> axis;
    Real angle = zero;
    if (normalise(rotation_vector, axis, angle) && angle > Real(0x1p-10)) {
      const int32_t turns = nearest_multiple(dot(angle_estimate, axis) - angle, k_two_pi);
      rotation_vector = rotation_vector + axis * multiple(k_two_pi, turns);
      // Full revolutions only: `rotation_vector` is too short to give an axis.
    } else if (normalise(angle_estimate, axis, angle)) {
      rotation_vector = rotation_vector + axis * multiple(k_two_pi, nearest_multiple(angle, k_two_pi));
    }
  }
  return {displacement, rotation_vector};
}

Quat sweep_end_rotation(const Quat& start, const Sweep& sweep) {
  const Real zero = 0.0;
  if (sweep.rotation_vector == Vec3<Real>{zero, zero, zero}) return start;
  return normalise(multiply(rotation_from_vector(sweep.rotation_vector), start));
}

#if defined(DETENT_FX32)
namespace {

/// Adds `d`, m, to coordinate + remainder, and splits the sum again. The coordinate is rounded down, so the remainder
/// is never negative. Returns whether the coordinate was clamped.
bool advance(Coord& coordinate, uint16_t& remainder, Real d) {
  const int64_t from = static_cast<int64_t>(coordinate.raw) * 65536 + remainder;  // 2^-32 m
  const int64_t to = from + ((d.raw + (int64_t{1} << 13)) >> 14);
  constexpr int64_t k_low = static_cast<int64_t>(INT32_MIN) * 65536;
  constexpr int64_t k_high = static_cast<int64_t>(INT32_MAX) * 65536 + 65535;
  const int64_t clamped = to < k_low ? k_low : to > k_high ? k_high : to;
  coordinate.raw = static_cast<int32_t>(clamped >> 16);
  remainder = static_cast<uint16_t>(clamped & 0xffff);
  return clamped != to;
}

}  // namespace
#endif

uint32_t sweep_end_position(BodyPose& pose, const Sweep& sweep) {
  Coord* coordinates[3] = {&pose.position.x, &pose.position.y, &pose.position.z};
  const Real distances[3] = {sweep.displacement.x, sweep.displacement.y, sweep.displacement.z};
  uint32_t clamped = 0;
  for (int i = 0; i < 3; ++i) {
    bool saturated = false;
#if defined(DETENT_FX32)
    saturated = advance(*coordinates[i], pose.remainder[i], distances[i]);
#else
    *coordinates[i] = coord_advance(*coordinates[i], distances[i], saturated);
#endif
    clamped += saturated ? 1 : 0;
  }
  return clamped;
}

#if DETENT_FIXED
Real part_of(Real whole, Fraction part) {
  return Real::from_raw(Int128::product(whole.raw, part.raw).round_shift(Fraction::k_frac));
}
#else
Real part_of(Real whole, Fraction part) { return whole * float_from_integer<Real>(part.raw, -Fraction::k_frac); }
#endif

namespace {

#if defined(DETENT_F32)
/// Adds whole * part, m, to the coordinate. Computes this product exactly, because for a long displacement the error of
/// a float product exceeds the resolution of positions. Returns whether the coordinate was clamped.
bool advance_part(Coord& coordinate, Real whole, Fraction part) {
  constexpr int k_bits = 46;
  bool saturated = false;
  const int64_t displacement = integer_from_float(whole, k_bits, saturated);
  const int64_t step = Int128::product(displacement, part.raw).round_shift(Fraction::k_frac + k_bits - Coord::k_frac);
  const int64_t sum = add_wrapped(coordinate.raw, step);
  if (((coordinate.raw ^ sum) & (step ^ sum)) < 0) {
    saturated = true;
    coordinate = Coord::from_raw(step < 0 ? INT64_MIN : INT64_MAX);
  } else {
    coordinate = Coord::from_raw(sum);
  }
  return saturated;
}
#endif

}  // namespace

Vec3<Real> part_of(const Vec3<Real>& whole, Fraction part) {
  return {part_of(whole.x, part), part_of(whole.y, part), part_of(whole.z, part)};
}

Sweep sweep_part(const Sweep& sweep, Fraction part) {
  return {part_of(sweep.displacement, part), part_of(sweep.rotation_vector, part)};
}

uint32_t advance_along(const Sweep& sweep, Fraction part, BodyPose& pose) {
  const Sweep now = sweep_part(sweep, part);
  pose.rotation = sweep_end_rotation(pose.rotation, now);
#if defined(DETENT_F32)
  const bool x = advance_part(pose.position.x, sweep.displacement.x, part);
  const bool y = advance_part(pose.position.y, sweep.displacement.y, part);
  const bool z = advance_part(pose.position.z, sweep.displacement.z, part);
  return (x ? 1u : 0u) + (y ? 1u : 0u) + (z ? 1u : 0u);
#else
  return sweep_end_position(pose, now);
#endif
}

Fraction fraction_product(Fraction a, Fraction b) {
  const Int128 product = Int128::product(a.raw, b.raw);
  return Fraction::from_raw(static_cast<int64_t>((static_cast<uint64_t>(product.high_word()) << 2) |
                                                 (product.low_word() >> Fraction::k_frac)));
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
