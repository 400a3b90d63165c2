#pragma once
#include "collision/collide.h"
#include "collision/surface_manifolds.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// One flat contact of a body with a mesh or height field.
struct SurfaceContact {
  ContactGeometry geometry;  ///< A is the surface; `normal` from it to the body
  uint32_t key;              ///< the same while the body stays on the same plane or edge; distinct, never 0
  uint32_t triangle;         ///< the one met deepest
  uint8_t material;          ///< its own
};

struct SurfaceContacts {
  uint32_t count = 0;    ///< ascending by key
  uint32_t dropped = 0;  ///< triangles touched that have found no room: those met deepest are kept
  bool capped = false;   ///< a search met its cap, a hull's bytes are missing, or a position is out of range
  SurfaceContact contact[k_surface_manifolds_max];
};

/// Finds where a body touches a surface's body, no farther apart than `reach`, m. Not for half-spaces and surfaces.
/// Precision: 2^-28 of the body's size and the extent of the triangle together. Stack: 16 KB.
void collide_mesh(const Surface& surface, const CollisionBody& ground, const CollisionBody& body, Real reach,
                  const AssetTable& assets, SurfaceContacts& contacts);

/// Likewise, of a convex part of a body, in the body's axes; `middle`: of the part, there,
/// 2^-46 m.
void collide_mesh(const Surface& surface, const CollisionBody& ground, const CollisionBody& body, const Convex& convex,
                  const Vec64& middle, Real reach, SurfaceContacts& contacts);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
