#pragma once
#include <detent/contact.h>

#include "proximity/contact_feature.h"
#include "proximity/resting_pair.h"

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
  BlockPoint point[k_contact_points_max];
};

/// As contact_points(), of a pair in its block. `reach`: 2^-46 m. `may_lean`: the normal may be that of a face that
/// leans against edges that cross.
void find_contact_points(const RestingPair& pair, int64_t reach, DistanceCache* cache, ManifoldReduction reduction,
                         BlockManifold& manifold, bool may_lean = true);

/// The points between A's `face` and B's feature farthest against its normal, which is the contact's. Only what lies
/// over the face, or a 64th of it beyond its sides; none if nothing does. No search: it cannot be capped.
void contact_points_over_face(const RestingPair& pair, const Feature& face, int64_t reach, ManifoldReduction reduction,
                              BlockManifold& manifold);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
