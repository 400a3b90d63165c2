#pragma once
#include "contact/collide_mesh.h"
#include "contact/surface_query.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// A view of the terrain (mesh or height field) of a body that has one.
inline Surface surface_of(const BodyTraits& traits, const AssetTable& assets) {
  return surface_view(assets.assets[traits.asset].bytes);
}

/// Finds the contacts of two bodies, one of which has terrain; normals from A to B. Two bodies with terrain have no
/// contacts.
void collide_surface(const CollisionBody& a, const CollisionBody& b, const ContactReach& reach,
                     const AssetTable& assets, SurfaceContacts& contacts);

/// The same for one convex part of the body without terrain. The part and its middle, `middle` (2^-46 m), are in the
/// axes of that body.
void collide_part_with_surface(const CollisionBody& a, const CollisionBody& b, const Convex& part, const Vec64& middle,
                               const ContactReach& reach, const AssetTable& assets, SurfaceContacts& contacts);

/// For a feature table.
struct SurfaceOps {
  decltype(&read_surface) read;
  decltype(&collide_surface) collide;
  decltype(&collide_part_with_surface) collide_part;
  decltype(&visit_surface) visit;
  decltype(&surface_convex) convex;
  decltype(&place_on_surface) place;
  decltype(&surface_view) view;
  decltype(&surface_triangle) triangle;
  decltype(&cast_ray_on_surface) cast_ray;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
