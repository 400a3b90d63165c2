#pragma once
#include <detent/math.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Stored in snapshots and recordings: a value is never reused.
enum class ShapeType : uint32_t { sphere = 1, capsule = 2, box = 3, half_space = 4 };

/// A convex shape in its body's frame, centred on the centre of mass. Build one with the functions below.
/// Sizes, m: [2^-14, 2^14] (0.06 mm to 16 km); the ratio of a shape's largest to its smallest size is at most 2^14.
struct Shape {
  ShapeType type = ShapeType::sphere;
  Real radius = 0.5;                          ///< m; sphere and capsule
  Real half_length = 0.0;                     ///< m; capsule: half the length of its core segment along local y
  Vec3<Real> half_extents = {0.5, 0.5, 0.5};  ///< m; box
};

/// A ball of the given radius, m.
constexpr Shape sphere(Real radius) {
  Shape shape;
  shape.type = ShapeType::sphere;
  shape.radius = radius;
  return shape;
}
/// All points within `radius` of the segment from (0, -half_length, 0) to (0, half_length, 0), m.
constexpr Shape capsule(Real radius, Real half_length) {
  Shape shape;
  shape.type = ShapeType::capsule;
  shape.radius = radius;
  shape.half_length = half_length;
  return shape;
}
/// The box |x| <= half_extents.x, |y| <= half_extents.y, |z| <= half_extents.z, m.
constexpr Shape box(Vec3<Real> half_extents) {
  Shape shape;
  shape.type = ShapeType::box;
  shape.half_extents = half_extents;
  return shape;
}
/// The solid half-space y <= 0 of the body's frame; for static and kinematic bodies only.
constexpr Shape half_space() {
  Shape shape;
  shape.type = ShapeType::half_space;
  return shape;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
