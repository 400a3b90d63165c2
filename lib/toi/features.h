#pragma once
#include "distance/gjk.h"
#include "toi/advance.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The nearest features of two cores: a vertex, an edge or a face of each.
struct NearFeatures {
  int count_a = 0, count_b = 0;  ///< distinct points of A and of B: 1 for a vertex, 2 for an edge, 3 for a face
  Vec32 a[2], b[2];              ///< the first two of these points, in the axes of their shapes
  Vec32 nearest_a, nearest_b;    ///< the nearest points of the cores, in the axes of their shapes

  bool curved = false;  ///< one of the points lies on a rim and moves along it

  explicit NearFeatures(const Simplex& simplex);

  /// Whether the axis is the normal of a face and rotates with it.
  bool has_face() const { return !curved && (count_a >= 3 || count_b >= 3); }
  /// The rotation vector of the body that has the face, or otherwise the edge, to which the axis is perpendicular. Zero
  /// between two vertices.
  Vec32 base_angular_velocity(const Horizon& horizon) const;
};

/// Sets `normal` to the axis between the features at `frames`, Q30. Returns false if the features touch or are parallel
/// edges. For two edges, `side` is the sign of the cross product, -1 or 1; if it is 0, the function sets it so that the
/// axis points to the side of `towards`.
bool axis_between(const MovingPair& pair, const NearFeatures& features, const Frames& frames, const Vec32& towards,
                  int& side, Vec32& normal);

/// Predicts the axis between the same features at a later time, and certifies a horizon along an axis that rotates
/// towards it (advance()). Such an axis is still valid at the time of contact, also for edges and vertices. Returns the
/// time up to which the cores are certain to stay at least `floor` (ulps of the pair's block) apart. Adds its passes
/// and its calls of gjk() to the counts in `result`. Before the call, `progress` is the time that the previous call
/// gained, which limits the length of the horizon; afterwards, the time that this call gained.
int64_t advance_tracking(const MovingPair& pair, const Frames& frames, const Simplex& simplex,
                         const NearFeatures& features, const GjkResult& nearest, int32_t floor, int64_t& progress,
                         TimeOfImpact& result);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
