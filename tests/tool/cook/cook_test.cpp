#include "cook.h"

#include <gtest/gtest.h>
#include <math.h>
#include <string.h>

#include <algorithm>

#include "base/crc.h"
#include "tests/tool/cook/solids.h"
#include "tests/unit/shape/hull_bytes.h"

namespace {

using namespace detent_cook;
using namespace detent_cook_test;

constexpr double k_pi = 3.14159265358979323846;
const std::array<double, 4> k_turn = {0.1, -0.5, 0.3, 0.8};

CookResult cooked(const Cloud& cloud, const CookOptions& options = {}) {
  CookResult result = cook_hull(cloud, options);
  EXPECT_EQ(result.reason, "");
  EXPECT_FALSE(result.bytes.empty());
  return result;
}

/// The three in ascending order: which axis is which is the cook's choice.
std::array<double, 3> ascending(std::array<double, 3> values) {
  std::sort(values.begin(), values.end());
  return values;
}

void expect_mass(const CookResult& result, double volume, const std::array<double, 3>& inertia, double error) {
  ASSERT_FALSE(result.bytes.empty());
  EXPECT_NEAR(stored_volume(result.bytes) / volume, 1, error);
  EXPECT_NEAR(result.volume / volume, 1, error);
  const auto right = ascending(inertia), found = ascending(stored_inertia(result.bytes));
  for (size_t k = 0; k < 3; ++k) EXPECT_NEAR(found[k] / right[k], 1, error) << k;
}

/// Against other formulae, from the bytes alone; and the frame is what it claims to be.
void expect_right_integrals(const CookResult& result) {
  ASSERT_FALSE(result.bytes.empty());
  const Integrals right = integrals_of(result.bytes);
  const double unit = ldexp(1, result.exponent);
  EXPECT_NEAR(static_cast<double>(stored_volume(result.bytes) / right.volume), 1, 0x1p-30);
  const auto found = stored_inertia(result.bytes);
  for (size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(static_cast<double>(found[k] / right.inertia[k]), 1, 0x1p-29) << k;
    EXPECT_NEAR(static_cast<double>(right.centre[k]), 0, unit * 0x1.01p-31) << k;
    const size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const long double second_i = (right.inertia[j] + right.inertia[k] - right.inertia[i]) / 2;
    const long double second_j = (right.inertia[i] + right.inertia[k] - right.inertia[j]) / 2;
    const long double turned = fabsl(right.products[k]) / fabsl(second_i - second_j);
    EXPECT_TRUE(turned < 0x1p-29L || fabsl(right.products[k]) < 0x1p-21L * sqrtl(second_i * second_j))
        << "axes " << i << " and " << j << " are turned by " << static_cast<double>(turned);
  }
}

TEST(cook, a_tetrahedron_and_a_prism_give_the_same_bytes_on_every_machine) {
  const std::vector<uint8_t> tetrahedron_bytes = cooked(tetrahedron()).bytes;
  ASSERT_EQ(tetrahedron_bytes.size(), sizeof detent_hulls::k_tetrahedron);
  EXPECT_EQ(memcmp(tetrahedron_bytes.data(), detent_hulls::k_tetrahedron, tetrahedron_bytes.size()), 0);
  const Cloud points = {{3.30593687, -1.51740597, 0.311882546}, {3.30593687, -1.9902383, 1.84042093},
                        {2.92980488, -1.38737935, 0.352104492}, {2.92980488, -1.86021168, 1.88064287},
                        {2.62386801, -1.63355722, 0.275952754}, {2.62386801, -2.10638955, 1.80449114},
                        {2.69406313, -2.0097617, 0.159579071},  {2.69406313, -2.48259403, 1.68811745},
                        {3.07019512, -2.13978832, 0.119357125}, {3.07019512, -2.61262065, 1.64789551},
                        {3.37613199, -1.89361045, 0.195508863}, {3.37613199, -2.36644278, 1.72404725}};
  const std::vector<uint8_t> prism_bytes = cooked(points).bytes;
  ASSERT_EQ(prism_bytes.size(), sizeof detent_hulls::k_prism);
  EXPECT_EQ(memcmp(prism_bytes.data(), detent_hulls::k_prism, prism_bytes.size()), 0);
}

TEST(cook, a_hundred_hulls_give_the_same_bytes_on_every_machine) {
  Random random = {8};
  uint32_t digest = 0;
  for (int round = 0; round < 100; ++round) {
    const std::array<double, 4> rotation_vector = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1),
                                                   1};
    const std::array<double, 3> size = {1, random.uniform(0.01, 1),
                                        random.uniform(0.01, 1)};  // arguments have no order
    const std::array<double, 3> away = {random.uniform(-9, 9), 0, 1};
    const Cloud cloud = placed(ellipsoid(random, 5 + 3 * round, size[0], size[1], size[2]), rotation_vector, away);
    CookOptions options;
    if (round % 5 == 4) options.frame = Frame::source;
    const std::vector<uint8_t> bytes = cooked(cloud, options).bytes;
    digest = detent::crc32(bytes.data(), static_cast<uint32_t>(bytes.size()), digest);
  }
  EXPECT_EQ(digest, 3226711606u);
}

TEST(cook, the_order_of_points_and_equal_points_do_not_matter) {
  Random random = {1};
  for (int round = 0; round < 20; ++round) {
    Cloud cloud = ellipsoid(random, 40, 1, 0.4, 0.3);
    const std::vector<uint8_t> bytes = cooked(cloud).bytes;
    const Cloud once = cloud;
    cloud.insert(cloud.end(), once.begin(), once.begin() + 20);
    EXPECT_EQ(cooked(shuffled(random, cloud)).bytes, bytes);
    CookOptions options;
    options.vertex_limit = 12;
    EXPECT_EQ(cooked(cloud, options).bytes, cooked(shuffled(random, cloud), options).bytes);
  }
}

TEST(cook, a_box_with_points_on_its_faces_and_edges_and_inside_has_six_faces_in_its_own_frame) {
  Random random = {2};
  Cloud cloud = box_corners(0.5, 0.25, 1);
  for (int k = 0; k < 200; ++k) {
    std::array<double, 3> p = {random.uniform(-0.5, 0.5), random.uniform(-0.25, 0.25), random.uniform(-1, 1)};
    if (k % 4 > 0) p[0] = (k & 8) != 0 ? 0.5 : -0.5;
    if (k % 4 > 1) p[2] = (k & 16) != 0 ? 1 : -1;
    cloud.push_back(p);
  }
  const CookResult result = cooked(shuffled(random, cloud));
  EXPECT_EQ(result.vertex_count, 8u);
  EXPECT_EQ(face_sizes(result.bytes), std::vector<size_t>(6, 4));
  EXPECT_EQ(result.rotation, (std::array<double, 4>{0, 0, 0, 1}));
  EXPECT_EQ(result.centre, (Point{0, 0, 0}));
  expect_mass(result, 1, {(0.0625 + 1) / 3, (0.25 + 1) / 3, (0.25 + 0.0625) / 3}, 0x1p-30);
  expect_right_integrals(result);
}

TEST(cook, solids_turned_and_moved_have_the_analytic_mass_and_whole_faces) {
  for (const double scale : {0.001, 1.0, 100.0}) {
    const std::array<double, 3> away = {3 * scale, -2 * scale, 7 * scale};
    const double s = scale * scale, v = s * scale;
    const CookResult box = cooked(placed(box_corners(scale, 2 * scale, 3 * scale), k_turn, away));
    expect_mass(box, 48 * v, {13 * s / 3, 10 * s / 3, 5 * s / 3}, 0x1p-28);
    EXPECT_EQ(face_sizes(box.bytes), std::vector<size_t>(6, 4));
    const CookResult eight = cooked(placed(octahedron(scale), k_turn, away));
    expect_mass(eight, 4 * v / 3, {s / 5, s / 5, s / 5}, 0x1p-28);
    EXPECT_EQ(face_sizes(eight.bytes), std::vector<size_t>(8, 3));
    const CookResult twenty = cooked(placed(icosahedron(scale), k_turn, away));
    const double edge = scale / sin(2 * k_pi / 5), golden = (1 + sqrt(5)) / 2;
    const double inertia = edge * edge * golden * golden / 10;
    expect_mass(twenty, 5 * (3 + sqrt(5)) / 12 * edge * edge * edge, {inertia, inertia, inertia}, 0x1p-28);
    EXPECT_EQ(twenty.face_count, 20u);
    for (const int sides : {3, 6, 17, 64}) {
      const CookResult column = cooked(placed(prism(sides, scale, 2 * scale), k_turn, away));
      const double area = sides * s * sin(2 * k_pi / sides) / 2;
      const double polar = s * (2 + cos(2 * k_pi / sides)) / 6;  // of a regular polygon, about its middle
      expect_mass(column, 4 * scale * area, {polar, polar / 2 + 4 * s / 3, polar / 2 + 4 * s / 3}, 0x1p-28);
      EXPECT_EQ(column.face_count, static_cast<uint32_t>(sides) + 2) << sides;
      EXPECT_EQ(column.edge_count, static_cast<uint32_t>(sides) * 3);
    }
    for (const CookResult* result : {&box, &eight, &twenty}) expect_right_integrals(*result);
  }
}

TEST(cook, needles_and_plates_of_1_to_1000_have_the_analytic_mass) {
  for (const double scale : {0.001, 1.0, 100.0}) {
    for (const std::array<double, 3>& half :
         {std::array<double, 3>{1, 0.001, 0.001}, std::array<double, 3>{1, 0.001, 0.0017},
          std::array<double, 3>{1, 0.7, 0.001}, std::array<double, 3>{1, 1, 0.001}}) {
      const double x = half[0] * scale, y = half[1] * scale, z = half[2] * scale;
      const CookResult result = cooked(placed(box_corners(x, y, z), k_turn, {scale, 2 * scale, 3 * scale}));
      // A thickness of 2^-10 of the unit is 2^20 steps: rounding moves a face by 1 of them, the moments by 2 parts.
      expect_mass(result, 8 * x * y * z, {(y * y + z * z) / 3, (z * z + x * x) / 3, (x * x + y * y) / 3}, 0x1p-18);
      expect_right_integrals(result);
      EXPECT_EQ(face_sizes(result.bytes), std::vector<size_t>(6, 4));
    }
  }
}

TEST(cook, mass_properties_agree_with_other_formulae_on_random_hulls) {
  Random random = {3};
  for (int round = 0; round < 60; ++round) {
    const double size = exp2(random.uniform(-10, 8));
    const Cloud cloud =
        ellipsoid(random, 8 + round * 2, size, size * exp2(-random.uniform(0, 8)), size * exp2(-random.uniform(0, 8)));
    const CookResult result =
        cooked(placed(cloud, {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), 0.5},
                      {random.uniform(-1, 1) * size, random.uniform(-1, 1) * size, 0}));
    expect_right_integrals(result);
  }
}

TEST(cook, every_point_lies_on_or_within_the_hull_and_every_vertex_is_a_point) {
  Random random = {4};
  for (int round = 0; round < 30; ++round) {
    const double size = exp2(random.uniform(-8, 8));
    const Cloud cloud = ellipsoid(random, 100, size, size / 3, size / 50);
    for (const Frame frame : {Frame::principal, Frame::source}) {
      CookOptions options;
      options.frame = frame;
      const CookResult result = cooked(cloud, options);
      const double step = ldexp(1, result.exponent - 30);
      EXPECT_LE(result.error, 2 * step);
      EXPECT_FALSE(result.reduced);
      for (const auto& vertex : source_vertices(result.bytes)) {
        double nearest = 1e9;
        for (const auto& p : cloud) {
          nearest = fmin(nearest, hypot(p[0] - vertex[0], p[1] - vertex[1], p[2] - vertex[2]));
        }
        EXPECT_LE(nearest, step);  // sqrt(3) / 2 of rounding
      }
    }
  }
}

TEST(cook, the_source_frame_keeps_origin_and_axes_and_has_no_inverse_inertia) {
  CookOptions options;
  options.frame = Frame::source;
  const CookResult result = cooked(placed(box_corners(0.25, 0.25, 0.25), {0, 0, 0, 1}, {1, 2, 3}), options);
  EXPECT_EQ(result.centre, (Point{1, 2, 3}));
  EXPECT_EQ(result.rotation, (std::array<double, 4>{0, 0, 0, 1}));
  EXPECT_EQ(result.inverse_inertia, (std::array<double, 3>{0, 0, 0}));
  EXPECT_EQ(result.exponent, 3);  // |(1.25, 2.25, 3.25)| = 4.1
  EXPECT_NEAR(stored_volume(result.bytes), 0.125, 1e-9);
  Cloud vertices = source_vertices(result.bytes);
  EXPECT_NE(std::find(vertices.begin(), vertices.end(), std::array<double, 3>{1.25, 2.25, 3.25}), vertices.end());
}

TEST(cook, a_hull_far_from_the_origin_of_its_source_is_as_good_as_a_near_one) {
  const CookResult near = cooked(box_corners(0.5, 0.25, 0.125));
  const CookResult far = cooked(placed(box_corners(0.5, 0.25, 0.125), {0, 0, 0, 1}, {0x1p30, -0x1p29, 0x1p20}));
  EXPECT_EQ(stored_volume(far.bytes), stored_volume(near.bytes));
  EXPECT_EQ(far.centre, (Point{0x1p30, -0x1p29, 0x1p20}));
  expect_right_integrals(far);
}

TEST(cook, more_vertices_than_the_limit_are_reduced_with_the_error_or_refused) {
  Random random = {5};
  const Cloud cloud = ellipsoid(random, 2000, 1, 1, 1);
  CookOptions options;
  const CookResult result = cooked(cloud, options);
  EXPECT_TRUE(result.reduced);
  EXPECT_EQ(result.vertex_count, 255u);
  EXPECT_GT(result.error, 0.001);
  EXPECT_LT(result.error, 0.05);
  double further = 0;  // it is the greatest there is
  options.vertex_limit = 32;
  const CookResult small = cooked(cloud, options);
  EXPECT_EQ(small.vertex_count, 32u);
  EXPECT_GT(small.error, result.error);
  for (const auto& p : source_vertices(small.bytes)) further = fmax(further, hypot(p[0], p[1], p[2]));
  EXPECT_LE(further, 1 + 1e-8);
  options.reduce = false;
  EXPECT_EQ(cook_hull(cloud, options).reason, "the hull has more than 32 vertices");
}

TEST(cook, points_nearer_than_the_weld_are_one) {
  Random random = {6};
  Cloud cloud = box_corners(1, 1, 1);
  for (const auto& corner : box_corners(1, 1, 1)) {
    for (int k = 0; k < 5; ++k) {
      cloud.push_back({corner[0] + random.uniform(-1e-3, 1e-3), corner[1] + random.uniform(-1e-3, 1e-3),
                       corner[2] + random.uniform(-1e-3, 1e-3)});
    }
  }
  CookOptions options;
  EXPECT_GT(cooked(cloud, options).vertex_count, 8u);
  options.weld = 0.01;
  const CookResult result = cooked(cloud, options);
  EXPECT_EQ(result.vertex_count, 8u);
  EXPECT_LE(result.error, 0.01);
  EXPECT_GT(result.error, 0);
}

TEST(cook, faces_of_points_rounded_to_floats_are_whole) {
  Random random = {7};
  for (int round = 0; round < 20; ++round) {
    Cloud cloud =
        placed(prism(12, 1, 0.7), {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), 1}, {});
    for (auto& p : cloud) {
      for (double& value : p) value = static_cast<double>(static_cast<float>(value));
    }
    EXPECT_EQ(cooked(cloud).face_count, 14u);
  }
}

}  // namespace
