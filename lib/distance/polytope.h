#pragma once
#include "distance/support.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The two faces beside an edge: their outward normals, in the shape's axes, of any length; zero for a degenerate one.
/// The left one runs along the edge from its first vertex to its second, counter-clockwise from outside.
struct EdgeFaces {
  Vec64 left, right;
  bool flat;  ///< they are one plane: the edge lies in a face
};

/// The boundary of a box, hull or triangle, triangulated. Vertices have the names of core_vertex() and lie in the
/// shape's axes, in 2^-30 of its unit.
class Polytope {
 public:
  /// False for another shape, or one that is rounded.
  static bool is_one(const Convex& convex);
  /// Range: is_one(convex), which must outlive this.
  explicit Polytope(const Convex& convex);

  uint32_t vertex_count() const { return vertex_count_; }
  Vec32 vertex(uint32_t i) const;
  /// Those it shares an edge with, ascending.
  HullIndices neighbours(uint32_t vertex) const;
  /// Of the edge between two neighbours.
  EdgeFaces faces(uint32_t from, uint32_t to) const;

  /// Calls visit(i, j, k) for each triangle, counter-clockwise from outside; for both sides of a triangle.
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
