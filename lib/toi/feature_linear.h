#pragma once
#include "toi/feature_search.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Features whose corners move in straight lines, in a unit of the caller's choice.
struct LinearFeatures {
  FeatureKind kind;
  Vec64 start[4], end[4];  ///< as FeatureKind orders them. Range: components at most 2^60
  int64_t ball;            ///< in each component a difference of corners is never farther off than this

  /// A hit is early in gap by at most k_feature_tolerance of the size and 32 of the unit.
  void first_contact(FeatureToi& result) const;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
