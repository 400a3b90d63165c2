#pragma once
#include <detent/math.h>

/// @file
/// Shapes: convex ones, compounds of them, and surfaces.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Which shape a Shape is. Stored in snapshots and recordings: a value is never reused.
enum class ShapeType : uint32_t {
  sphere = 1,      ///< sphere()
  capsule = 2,     ///< capsule()
  box = 3,         ///< box()
  half_space = 4,  ///< half_space()
  cylinder = 5,    ///< cylinder()
  cone = 6,        ///< cone()
  hull = 7,        ///< cooked bytes: an asset of the world; or made by make_hull() (convex.h)
  triangle = 8,    ///< made by make_triangle() (convex.h)
  surface = 9,     ///< surface()
  compound = 10,   ///< compound()
};

/// A shape in its body's frame, centred on the centre of mass. Build one with the functions below.
/// Sizes, m: [2^-14, 2^14] (0.06 mm to 16 km); the ratio of a shape's largest to its smallest size is at most 2^14.
/// In a world the bounding radius, `rounding` included, is below 2^15 m and at most 2^14 times the least size.
struct Shape {
  ShapeType type = ShapeType::sphere;         ///< which of the sizes below count
  Real radius = 0.5;                          ///< m; sphere, capsule, cylinder, and a cone's base
  Real half_length = 0.0;                     ///< m; along local y, half: a capsule's core segment, a cylinder, a cone
  Vec3<Real> half_extents = {0.5, 0.5, 0.5};  ///< m; box
  Real rounding = 0.0;  ///< m; box, cylinder, cone, hull: grown by a ball of this radius; 0, or a size
  uint32_t asset = 0;   ///< hull, surface, compound: index in the world's asset table
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
/// The cylinder about local y, of half the height `half_length`, m.
constexpr Shape cylinder(Real radius, Real half_length) {
  Shape shape;
  shape.type = ShapeType::cylinder;
  shape.radius = radius;
  shape.half_length = half_length;
  return shape;
}
/// The cone about local y, of half the height `half_length`, m: its base of the given radius at y = -half_length / 2,
/// its apex at y = 3 half_length / 2, so that the origin is its centre of mass.
constexpr Shape cone(Real radius, Real half_length) {
  Shape shape;
  shape.type = ShapeType::cone;
  shape.radius = radius;
  shape.half_length = half_length;
  return shape;
}
/// The cooked hull (docs/hull.md) that the world's asset `asset` holds, once bind_asset() has bound it. Its origin is
/// the body's; a dynamic body takes one of the principal frame. For create_body(); without a world: make_hull().
constexpr Shape hull(uint32_t asset) {
  Shape shape;
  shape.type = ShapeType::hull;
  shape.asset = asset;
  return shape;
}
/// The shape grown by a ball of radius `rounding`, m; for box, cylinder, cone and hull.
constexpr Shape rounded(Shape shape, Real rounding) {
  shape.rounding = rounding;
  return shape;
}
/// The triangle mesh (docs/mesh.md) or height field (docs/height_field.md) that the world's asset `asset` holds, once
/// bind_asset() has bound it; for static and kinematic bodies only. Its origin is the body's. It has no inside: what
/// comes to lie beyond it is pushed out on that side, or from behind a one-sided one not at all.
constexpr Shape surface(uint32_t asset) {
  Shape shape;
  shape.type = ShapeType::surface;
  shape.asset = asset;
  return shape;
}
/// The compound of convex shapes (docs/compound.md) that the world's asset `asset` holds, once bind_asset() has bound
/// it. Its origin is the body's; it is rounded where it was cooked so.
constexpr Shape compound(uint32_t asset) {
  Shape shape;
  shape.type = ShapeType::compound;
  shape.asset = asset;
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
