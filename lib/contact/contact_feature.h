#pragma once
#include "distance/support.h"

/// The faces, edges and vertices of cores between which contacts form, and their names.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The type of a feature. A feature has a 12-bit name, which is distinct within its shape and never 0.
enum class FeatureType : uint32_t { vertex = 1, edge = 2, face = 3 };
constexpr uint32_t feature_name(FeatureType kind, uint32_t index) { return static_cast<uint32_t>(kind) << 10 | index; }

/// The key of a contact point between a feature of A and a feature of B, from the names of the two features.
constexpr uint32_t feature_pair(uint32_t on_a, uint32_t on_b) { return on_a | on_b << 12; }

inline constexpr int k_feature_points_max = 32;

/// A face, an edge or a vertex of a placed core. A face is a convex polygon, counter-clockwise seen from outside.
struct Feature {
  int count = 0;                         ///< number of points: 1 for a vertex, 2 for an edge
  Vec32 point[k_feature_points_max];     ///< from the core's centre, in ulps of the pair's block
  uint8_t vertex[k_feature_points_max];  ///< names of the points
  uint32_t index = 0;                    ///< index of the face or edge
  Vec32 normal;                          ///< of a face, outward, Q30
  Vec32 along;                           ///< a direction in the plane of a face, fixed in the shape, Q30

  bool is_face() const { return count > 2; }
  uint32_t name() const;
  void add(const Vec32& at, uint32_t name) {
    point[count] = at;
    vertex[count++] = static_cast<uint8_t>(name);
  }
};

/// Sets `face` to the core's face in `direction` (world axes, Q30). Candidates are the faces with the greatest number
/// of vertices that are about as far along `direction` as the farthest point. The result is the candidate whose normal
/// is closest to `direction`. Returns false if there is no face: on the round side of a cylinder or cone, and for a
/// core that is a point or a segment. `thickness`: the core's half thickness, as core_half_thickness() returns it. The
/// flat side of a cylinder or cone is represented by an octagon inscribed in its rim. On a hull, points that are level
/// with the face within 1/64 of `thickness` belong to the face.
bool supporting_face(const Placed& placed, const Vec32& direction, int32_t thickness, Feature& face);

/// Sets `edge` to the core's edge in `direction` (world axes, Q30): of the edges at the farthest point, the edge most
/// perpendicular to `direction`. On a cylinder or cone, this is the line of the round side that a tangent plane
/// touches. If the slope of the edge (the magnitude of the dot product of its unit vector and `direction`, Q30) exceeds
/// `slope_max`, or if there are no edges, sets `edge` to the farthest vertex.
void supporting_edge(const Placed& placed, const Vec32& direction, int64_t slope_max, Feature& edge);

/// Returns the index of the edge between two vertices, given by their names. Range: the vertices are neighbours in a
/// face, or the ends of an edge.
uint32_t edge_index(const Placed& placed, uint32_t vertex_a, uint32_t vertex_b);

/// Converts a length from 2^-30 of the shape's own unit to ulps (2^-30 of the pair's unit), rounded down.
DETENT_SHARED inline int32_t in_block(const Placed& placed, int32_t length) {
  // `placed.shift` may be negative only for a core that is a point.
  return length == 0 || placed.shift > 30 ? 0 : length >> placed.shift;
}

/// Returns the half thickness of the core, in 2^-30 of the shape's own unit. Box, cylinder and cone: the least half
/// extent. Hull: the value stored in the Convex, if any; else the least distance of a face from a centre, which is the
/// frame's origin or the mean of the vertices, whichever gives the greater value. Other cores: the core radius.
int32_t core_half_thickness(const Placed& placed);
/// Returns the half thickness of the core in ulps (2^-30 of the pair's unit), rounded down.
int32_t half_thickness(const Placed& placed);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
