#include "exact_hull.h"

#include <gtest/gtest.h>
#include <math.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "mass.h"
#include "tests/tool/cook/solids.h"

namespace {

using namespace detent_cook;
using detent_cook_test::Random;

/// A plane in lowest terms: outward normal and offset.
using BrutePlane = std::array<int64_t, 4>;

int64_t height(const BrutePlane& plane, const GridPoint& p) {
  return plane[0] * p.x + plane[1] * p.y + plane[2] * p.z - plane[3];
}

/// The planes through three points that have none above, of all triples.
std::set<BrutePlane> supporting_planes(const std::vector<GridPoint>& points) {
  std::set<BrutePlane> planes;
  for (const GridPoint& a : points) {
    for (const GridPoint& b : points) {
      for (const GridPoint& c : points) {
        const auto n = area_normal(a, b, c);
        if (n[0] == 0 && n[1] == 0 && n[2] == 0) continue;
        const int64_t shared = std::gcd(std::gcd(n[0], n[1]), n[2]);
        BrutePlane plane = {n[0] / shared, n[1] / shared, n[2] / shared, 0};
        plane[3] = height(plane, a);
        if (std::all_of(points.begin(), points.end(), [&](const GridPoint& p) { return height(plane, p) <= 0; })) {
          planes.insert(plane);
        }
      }
    }
  }
  return planes;
}

TEST(exact_hull, of_lattice_points_has_the_planes_and_the_extreme_points_of_all_triples) {
  Random random = {1};
  int solid = 0;
  for (int round = 0; round < 300; ++round) {
    const uint64_t sides = 2 + random.bits() % 6, count = 4 + random.bits() % 24;
    const int32_t scale = round % 2 == 0 ? 1 : 1 << 8;  // and a few steps off the lattice
    std::set<GridPoint> cloud;
    for (uint64_t k = 0; k < count; ++k) {
      std::array<int32_t, 3> p;
      for (int32_t& value : p) {
        value = static_cast<int32_t>(random.bits() % sides) * scale;
        if (scale > 1) value += static_cast<int32_t>(random.bits() % 3);
      }
      cloud.insert({p[0], p[1], p[2]});
    }
    const std::vector<GridPoint> points(cloud.begin(), cloud.end());
    const ExactHull hull = exact_hull(points, 255);
    const std::set<BrutePlane> planes = supporting_planes(points);
    std::vector<uint32_t> extreme;
    for (uint32_t i = 0; i < points.size(); ++i) {
      const auto touched = std::count_if(planes.begin(), planes.end(),
                                         [&](const BrutePlane& plane) { return height(plane, points[i]) == 0; });
      if (touched >= 3) extreme.push_back(i);
    }
    // Of points in a plane, only that plane's two sides support them.
    ASSERT_EQ(hull.span == Span::solid, planes.size() >= 4);
    if (hull.span != Span::solid) continue;
    ++solid;
    EXPECT_EQ(hull.vertices, extreme);
    EXPECT_EQ(hull.triangles.size(), 2 * hull.vertices.size() - 4);
    std::set<BrutePlane> found;
    for (const Triangle& t : hull.triangles) {
      const auto n = area_normal(points[t[0]], points[t[1]], points[t[2]]);
      const int64_t shared = std::gcd(std::gcd(n[0], n[1]), n[2]);
      ASSERT_NE(shared, 0);
      BrutePlane plane = {n[0] / shared, n[1] / shared, n[2] / shared, 0};
      plane[3] = height(plane, points[t[0]]);
      found.insert(plane);
    }
    EXPECT_EQ(found, planes);
  }
  EXPECT_GT(solid, 200);
}

TEST(exact_hull, leaves_out_a_point_within_an_edge_that_was_inserted_before_its_ends) {
  const std::vector<GridPoint> points = {{0, 0, 0}, {0, 0, 2}, {0, 2, 1}, {2, 0, 0},
                                         {2, 0, 1}, {2, 0, 2}, {2, 1, 0}, {2, 1, 2}};
  EXPECT_EQ(exact_hull(points, 255).vertices, (std::vector<uint32_t>{0, 1, 2, 3, 5, 6, 7}));
}

TEST(exact_hull, says_what_flat_clouds_span) {
  EXPECT_EQ(exact_hull({{1, 2, 3}}, 255).span, Span::point);
  EXPECT_EQ(exact_hull({{0, 0, 0}, {1, 1, 1}, {7, 7, 7}}, 255).span, Span::line);
  EXPECT_EQ(exact_hull({{0, 0, 0}, {0, 1, 1}, {0, 7, 7}, {0, 8, 7}}, 255).span, Span::plane);
  constexpr int32_t k_far = (1 << 30) - 1;  // a volume of one step, of the greatest extent
  EXPECT_EQ(exact_hull({{-k_far, 0, 0}, {0, 0, 0}, {0, k_far, 0}, {k_far, 0, 1}}, 255).span, Span::solid);
}

TEST(exact_hull, keeps_to_the_limit_of_vertices) {
  Random random = {2};
  std::set<GridPoint> cloud;
  for (int k = 0; k < 500; ++k) {
    const double x = random.uniform(-1, 1), y = random.uniform(-1, 1), z = random.uniform(-1, 1);
    const double scale = 1e9 / sqrt(x * x + y * y + z * z);
    cloud.insert({static_cast<int32_t>(x * scale), static_cast<int32_t>(y * scale), static_cast<int32_t>(z * scale)});
  }
  const std::vector<GridPoint> points(cloud.begin(), cloud.end());
  for (const uint32_t limit : {4u, 5u, 17u, 255u, 499u}) {
    const ExactHull hull = exact_hull(points, limit);
    EXPECT_EQ(hull.vertices.size(), limit);
    EXPECT_TRUE(hull.reduced);
  }
  EXPECT_EQ(exact_hull(points, 1000).vertices.size(), points.size());
  EXPECT_FALSE(exact_hull(points, 1000).reduced);
}

TEST(mass, a_rotation_survives_its_matrix) {
  Random random = {3};
  for (int round = 0; round < 2000; ++round) {
    std::array<double, 4> q;
    for (double& value : q) value = random.uniform(-1, 1);
    q[static_cast<size_t>(round % 4)] *= 8;  // each component is the greatest in turn
    if (round % 16 < 4) q[3] = 0.001;
    double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (q[3] < 0) length = -length;
    GridRotation rotation;
    for (size_t k = 0; k < 4; ++k) rotation[k] = static_cast<int32_t>(floor(q[k] / length * 0x1p30 + 0.5));
    const GridRotation back = rotation_from(matrix_from(rotation));
    for (size_t k = 0; k < 4; ++k) EXPECT_NEAR(back[k], rotation[k], 1.5) << round;
  }
}

TEST(mass, principal_axes_diagonalise_and_leave_small_products_alone) {
  const Matrix axes = principal_axes({3, 2, 1, 0x1p-23, -0x1p-24, 0});
  EXPECT_EQ(axes, (Matrix{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}));
  Random random = {4};
  for (int round = 0; round < 500; ++round) {
    const Matrix rotation_vector =
        matrix_from({static_cast<int32_t>(random.uniform(-1e9, 1e9)), static_cast<int32_t>(random.uniform(-1e9, 1e9)),
                     static_cast<int32_t>(random.uniform(-1e9, 1e9)), 1 << 29});
    const std::array<double, 3> moments = {1, random.uniform(1e-6, 1), random.uniform(1e-6, 1)};
    Matrix a{};
    for (size_t i = 0; i < 3; ++i) {
      for (size_t j = 0; j < 3; ++j) {
        for (size_t k = 0; k < 3; ++k) a[i][j] += rotation_vector[i][k] * moments[k] * rotation_vector[j][k];
      }
    }
    const Matrix r = principal_axes({a[0][0], a[1][1], a[2][2], a[0][1], a[1][2], a[0][2]});
    const Matrix transposed = {{{r[0][0], r[1][0], r[2][0]}, {r[0][1], r[1][1], r[2][1]}, {r[0][2], r[1][2], r[2][2]}}};
    const Matrix diagonal = product(transposed, product(a, r));
    EXPECT_NEAR(diagonal[0][1], 0, 0x1p-22);
    EXPECT_NEAR(diagonal[1][2], 0, 0x1p-22);
    EXPECT_NEAR(diagonal[0][2], 0, 0x1p-22);
    const double determinant = r[0][0] * (r[1][1] * r[2][2] - r[1][2] * r[2][1]) -
                               r[0][1] * (r[1][0] * r[2][2] - r[1][2] * r[2][0]) +
                               r[0][2] * (r[1][0] * r[2][1] - r[1][1] * r[2][0]);
    EXPECT_NEAR(determinant, 1, 1e-14);
  }
}

}  // namespace
