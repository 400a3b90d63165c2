#pragma once
#include "contact/terrain_ops.h"
#include "world/query_bodies.h"

/// Queries against a body that is a terrain (a mesh or height field), triangle by triangle. They call the terrain code
/// only through the world's feature table. Therefore a program without terrains does not link the terrain code.
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
/// triangle is hit. If so, sets all of `hit` but the body. Errors: those of the narrow phase for any nearby triangle;
/// `touched` and `hit` then do not change.
Status cast_on_terrain(const AskedSurface& ground, const QueryShape& shape, const Motion& motion, QueryHit& hit,
                       bool& touched);
/// Finds the triangle nearest to the shape. The search covers at least all triangles within `distance_max`, m; the
/// triangle found may be farther away than this. Results as for cast_on_terrain().
Status near_on_terrain(const AskedSurface& ground, const QueryShape& shape, const Pose& at, Real distance_max,
                       QueryHit& hit, bool& touched);
/// Sets `normal` to the normal of a triangle, in world axes, on the side of the triangle on which the position of `at`
/// lies, and `height` to the height of this position above the triangle's plane, m. For a one-sided terrain, `normal`
/// is always that of the front, so the height may be negative. Errors: as place_on_terrain().
Status side_of_triangle(const AskedSurface& ground, uint32_t triangle, const Pose& at, Vec3<Unit>& normal,
                        Real& height);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
