#include "distance/polytope.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

// The triangles of a box, three vertex numbers each. Bit i of a vertex number is set if coordinate i is negative.
constexpr uint8_t k_box_triangles[] = {0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3, 0, 4, 5, 0, 5, 1,
                                       2, 3, 7, 2, 7, 6, 0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5};
constexpr uint8_t k_box_neighbours[] = {1, 2, 3, 4, 5, 6, 0, 3, 5, 7, 0, 3, 6, 7, 0, 1, 2, 7,
                                        0, 5, 6, 7, 0, 1, 4, 7, 0, 2, 4, 7, 1, 2, 3, 4, 5, 6};
constexpr uint8_t k_box_neighbours_at[] = {0, 6, 10, 14, 18, 22, 26, 30, 36};

// The two sides of a triangle shape, and the two neighbours of each corner.
constexpr uint8_t k_sides[] = {0, 1, 2, 0, 2, 1};
constexpr uint8_t k_corner_neighbours[] = {1, 2, 0, 2, 0, 1};

/// Returns a normal of a triangle; its length is twice the area.
Vec64 across(const Vec32& p, const Vec32& q, const Vec32& r) { return cross(subtract(q, p), subtract(r, p)); }

}  // namespace

bool Polytope::is_one(const Convex& convex) {
  return convex.radius == 0 &&
         (convex.type == ShapeType::box || convex.type == ShapeType::hull || convex.type == ShapeType::triangle);
}

Polytope::Polytope(const Convex& convex) : convex_(convex), hull_(hull_of(convex)) {
  vertex_count_ = convex.type == ShapeType::box ? 8 : convex.type == ShapeType::hull ? hull_.vertex_count : 3;
}

Vec32 Polytope::vertex(uint32_t i) const {
  if (convex_.type == ShapeType::hull) return {hull_.x(i), hull_.y(i), hull_.z(i)};
  CorePoint point = {};
  core_vertex(convex_, static_cast<uint8_t>(i), point);
  return point.local;
}

HullIndices Polytope::neighbours(uint32_t vertex) const {
  switch (convex_.type) {
    case ShapeType::hull:
      return hull_.neighbours(vertex);
    case ShapeType::box: {
      const uint32_t at = k_box_neighbours_at[vertex];
      return {k_box_neighbours + at, k_box_neighbours_at[vertex + 1] - at};
    }
    default:
      return {k_corner_neighbours + 2 * vertex, 2};
  }
}

HullIndices Polytope::triangles(uint32_t group) const {
  switch (convex_.type) {
    case ShapeType::hull:
      return hull_.triangles(group);
    case ShapeType::box:
      return {k_box_triangles, sizeof k_box_triangles};
    default:
      return {k_sides, sizeof k_sides};
  }
}

EdgeFaces Polytope::faces(uint32_t from, uint32_t to) const {
  const Vec32 start = vertex(from), end = vertex(to);
  const HullIndices near = neighbours(from), far = neighbours(to);
  EdgeFaces faces = {{0, 0, 0}, {0, 0, 0}, false};
  // Each of the two triangles at the edge has a third corner, which is a neighbour of both ends of the edge. On either
  // side, this corner is the outermost common neighbour of the two ends: no other common neighbour lies above the plane
  // through the edge and this corner. The common neighbours lie within an angle of pi about the edge, so they are
  // ordered by angle. If they span exactly pi, the edge is flat.
  bool first = true;
  for (uint32_t i = 0, j = 0; i < near.count && j < far.count;) {
    const uint32_t common = near.index[i];
    if (common != far.index[j]) {
      (common < far.index[j] ? i : j) += 1;
      continue;
    }
    ++i;
    ++j;
    const Vec32 corner = vertex(common), displacement = subtract(corner, start);
    const int above = first ? 1 : sign_of(dot(faces.left, displacement));
    if (above > 0) faces.left = across(start, end, corner);
    if (above == 0) faces.flat = faces.flat || sign_of(dot(faces.left, across(start, end, corner))) < 0;
    if (first || sign_of(dot(faces.right, displacement)) > 0) faces.right = across(start, corner, end);
    first = false;
  }
  return faces;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
