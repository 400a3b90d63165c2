#pragma once
#include "contact/collide.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// What of a pair's contact is kept, so that it can be used again. All zero where it is not: contacts of fewer than
/// three points, about which a body turns or rolls; those with a half-space, which are found as fast;
/// capped searches; and bodies deep in each other.
ManifoldState kept_manifold(const CollisionBody& a, const CollisionBody& b, const ContactGeometry& contact);

/// Not of what is all zero.
bool is_kept(const ManifoldState& manifold);

/// The contact of `before`, whose features are `feature`, with its points moved along: normal and base's surface go
/// with the base, the points with the other body, and separations follow the motion along the normal. Points farther
/// apart than `reach`, m, are left out, of `after` too. False if a point of the smaller body may have moved, as the
/// larger one sees it, by more than `tolerance`, m, or fewer than three points are left: the pair is to be collided
/// anew.
///
/// Precision: as collide(), and 2^-17 of the motion; always from what was kept, so that nothing adds up. The normal's
/// direction is within the pair's turn since then, at most 2 tolerance / the smaller body's bounding diameter.
bool reuse_manifold(const CollisionBody& a, const CollisionBody& b, const ManifoldState& before,
                    const uint32_t (&feature)[k_manifold_points_max], uint32_t count, Real tolerance, Real reach,
                    ContactGeometry& contact, ManifoldState& after);

/// True of what kept_manifold() gives for a contact of `count` points, and of whatever can be used as well.
bool is_manifold(const BodyTraits& a, const BodyTraits& b, uint32_t count, const ManifoldState& manifold);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
