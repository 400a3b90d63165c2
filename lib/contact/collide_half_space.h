#pragma once
#include "contact/collide.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

struct HalfSpaceOps {
  void (*collide)(const CollisionBody& plane, const CollisionBody& body, Real reach, ContactGeometry& contact);
};

/// (to - from) . direction, m, exact but for one rounding, clamped to Real's range: the plane's origin may be 10,000 km
/// off.
Real distance_along(const Position& from, const Position& to, const Vec3<Unit>& direction);

/// Contact of a half-space (A) with any other shape (B): the lowest points of B over the plane. Appends to an empty
/// contact.
void collide_half_space(const CollisionBody& plane, const CollisionBody& body, Real reach, ContactGeometry& contact);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
