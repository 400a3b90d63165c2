#pragma once
#include "collision/collide_mesh.h"
#include "collision/surface_query.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The bound surface of a body that has one.
inline Surface surface_of(const BodyTraits& traits, const AssetTable& assets) {
  return surface_view(assets.assets[traits.asset].bytes);
}

/// The contacts of two bodies of which one has a surface; normals from A to B. A pair of two surfaces has none.
void collide_surface(const CollisionBody& a, const CollisionBody& b, Real reach, const AssetTable& assets,
                     SurfaceContacts& contacts);

/// For a feature table.
struct SurfaceCode {
  decltype(&read_surface) read;
  decltype(&collide_surface) collide;
  decltype(&visit_surface) visit;
  decltype(&surface_convex) convex;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
