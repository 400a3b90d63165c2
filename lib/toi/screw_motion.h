#pragma once
#include "toi/feature_search.h"

/// The screw motion between two poses, as in S. Redon, A. Kheddar and S. Coquillart (redon.h).
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The pose of B in A's frame.
struct RelativePose {
  Quat32 rotation;
  Vec64 position;  ///< 2^-46 m
};
/// The relative pose of bodies with these rotations. `offset`: from A's position to B's, world axes, 2^-46 m.
RelativePose relative_pose(const Quat32& a, const Quat32& b, const Vec64& offset);

inline constexpr int k_tangent_bits = 28;
/// Components of B's position in A's frame are within 2^10 m, and so are those of B's corners relative to that
/// position.
inline constexpr int k_screw_range_bits = 10;

/// The screw motion of B in A's frame. The vector g points along the screw axis; its length is the tangent of half the
/// angle. c is the position of B at the start and d its displacement. The point that starts at c + x is at time t at
///   c + x + t d + t (g x y + t g x (g x y)) / (1 + t^2 g^2),  y = 2 x - (1 - t) d.
/// The formula needs neither the place of the axis nor the angle, and gives a straight line if there is no rotation.
/// The products g x y and g x (g x y) are perpendicular to each other; with |g| <= 4 and |y| < 2^59 their sum is below
/// 2^63.
struct ScrewMotion {
  Vec64 first, displacement;  ///< B's position relative to A's at the start (c), and d; 2^-46 m
  Vec32 tangent;              ///< g, Q28
  int64_t square;             ///< |g|^2, Q56

  /// |g|, Q28, rounded up.
  int64_t tangent_length() const;
  /// 1 + t^2 g^2, Q56.
  int64_t weight_at(int64_t time) const {
    return (int64_t{1} << (2 * k_tangent_bits)) + over_time(over_time(square, time), time);
  }
  /// 1 / weight_at(time), Q62.
  int64_t inverse_weight_at(int64_t time) const {
    return time_quotient(int64_t{1} << (2 * k_tangent_bits), weight_at(time));
  }
  /// t (g x y + t g x (g x y)) / (1 + t^2 g^2).
  Vec64 turned(const Vec64& y, int64_t time, int64_t inverse_weight) const;
  /// The position at `time`, relative to A's position and in A's frame, of the point that lies at `x` from B's position
  /// in the start pose. `inverse_weight`: inverse_weight_at(time).
  Vec64 at(const Vec64& x, int64_t time, int64_t inverse_weight) const;
  /// Bound on the distance of a path from its chord over the whole step, for points within `radius` of B's position.
  int64_t bend(int64_t radius) const;
};

/// Error bound of a difference of a corner of A and a corner of B that is `radius` from B's position, 2^-46 m. Sources:
/// rotations composed from rounded ones, a tangent rounded after a division by 1/4 or more, rounded sums.
inline int64_t screw_ball(int64_t radius, const RelativePose& start, const RelativePose& end) {
  return (radius >> 24) + ((length_above(start.position) + length_above(end.position)) >> 26) + 64;
}

/// The part of an interval in which the features of a path may be coplanar. `Path` has set_differences_at(), `kind` and
/// `ball`, as ScrewPath. The condition that a moving line meets a line at rest, or a moving point a plane at rest, is
/// linear in the coordinates of the moving feature. These coordinates contain the entries of the rotation, which are
/// quadratic in t after multiplication by 1 + t^2 g^2, and products of such entries with the displacement along the
/// axis, which is linear in t. The condition is therefore a cubic.
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

/// Finds the screw motion between two poses. Of the two possible ones, takes the one with the smaller rotation angle.
/// Errors: out_of_range for a rotation of more than 2.65 rad, and for a component of a position above 2^11 m.
Status screw_between(const RelativePose& start, const RelativePose& end, ScrewMotion& screw);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
