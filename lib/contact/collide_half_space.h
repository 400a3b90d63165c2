#pragma once
#include "contact/collide.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

struct HalfSpaceOps {
  void (*collide)(const CollisionBody& plane, const CollisionBody& body, Real margin, ContactGeometry& contact);
};

/// (to - from) . direction, m. The two points may be 10,000 km apart, because the origin of a plane may be far away.
/// Fixed point: exact but for one rounding, clamped to Real's range. Floating point: each operation rounds.
Real distance_along(const Position& from, const Position& to, const Vec3<Unit>& direction);

/// Finds the contact of a half-space (A) with a sphere, capsule or unrounded box (B). Candidates are the lowest point
/// of the sphere, the lowest point of each end of the capsule, or the four corners of that face of the box that faces
/// the plane most directly. The candidates at a height of at most `margin`, m, above the plane become contact points.
/// `contact` must be empty.
void collide_half_space(const CollisionBody& plane, const CollisionBody& body, Real margin, ContactGeometry& contact);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
