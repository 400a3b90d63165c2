#include "toi/moving_pair.h"

#include "distance/pair.h"
#include "math/root.h"
#include "math/trig_integer.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr int64_t k_raw_rotation_max = int64_t{1} << (k_metre_bits + 16);  ///< 2^16 rad, in 2^-46 rad
/// Bound on the sum of all roundings in a certified separation, ulps of the block. Derived in
/// docs/design/time_of_impact.md, "The rounding budget".
constexpr int32_t k_budget = 32;

Status set_turning(const Convex& convex, const Motion& motion, Turning& turning) {
  if (const Status status = turning_of(motion, turning); status != Status::ok) return status;
  turning = rotation_of(convex, turning);
  return Status::ok;
}

/// An upper bound of the distance between the centres, 2^-46 m.
int64_t distance_at(const MovingPair& pair, int64_t time) {
  return length_bound(add(pair.offset, over_time(pair.displacement, time)));
}

/// The root of a 128-bit number, rounded up.
int64_t root_above(Int128 value) {
  return static_cast<int64_t>(
             square_root_nearest(Words128{static_cast<uint64_t>(value.high_word()), value.low_word()})) +
         1;
}

/// Sets the window in which |offset + t displacement| <= distance_max, 2^-46 m, widened by all rounding. Returns a
/// bound, 2^-46 m, on the amount by which the distance in the widened window can exceed `distance_max`.
int64_t set_window(MovingPair& pair, int64_t distance_max) {
  const Vec64 &c = pair.offset, &d = pair.displacement;
  const int length = bit_length_64(static_cast<uint64_t>(distance_max) | magnitudes(c) | magnitudes(d));
  const int n = length > 29 ? length - 29 : 0;  // components below 2^29, norms below 2^30
  const Vec32 from = round_shift(c, n), displacement = round_shift(d, n);
  const int64_t r = (distance_max >> n) + 4;  // for the rounding of offset, displacement and distance_max
  const int64_t square = dot(displacement, displacement), along = dot(from, displacement),
                rest = dot(from, from) - r * r;
  const int64_t rounding = int64_t{12} << n;
  pair.from = 0;
  pair.to = k_time_end;
  if (rest <= 0) {
    if (square == 0) return rounding;
  } else {
    if (along >= 0) {
      pair.from = 1;
      pair.to = 0;
      return 0;
    }
  }
  const Int128 discriminant = Int128::product(along, along) - Int128::product(square, rest);
  if (discriminant.high_word() < 0) {
    pair.from = 1;
    pair.to = 0;
    return 0;
  }
  const int64_t root = root_above(discriminant);
  if (rest > 0) {
    pair.from = time_quotient(rest, root - along);
    if (pair.from == k_time_end) {
      pair.from = 1;
      pair.to = 0;
      return 0;
    }
  }
  const int64_t leave = root - along;  // end of the window times `square`; rounded up, as the root is
  if (leave >= 0 && leave < square) {
    const int64_t to = time_quotient(leave, square);
    if (to < k_time_end - 1) pair.to = to + 1;
  }
  return rounding;
}

DETENT_SHARED int32_t ulps_above(int64_t raw, int exponent) {
  const int n = exponent + 16;
  return static_cast<int32_t>((raw >> n) +
                              ((raw & ((int64_t{1} << n) - 1)) != 0 ? 1 : 0));  // no overflow for INT64_MAX
}

}  // namespace

int64_t time_quotient(int64_t numerator, int64_t denominator) {
  if (numerator >= denominator) return k_time_end;
  const uint64_t n = static_cast<uint64_t>(numerator);
  uint64_t remainder = 0;
  return static_cast<int64_t>(
      divide_128_by_64({n >> (64 - k_time_bits), n << k_time_bits}, static_cast<uint64_t>(denominator), remainder));
}

Quat32 Turning::rotation_at(int64_t time) const {
  if (!turns) return start;
  const SineCosineRaw half = sine_cosine_raw(over_time(rate, time) >> 13);
  const int64_t s = half.sine;
  const Quat32 turned = {round_30(s * axis.x), round_30(s * axis.y), round_30(s * axis.z), half.cosine};
  return multiply(turned, start);
}

Status set_turnings(const Motion& motion_a, const Motion& motion_b, MovingPair& pair) {
  if (const Status status = set_turning(*pair.a, motion_a, pair.turning_a); status != Status::ok) return status;
  return set_turning(*pair.b, motion_b, pair.turning_b);
}

Status set_displacements(const Motion& motion_a, const Motion& motion_b, MovingPair& pair) {
  Vec64 displacement_a, displacement_b;
  if (!raw_from_real(motion_a.displacement, displacement_a) || !raw_from_real(motion_b.displacement, displacement_b)) {
    return Status::out_of_range;
  }
  if (((magnitudes(displacement_a) | magnitudes(displacement_b)) >> 60) != 0) return Status::out_of_range;
  pair.displacement_a = displacement_a;
  Vec64 offset;
  if (!raw_difference(motion_b.start.position, motion_a.start.position, offset)) return Status::out_of_range;
  return set_block(offset, add(displacement_b, negate(displacement_a)), pair);
}

Status prepare(const Convex& a, const Motion& motion_a, const Convex& b, const Motion& motion_b, MovingPair& pair) {
  if (a.type == ShapeType::half_space && b.type == ShapeType::half_space) return Status::bad_argument;
  pair.a = &a;
  pair.b = &b;
  if (const Status status = set_turnings(motion_a, motion_b, pair); status != Status::ok) return status;
  return set_displacements(motion_a, motion_b, pair);
}

Status turning_of(const Motion& motion, Turning& turning) {
  if (!raw_from_quat(motion.start.rotation, turning.start)) return Status::not_normalised;
  if (!raw_from_real(motion.rotation_vector, turning.rotation_vector)) return Status::out_of_range;
  const Vec64& rotation_vector = turning.rotation_vector;
  if (magnitude_64(rotation_vector.x) > k_raw_rotation_max || magnitude_64(rotation_vector.y) > k_raw_rotation_max ||
      magnitude_64(rotation_vector.z) > k_raw_rotation_max) {
    return Status::out_of_range;
  }
  // The components are at most 2^62 in magnitude, so the sum of their squares fits 128 bits.
  const Int128 longest = Int128::product(k_raw_rotation_max, k_raw_rotation_max);
  if (longest < dot(rotation_vector, rotation_vector)) return Status::out_of_range;
  const Vec64 displacement = rotation_vector;
  turning = still(turning.start);
  if (is_zero(displacement)) return Status::ok;
  turning.turns = true;
  turning.rotation_vector = displacement;
  turning.axis = unit_vector_raw(scaled_to_30_bits(rotation_vector));
  // |rotation_vector| = axis . rotation_vector / |axis|, with |axis|^2 = 1 + excess. The rounding of the axis has only
  // a second-order effect.
  const int64_t excess = dot(turning.axis, turning.axis) - (int64_t{1} << 60);
  const int64_t along = dot(rotation_vector, turning.axis).round_shift(30);
  turning.angle = along - Int128::product(along, excess).round_shift(61);
  constexpr int64_t k_inverse_two_pi = 2935890503282001226;  // Q64
  turning.rate = Int128::product(turning.angle, k_inverse_two_pi).round_shift(64);
  return Status::ok;
}

Turning rotation_of(const Convex& convex, const Turning& turning) {
  return convex.core_radius == 0 && convex.type != ShapeType::half_space ? still(turning.start) : turning;
}

Turning still(const Quat32& rotation) { return {rotation, matrix_from(rotation), false, {0, 0, 0}, 0, {0, 0, 0}, 0}; }

Status set_block(const Vec64& offset, const Vec64& displacement, MovingPair& pair) {
  const Convex &a = *pair.a, &b = *pair.b;
  pair.offset = pair.offset_whole = offset;
  pair.displacement = pair.displacement_whole = displacement;
  const bool plane_is_a = a.type == ShapeType::half_space;
  if (magnitudes(displacement) >> 61 != 0) return Status::out_of_range;
  pair.planar = plane_is_a || b.type == ShapeType::half_space;
  if (pair.planar && magnitudes(offset) >> 62 != 0) return Status::out_of_range;
  const Turning& plane = plane_is_a ? pair.turning_a : pair.turning_b;
  if (pair.planar && !plane.turns) {
    const Vec32& up = plane.start_matrix.column[1];
    pair.offset = component_along(pair.offset, up);
    pair.displacement = component_along(pair.displacement, up);
  }
  const int64_t cores = raw_core_radius(a) + raw_core_radius(b), balls = raw_radius(a) + raw_radius(b);
  const int64_t close = cores + balls + ((cores + balls) >> 18) + 64;
  if (magnitudes(pair.offset) >> 62 != 0) {
    // Sums would overflow. The shapes are either certainly too far apart to touch, or the call fails.
    const auto parted = [close](int64_t c, int64_t d) {
      return magnitude_64(c) > magnitude_64(d) + static_cast<uint64_t>(close);
    };
    const Vec64 &c = pair.offset, &d = pair.displacement;
    if (pair.planar || !(parted(c.x, d.x) || parted(c.y, d.y) || parted(c.z, d.z))) return Status::out_of_range;
    pair.from = 1;
    pair.to = 0;
    return Status::ok;
  }
  int64_t distance_max = close;
  if (pair.planar) {
    // A plane is unbounded: the window is the whole step, and the block holds both ends of the translation.
    pair.from = 0;
    pair.to = k_time_end;
    const int64_t begins = distance_at(pair, 0), ends = distance_at(pair, k_time_end);
    distance_max = saturated_sum(begins > ends ? begins : ends, close);
  } else {
    const int64_t rounding = set_window(pair, close);
    if (pair.from > pair.to) return Status::ok;
    distance_max += rounding;
  }
  const int64_t whole = saturated_sum(distance_max, cores + 64);
  pair.exponent = whole == INT64_MAX ? k_exponent_max : raw_exponent_above(whole);
  pair.distance_max = ulps_above(distance_max, pair.exponent);
  pair.core_a = ulps_above(raw_core_radius(a), pair.exponent);
  pair.core_b = ulps_above(raw_core_radius(b), pair.exponent);
  pair.radius_a = raw_radius(a);
  pair.radius = ulps_above(balls, pair.exponent);
  // The tolerance is 0.9 2^-20 of the larger core's diameter, but at least four times the rounding budget.
  const int64_t larger = pair.core_a > pair.core_b ? pair.core_a : pair.core_b;
  const int32_t wanted = static_cast<int32_t>((larger * 59) >> 25);
  pair.tolerance = wanted > 4 * k_budget ? wanted : 4 * k_budget;
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
