#pragma once
#include "proximity/advance.h"
#include "proximity/simplex.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The features of two cores that are nearest: a vertex, an edge or a face of each.
struct Features {
  int count_a = 0, count_b = 0;  ///< distinct points of A and of B: 1 a vertex, 2 an edge, 3 a face
  Vec32 a[2], b[2];              ///< the first two of each, local

  explicit Features(const Simplex& simplex);

  /// Something turns about an edge or a vertex only: the axis does not belong to a face.
  bool has_face() const { return count_a >= 3 || count_b >= 3; }
  /// The spin of the body whose face, or else edge, the axis is perpendicular to; none between two vertices.
  Vec32 base_spin(const Horizon& horizon) const;
};

/// Like advance(), with a spin foreseen from where the features will be: right at contact too, for edges and vertices.
/// Returns how far it is certain that the cores stay `floor` apart, as a time. `distance`: of the cores now, ulps.
int64_t advance_tracking(const MovingPair& pair, const Frames& frames, const Features& features, const Vec32& normal,
                         int32_t distance, int32_t floor, uint32_t& passes);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
