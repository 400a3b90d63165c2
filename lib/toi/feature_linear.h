#pragma once
#include "toi/feature_search.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Features whose corners move in straight lines. The caller chooses the unit of length.
struct LinearFeatures {
  FeatureKind kind;
  Vec64 start[4], end[4];  ///< in the order of FeatureKind. Range: components at most 2^60
  int64_t ball;            ///< bound on the error of a difference of corners, in each component

  /// Finds the first contact. At a hit the gap is at most k_feature_tolerance times the larger of size_of() at the
  /// start and at the end, plus 32 units if `ball` is 1.
  void first_contact(FeatureToi& result) const;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
