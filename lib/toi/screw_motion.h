#pragma once
#include "toi/feature_search.h"

/// The screw between two poses, as S. Redon, A. Kheddar and S. Coquillart use it.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// B in A's frame.
struct RelativePose {
  Quat32 rotation;
  Vec64 position;  ///< 2^-46 m
};
/// Of bodies with these rotations, B's position `offset` from A's, world axes, 2^-46 m.
RelativePose relative_pose(const Quat32& a, const Quat32& b, const Vec64& offset);

inline constexpr int k_tangent_bits = 28;
/// Components of B's position in A's frame lie within 2^10 m, and so do those of its corners from there.
inline constexpr int k_screw_range_bits = 10;

/// B's screw in A's frame. With g along its axis and as long as the tangent of half its angle, and d the way of B's
/// position, the point that is x from B's position c at the start is at time t at
///   c + x + t d + t (g x y + t g x (g x y)) / (1 + t^2 g^2),  y = 2 x - (1 - t) d:
/// neither the axis nor the angle is needed, and without a turn it is a straight line. With |g| <= 4 and |y| < 2^59 the
/// two products, at right angles to each other, have a sum below 2^63.
struct ScrewMotion {
  Vec64 first, way;  ///< of B's position from A's: at the start, and d; 2^-46 m
  Vec32 tangent;     ///< g, Q28
  int64_t square;    ///< of g, Q56

  /// |g|, Q28, rounded up.
  int64_t tangent_length() const;
  /// 1 + t^2 g^2, Q56.
  int64_t weight_at(int64_t time) const {
    return (int64_t{1} << (2 * k_tangent_bits)) + over_time(over_time(square, time), time);
  }
  /// Q62.
  int64_t inverse_weight_at(int64_t time) const {
    return time_quotient(int64_t{1} << (2 * k_tangent_bits), weight_at(time));
  }
  /// What t (g x y + t g x (g x y)) / (1 + t^2 g^2) is of a y.
  Vec64 turned(const Vec64& y, int64_t time, int64_t inverse_weight) const;
  /// Where a point is that is `x` from B's position at the start, from A's position.
  Vec64 at(const Vec64& x, int64_t time, int64_t inverse_weight) const;
  /// The most that a point within `reach` of B's position is off its chord over the whole step.
  int64_t bend(int64_t reach) const;
};

/// Of a difference of a corner of A and one of B that is `reach` from its position, 2^-46 m: rotations composed from
/// rounded ones, a tangent rounded after a division by 1/4 or more; sums rounded.
inline int64_t screw_ball(int64_t reach, const RelativePose& start, const RelativePose& end) {
  return (reach >> 24) + ((length_above(start.position) + length_above(end.position)) >> 26) + 64;
}

/// Where the features of a path are coplanar, which has set_differences_at(), a kind and a ball. Whether a line at rest
/// meets a moving line, or a point a plane, is linear in the moving one's coordinates. Those are entries of its
/// rotation, which are quadratic after multiplication by 1 + t^2 g^2, and such times the way along the axis, which is
/// linear: in all a cubic.
template <class Path>
OpenPart screw_roots(const Path& path, const ScrewMotion& screw, int64_t from, int64_t to) {
  Vec64 corners[4][3];
  int64_t weight[4];
  for (int i = 0; i < 4; ++i) {
    const int64_t time = i == 3 ? to : from + i * ((to - from) / 3);
    Vec64 difference[4];
    path.set_differences_at(time, difference);
    corners[i][0] = difference[0];
    corners[i][1] = difference[1];
    corners[i][2] = difference[difference_count(path.kind) - 1];
    weight[i] = screw.weight_at(time) >> k_tangent_bits;
  }
  return reduced_roots(corners, weight, path.ball + 1);  // a third of the interval is rounded down
}

/// The shorter way round. Errors: out_of_range for a turn of more than 2.65 rad, and positions out of range.
Status screw_between(const RelativePose& start, const RelativePose& end, ScrewMotion& screw);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
