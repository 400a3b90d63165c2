#pragma once
#include <detent/distance.h>

#include "contact/collide.h"
#include "contact/contact_points.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Makes the rules for contact_points_by() from the margins. Returns false if `margin.distance` is negative, or if a
/// length is NaN, infinite, or 2^17 m or more.
bool make_rules(const ContactMargins& margin, ManifoldReduction reduction, ContactRules& rules);

/// Entry of FeatureTable (detent/features.h): the function for pairs with a cylinder, a cone, a hull or a rounded
/// shape.
struct ConvexOps {
  void (*collide)(const CollisionBody& a, const CollisionBody& b, const ContactMargins& margin,
                  const AssetTable& assets, ManifoldReduction reduction, ContactGeometry& contact);
};

/// Finds the contact of two bodies with convex shapes, at most one of them a half-space, by contact_points(). `contact`
/// must be empty. Also sets `contact.capped` if the bytes of a hull are missing or a position is out of range.
void collide_convex(const CollisionBody& a, const CollisionBody& b, const ContactMargins& margin,
                    const AssetTable& assets, ManifoldReduction reduction, ContactGeometry& contact);

/// As collide_convex(), but with the convex shapes `convex_a` and `convex_b`, in the axes of the bodies. Each of them
/// is the shape of its body or a part of that shape.
void collide_convexes(const CollisionBody& a, const Convex& convex_a, const CollisionBody& b, const Convex& convex_b,
                      const ContactMargins& margin, ManifoldReduction reduction, ContactGeometry& contact);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
