#pragma once
#include "collision/collide.h"
#include "collision/surface_manifolds.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// One flat contact of a body with a mesh or height field; or of two convex parts, of which one is a compound's.
struct SurfaceContact {
  ContactGeometry geometry;  ///< A is the surface; `normal` from it to the body
  uint32_t key;              ///< the same while the body stays on the same plane or edge; distinct, never 0
  uint32_t triangle;         ///< the one met deepest; 0 where there is no surface
  uint8_t material;          ///< its own; likewise
};

struct SurfaceContacts {
  uint32_t count = 0;    ///< ascending by key
  uint32_t dropped = 0;  ///< triangles, or pairs of parts, touched that have found no room: the deepest are kept
  bool capped = false;   ///< a search met its cap, an asset's bytes are missing, or a position is out of range
  SurfaceContact contact[k_surface_manifolds_max];
};

/// Finds where a convex shape in a body's axes, the body's or a part of it, touches a surface's body, no farther apart
/// than `reach`, m. `middle`: of the shape, in those axes, 2^-46 m: which side of the surface it is on.
/// Precision: 2^-28 of the body's size and the extent of the triangle together. Stack: 16 KB.
void collide_mesh(const Surface& surface, const CollisionBody& ground, const CollisionBody& body, const Convex& shape,
                  const Vec64& middle, Real reach, SurfaceContacts& contacts);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
