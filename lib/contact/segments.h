#pragma once
#include "math/arithmetic.h"
#include "math/root.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// A segment, or a point if `half_length` is 0.
struct Segment {
  Vec3<Unit> centre;
  Vec3<Unit> direction;  ///< of unit length
  Unit half_length;
};

/// Returns the point of the segment's line at the signed distance `along` from the centre.
inline Vec3<Unit> point_at(const Segment& segment, Unit along) { return segment.centre + segment.direction * along; }

/// Returns numerator / denominator, clamped to +-limit. Range: denominator > 0, limit < 2.
inline Unit divide_clamped(Unit numerator, Unit denominator, Unit limit) {
  const Unit edge = limit * denominator;
  if (numerator >= edge) return limit;
  if (numerator <= -edge) return -limit;
  return divide(numerator, denominator);
}

/// Finds the closest points of two segments. Sets `along_a` and `along_b` to the signed distance of each point from the
/// centre of its segment. If the segments are within 2^-11 rad of parallel, one of the two points is the middle of A or
/// an end of a segment. Error: 2^-29 / |a x b| of the unit of length, where a and b are the directions of the segments.
/// Source: the common perpendicular of two lines, clamped as in Ericson, "Real-Time Collision Detection", 5.1.9.
inline void closest_points(const Segment& a, const Segment& b, Unit& along_a, Unit& along_b) {
  const Vec3<Unit> between = b.centre - a.centre;
  const Unit cosine = dot(a.direction, b.direction);
  Vec3<Unit> across;
  Unit sine = 0.0;
  along_a = 0.0;
  if (normalise(cross(a.direction, b.direction), across, sine) && sine > Unit(0x1p-11))
    along_a = divide_clamped(dot(cross(between, b.direction), across), sine, a.half_length);
  const Unit free_b = cosine * along_a - dot(b.direction, between);
  along_b = clamp(free_b, -b.half_length, b.half_length);
  if (!(along_b == free_b))
    along_a = clamp(cosine * along_b + dot(a.direction, between), -a.half_length, a.half_length);
}

/// Shortens the range [low, high] of positions along a segment to the part that is within the lateral distance `room`
/// of a line. The segment crosses the line at the position `along`; from there, its lateral distance grows by |rate|
/// per unit of length.
inline void stay_beside(Unit rate, Unit room, Unit along, Unit& low, Unit& high) {
  const Unit aside = abs(rate);
  if (aside * (along - low) > room) low = along - divide(room, aside);
  if (aside * (high - along) > room) high = along + divide(room, aside);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
