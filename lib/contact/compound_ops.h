#pragma once
#include <detent/contact.h>

#include "contact/terrain_ops.h"
#include "shape/compound.h"
#include "shape/shape_properties.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The convex parts of a body: the children of a compound, or the single shape of any other body. All parts are in the
/// body's frame, so the body's pose and motion apply to each of them.
class ConvexParts {
 public:
  ConvexParts(const BodyProperties& properties, const AssetTable& assets);

  uint32_t count() const { return count_; }
  /// Sets `convex` to part `i`. Returns false if an asset is missing. If `inner` is true and the part is a hull child
  /// of a compound, takes the child's inner hull: a smaller hull inside it, for tests of bodies that penetrate deeply.
  bool convex(uint32_t i, bool inner, Convex& convex) const;
  /// The number that stands for part `i` in ContactGeometryPoint::part: the child's number, counted from 1; 0 if the
  /// body is not a compound.
  uint32_t name(uint32_t i) const { return whole() ? 0 : i + 1; }
  /// Sets `middle` and `half` to the middle and the half extents of the part's bounds in the body's axes, 2^-46 m. For
  /// a body that is not a compound, these are the bounds of its bounding ball. For a half-space the half extents are
  /// zero, so the caller must not cull it.
  void place(uint32_t i, Vec64& middle, Vec64& half) const;

 private:
  bool whole() const { return compound_.bytes == nullptr; }

  const BodyProperties& properties_;
  const AssetTable& assets_;
  CompoundView compound_;
  uint32_t count_;
};

/// Finds the contacts of two bodies, at least one of which is a compound. Normals point from A to B. Points in one
/// plane form one contact, whichever parts they belong to. The result has at most k_terrain_manifolds_max contacts:
/// TerrainManifolds merges or drops the touches of further planes.
void collide_compound(const CollisionBody& a, const CollisionBody& b, const ContactMargins& margin,
                      const AssetTable& assets, ManifoldReduction reduction, const FeatureTable& features,
                      TerrainContacts& contacts);

/// Entry of FeatureTable (detent/features.h): the functions for compounds.
struct CompoundOps {
  decltype(&read_compound) read;
  decltype(&collide_compound) collide;
};

/// Finds the contacts of two bodies that can have several contacts: those for which has_parts() is true.
inline void collide_parts(const CollisionBody& a, const CollisionBody& b, const ContactMargins& margin,
                          const AssetTable& assets, ManifoldReduction reduction, const FeatureTable& features,
                          TerrainContacts& contacts) {
  if (is_compound(a.properties) || is_compound(b.properties))
    features.compound->collide(a, b, margin, assets, reduction, features, contacts);
  else
    features.terrain->collide(a, b, margin, assets, contacts);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
