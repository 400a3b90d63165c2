#pragma once
#include <detent/contact.h>

#include "contact/contact_feature.h"
#include "distance/resting_pair.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Of the smaller core's radius, as a power of two: the deepest point is at most so much deeper than all chosen.
inline constexpr int k_drop_power = 10;

/// A ManifoldPoint, 2^-46 m, in the pair's axes.
struct BlockPoint {
  Vec64 from_a, from_b;
  int64_t separation;
  uint32_t feature;
};
struct BlockManifold {
  Vec32 normal = {};  ///< from A to B, Q30; zero if there are no points
  uint32_t count = 0;
  bool capped = false;
  bool leans = false;  ///< of a face that leans against the axis
  bool seam = false;   ///< it is none, or has another normal, because it is that of a seam
  bool turns = false;  ///< the normal is no face's: it turns as what is round slides past the other
  BlockPoint point[k_contact_points_max];
};

/// What is a contact. Lengths 2^-46 m.
struct ContactRules {
  int64_t reach;  ///< how far apart points may be
  int64_t sunk;   ///< how deep what rests is sunk in, about
  ManifoldReduction reduction;
  bool leans;         ///< the normal may be that of a face that leans against edges that cross
  bool smooth_seams;  ///< slivers are left out, and level edges count as the face: contact_seam.h
};
inline ContactRules rules_of(int64_t reach, ManifoldReduction reduction) { return {reach, 0, reduction, true, false}; }

/// As contact_points(), of a pair in its block.
void find_contact_points(const RestingPair& pair, const ContactRules& rules, DistanceCache* cache,
                         BlockManifold& manifold);

/// Of BlockManifold.
struct ContactKind {
  bool seam = false, turns = false;
};

/// Likewise, of shapes at their poses.
Status contact_points_by(const ContactRules& rules, const Convex& a, const Pose& pose_a, const Convex& b,
                         const Pose& pose_b, DistanceCache* cache, ContactManifold& manifold, ContactKind& kind);

/// The points between A's `face` and B's feature farthest against its normal, which is the contact's. Only what lies
/// over the face, or a 64th of it beyond its sides; none if nothing does. No search: it cannot be capped.
void contact_points_over_face(const RestingPair& pair, const Feature& face, int64_t reach, ManifoldReduction reduction,
                              BlockManifold& manifold);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
