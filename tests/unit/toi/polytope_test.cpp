#include "distance/polytope.h"

#include <set>

#include "tests/unit/distance/closed_form.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// Polytopes with a volume, and a triangle.
std::vector<KnownShape> solids() {
  return {known(box({1.0, 0.5, 0.25})), known_hull(tetrahedron_bytes(), 0), known_hull(prism_bytes(), 0)};
}
KnownShape corner_triangle() {
  const Vector corners[3] = {{{1, 0, 0}}, {{0, 1, 0}}, {{-1, -1, 0.5}}};
  return known_triangle(corners, 0);
}

int side(const Vec64& normal, const Polytope& polytope, uint32_t from, uint32_t vertex) {
  return sign_of(dot(normal, subtract(polytope.vertex(vertex), polytope.vertex(from))));
}

DETENT_TEST(polytope, is_a_box_a_hull_or_a_triangle_without_a_ball) {
  for (const KnownShape& solid : solids()) EXPECT_TRUE(Polytope::is_one(solid.convex));
  EXPECT_TRUE(Polytope::is_one(corner_triangle().convex));
  EXPECT_FALSE(Polytope::is_one(known(rounded(box({1.0, 0.5, 0.25}), 0.125)).convex));
  EXPECT_FALSE(Polytope::is_one(known_hull(prism_bytes(), 0.125).convex));
  for (const Shape& shape : {sphere(0.5), capsule(0.5, 0.5), cylinder(0.5, 0.5), cone(0.5, 0.5), half_space()})
    EXPECT_FALSE(Polytope::is_one(known(shape).convex));
}

DETENT_TEST(polytope, has_the_vertices_of_its_shape) {
  for (const KnownShape& solid : solids()) {
    const Polytope polytope(solid.convex);
    for (uint32_t i = 0; i < polytope.vertex_count(); ++i) {
      CorePoint point;
      ASSERT_TRUE(core_vertex(solid.convex, static_cast<uint8_t>(i), point));
      EXPECT_TRUE(polytope.vertex(i) == point.local);
    }
    CorePoint none;
    EXPECT_FALSE(core_vertex(solid.convex, static_cast<uint8_t>(polytope.vertex_count()), none));
  }
}

DETENT_TEST(polytope, faces_look_outward_and_close_it) {
  for (const KnownShape& solid : solids()) {
    const Polytope polytope(solid.convex);
    std::set<std::pair<uint32_t, uint32_t>> sides;
    polytope.for_each_face([&](uint32_t i, uint32_t j, uint32_t k) {
      const Vec32 p = polytope.vertex(i);
      const Vec64 normal = cross(subtract(polytope.vertex(j), p), subtract(polytope.vertex(k), p));
      EXPECT_FALSE(is_zero(normal));
      for (uint32_t v = 0; v < polytope.vertex_count(); ++v) EXPECT_LE(side(normal, polytope, i, v), 0);
      for (const auto& along : {std::pair{i, j}, std::pair{j, k}, std::pair{k, i}})
        EXPECT_TRUE(sides.insert(along).second) << "a side belongs to two faces";
    });
    size_t neighbours = 0;
    for (uint32_t v = 0; v < polytope.vertex_count(); ++v) {
      const HullIndices of_v = polytope.neighbours(v);
      for (uint32_t n = 0; n < of_v.count; ++n) {
        EXPECT_TRUE(n == 0 || of_v.index[n - 1] < of_v.index[n]);
        EXPECT_EQ(sides.count({v, of_v.index[n]}), 1u);
      }
      neighbours += of_v.count;
    }
    EXPECT_EQ(neighbours, sides.size());
    EXPECT_EQ(sides.size(), 6 * (polytope.vertex_count() - 2));  // Euler
  }
}

DETENT_TEST(polytope, faces_beside_an_edge_have_no_vertex_above_them) {
  for (const KnownShape& solid : solids()) {
    const Polytope polytope(solid.convex);
    uint32_t flat = 0, sharp = 0;
    for (uint32_t from = 0; from < polytope.vertex_count(); ++from) {
      const HullIndices near = polytope.neighbours(from);
      for (uint32_t n = 0; n < near.count; ++n) {
        const uint32_t to = near.index[n];
        const EdgeFaces faces = polytope.faces(from, to), back = polytope.faces(to, from);
        const Vec32 along = subtract(polytope.vertex(to), polytope.vertex(from));
        EXPECT_EQ(faces.flat, back.flat);
        if (faces.flat) {
          ++flat;
          continue;
        }
        ++sharp;
        for (const Vec64& normal : {faces.left, faces.right}) {
          EXPECT_FALSE(is_zero(normal));
          EXPECT_EQ(sign_of(dot(normal, along)), 0);
          for (uint32_t v = 0; v < polytope.vertex_count(); ++v) EXPECT_LE(side(normal, polytope, from, v), 0);
        }
        // left x right is parallel to the edge.
        const Vec64 across = cross(scaled_to_30_bits(faces.left), scaled_to_30_bits(faces.right));
        EXPECT_EQ(sign_of(dot(across, along)), 1);
      }
    }
    if (solid.type() == ShapeType::box) {
      EXPECT_EQ(flat, 12u);
      EXPECT_EQ(sharp, 24u);
    }
    EXPECT_GE(sharp, 12u);
  }
}

DETENT_TEST(polytope, of_a_triangle_has_two_faces) {
  const KnownShape triangle = corner_triangle();
  const Polytope polytope(triangle.convex);
  std::vector<Vec64> normals;
  polytope.for_each_face([&](uint32_t i, uint32_t j, uint32_t k) {
    const Vec32 p = polytope.vertex(i);
    normals.push_back(cross(subtract(polytope.vertex(j), p), subtract(polytope.vertex(k), p)));
  });
  ASSERT_EQ(normals.size(), 2u);
  EXPECT_TRUE(normals[0] == negate(normals[1]));
  for (uint32_t from = 0; from < 3; ++from) {
    const EdgeFaces faces = polytope.faces(from, (from + 1) % 3);
    EXPECT_TRUE(faces.left == normals[0]);
    EXPECT_TRUE(faces.right == normals[1]);
    EXPECT_FALSE(faces.flat);
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
