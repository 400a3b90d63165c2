#pragma once
#include "distance/gjk.h"
#include "toi/advance.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The features of two cores that are nearest: a vertex, an edge or a face of each.
struct NearFeatures {
  int count_a = 0, count_b = 0;  ///< distinct points of A and of B: 1 a vertex, 2 an edge, 3 a face
  Vec32 a[2], b[2];              ///< the first two of each, local
  Vec32 nearest_a, nearest_b;    ///< the points of the cores that are nearest, local

  bool curved = false;  ///< one of the points lies on a rim, and will be another one soon

  explicit NearFeatures(const Simplex& simplex);

  /// The axis belongs to a face, and turns with it.
  bool has_face() const { return !curved && (count_a >= 3 || count_b >= 3); }
  /// The spin of the body whose face, or else edge, the axis is perpendicular to; none between two vertices.
  Vec32 base_spin(const Horizon& horizon) const;
};

/// The axis between the features, `frames` being where they are, Q30. False if they touch, or are parallel edges. Of
/// two edges the one on the side `side` of `towards`, -1 or 1; 0 to find out which.
bool axis_between(const MovingPair& pair, const NearFeatures& features, const Frames& frames, const Vec32& towards,
                  int& side, Vec32& normal);

/// Like advance(), with a spin foreseen from where the features will be: right at contact too, for edges and vertices.
/// Returns how far it is certain that the cores stay `floor` apart, as a time. Counts passes and calls of gjk().
/// `progress`: of the last call, renewed; what it led to is what the next one may hope for.
int64_t advance_tracking(const MovingPair& pair, const Frames& frames, const Simplex& simplex,
                         const NearFeatures& features, const GjkResult& nearest, int32_t floor, int64_t& progress,
                         TimeOfImpact& result);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
