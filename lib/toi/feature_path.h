#pragma once
#include "toi/feature_search.h"

/// Features of two bodies in motion: what a motion has to know, and how features go along with it.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Where two bodies are at a time, in one frame.
struct PlacedPair {
  Matrix32 a, b;
  Vec64 offset;  ///< from A's position to B's, 2^-46 m
};

/// Bounds on the paths of points of a body that turns about its position.
struct RotationBound {
  int64_t reach;  ///< their farthest from it, 2^-46 m
  int64_t angle;  ///< 2^-46 rad over the step; a point's acceleration is at most angle^2 reach

  /// How far a point may be from its chord over an interval so long: an eighth of the acceleration and the interval's
  /// square. No farther than a diameter anyway.
  int64_t bend(int64_t length) const {
    const int64_t part = turn(length);
    if (part >= int64_t{1} << 31) return 2 * reach;
    return part_of(reach, ((part * part) >> 33) + 1) + 1;
  }
  /// The angle over an interval so long, Q30, rounded up.
  int64_t turn(int64_t length) const { return (over_time(angle, length) >> 16) + 1; }
};

/// Two bodies whose positions go straight.
struct SweptPair {
  RotationBound bound_a, bound_b;

  /// Of a difference of any two points of theirs, in an interval so long.
  int64_t bend(int64_t length) const { return bound_a.bend(length) + bound_b.bend(length); }
  /// The bodies turn relative to each other by no more than that in an interval so long, Q30 rad.
  int64_t turn(int64_t length) const { return bound_a.turn(length) + bound_b.turn(length); }
  /// Of a difference of two points at a time. The rotations' 16 2^-30 of the reach, and eight roundings: of two
  /// corners, their images, the positions, the ways.
  int64_t ball() const {
    static_assert(k_turning_error == 16);
    return ((bound_a.reach + bound_b.reach) >> 26) + 9;
  }
};

/// Two bodies of constant velocity and constant spin, in world axes.
struct SteadyMotion : SweptPair {
  Turning turning_a, turning_b;
  Vec64 offset, displacement;  ///< of B from A, 2^-46 m

  PlacedPair at(int64_t time) const {
    return {turning_a.at(time), turning_b.at(time), add(offset, over_time(displacement, time))};
  }
};

/// Two poses of a pair between which it is asked about.
struct Ends {
  int64_t from, to;
  PlacedPair begin, end;
};

/// Features of two bodies in a motion that has at(), bend(), turn() and ball() as SteadyMotion.
template <class Motion>
struct FeaturePath {
  const Motion& motion;
  Ends ends;  ///< not asked of the motion again
  FeatureKind kind;
  bool swapped;     ///< the corners that FeatureKind gives to A are B's
  Vec64 corner[4];  ///< in their bodies' axes, 2^-46 m
  int64_t ball;     ///< of a difference at either end of an interval

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
