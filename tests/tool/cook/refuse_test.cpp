#include <gtest/gtest.h>
#include <math.h>

#include "cook.h"
#include "cook_compound.h"
#include "tests/tool/cook/solids.h"

namespace {

using namespace detent_cook;
using namespace detent_cook_test;

constexpr const char* k_flat = "all points lie in one plane: the hull has no volume";

std::string reason(const Cloud& cloud, const CookOptions& options = {}) {
  const CookResult result = cook_hull(cloud, options);
  EXPECT_EQ(result.bytes.empty(), !result.reason.empty());
  return result.reason;
}

bool begins(const std::string& text, const std::string& with) { return text.compare(0, with.size(), with) == 0; }

TEST(cook_refuses, fewer_than_four_points) {
  EXPECT_EQ(reason({}), "a hull needs four points or more, not 0");
  EXPECT_EQ(reason({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), "a hull needs four points or more, not 3");
}

TEST(cook_refuses, equal_collinear_and_coplanar_points) {
  EXPECT_EQ(reason(Cloud(10, {1, 2, 3})), "all points are equal: the hull has no volume");
  EXPECT_EQ(reason({{0, 0, 0}, {1, 2, 3}, {2, 4, 6}, {-1, -2, -3}}),
            "all points lie on one line: the hull has no volume");
  EXPECT_EQ(reason({{0, 0, 5}, {1, 0, 5}, {0, 1, 5}, {1, 1, 5}}), k_flat);
  EXPECT_EQ(reason({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1e-300, 0, 0}}), k_flat);
  EXPECT_EQ(reason({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}}), k_flat);
}

TEST(cook_refuses, a_plane_turned_any_way_however_rounded) {
  Random random = {1};
  for (int round = 0; round < 300; ++round) {
    Cloud cloud;
    const double size = exp2(random.uniform(-12, 12));
    for (int k = 0; k < 4 + round % 20; ++k)
      cloud.push_back({random.uniform(-size, size), random.uniform(-size, size), 0});
    cloud = placed(cloud, {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), 1}, {size, 0, 0});
    EXPECT_TRUE(begins(reason(cloud), "all points lie in one plane")) << reason(cloud);
    CookOptions options;
    options.frame = Frame::source;
    EXPECT_TRUE(begins(reason(cloud, options), "all points lie in one plane")) << reason(cloud, options);
  }
}

TEST(cook_refuses, a_thickness_below_a_floats_rounding_and_no_other) {
  for (const double size : {0.001, 1.0, 1000.0}) {
    EXPECT_TRUE(begins(reason(box_corners(size, size, size * 0x1p-26)), "all points lie in one plane but for "));
    EXPECT_EQ(reason(box_corners(size, size, size * 0x1p-23)), "");
    EXPECT_EQ(reason(box_corners(size, size * 0x1p-20, size * 0x1p-20)), "");
    EXPECT_EQ(reason({{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size * 0x1p-20}}), "");
  }
}

TEST(cook_refuses, what_is_no_number_or_out_of_range) {
  for (const double bad : {static_cast<double>(NAN), static_cast<double>(INFINITY), -static_cast<double>(INFINITY)}) {
    Cloud cloud = tetrahedron();
    cloud[2][1] = bad;
    EXPECT_EQ(reason(cloud), "point 3 has a coordinate that is not a finite number");
  }
  Cloud cloud = tetrahedron();
  cloud[1][0] = 0x1.8p31;
  EXPECT_EQ(reason(cloud), "point 2 lies beyond 2^31 m");
  cloud[1][0] = 1e300;
  EXPECT_EQ(reason(cloud), "point 2 lies beyond 2^31 m");
}

TEST(cook_refuses, sizes_beyond_2_to_the_15_m_and_below_2_to_the_minus_15) {
  EXPECT_EQ(reason(octahedron(0x1.fffp14)), "");
  EXPECT_EQ(reason(octahedron(0x1p-15)), "");
  EXPECT_TRUE(begins(reason(octahedron(0x1p15)), "the furthest point lies "));
  EXPECT_TRUE(begins(reason(octahedron(0x1.fffp-16)), "the furthest point lies "));
  EXPECT_TRUE(begins(reason(octahedron(1e-300)), "the furthest point lies "));
}

TEST(cook_refuses, options_out_of_range) {
  CookOptions options;
  options.vertex_limit = 3;
  EXPECT_EQ(reason(tetrahedron(), options), "the vertex limit is 3; it must be from 4 to 255");
  options.vertex_limit = 256;
  EXPECT_EQ(reason(tetrahedron(), options), "the vertex limit is 256; it must be from 4 to 255");
  options = {};
  options.weld = -1;
  EXPECT_EQ(reason(tetrahedron(), options), "the weld tolerance is no distance");
  options.weld = static_cast<double>(NAN);
  EXPECT_EQ(reason(tetrahedron(), options), "the weld tolerance is no distance");
}

TEST(cook_refuses, no_cloud_of_few_distinct_coordinates_without_a_reason) {
  // Every kind of degeneracy at once: points of a 3 x 3 x 3 lattice, some displaced by a few steps of the grid.
  Random random = {2};
  int solid = 0, flat = 0;
  for (int round = 0; round < 20000; ++round) {
    Cloud cloud;
    const uint64_t count = 4 + random.bits() % 12;
    for (uint64_t k = 0; k < count; ++k) {
      std::array<double, 3> p;
      for (double& value : p) {
        value = static_cast<double>(random.bits() % 3) - 1;
        if (round % 2 == 1) value += static_cast<double>(random.bits() % 5) * 0x1p-29;
      }
      cloud.push_back(p);
    }
    CookOptions options;
    options.frame = round % 4 < 2 ? Frame::principal : Frame::source;
    const std::string why = reason(cloud, options);
    if (why.empty()) {
      ++solid;
    } else {
      ++flat;
      EXPECT_TRUE(begins(why, "all points ")) << why;
    }
  }
  EXPECT_GT(solid, 1000);
  EXPECT_GT(flat, 100);
}

TEST(read_compound, refuses_more_corners_and_parts_than_can_be_cooked) {
  std::string parts;
  for (size_t i = 0; i <= 65536; ++i) parts += "ball 0 0 0 1\n";
  EXPECT_EQ(read_compound_text(parts).problem, "line 65537: more parts than can be cooked");
  std::string corners = "v 0 0 0\nf";
  for (size_t i = 0; i <= size_t{1} << 24; ++i) corners += " 1";
  EXPECT_EQ(read_compound_text(corners).problem, "line 2: more corners than can be cooked");
}

}  // namespace
