#pragma once
#include "contact/collide.h"
#include "contact/surface_manifolds.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Finds where a convex shape in a body's axes, the body's or a part of it, touches a surface's body, no farther apart
/// than `reach`, m. `middle`: of the shape, in those axes, 2^-46 m: which side of the surface it is on.
/// Precision: 2^-28 of the body's size and the extent of the triangle together. Stack: 16 KB.
void collide_mesh(const Surface& surface, const CollisionBody& ground, const CollisionBody& body, const Convex& shape,
                  const Vec64& middle, const ContactReach& reach, SurfaceContacts& contacts);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
