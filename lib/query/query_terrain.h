#pragma once
#include "contact/terrain_ops.h"
#include "world/query_bodies.h"

/// Queries against a body that is a terrain (a mesh or height field), triangle by triangle. They call the terrain code
/// only through the world's feature table. So a program without terrains does not link this code.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// A body that is a terrain and whose asset bytes are present.
struct AskedSurface {
  const TerrainOps& code;
  Terrain terrain;
  Pose pose;
};

/// Whether the program has the bytes of a body's terrain.
inline bool has_terrain_bytes(const World& world, const BodyProperties& properties) {
  return is_in(world.hooks.assets, properties.asset);
}
inline AskedSurface asked_terrain(const World& world, const BodyProperties& properties, const BodyPose& pose) {
  const TerrainOps& code = *world.features->terrain;
  return {code, code.view(world.hooks.assets.assets[properties.asset].bytes), {pose.position, pose.rotation}};
}

/// Finds the first triangle that the shape hits on its path. A point is cast as a ray. Sets `touched` to whether a
/// triangle is hit. If so, sets all of `hit` but the body. Errors: those of the narrow phase, for any of the nearby
/// triangles; `touched` and `hit` are then unchanged.
Status cast_on_terrain(const AskedSurface& ground, const QueryShape& shape, const Motion& motion, QueryHit& hit,
                       bool& touched);
/// The triangle nearest to the shape, which is searched up to the distance `distance_max`, m, so that a hit may also be
/// farther. Results as for cast_on_terrain().
Status near_on_terrain(const AskedSurface& ground, const QueryShape& shape, const Pose& at, Real distance_max,
                       QueryHit& hit, bool& touched);
/// The normal of a triangle on the side of a point, in world axes, and the height of the point above the plane on that
/// side, m. For a one-sided terrain the side is always the front, so the height may be negative. Errors: as
/// place_on_terrain().
Status side_of_triangle(const AskedSurface& ground, uint32_t triangle, const Pose& at, Vec3<Unit>& normal,
                        Real& height);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
