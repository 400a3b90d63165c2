#pragma once
#include "contact/collide.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Entry of FeatureTable (detent/features.h): the function for pairs with a half-space.
struct HalfSpaceOps {
  void (*collide)(const CollisionBody& plane, const CollisionBody& body, Real margin, ContactGeometry& contact);
};

/// Returns (to - from) . direction, m. The two points may be 10,000 km apart, because the origin of a plane may be far
/// away. Fixed point: rounded once, clamped to Real's range. Floating point: each operation rounds.
Real distance_along(const Position& from, const Position& to, const Vec3<Unit>& direction);

/// Finds the contact of a half-space (A) with a sphere, capsule or unrounded box (B). The candidates for contact points
/// are the lowest point of the sphere, the lowest point of each end of the capsule, or the four corners of the box face
/// that faces the plane most directly. A candidate becomes a contact point if it lies at most `margin`, m, above the
/// plane. `contact` must be empty.
void collide_half_space(const CollisionBody& plane, const CollisionBody& body, Real margin, ContactGeometry& contact);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
