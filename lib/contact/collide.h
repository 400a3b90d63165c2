#pragma once
#include <detent/asset.h>
#include <detent/contact.h>
#include <detent/detail/state.h>
#include <detent/features.h>

#include "math/rotation.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// A contact point of two bodies.
struct ContactGeometryPoint {
  /// The vector from the centre of mass of A (`arm_a`) or of B (`arm_b`) to the point midway between the surfaces, in
  /// world axes, in the unit of length of that body. Zero if that body is a half-space.
  Vec3<Unit> arm_a, arm_b;
  Real separation;  ///< along the normal, m; negative when overlapping
  /// Key of the two features (vertices, edges, faces) that touch. It differs between the points of a contact, stays the
  /// same while the features touch, and is not 0.
  uint32_t feature;
  uint32_t part = 0;  ///< for compounds: 2^16 (child number in A) + (child number in B), both counted from 1
};

/// Limits and options for the contact points of two bodies.
struct ContactMargins {
  Real distance;    ///< contact margin: the greatest separation of a contact point, m
  Real sunk = 0.0;  ///< typical penetration of resting bodies, m
  /// If true, a body that slides over the seam between two other bodies is not stopped there (contact_seam.h): slivers
  /// (shallow contacts beside a face contact of the same shapes) are left out, and a contact at an edge that is level
  /// with a face, within `sunk`, gets the normal of that face.
  bool smooth_seams = false;

  ContactMargins(Real within) : distance(within) {}
  ContactMargins(Real within, Real sunk_in) : distance(within), sunk(sunk_in), smooth_seams(true) {}
};

/// The contact of two bodies. Vectors are in world axes.
struct ContactGeometry {
  Vec3<Unit> normal;  ///< from A to B
  uint32_t count = 0;
  bool seam = false;    ///< the contact lies at a seam: it was removed, or its normal was replaced
  bool turns = false;   ///< no face and no two crossing edges fix the normal: it rotates as the shapes slide
  bool near = false;    ///< no point was found, but the shapes may be within the contact margin of each other
  bool capped = false;  ///< a search reached its iteration cap, hull bytes are missing, or a position is out of range
  ContactGeometryPoint point[k_manifold_points_max];
};

/// Returns the depth of the deepest point, m; negative if the surfaces are apart at all points. Range: count > 0.
DETENT_SHARED inline Real depth_of(const ContactGeometry& geometry) {
  Real least = geometry.point[0].separation;
  for (uint32_t i = 1; i < geometry.count; ++i) least = min(least, geometry.point[i].separation);
  return -least;
}

/// The data of a body that collide() reads. `rotation` is the rotation matrix of `pose`.
struct CollisionBody {
  const BodyPose& pose;
  const BodyProperties& properties;
  const Matrix3& rotation;
};

/// Finds the contact points of two bodies with convex shapes. Points with a separation above `margin.distance`, m, are
/// left out; the result may have no points. Pairs of spheres, capsules, unrounded boxes and half-spaces have
/// specialised functions; all other pairs go through contact_points(). `features` must be made with the flags
/// (Features) of both shape types, and with `rounding` if a shape is rounded. Error in fixed point
/// (tests/unit/contact): 2^-26 of the larger body's bounding diameter. Against a half-space: 2^-26 of the size of the
/// other body plus 2^-31 of that body's distance from the plane's origin.
void collide(const CollisionBody& a, const CollisionBody& b, const ContactMargins& margin, ContactGeometry& contact,
             const AssetTable& assets = {}, ManifoldReduction reduction = ManifoldReduction::projected_extremes,
             const FeatureTable& features = feature_table<Features::all>);

/// Exchanges A and B in the contact: negates the normal and exchanges the arms. Features and parts keep their keys.
void swap_bodies(ContactGeometry& contact);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
