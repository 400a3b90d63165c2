#pragma once
#include <detent/toi.h>

#include "distance/support.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Times are fractions of the step, in units of 2^-62.
inline constexpr int k_time_bits = 62;
inline constexpr int64_t k_time_end = int64_t{1} << k_time_bits;

/// value times time, with the step as the unit of time. Rounding: down.
constexpr int64_t over_time(int64_t value, int64_t time) {
  const Int128 product = Int128::product(value, time);
  return static_cast<int64_t>((static_cast<uint64_t>(product.high_word()) << 2) | (product.low_word() >> k_time_bits));
}

constexpr Vec64 over_time(const Vec64& v, int64_t time) {
  return {over_time(v.x, time), over_time(v.y, time), over_time(v.z, time)};
}

/// numerator / denominator as a time, rounded down; k_time_end if the quotient is 1 or more. Range: both >= 0,
/// denominator > 0.
int64_t time_quotient(int64_t numerator, int64_t denominator);

/// Sets the outcome of `result` to clear and its time to 1. Leaves its counts as they are.
inline void set_clear(TimeOfImpact& result) {
  result.outcome = ToiOutcome::clear;
  result.time = Fraction(1.0);
}

/// The rotation of a body's axes during the step.
struct Turning {
  Quat32 start;
  Matrix32 start_matrix;
  bool turns;             ///< whether the shape rotates; false also if its core is a point
  Vec32 axis;             ///< axis of the rotation, world axes, Q30
  int64_t rate;           ///< 2^-46 revolutions over the step
  Vec64 rotation_vector;  ///< 2^-46 rad over the step
  int64_t angle;          ///< |rotation_vector|, rounded up

  /// The rotation at a time. Error of a rotated unit vector: k_turning_error.
  Matrix32 at(int64_t time) const { return turns ? matrix_from(rotation_at(time)) : start_matrix; }
  Quat32 rotation_at(int64_t time) const;
};
inline constexpr double k_turning_error = 16.0;  ///< units of 2^-30 (tests/unit/toi)

/// Returns the Turning of a body that does not rotate.
Turning still(const Quat32& rotation);
/// The rotation of a motion. Errors: not_normalised; out_of_range for a rotation of more than 2^16 rad. After an error
/// `turning` may be partly written.
Status turning_of(const Motion& motion, Turning& turning);
/// Returns the rotation of `convex`, a shape of a body with the rotation `turning`. A shape whose core is a point at
/// the body's centre counts as not rotating.
Turning rotation_of(const Convex& convex, const Turning& turning);

/// The placement of the bodies of a pair at a time.
struct Frames {
  int64_t time;
  Matrix32 a, b;
  Vec32 offset;  ///< from A's centre to B's, in ulps of the pair's block. Error: 1 ulp in each component.
};

/// Two shapes in motion. Their numbers have one common exponent (a block), with which the poses at all times from
/// `from` to `to` can be represented.
struct MovingPair {
  const Convex* a;
  const Convex* b;
  Turning turning_a, turning_b;
  Vec64 offset;           ///< from A's position to B's at the start, 2^-46 m
  Vec64 displacement;     ///< translation of B relative to A over the step, 2^-46 m
  bool absolute = false;  ///< offset_at() moves A and B separately, then takes their difference
  Vec64 displacement_a;   ///< translation of A over the step, 2^-46 m
  /// The full offset and displacement of the bodies. If a half-space does not rotate, `offset` and `displacement`
  /// contain only the part along its normal; otherwise they are equal to these members.
  Vec64 offset_whole, displacement_whole;
  bool planar;                ///< one of the two shapes is a half-space
  int64_t from, to;           ///< the window: contains all times at which the shapes can touch; from > to: never
  int64_t last = k_time_end;  ///< a search may end as clear when it has passed this time
  int exponent;               ///< 2^exponent m is the pair's unit of length; the block's ulp is 2^-30 of it
  int32_t core_a, core_b;     ///< core radii, ulps of the block, rounded up
  int64_t distance_max;       ///< bound on the distance of the centres in the window, ulps of the block
  int64_t radius_a;           ///< radius of the ball that rounds A's core, 2^-46 m
  int32_t radius;             ///< sum of the radii of both balls that round the cores, ulps, rounded up
  int32_t tolerance;          ///< ulps: a distance of at most radius + tolerance is a hit

  Frames at(int64_t time) const { return {time, turning_a.at(time), turning_b.at(time), offset_at(time)}; }
  Vec32 offset_at(int64_t time) const {
    if (!absolute) return in_block(add(offset, over_time(displacement, time)));
    const Vec64 moved_a = over_time(displacement_a, time), moved_b = over_time(add(displacement, displacement_a), time);
    return subtract(in_block(add(offset, moved_b)), in_block(moved_a));
  }

 private:
  Vec32 in_block(const Vec64& v) const {
    return {static_cast<int32_t>(round_shift_64(v.x, exponent + 16)),
            static_cast<int32_t>(round_shift_64(v.y, exponent + 16)),
            static_cast<int32_t>(round_shift_64(v.z, exponent + 16))};
  }
};

/// Finds the window in which the bounding spheres touch, and the block, for a pair whose shapes and rotations are set.
/// `offset` and `displacement`: of B relative to A, 2^-46 m. Errors: out_of_range for a component of the displacement
/// of 2^15 m or more, or of the offset of 2^16 m or more if the spheres may touch or one shape is a half-space.
Status set_block(const Vec64& offset, const Vec64& displacement, MovingPair& pair);
/// set_turnings() sets the rotations. set_displacements() sets the translations, the window and the block. The shapes
/// of the pair must be set. If one shape is a half-space, set_turnings() must be called first; otherwise the order does
/// not matter. Errors: as time_of_impact().
Status set_turnings(const Motion& motion_a, const Motion& motion_b, MovingPair& pair);
Status set_displacements(const Motion& motion_a, const Motion& motion_b, MovingPair& pair);
/// Sets all of the pair: shapes, rotations, translations and block. Errors: as time_of_impact().
Status prepare(const Convex& a, const Motion& motion_a, const Convex& b, const Motion& motion_b, MovingPair& pair);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
