#pragma once
#include <detent/numbers.h>

/// @file
/// Shapes: convex shapes, compounds of convex shapes, and terrains (meshes and height fields).
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The type of a Shape. Stored in snapshots and recordings: a value is never reused.
enum class ShapeType : uint32_t {
  sphere = 1,      ///< sphere()
  capsule = 2,     ///< capsule()
  box = 3,         ///< box()
  half_space = 4,  ///< half_space()
  cylinder = 5,    ///< cylinder()
  cone = 6,        ///< cone()
  hull = 7,        ///< hull(): a cooked asset of the world; or made by make_hull() (distance.h)
  triangle = 8,    ///< made by make_triangle() (distance.h)
  terrain = 9,     ///< terrain()
  compound = 10,   ///< compound()
};

/// A shape in its body's frame, centred on the centre of mass. Make one with the functions below.
/// The *sizes* of a shape are those of its members `radius`, `half_length` and `half_extents` that its type uses. Each
/// size is in [2^-14, 2^14] m (0.06 mm to 16 km), and the largest is at most 2^14 times the smallest. In a world, the
/// bounding radius (with `rounding`) must be below 2^15 m and at most 2^14 times the smallest size.
struct Shape {
  ShapeType type = ShapeType::sphere;  ///< selects which of the members below are used
  Real radius = 0.5;                   ///< m; of a sphere, capsule, cylinder, and of a cone's base
  Real half_length = 0.0;  ///< m; half the length of a capsule's core segment, a cylinder or a cone, along local y
  Vec3<Real> half_extents = {0.5, 0.5, 0.5};  ///< m; of a box
  Real rounding = 0.0;  ///< m; radius of the ball that rounds a box, cylinder, cone or hull; 0, or a valid size
  uint32_t asset = 0;   ///< of a hull, terrain or compound: index in the world's asset table
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
/// The cylinder about local y, of height 2 half_length, m.
constexpr Shape cylinder(Real radius, Real half_length) {
  Shape shape;
  shape.type = ShapeType::cylinder;
  shape.radius = radius;
  shape.half_length = half_length;
  return shape;
}
/// The cone about local y, of height 2 half_length, m. Its base, of the given radius, m, is at y = -half_length / 2;
/// its apex is at y = 3 half_length / 2. Therefore the origin is its centre of mass.
constexpr Shape cone(Real radius, Real half_length) {
  Shape shape;
  shape.type = ShapeType::cone;
  shape.radius = radius;
  shape.half_length = half_length;
  return shape;
}
/// The cooked hull (docs/hull.md) of the asset with the index `asset`, which bind_asset() must have bound. The hull's
/// origin is the body's origin. A dynamic body needs a hull in its principal frame (HullFrame). This shape is for
/// create_body(); without a world, use make_hull().
constexpr Shape hull(uint32_t asset) {
  Shape shape;
  shape.type = ShapeType::hull;
  shape.asset = asset;
  return shape;
}
/// Returns the Minkowski sum of `shape` and a ball of radius `rounding`, m. Range: `shape` is a box, cylinder, cone or
/// hull.
constexpr Shape rounded(Shape shape, Real rounding) {
  shape.rounding = rounding;
  return shape;
}
/// A terrain: the triangle mesh (docs/mesh.md) or height field (docs/height_field.md) of the asset with the index
/// `asset`, which bind_asset() must have bound. Only fixed and kinematic bodies can have this shape. The terrain's
/// origin is the body's origin. A terrain is a surface without an inside: it pushes a body on its back side out on
/// that side. A one-sided terrain does not push bodies on its back side.
constexpr Shape terrain(uint32_t asset) {
  Shape shape;
  shape.type = ShapeType::terrain;
  shape.asset = asset;
  return shape;
}
/// The compound of convex shapes (docs/compound.md) of the asset with the index `asset`, which bind_asset() must have
/// bound. The compound's origin is the body's origin. Its parts have the rounding of the cooked data.
constexpr Shape compound(uint32_t asset) {
  Shape shape;
  shape.type = ShapeType::compound;
  shape.asset = asset;
  return shape;
}
/// The solid half-space y <= 0 of the body's frame; for fixed and kinematic bodies only.
constexpr Shape half_space() {
  Shape shape;
  shape.type = ShapeType::half_space;
  return shape;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
