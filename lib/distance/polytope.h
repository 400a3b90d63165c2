#pragma once
#include "distance/support.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The outward normals of the two faces at an edge, in the shape's axes. They have any length, and are zero for a
/// degenerate face. Seen from outside, the counter-clockwise boundary of the left face passes the edge from its first
/// vertex to its second.
struct EdgeFaces {
  Vec64 left, right;
  bool flat;  ///< both faces lie in one plane: the edge is inside a flat face
};

/// The triangulated boundary of a box, hull or triangle. Vertices have the numbers of core_vertex(); their coordinates
/// are in the shape's axes, in 2^-30 of its unit.
class Polytope {
 public:
  /// Whether the shape is a polytope: a box, hull or triangle without rounding.
  static bool is_one(const Convex& convex);
  /// Range: is_one(convex). `convex` must outlive this object.
  explicit Polytope(const Convex& convex);

  uint32_t vertex_count() const { return vertex_count_; }
  Vec32 vertex(uint32_t i) const;
  /// The vertices that share an edge with `vertex`, in ascending order.
  HullIndices neighbours(uint32_t vertex) const;
  /// The faces at the edge between two neighbours.
  EdgeFaces faces(uint32_t from, uint32_t to) const;

  /// Calls visit(i, j, k) with the vertices of each triangle of the boundary, counter-clockwise seen from outside. A
  /// triangle shape has two such triangles, one for each side.
  template <class Visit>
  void for_each_face(Visit&& visit) const {
    const uint32_t groups = convex_.type == ShapeType::hull ? hull_.face_count : 1;
    for (uint32_t group = 0; group < groups; ++group) {
      const HullIndices corners = triangles(group);
      for (uint32_t i = 0; i < corners.count; i += 3)
        visit(corners.index[i], corners.index[i + 1], corners.index[i + 2]);
    }
  }

 private:
  HullIndices triangles(uint32_t group) const;

  const Convex& convex_;
  HullView hull_;
  uint32_t vertex_count_;
};
inline constexpr uint32_t k_polytope_vertices_max = k_hull_vertices_max;

}  // namespace DETENT_NAMESPACE
}  // namespace detent
