#include "tests/campaigns/fuzz/readers.h"

#include <gtest/gtest.h>

#include <string>

#include "ports/host/cook/cook_compound.h"
#include "ports/host/cook/read_heights.h"
#include "ports/host/cook/read_mesh.h"
#include "ports/host/cook/read_points.h"

namespace detent_fuzz {
namespace {

constexpr size_t k_points_max = 60, k_triangles_max = 200, k_parts_max = 4;  // more is not cooked here: that takes long
constexpr uint32_t k_cells_max = 32;

enum class Reader : uint8_t { points, clouds, mesh, heights, compound };

void cook(const std::vector<detent_cook::Point>& points) {
  if (points.size() > k_points_max) return;
  const detent_cook::CookResult result = detent_cook::cook_hull(points);
  EXPECT_NE(result.bytes.empty(), result.reason.empty()) << result.reason;
}

bool take_points(const detent_cook::PointsRead& read) {
  if (!read.problem.empty()) return false;
  cook(read.points);
  return true;
}

bool take_mesh(std::string_view text) {
  const detent_cook::MeshRead read = detent_cook::read_obj_mesh(text);
  if (!read.problem.empty()) return false;
  if (read.mesh.triangles.size() > k_triangles_max) return true;
  const detent_cook::MeshResult result = detent_cook::cook_mesh(read.mesh);
  EXPECT_NE(result.bytes.empty(), result.reason.empty()) << result.reason;
  return true;
}

bool take_heights(std::string_view text) {
  const detent_cook::HeightsRead read = detent_cook::read_pgm(text, 0.5, 2);
  if (!read.problem.empty()) return false;
  if (read.field.columns > k_cells_max || read.field.rows > k_cells_max) return true;
  const detent_cook::HeightFieldResult result = detent_cook::cook_height_field(read.field);
  EXPECT_NE(result.bytes.empty(), result.reason.empty()) << result.reason;
  return true;
}

bool take_compound(std::string_view text) {
  const detent_cook::CompoundRead read = detent_cook::read_compound_text(text);
  if (!read.problem.empty()) return false;
  if (read.parts.size() > k_parts_max) return true;
  for (const detent_cook::CompoundPart& part : read.parts) {
    if (part.points.size() > k_points_max) return true;
  }
  const detent_cook::CompoundResult result = detent_cook::cook_compound(read.parts);
  EXPECT_NE(result.bytes.empty(), result.reason.empty()) << result.reason;
  return true;
}

bool take(const Bytes& bytes) {
  if (bytes.empty()) return false;
  const std::string text(bytes.begin() + 1, bytes.end());
  switch (static_cast<Reader>(bytes[0] % 5)) {
    case Reader::points:
      return take_points(detent_cook::read_obj(text));
    case Reader::clouds:
      return take_points(detent_cook::read_clouds(text, bytes[0] / 5 % 2));
    case Reader::mesh:
      return take_mesh(text);
    case Reader::heights:
      return take_heights(text);
    default:
      return take_compound(text);
  }
}

Bytes seed(Reader reader, std::string_view text) {
  Bytes bytes(1 + text.size(), static_cast<uint8_t>(reader));
  std::copy(text.begin(), text.end(), bytes.begin() + 1);
  return bytes;
}

std::vector<Bytes> seeds() {
  using namespace std::string_view_literals;
  constexpr std::string_view k_solid =
      "# a solid\nv 0 0 0\r\nv 1 0 0\n\tv  -1.5\t+2e-3 .5 1.0\nv 0 0 1\nvn 0 0 1\n"
      "usemtl ice\nf 1 3 2\nf 1/1 4/2 3/3\nusemtl mud\nf -1 -2 -3 -4\n"sv;
  constexpr std::string_view k_parts =
      "o foot\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1/1 4/2 3/3\n"
      "density 2\nball 1 2 3 0.5\nrounding 0.1\nbox 0 0 0 1 2 3\ncapsule 0 0 0 1 0 0 0.25\n"sv;
  constexpr std::string_view k_cloud =
      "\4\0\0\0\0\0\x80\x3f\0\0\0\x40\0\0\0\xbf\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x80\x3f\0\0\x80\x3f\0\0\x80\x3f"
      "\0\0\0\x40\0\0\x80\xbf\0\0\0\0"sv;
  constexpr std::string_view k_binary = "P5 3 2 500\n\0\0\0\x64\0\xc8\x01\x2c\x01\x90\x01\xf4"sv;
  return {seed(Reader::points, k_solid),
          seed(Reader::clouds, k_cloud),
          seed(Reader::mesh, k_solid),
          seed(Reader::heights, "P2\n# made by hand\n3 2 # samples\n500\n0 100 200\n300 400 500\n"),
          seed(Reader::heights, k_binary),
          seed(Reader::compound, k_parts)};
}

}  // namespace

const Target k_readers_target = {take, seeds};

}  // namespace detent_fuzz
