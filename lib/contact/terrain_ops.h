#pragma once
#include "contact/collide_mesh.h"
#include "contact/terrain_query.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Returns a view of the body's terrain (mesh or height field). Range: the body has terrain.
DETENT_SHARED inline Terrain terrain_of(const BodyProperties& properties, const AssetTable& assets) {
  return terrain_view(assets.assets[properties.asset].bytes);
}

/// Finds the contacts of two bodies, one of which has terrain. The normals point from A to B. Terrain has no contacts
/// with other terrain or with a half-space.
void collide_terrain(const CollisionBody& a, const CollisionBody& b, const ContactMargins& margin,
                     const AssetTable& assets, TerrainContacts& contacts);

/// As collide_terrain(), but for one convex part of the body that is not terrain. `part` and its middle, `middle`
/// (2^-46 m), are in the axes of that body.
void collide_part_with_terrain(const CollisionBody& a, const CollisionBody& b, const Convex& part, const Vec64& middle,
                               const ContactMargins& margin, const AssetTable& assets, TerrainContacts& contacts);

/// Entry of FeatureTable (detent/features.h): the functions for terrain.
struct TerrainOps {
  decltype(&read_terrain) read;
  decltype(&collide_terrain) collide;
  decltype(&collide_part_with_terrain) collide_part;
  decltype(&visit_terrain) visit;
  decltype(&terrain_convex) convex;
  decltype(&place_on_terrain) place;
  decltype(&terrain_view) view;
  decltype(&terrain_triangle) triangle;
  decltype(&cast_ray_on_terrain) cast_ray;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
