#pragma once
#include "math/arithmetic.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// A segment, or with half_length 0 a point.
struct Segment {
  Vec3<Unit> centre;
  Vec3<Unit> direction;  ///< of unit length
  Unit half_length;
};

/// The point at `along` from the centre.
inline Vec3<Unit> point_at(const Segment& segment, Unit along) { return segment.centre + segment.direction * along; }

/// numerator / denominator held to +-limit; the denominator is positive, the limit below 2.
inline Unit divide_clamped(Unit numerator, Unit denominator, Unit limit) {
  const Unit edge = limit * denominator;
  if (numerator >= edge) return limit;
  if (numerator <= -edge) return -limit;
  return divide(numerator, denominator);
}

/// Where two segments are closest, as distances along each from its centre. Of parallel segments, a pair that contains
/// the middle of A or an end. Error: 2^-29 / (1 - (a.b)^2) of the unit of length along the segments.
/// Source: the clamped normal equations, as in Ericson, "Real-Time Collision Detection", 5.1.9.
inline void closest_points(const Segment& a, const Segment& b, Unit& along_a, Unit& along_b) {
  const Unit zero = 0.0;
  const Vec3<Unit> offset = a.centre - b.centre;
  const Unit cosine = dot(a.direction, b.direction);
  const Unit offset_a = dot(a.direction, offset);
  const Unit offset_b = dot(b.direction, offset);
  const Unit sine_squared = Unit(1.0) - cosine * cosine;
  along_a = zero;
  if (sine_squared > Unit(0x1p-16)) {
    along_a = divide_clamped(cosine * offset_b - offset_a, sine_squared, a.half_length);
  }
  const Unit free_b = cosine * along_a + offset_b;
  along_b = clamp(free_b, -b.half_length, b.half_length);
  if (!(along_b == free_b)) along_a = clamp(cosine * along_b - offset_a, -a.half_length, a.half_length);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
