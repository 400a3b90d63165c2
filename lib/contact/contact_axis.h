#pragma once
#include "distance/resting_pair.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// What the normal and the deepest place of a contact are. Lengths in ulps, of the cores.
struct ContactAxis {
  Vec32 normal;            ///< from A to B, Q30
  int64_t separation;      ///< negative where the cores overlap
  Vec32 point_a, point_b;  ///< nearest, or deepest, each from its own centre
  bool capped;
};

/// False if the cores are certain to be farther apart than `above` ulps.
bool find_contact_axis(const RestingPair& pair, int32_t above, DistanceCache* cache, ContactAxis& axis);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
