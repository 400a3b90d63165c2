#pragma once
#include <detent/convex.h>

#include "contact/collide.h"
#include "contact/contact_points.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// For contact_points_by(). False if the reach is negative, or none.
bool make_rules(const ContactReach& reach, ManifoldReduction reduction, ContactRules& rules);

struct ConvexOps {
  void (*collide)(const CollisionBody& a, const CollisionBody& b, const ContactReach& reach, const AssetTable& assets,
                  ManifoldReduction reduction, ContactGeometry& contact);
};

/// Contact of any two shapes but two half-spaces, by contact_points(). Fills an empty contact. `capped` also where a
/// hull's bytes are missing, or a position is out of its range.
void collide_convex(const CollisionBody& a, const CollisionBody& b, const ContactReach& reach, const AssetTable& assets,
                    ManifoldReduction reduction, ContactGeometry& contact);

/// Likewise, of these convex shapes at the bodies' poses: the bodies', or parts of them.
void collide_convexes(const CollisionBody& a, const Convex& convex_a, const CollisionBody& b, const Convex& convex_b,
                      const ContactReach& reach, ManifoldReduction reduction, ContactGeometry& contact);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
