#pragma once
#include "contact/collide.h"
#include "contact/terrain_manifolds.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Finds the contacts of terrain (a mesh or height field, of the body `ground`) with a convex shape, up to a separation
/// of `margin.distance`, m. `shape`: the shape of `body` or a part of it, in the axes of `body`. `middle`: the middle
/// of `shape`, in the axes of `body`, in units of 2^-46 m. It decides on which side of the terrain the shape is.
/// Precision: 2^-28 of the sum of the body's size and the triangle's extent. Stack: 16 KB.
void collide_mesh(const Terrain& terrain, const CollisionBody& ground, const CollisionBody& body, const Convex& shape,
                  const Vec64& middle, const ContactMargins& margin, TerrainContacts& contacts);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
