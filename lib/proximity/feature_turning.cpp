#include "proximity/feature_search.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr int k_range_bits = 14;

/// Of corners of a body that turns: their farthest from its position, and its angle over the step.
struct Sweep {
  int64_t reach;  ///< 2^-46 m
  int64_t angle;  ///< 2^-46 rad

  /// How far a corner may be from its chord over an interval so long: |x''| <= angle^2 reach over the step, and a chord
  /// is off by no more than an eighth of that and the interval's square. No farther than a diameter anyway.
  int64_t bend(int64_t length) const {
    const int64_t part = (over_time(angle, length) >> 16) + 1;  // Q30
    if (part >= int64_t{1} << 31) return 2 * reach;
    return part_of(reach, ((part * part) >> 33) + 1) + 1;
  }
};

/// Corners of two bodies in motion, from A's position.
struct TurningPath {
  FeatureKind kind;
  Vec64 corner[4];  ///< in their bodies' axes, 2^-46 m
  Turning turning_a, turning_b;
  Vec64 offset, displacement;  ///< of B from A
  Sweep sweep_a, sweep_b;
  int64_t ball;  ///< of a difference at either end

  FeatureSpan span(int64_t from, int64_t to) const {
    FeatureSpan span;
    span.count = difference_count(kind);
    set_differences_at(from, span.from);
    set_differences_at(to, span.to);
    span.ball = ball + sweep_a.bend(to - from) + sweep_b.bend(to - from);
    return span;
  }

 private:
  void set_differences_at(int64_t time, Vec64 (&difference)[4]) const {
    const Matrix32 a = turning_a.at(time), b = turning_b.at(time);
    const Vec64 way = add(offset, over_time(displacement, time));
    Vec64 placed[4];
    for (int i = 0; i < 4; ++i) {
      placed[i] = i < first_of_b(kind) ? rotated(a, corner[i]) : add(way, rotated(b, corner[i]));
    }
    set_differences(kind, placed, difference);
  }
};

}  // namespace

Status feature_toi(FeatureKind kind, const Vec3<Real> (&corner)[4], const Motion& motion_a, const Motion& motion_b,
                   FeatureToi& result) {
  if (!is_kind(kind)) return Status::bad_argument;
  TurningPath path;
  path.kind = kind;
  if (const Status status = turning_of(motion_a, path.turning_a); status != Status::ok) return status;
  if (const Status status = turning_of(motion_b, path.turning_b); status != Status::ok) return status;
  Vec64 way_a, way_b;
  if (!raw_corners(corner, k_range_bits, path.corner) || !raw_from_real(motion_a.displacement, way_a) ||
      !raw_from_real(motion_b.displacement, way_b) || !in_range(way_a, k_range_bits) ||
      !in_range(way_b, k_range_bits) ||
      !raw_difference(motion_b.start.position, motion_a.start.position, path.offset) ||
      !in_range(path.offset, k_range_bits)) {
    return Status::out_of_range;
  }
  path.displacement = add(way_b, negate(way_a));
  const int split = first_of_b(kind);
  path.sweep_a = {reach_of(path.corner, split), path.turning_a.angle};
  path.sweep_b = {reach_of(path.corner + split, 4 - split), path.turning_b.angle};
  // The rotations' 16 2^-30 of the reach, and eight roundings: of two corners, their images, the positions, the ways.
  static_assert(k_turning_error == 16);
  path.ball = ((path.sweep_a.reach + path.sweep_b.reach) >> 26) + 9;
  search(path, near_gap(size_of(kind, path.corner), path.ball), result);
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
