#pragma once
#include "distance/support.h"

/// The faces, edges and vertices of cores that contacts are between, and their names.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// A name of 12 bits within a shape: never 0.
enum class FeatureType : uint32_t { vertex = 1, edge = 2, face = 3 };
constexpr uint32_t feature_name(FeatureType kind, uint32_t index) { return static_cast<uint32_t>(kind) << 10 | index; }

/// The name of a contact of a feature of A with one of B.
constexpr uint32_t feature_pair(uint32_t on_a, uint32_t on_b) { return on_a | on_b << 12; }

inline constexpr int k_feature_points_max = 32;

/// A flat convex polygon (its points counter-clockwise from outside), an edge or a vertex of a placed core.
struct Feature {
  int count = 0;                         ///< of points: 1 a vertex, 2 an edge
  Vec32 point[k_feature_points_max];     ///< in the block, from the core's centre
  uint8_t vertex[k_feature_points_max];  ///< their names
  uint32_t index = 0;                    ///< of the face or edge
  Vec32 normal;                          ///< of a face, outward, Q30
  Vec32 along;                           ///< a fixed direction in a face, Q30

  bool is_face() const { return count > 2; }
  uint32_t name() const;
  void add(const Vec32& at, uint32_t name) {
    point[count] = at;
    vertex[count++] = static_cast<uint8_t>(name);
  }
};

/// The face that looks along `direction` (world, Q30) most, of those with the most of a core's points that are about as
/// far along it as the farthest. False if the core has none there: a round side, or an edge's or vertex' own core.
/// `thickness`: core_half_thickness(). The flat side of a cylinder or cone is an octagon in its rim. Of a hull what is
/// level with the face within a 64th of the thickness belongs to it.
bool supporting_face(const Placed& placed, const Vec32& direction, int32_t thickness, Feature& face);

/// Of the core's edges at its farthest point along `direction` the one most perpendicular to it; on a round side the
/// line that touches; the farthest vertex where that edge's slope (dot of its unit vector with `direction`, Q30) is
/// above `slope_max` or there are no edges.
void supporting_edge(const Placed& placed, const Vec32& direction, int64_t slope_max, Feature& edge);

/// The index of the edge between two vertices that are neighbours in a face, or are an edge's.
uint32_t edge_index(const Placed& placed, uint32_t vertex_a, uint32_t vertex_b);

/// A length of the core's in ulps of the block, rounded down.
int32_t in_block(const Placed& placed, int32_t length);

/// The least half extent of a core that has faces (of a hull the least distance of a face from the frame's origin, or
/// from the vertices' mean if that is more, unless the hull says it); of others the greatest. Ulps of the core.
int32_t core_half_thickness(const Placed& placed);
/// Likewise, ulps of the block.
int32_t half_thickness(const Placed& placed);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
