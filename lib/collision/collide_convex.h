#pragma once
#include "collision/collide.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

struct ConvexCode {
  void (*collide)(const CollisionBody& a, const CollisionBody& b, Real reach, const AssetTable& assets,
                  ManifoldReduction reduction, ContactGeometry& contact);
};

/// Contact of any two shapes but two half-spaces, by contact_points(). Fills an empty contact. `capped` also where a
/// hull's bytes are missing, or a position is out of its range.
void collide_convex(const CollisionBody& a, const CollisionBody& b, Real reach, const AssetTable& assets,
                    ManifoldReduction reduction, ContactGeometry& contact);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
