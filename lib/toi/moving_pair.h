#pragma once
#include <detent/toi.h>

#include "distance/support.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Times are parts of the step in 2^-62.
inline constexpr int k_time_bits = 62;
inline constexpr int64_t k_time_end = int64_t{1} << k_time_bits;

/// value time, with the step as the unit of time. Rounding: down.
constexpr int64_t over_time(int64_t value, int64_t time) {
  const Int128 product = Int128::product(value, time);
  return static_cast<int64_t>((static_cast<uint64_t>(product.high_word()) << 2) | (product.low_word() >> k_time_bits));
}

constexpr Vec64 over_time(const Vec64& v, int64_t time) {
  return {over_time(v.x, time), over_time(v.y, time), over_time(v.z, time)};
}

/// numerator / denominator as a time, rounded down; k_time_end if it is not below 1. Range: both >= 0, denominator > 0.
int64_t time_quotient(int64_t numerator, int64_t denominator);

/// Leaves the counts.
inline void set_clear(TimeOfImpact& result) {
  result.outcome = ToiOutcome::clear;
  result.time = Fraction(1.0);
}

/// How a body's axes turn during the step.
struct Turning {
  Quat32 start;
  Matrix32 start_matrix;
  bool turns;     ///< false also if the core is a point
  Vec32 axis;     ///< of the spin, world, Q30
  int64_t rate;   ///< 2^-46 turns over the step
  Vec64 turn;     ///< rotation vector, 2^-46 rad over the step
  int64_t angle;  ///< |turn|, rounded up

  /// Error: k_turning_error for a unit vector.
  Matrix32 at(int64_t time) const { return turns ? matrix_from(rotation_at(time)) : start_matrix; }
  Quat32 rotation_at(int64_t time) const;
};
inline constexpr double k_turning_error = 16.0;  ///< 2^-30 (tests/unit/distance)

/// A body that does not turn.
Turning still(const Quat32& rotation);
/// Errors: not_normalised; out_of_range for a turn of more than 2^16 rad. Then `turning` may be half written.
Status turning_of(const Motion& motion, Turning& turning);

/// Where the bodies of a pair are at a time.
struct Frames {
  int64_t time;
  Matrix32 a, b;
  Vec32 offset;  ///< from A's centre to B's, in the block. Error: 1 ulp in each component.
};

/// Two shapes in motion, in a block in which every pose of the window fits.
struct MovingPair {
  const Convex* a;
  const Convex* b;
  Turning turning_a, turning_b;
  Vec64 offset;                            ///< from A's position to B's at the start, 2^-46 m
  Vec64 displacement;                      ///< of B relative to A over the step, 2^-46 m
  bool absolute = false;                   ///< A and B are moved one by one, and only then is the difference taken
  Vec64 way_a;                             ///< of A over the step, along what the pair's offset is along, 2^-46 m
  Vec64 offset_whole, displacement_whole;  ///< before the part along a resting half-space was left out
  bool planar;                             ///< one of the two is a half-space
  int64_t from, to;                        ///< only in this window can they meet; from > to: never
  int exponent;            ///< 2^exponent m is the pair's unit of length; the block's ulp is 2^-30 of it
  int32_t core_a, core_b;  ///< core radii, ulps of the block, rounded up
  int64_t reach;           ///< ulps; the centres are never farther apart in the window
  int64_t radius_a;        ///< of A's ball, 2^-46 m
  int32_t radius;          ///< of both balls, ulps, rounded up
  int32_t tolerance;       ///< ulps: closer than radius + tolerance is a hit

  Frames at(int64_t time) const { return {time, turning_a.at(time), turning_b.at(time), offset_at(time)}; }
  Vec32 offset_at(int64_t time) const {
    if (!absolute) return in_block(add(offset, over_time(displacement, time)));
    const Vec64 moved_a = over_time(way_a, time), moved_b = over_time(add(displacement, way_a), time);
    return subtract(in_block(add(offset, moved_b)), in_block(moved_a));
  }

 private:
  Vec32 in_block(const Vec64& v) const {
    return {static_cast<int32_t>(round_shift_64(v.x, exponent + 16)),
            static_cast<int32_t>(round_shift_64(v.y, exponent + 16)),
            static_cast<int32_t>(round_shift_64(v.z, exponent + 16))};
  }
};

/// Of a pair whose shapes and turnings are set: finds the window in which the bounding spheres touch, and the block.
/// `offset` and `displacement`, both of B from A: 2^-46 m. Errors: out_of_range for a displacement of 2^15 m, or if the
/// centres are 2^16 m apart and the spheres may touch all the same.
Status set_block(const Vec64& offset, const Vec64& displacement, MovingPair& pair);
/// Of a pair whose shapes are set: how they turn, and where they go, with the block. Of a half-space's pair the first
/// comes first; of others the window is known without it. Errors: as time_of_impact().
Status set_turnings(const Motion& motion_a, const Motion& motion_b, MovingPair& pair);
Status set_ways(const Motion& motion_a, const Motion& motion_b, MovingPair& pair);
/// Reads the poses and sets the block. Errors: as time_of_impact().
Status prepare(const Convex& a, const Motion& motion_a, const Convex& b, const Motion& motion_b, MovingPair& pair);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
