#pragma once
#include "toi/feature_search.h"

/// Features of two moving bodies: the interface of a motion, and the paths of features under it.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The poses of two bodies at a time, in one frame.
struct PlacedPair {
  Matrix32 a, b;
  Vec64 offset;  ///< from A's position to B's, 2^-46 m
};

/// Bounds on the paths of points of a body that rotates about its position.
struct RotationBound {
  int64_t radius;  ///< the largest distance of a point from the position, 2^-46 m
  int64_t angle;   ///< 2^-46 rad over the step; a point's acceleration is at most angle^2 radius

  /// A bound on the distance of a point's path from its chord over an interval of this length: an eighth of the
  /// acceleration times the square of the length, or the diameter if that is less.
  int64_t bend(int64_t length) const {
    const int64_t part = angle_in(length);
    if (part >= int64_t{1} << 31) return 2 * radius;
    return part_of(radius, ((part * part) >> 33) + 1) + 1;
  }
  /// The rotation angle over an interval of this length, Q30 rad, rounded up.
  int64_t angle_in(int64_t length) const { return (over_time(angle, length) >> 16) + 1; }
};

/// Bounds on the rotations of two bodies whose positions move in straight lines.
struct SweptPair {
  RotationBound bound_a, bound_b;

  /// A bound as RotationBound::bend(), but for the path of the difference of a point of A and a point of B.
  int64_t bend(int64_t length) const { return bound_a.bend(length) + bound_b.bend(length); }
  /// Bound on the relative rotation of the bodies over an interval of this length, Q30 rad.
  int64_t angle_in(int64_t length) const { return bound_a.angle_in(length) + bound_b.angle_in(length); }
  /// Error bound, 2^-46 m, of a difference of two points at a time: 16 * 2^-30 of the radius for the rotation of each
  /// body, and eight roundings (two corners, their images, the positions, the translations).
  int64_t ball() const {
    static_assert(k_turning_error == 16);
    return ((bound_a.radius + bound_b.radius) >> 26) + 9;
  }
};

/// Two bodies of constant velocity and constant angular velocity, in world axes.
struct SteadyMotion : SweptPair {
  Turning turning_a, turning_b;
  Vec64 offset, displacement;  ///< position and translation of B relative to A, 2^-46 m

  PlacedPair at(int64_t time) const {
    return {turning_a.at(time), turning_b.at(time), add(offset, over_time(displacement, time))};
  }
};

/// The poses of a pair at both ends of the searched interval.
struct Ends {
  int64_t from, to;
  PlacedPair begin, end;
};

/// Features of two bodies in a motion. `Motion` has at(), bend(), angle_in() and ball(), which mean the same as in
/// SteadyMotion.
template <class Motion>
struct FeaturePath {
  const Motion& motion;
  Ends ends;  ///< cached, so that motion.at() is not evaluated again at the ends
  FeatureKind kind;
  bool swapped;     ///< the corners that FeatureKind assigns to A belong to B
  Vec64 corner[4];  ///< in the axes of their bodies, 2^-46 m
  int64_t ball;     ///< error bound of a difference of corners at either end of an interval

  FeatureSpan span(int64_t from, int64_t to) const {
    FeatureSpan span;
    span.count = difference_count(kind);
    set_differences_at(from, span.from);
    set_differences_at(to, span.to);
    span.ball = ball + motion.bend(to - from);
    return span;
  }
  OpenPart roots(int64_t from, int64_t to) const requires requires(const Motion& m) { m.roots(*this, from, to); }
  { return motion.roots(*this, from, to); }
  void set_differences_at(int64_t time, Vec64 (&difference)[4]) const {
    if (time == ends.from) return set_differences_in(ends.begin, difference);
    if (time == ends.to) return set_differences_in(ends.end, difference);
    set_differences_in(motion.at(time), difference);
  }

 private:
  void set_differences_in(const PlacedPair& pair, Vec64 (&difference)[4]) const {
    Vec64 placed[4];
    for (int i = 0; i < 4; ++i) {
      const bool of_a = (i < first_of_b(kind)) != swapped;
      placed[i] = of_a ? rotated(pair.a, corner[i]) : add(pair.offset, rotated(pair.b, corner[i]));
    }
    set_differences(kind, placed, difference);
  }
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
