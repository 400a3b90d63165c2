#pragma once
#include <detent/detail/scratch.h>

#include "math/arithmetic.h"
#include "math/root.h"
#include "math/rotation.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

#if defined(DETENT_F64)
inline constexpr Coord k_coord_limit = 0x1p1000;
#else
inline constexpr Coord k_coord_limit =
    Coord::from_raw(sizeof(Coord) == 8 ? static_cast<Coord::Raw>(INT64_MAX) : INT32_MAX);
#endif
inline constexpr Bounds k_everywhere = {{-k_coord_limit, -k_coord_limit, -k_coord_limit},
                                        {k_coord_limit, k_coord_limit, k_coord_limit}};

/// Empty bounds, which overlap no other bounds.
inline constexpr Bounds k_nowhere = {k_everywhere.upper, k_everywhere.lower};

/// The half extents, m, of the smallest axis-aligned bounds in world axes that are centred at the body's position and
/// contain the shape. Range: not a half-space. For a hull, terrain or compound, each component is the smaller one of
/// two bounds: that of the box of its half extents, and that of its bounding ball. Rounding: within 2^-28 of the body's
/// unit of length.
inline Vec3<Real> half_bounds(const BodyProperties& properties, const Matrix3& rotation) {
  const Unit zero = 0.0;
  Vec3<Unit> half = {zero, zero, zero};
  switch (static_cast<ShapeType>(properties.shape)) {
    case ShapeType::sphere:
      half = {properties.size.x, properties.size.x, properties.size.x};
      break;
    case ShapeType::capsule: {
      const Vec3<Unit>& axis = rotation.column[1];
      half = {abs(axis.x) * properties.size.y + properties.size.x, abs(axis.y) * properties.size.y + properties.size.x,
              abs(axis.z) * properties.size.y + properties.size.x};
      break;
    }
    case ShapeType::hull:
    case ShapeType::terrain:
    case ShapeType::compound:
    case ShapeType::box: {
      const Vec3<Unit>&x = rotation.column[0], &y = rotation.column[1], &z = rotation.column[2];
      half = {dot(Vec3<Unit>{abs(x.x), abs(y.x), abs(z.x)}, properties.size),
              dot(Vec3<Unit>{abs(x.y), abs(y.y), abs(z.y)}, properties.size),
              dot(Vec3<Unit>{abs(x.z), abs(y.z), abs(z.z)}, properties.size)};
      break;
    }
    case ShapeType::cylinder:
    case ShapeType::cone: {
      const Vec3<Unit>&x = rotation.column[0], &y = rotation.column[1], &z = rotation.column[2];
      const auto disc = [&](Unit a, Unit b) { return length(Vec3<Unit>{a, b, zero}) * properties.size.x; };
      const Vec3<Unit> rim = {disc(x.x, z.x), disc(x.y, z.y), disc(x.z, z.z)};
      const Vec3<Unit> axis = {abs(y.x) * properties.size.y, abs(y.y) * properties.size.y,
                               abs(y.z) * properties.size.y};
      half = rim + axis;
      if (static_cast<ShapeType>(properties.shape) == ShapeType::cylinder) break;
      const auto cone = [](Unit a, Unit r) { return max(a + scale_by_power(a, -1), scale_by_power(a, -1) + r); };
      half = {cone(axis.x, rim.x), cone(axis.y, rim.y), cone(axis.z, rim.z)};
      break;
    }
    default:
      break;
  }
  const ShapeType shape = static_cast<ShapeType>(properties.shape);
  if (!(properties.rounding == zero) && shape != ShapeType::compound)
    half += Vec3<Unit>{properties.rounding, properties.rounding, properties.rounding};
  if (shape == ShapeType::hull || shape == ShapeType::terrain || shape == ShapeType::compound) {
    const Unit ball = properties.bounding_radius;
    half = {min(half.x, ball), min(half.y, ball), min(half.z, ball)};
  }
  return real_from_unit(half, properties.size_exponent);
}

/// Enlarges `bounds` so that they contain `other`.
inline void include(const Bounds& other, Bounds& bounds) {
  const auto along = [](Coord other_lower, Coord other_upper, Coord& lower, Coord& upper) {
    if (other_lower < lower) lower = other_lower;
    if (upper < other_upper) upper = other_upper;
  };
  along(other.lower.x, other.upper.x, bounds.lower.x, bounds.upper.x);
  along(other.lower.y, other.upper.y, bounds.lower.y, bounds.upper.y);
  along(other.lower.z, other.upper.z, bounds.lower.z, bounds.upper.z);
}

DETENT_SHARED inline bool overlap(const Bounds& a, const Bounds& b) {
  // One branch for each axis, not two: a processor can hardly predict on which side of each other two bounds lie.
  const auto along = [](Coord lower_a, Coord upper_a, Coord lower_b, Coord upper_b) {
    return static_cast<int>(lower_a <= upper_b) & static_cast<int>(lower_b <= upper_a);
  };
  return along(a.lower.x, a.upper.x, b.lower.x, b.upper.x) != 0 &&
         along(a.lower.y, a.upper.y, b.lower.y, b.upper.y) != 0 &&
         along(a.lower.z, a.upper.z, b.lower.z, b.upper.z) != 0;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
