#include "read_points.h"

#include <gtest/gtest.h>

namespace {

using namespace detent_cook;

TEST(read_points, takes_the_vertices_of_an_obj_and_nothing_else) {
  const PointsRead read = read_obj(
      "# v 9 9 9\n"
      "mtllib a.mtl\r\n"
      "v 1 2 3\r\n"
      "\tv  -1.5\t+2e-3   .5 1.0\n"
      "vn 0 0 1\nvt 0 0\nv0 1 2 3\n"
      "\n"
      "f 1 2 3\n"
      "v 0x 0 0 \n");
  EXPECT_EQ(read.problem, "line 10: '0x' is no finite number");
  const PointsRead good = read_obj("v 1 2 3\r\n\tv  -1.5\t+2e-3   .5 1.0 0.5 0.5 0.5\nvn 0 0 1\nv 7 8 9");
  EXPECT_EQ(good.problem, "");
  EXPECT_EQ(good.points, (std::vector<Point>{{1, 2, 3}, {-1.5, 0.002, 0.5}, {7, 8, 9}}));
}

TEST(read_points, names_the_line_of_a_bad_vertex) {
  EXPECT_EQ(read_obj("\n\nv 1 2\n").problem, "line 3: a vertex needs three numbers");
  EXPECT_EQ(read_obj("v").problem, "line 1: a vertex needs three numbers");
  EXPECT_EQ(read_obj("v 1 2 nan").problem, "line 1: 'nan' is no finite number");
  EXPECT_EQ(read_obj("v 1 2 inf").problem, "line 1: 'inf' is no finite number");
  EXPECT_EQ(read_obj("v 1 1e999 3").problem, "line 1: '1e999' is no finite number");
  EXPECT_EQ(read_obj("v 1 +-1 3").problem, "line 1: '+-1' is no finite number");
  EXPECT_EQ(read_obj("v 1 2,5 3").problem, "line 1: '2,5' is no finite number");
  EXPECT_EQ(read_obj(std::string_view("v 1 \0\x1b[2J 3", 11)).problem, "line 1: '??[2J' is no finite number");
  EXPECT_EQ(read_obj("").problem, "no line starts with 'v': this is no OBJ with vertices");
  EXPECT_EQ(read_obj("f 1 2 3\n").problem, "no line starts with 'v': this is no OBJ with vertices");
}

/// A cloud of one point, then one of two.
const std::string k_clouds(
    "\1\0\0\0"
    "\0\0\x80\x3f\0\0\0\x40\0\0\0\xbf"
    "\2\0\0\0"
    "\0\0\0\0\0\0\0\0\0\0\0\0"
    "\0\0\x80\x3f\0\0\x80\x3f\0\0\x80\x3f",
    44);

TEST(read_points, takes_one_of_many_clouds) {
  EXPECT_EQ(read_clouds(k_clouds, 0).points, (std::vector<Point>{{1, 2, -0.5}}));
  EXPECT_EQ(read_clouds(k_clouds, 1).points, (std::vector<Point>{{0, 0, 0}, {1, 1, 1}}));
  EXPECT_EQ(read_clouds(k_clouds, 2).problem, "there is no cloud 2: the file holds 2");
  EXPECT_EQ(read_points("a.bin", k_clouds, 1).points.size(), 2u);
  EXPECT_EQ(read_points("a.obj", "v 1 2 3", 7).points.size(), 1u);
}

TEST(read_points, says_where_a_file_of_clouds_is_cut_short) {
  for (size_t count = 1; count < k_clouds.size(); ++count) {
    const PointsRead read = read_clouds(std::string_view(k_clouds).substr(0, count), 1);
    EXPECT_EQ(read.problem, count < 16    ? "the file ends within cloud 0"
                            : count == 16 ? "there is no cloud 1: the file holds 1"
                                          : "the file ends within cloud 1");
  }
  EXPECT_EQ(read_clouds(std::string_view("\xff\xff\xff\xff", 4), 0).problem, "the file ends within cloud 0");
}

}  // namespace
