#pragma once
#include "contact/collide.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

struct HalfSpaceOps {
  void (*collide)(const CollisionBody& plane, const CollisionBody& body, Real margin, ContactGeometry& contact);
};

/// (to - from) . direction, m. The plane's origin may be 10,000 km away. Fixed point: exact but for one rounding,
/// clamped to Real's range. Floating point: each operation rounds.
Real distance_along(const Position& from, const Position& to, const Vec3<Unit>& direction);

/// Finds the contact of a half-space (A) with a sphere, capsule or unrounded box (B). The contact points are those of
/// these points of B that are within the margin of the plane: the lowest point of the sphere or of each end of the
/// capsule, or the corners of the face of the box that faces the plane most directly. `contact` must be empty.
void collide_half_space(const CollisionBody& plane, const CollisionBody& body, Real margin, ContactGeometry& contact);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
