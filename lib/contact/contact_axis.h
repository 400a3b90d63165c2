#pragma once
#include "distance/resting_pair.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The normal of a contact between two cores, and the points where they are nearest or overlap deepest. Lengths are in
/// ulps: 2^-30 of the pair's unit of length (distance/support.h).
struct ContactAxis {
  Vec32 normal;            ///< from A to B, Q30
  int64_t separation;      ///< negative where the cores overlap
  Vec32 point_a, point_b;  ///< nearest points, or deepest if the cores overlap; each from its core's centre
  bool capped;             ///< a search reached its cap: the normal may not be the direction of least penetration
};

/// Sets `axis` to the contact axis of the pair's cores. Returns false if the cores are certainly farther apart than
/// `above` ulps. `cache`: the vertices from which gjk() starts; find_contact_axis() updates them. May be null.
bool find_contact_axis(const RestingPair& pair, int32_t above, DistanceCache* cache, ContactAxis& axis);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
