#pragma once
#include "contact/surface_ops.h"
#include "world/query_bodies.h"

/// Questions to a body that has a surface: to its triangles, one by one. Called through the world's table alone, so
/// that a program without surfaces links none of their formats.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// A body with a surface, whose bytes are there.
struct AskedSurface {
  const SurfaceOps& code;
  Surface surface;
  Pose pose;
};

/// Whether the program has the bytes of a body's surface.
inline bool has_surface_bytes(const World& world, const BodyTraits& traits) {
  return is_in(world.assets, traits.asset);
}
inline AskedSurface asked_surface(const World& world, const BodyTraits& traits, const BodyPose& pose) {
  const SurfaceOps& code = *world.features->surface;
  return {code, code.view(world.assets.assets[traits.asset].bytes), {pose.position, pose.rotation}};
}

/// The first triangle that the shape meets on its way: by a ray if it is a point that need not turn. `met` tells
/// whether there is one; `hit` tells what is known of it, but for the body. Errors: those of the narrow phase, for any
/// of the triangles near.
Status cast_on_surface(const AskedSurface& ground, const QueryShape& shape, const Motion& motion, QueryHit& hit,
                       bool& met);
/// Likewise the triangle nearest to the shape within `reach`.
Status near_on_surface(const AskedSurface& ground, const QueryShape& shape, const Pose& at, Real reach, QueryHit& hit,
                       bool& met);
/// The side of a triangle that a point is on: its normal, in world axes, and how far from its plane the point is, m.
/// Errors: as place_on_surface().
Status side_of_triangle(const AskedSurface& ground, uint32_t triangle, const Pose& at, Vec3<Unit>& normal,
                        Real& height);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
