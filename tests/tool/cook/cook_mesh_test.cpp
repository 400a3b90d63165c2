#include "cook_mesh.h"

#include <gtest/gtest.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "cook_height_field.h"
#include "read_mesh.h"
#include "shape/mesh.h"
#include "tests/common/support/data_file.h"
#include "tests/unit/shape/terrains.h"

namespace {

using namespace detent_cook;
using namespace detent_terrains;

detent::MeshView view_of(const Bytes& bytes) {
  detent::MeshView mesh;
  EXPECT_EQ(detent::read_mesh({bytes.data(), bytes.count()}, mesh), detent::Status::ok);
  return mesh;
}

TEST(cook_mesh, real_levels_cook_and_are_accepted) {
  int cooked_count = 0;
  for (const char* name : {"building.obj", "conveyor.obj", "stairs.obj", "test_map01.obj", "voxel_mesh_01.obj"}) {
    const std::string text = detent_test::data_file(std::string("meshes/") + name);
    if (text.empty()) continue;
    const MeshRead read = read_obj_mesh(text);
    ASSERT_EQ(read.problem, "") << name;
    const MeshResult result = cook_mesh(read.mesh);
    ASSERT_EQ(result.reason, "") << name;
    view_of(Bytes(result.bytes));
    EXPECT_EQ(result.triangle_count + result.degenerate + result.repeated, read.mesh.triangles.size()) << name;
    printf("%s: %u triangles, %u degenerate, %u repeated, %u welded, %u open edges, %u forked, %zu bytes\n", name,
           result.triangle_count, result.degenerate, result.repeated, result.welded, result.open_edges,
           result.forked_edges, result.bytes.size());
    ++cooked_count;
  }
  if (cooked_count == 0) GTEST_SKIP() << "no meshes under DETENT_DATA";
  EXPECT_EQ(cooked_count, 5);
}

TEST(cook_mesh, welds_vertices_and_leaves_out_what_has_no_area) {
  Source source = plane(2, 1);
  const uint32_t a = add_vertex(source, -1, 0, -1), b = add_vertex(source, 0, 0, -1), c = add_vertex(source, 1, 0, -1);
  add_triangle(source, a, b, c);                    // on a line
  add_triangle(source, 0, 0, 1);                    // two corners the same
  source.triangles.push_back(source.triangles[0]);  // repeated
  const MeshResult exact = cook_mesh(source);
  EXPECT_EQ(exact.triangle_count, 8u);
  EXPECT_EQ(exact.vertex_count, 9u);
  EXPECT_EQ(exact.welded, 3u);
  EXPECT_EQ(exact.degenerate, 2u);
  EXPECT_EQ(exact.repeated, 1u);
  EXPECT_EQ(exact.open_edges, 8u);
  EXPECT_EQ(exact.forked_edges, 0u);

  Source torn = plane(2, 1);
  for (MeshSource::Triangle& triangle : torn.triangles) {
    for (uint32_t& v : triangle.vertex) {
      const Point p = torn.vertices[v];
      v = add_vertex(torn, p[0] + 1e-4 * static_cast<double>(torn.vertices.size() % 3), p[1], p[2]);
    }
  }
  MeshOptions options;
  EXPECT_GT(cook_mesh(torn, options).vertex_count, 9u);
  options.weld = 1e-3;
  const MeshResult welded = cook_mesh(torn, options);
  EXPECT_EQ(welded.vertex_count, 9u);
  EXPECT_EQ(welded.open_edges, 8u);
}

TEST(cook_mesh, an_edge_of_three_triangles_has_no_neighbours_and_is_counted) {
  Source source;
  const uint32_t a = add_vertex(source, 0, 0, 0), b = add_vertex(source, 1, 0, 0);
  add_triangle(source, a, b, add_vertex(source, 0, 1, 0));
  add_triangle(source, b, a, add_vertex(source, 0, 0, 1));
  add_triangle(source, b, a, add_vertex(source, 0, -1, 0));
  const MeshResult result = cook_mesh(source);
  EXPECT_EQ(result.forked_edges, 1u);
  EXPECT_EQ(result.open_edges, 7u);
  view_of(Bytes(result.bytes));
}

TEST(cook_mesh, what_cannot_be_cooked_is_refused_with_the_reason) {
  EXPECT_EQ(cook_mesh({}).reason, "there are no triangles");
  Source source = plane(1, 1);
  source.vertices[0][0] = NAN;
  EXPECT_EQ(cook_mesh(source).reason, "vertex 1 has a coordinate that is not a finite number");
  source.vertices[0][0] = 16384;
  EXPECT_EQ(cook_mesh(source).reason, "vertex 1 lies 16 km or more from the origin");
  source = plane(1, 1);
  source.triangles[1].vertex[2] = 4;
  EXPECT_EQ(cook_mesh(source).reason, "triangle 2 names a vertex that is missing");
  source = plane(1, 0);
  EXPECT_EQ(cook_mesh(source).reason, "all triangles are degenerate");
  MeshOptions options;
  options.weld = -1;
  EXPECT_EQ(cook_mesh(plane(1, 1), options).reason, "the weld tolerance is no distance");
}

TEST(cook_mesh, the_greatest_extent_and_many_triangles_are_accepted) {
  Source source = plane(1, 32767.9);
  view_of(Bytes(cook_mesh(source).bytes));
  const MeshResult many = cook_mesh(ground(getenv("DETENT_EMULATED") != nullptr ? 30 : 150, 0.5,
                                           [](double x, double z) { return 0.2 * sin(x) * sin(z); }));
  const Bytes bytes(many.bytes);
  const detent::MeshView mesh = view_of(bytes);
  EXPECT_EQ(many.open_edges, getenv("DETENT_EMULATED") != nullptr ? 120u : 600u);
  // A small box meets a few leaves alone.
  uint32_t asked = 0, met = 0;
  const detent::GridBox box = {{0, -(1 << 29), 0}, {1 << 20, 1 << 29, 1 << 20}};
  mesh.walk(
      [&](const detent::GridBox& other) {
        ++asked;
        return detent::meet(box, other);
      },
      [&](uint32_t) { ++met; });
  EXPECT_GE(met, 1u);
  EXPECT_LT(asked, 150u);
}

TEST(cook_height_field, what_cannot_be_cooked_is_refused_with_the_reason) {
  HeightFieldSource source;
  EXPECT_EQ(cook_height_field(source).reason, "a height field has 1 to 4096 cells along a side");
  source.columns = source.rows = 2;
  EXPECT_EQ(cook_height_field(source).reason, "there must be one height more along a side than there are cells");
  source.heights.assign(9, 1);
  source.cells.assign(3, 0);
  EXPECT_EQ(cook_height_field(source).reason, "the number of cells is not that of the sides");
  source.cells.clear();
  source.spacing_x = 0;
  EXPECT_EQ(cook_height_field(source).reason, "the spacing is not above 0");
  source.spacing_x = 10000;
  EXPECT_EQ(cook_height_field(source).reason, "the height field reaches 16 km or more from the origin");
  source.spacing_x = 8000;
  EXPECT_EQ(cook_height_field(source).reason, "");
  source.heights[4] = NAN;
  EXPECT_EQ(cook_height_field(source).reason, "height 5 lies 16 km or more from the origin");
}

TEST(read_obj_mesh, faces_of_any_size_with_backward_indices_and_materials_are_read) {
  const MeshRead read = read_obj_mesh(
      "v 0 0 0\nv 1 0 0\r\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nusemtl rock\nf 1/1/1 2/2/1 3/3/1 4\n"
      "usemtl ice\nf -1//1 -2//1 -3//1\nusemtl rock\nf 1 2 4");
  ASSERT_EQ(read.problem, "");
  ASSERT_EQ(read.mesh.triangles.size(), 4u);
  EXPECT_EQ(read.mesh.triangles[1].vertex, (std::array<uint32_t, 3>{0, 2, 3}));
  EXPECT_EQ(read.mesh.triangles[2].vertex, (std::array<uint32_t, 3>{3, 2, 1}));
  EXPECT_EQ(read.mesh.triangles[0].material, 0);
  EXPECT_EQ(read.mesh.triangles[2].material, 1);
  EXPECT_EQ(read.mesh.triangles[3].material, 0);
}

TEST(read_obj_mesh, what_is_wrong_is_told_with_its_line) {
  EXPECT_EQ(read_obj_mesh("v 0 0 0\n").problem, "no line starts with 'f': this is no OBJ with faces");
  EXPECT_EQ(read_obj_mesh("v 0 0\nf 1 1 1").problem, "line 1: a vertex needs three numbers");
  EXPECT_EQ(read_obj_mesh("v 0 0 0\nf 1 1").problem, "line 2: a face needs three vertices");
  EXPECT_EQ(read_obj_mesh("v 0 0 0\nf 1 1 2").problem, "line 2: '2' names no vertex before this line");
  EXPECT_EQ(read_obj_mesh("v 0 0 0\nf 1 1 0").problem, "line 2: '0' names no vertex before this line");
  EXPECT_EQ(read_obj_mesh("v 0 0 0\nf 1 1 -2").problem, "line 2: '-2' names no vertex before this line");
  EXPECT_EQ(read_obj_mesh("v 0 0 0\nf 1 1 x").problem, "line 2: 'x' names no vertex before this line");
}

/// A small file must not take all memory: `1 ` is a corner, and a corner a triangle.
TEST(read_obj_mesh, refuses_more_triangles_than_can_be_cooked) {
  std::string text = "v 0 0 0\nf 1 1 1";
  for (size_t i = 0; i < k_mesh_source_max; ++i) text += " 1";
  EXPECT_EQ(read_obj_mesh(text).problem, "line 2: more triangles than can be cooked");
}

/// A file of these scenes and nodes, and of one mesh: a triangle (0,0,0), (1,0,0), (0,1,0).
MeshRead read_nodes(const std::string& nodes) {
  // Three floats a corner; indices 0, 1, 2 as uint16.
  const std::string text = R"({"asset":{"version":"2.0"},)" + nodes + R"(,
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6}],
"buffers":[{"byteLength":42,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIA"}]})";
  EXPECT_NE(read_gltf_mesh("mesh.gltf", "").problem, "");
  EXPECT_NE(read_gltf_mesh("mesh.glb", text).problem, "");
  return read_gltf_mesh("mesh.gltf", text);
}

TEST(read_gltf_mesh, nodes_place_the_triangles) {
  if (!k_reads_gltf) GTEST_SKIP() << "built without tinygltf";
  const MeshRead read = read_nodes(R"("scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"translation":[1,2,3],"children":[1]},{"scale":[-2,1,1],"mesh":0}])");  // it moves, turns and mirrors
  ASSERT_EQ(read.problem, "");
  ASSERT_EQ(read.mesh.vertices.size(), 3u);
  EXPECT_EQ(read.mesh.vertices[1], (Point{-1, 2, 3}));
  EXPECT_EQ(read.mesh.vertices[2], (Point{1, 3, 3}));
  ASSERT_EQ(read.mesh.triangles.size(), 1u);
  EXPECT_EQ(read.mesh.triangles[0].vertex, (std::array<uint32_t, 3>{2, 1, 0}));
}

TEST(read_gltf_mesh, without_a_scene_each_node_is_there_once) {
  if (!k_reads_gltf) GTEST_SKIP() << "built without tinygltf";
  const MeshRead read = read_nodes(R"("nodes":[{"mesh":0},{"translation":[1,2,3],"children":[0]}])");
  EXPECT_EQ(read.problem, "");
  ASSERT_EQ(read.mesh.vertices.size(), 3u);
  EXPECT_EQ(read.mesh.vertices[0], (Point{1, 2, 3}));
}

TEST(read_gltf_mesh, nodes_that_share_their_parts_are_refused_before_they_are_too_many) {
  if (!k_reads_gltf) {
    EXPECT_NE(read_nodes(R"("nodes":[{"mesh":0}])").problem, "");
    GTEST_SKIP() << "built without tinygltf";
  }
  std::string nodes = R"("scene":0,"scenes":[{"nodes":[0]}],"nodes":[)";
  for (int i = 1; i <= 60; ++i) {  // 2^60 triangles
    nodes += R"({"children":[)" + std::to_string(i) + "," + std::to_string(i) + "]},";
  }
  EXPECT_EQ(read_nodes(nodes + R"({"mesh":0}])").problem, "the glTF names a node in two places");
  EXPECT_EQ(read_nodes(R"("scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"children":[0]}])").problem,
            "the glTF names a node in two places");
}

}  // namespace
