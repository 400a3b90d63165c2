#pragma once
#include <detent/reduction.h>

#include "contact/surface_ops.h"
#include "shape/compound.h"
#include "shape/shape_traits.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The convex parts of a body: the children of a compound, or the one shape that any other body has. All at the body's
/// own position and rotation, so that its motion is theirs.
class ConvexParts {
 public:
  ConvexParts(const BodyTraits& traits, const AssetTable& assets);

  uint32_t count() const { return count_; }
  /// False where an asset is missing. `inner`: of a hull of a compound the one within it.
  bool convex(uint32_t i, bool inner, Convex& convex) const;
  /// 0 of a body that is no compound; else the child's number, from 1 on.
  uint32_t name(uint32_t i) const { return whole() ? 0 : i + 1; }
  /// Where the part is, 2^-46 m, in the body's axes: `middle` and the half extents of its bounds, of a body that is no
  /// compound its bounding ball's. Of a half-space no half extents: it is never far.
  void place(uint32_t i, Vec64& middle, Vec64& half) const;
  /// How far from the middle the part reaches, m.
  Real reach(uint32_t i) const;

 private:
  bool whole() const { return compound_.bytes == nullptr; }

  const BodyTraits& traits_;
  const AssetTable& assets_;
  CompoundView compound_;
  uint32_t count_;
};

/// The contacts of two bodies of which one is a compound; normals from A to B. What lies in one plane is one contact,
/// whatever parts it is of; of the planes the deepest k_surface_manifolds_max are kept.
void collide_compound(const CollisionBody& a, const CollisionBody& b, const ContactReach& reach,
                      const AssetTable& assets, ManifoldReduction reduction, const FeatureTable& features,
                      SurfaceContacts& contacts);

/// For a feature table.
struct CompoundOps {
  decltype(&read_compound) read;
  decltype(&collide_compound) collide;
};

/// The contacts of two bodies that can have more than one: has_parts().
inline void collide_parts(const CollisionBody& a, const CollisionBody& b, const ContactReach& reach,
                          const AssetTable& assets, ManifoldReduction reduction, const FeatureTable& features,
                          SurfaceContacts& contacts) {
  if (is_compound(a.traits) || is_compound(b.traits))
    features.compound->collide(a, b, reach, assets, reduction, features, contacts);
  else
    features.surface->collide(a, b, reach, assets, contacts);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
