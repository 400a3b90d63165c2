#pragma once
#include <detent/contact.h>

#include "contact/contact_feature.h"
#include "distance/resting_pair.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The deepest point of the contact area is always chosen if it is deeper than all other chosen points by more than
/// 2^-k_drop_power of the smaller core's bounding radius.
inline constexpr int k_drop_power = 10;

/// A ManifoldPoint in integers. Lengths are in 2^-46 m. Vectors are in the axes in which the pair is placed: those of
/// the world or, in TerrainPair, those of the terrain.
struct BlockPoint {
  Vec64 from_a, from_b;
  int64_t separation;
  uint32_t feature;
};
/// A ContactManifold in integers.
struct BlockManifold {
  Vec32 normal = {};  ///< from A to B, Q30; zero if there are no points
  uint32_t count = 0;
  bool capped = false;
  bool leans = false;  ///< two edges cross, and the normal is that of a face slightly tilted against the contact axis
  bool seam = false;   ///< the contact lies at a seam: it was removed, or its normal was replaced
  bool turns = false;  ///< no face and no two crossing edges fix the normal: it rotates as the shapes slide
  BlockPoint point[k_contact_points_max];
};

/// Returns the index of the point with the least separation; 0 if there are no points.
uint32_t deepest_point(const BlockManifold& manifold);
/// Returns the least separation of the points, 2^-46 m; INT64_MAX if there are none.
int64_t least_separation(const BlockManifold& manifold);

/// The rules by which contact points are found. Lengths in 2^-46 m.
struct ContactRules {
  int64_t margin;  ///< contact margin: the greatest separation of a point
  int64_t sunk;    ///< typical penetration of resting bodies
  ManifoldReduction reduction;
  bool leans;         ///< where two edges cross, the normal of a slightly tilted face may replace their normal
  bool smooth_seams;  ///< as ContactMargins::smooth_seams
};
inline ContactRules rules_of(int64_t margin, ManifoldReduction reduction) {
  return {margin, 0, reduction, true, false};
}

/// As contact_points(), but in integers: `pair` holds the two shapes in integer coordinates, and lengths in `manifold`
/// are in 2^-46 m.
void find_contact_points(const RestingPair& pair, const ContactRules& rules, DistanceCache* cache,
                         BlockManifold& manifold);

/// Properties of a contact; their meaning is that of the members of BlockManifold with the same names.
struct ContactKind {
  bool seam = false, turns = false;
};

/// As contact_points(), but by any `rules`, which include the contact margin and the reduction. Also sets `kind`.
Status contact_points_by(const ContactRules& rules, const Convex& a, const Pose& pose_a, const Convex& b,
                         const Pose& pose_b, DistanceCache* cache, ContactManifold& manifold, ContactKind& kind);

/// Finds the contact points between A's `face` and the feature of B that is farthest in the direction opposite to the
/// face's normal. The contact normal is the face's normal. The function finds only points that are over the face, or
/// beyond its sides by at most a tolerance (the slack of Reference in contact_clip.h, with the bounding radius of B as
/// its `size`). There may be no such points. It makes no search, so the result is never capped.
void contact_points_over_face(const RestingPair& pair, const Feature& face, int64_t margin, ManifoldReduction reduction,
                              BlockManifold& manifold);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
