#pragma once
#include <detent/asset.h>
#include <detent/detail/state.h>
#include <detent/features.h>
#include <detent/reduction.h>

#include "math/rotation.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

struct ContactGeometryPoint {
  Vec3<Unit> arm_a, arm_b;  ///< from the centre of mass to midway between the surfaces, in each body's unit of length
  Real separation;          ///< along the normal, m; negative when overlapping
  uint32_t feature;         ///< distinct within the contact, stable while the same features meet; never 0
  uint32_t part = 0;        ///< of compounds: (child of A) 2^16 + (child of B), counted from 1
};

/// What two bodies have contact points for.
struct ContactReach {
  Real distance;    ///< how far apart they may be, m
  Real sunk = 0.0;  ///< how deep what rests is sunk in, about, m
  /// Whether what slides over the seam of two bodies is kept from their edges: slivers are left out, and an edge that
  /// is level with a face but for `sunk` counts as the face (contact_seam.h).
  bool smooth_seams = false;

  ContactReach(Real within) : distance(within) {}
  ContactReach(Real within, Real sunk_in) : distance(within), sunk(sunk_in), smooth_seams(true) {}
};

/// Contact of two bodies, world axes.
struct ContactGeometry {
  Vec3<Unit> normal;  ///< from A to B
  uint32_t count = 0;
  bool seam = false;    ///< it is none, or has another normal, because it is that of a seam
  bool turns = false;   ///< the normal is no face's: it turns as what is round slides past the other
  bool capped = false;  ///< a search met its cap, or a hull's bytes are missing
  ContactGeometryPoint point[k_manifold_points_max];
};

/// Of the deepest point, m.
inline Real depth_of(const ContactGeometry& geometry) {
  Real least = geometry.point[0].separation;
  for (uint32_t i = 1; i < geometry.count; ++i) least = min(least, geometry.point[i].separation);
  return -least;
}

/// What collide needs of a body. `rotation` is the matrix of its pose's rotation.
struct CollisionBody {
  const BodyPose& pose;
  const BodyTraits& traits;
  const Matrix3& rotation;
};

/// Finds the contact points of a pair no farther apart than `reach`, m; none, and an empty result, if there are none.
/// Spheres, capsules, sharp boxes and half-spaces have ways of their own; the rest go through contact_points().
/// Their features are linked, and `rounding` where one is rounded. Precision: 2^-26 of the larger body's bounding
/// diameter (fixed; tests/unit/contact), of a half-space of the other body's size and 2^-31 of its distance from the
/// plane's origin.
void collide(const CollisionBody& a, const CollisionBody& b, const ContactReach& reach, ContactGeometry& contact,
             const AssetTable& assets = {}, ManifoldReduction reduction = ManifoldReduction::projected_extremes,
             const FeatureTable& features = feature_table<Features::all>);

/// The same contact, with A for B.
void swap_bodies(ContactGeometry& contact);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
