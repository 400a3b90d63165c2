#include "shape/height_field.h"

#include <set>

#include "base/crc.h"
#include "shape/terrain.h"
#include "tests/common/oracle/effort.h"
#include "tests/common/support/test.h"
#include "tests/unit/math/samples.h"
#include "tests/unit/shape/terrains.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using namespace detent_terrains;

Asset asset_of(const Bytes& bytes) { return {bytes.data(), bytes.count()}; }

/// Random heights, materials, diagonals and some holes.
Bytes rough_field(uint32_t columns, uint32_t rows, uint64_t seed) {
  Samples samples = {seed};
  detent_cook::HeightFieldSource source;
  source.columns = columns;
  source.rows = rows;
  source.origin = {-3, 1, -2};
  source.spacing_x = 0.5;
  source.spacing_z = 0.75;
  for (uint32_t i = 0; i < (columns + 1) * (rows + 1); ++i) source.heights.push_back(samples.below(1000) * 0.002 - 1);
  for (uint32_t i = 0; i < columns * rows; ++i) {
    source.cells.push_back(
        static_cast<uint8_t>(samples.below(8) == 0 ? 0x80 : samples.below(2) * 0x40 + samples.below(4)));
  }
  return Bytes(detent_cook::cook_height_field(source).bytes);
}

DETENT_TEST(height_field, is_read_as_it_was_cooked) {
  const Bytes bytes = rough_field(13, 9, 1);
  HeightFieldInfo info;
  ASSERT_OK(height_field_info(asset_of(bytes), info));
  EXPECT_EQ(info.columns, 13u);
  EXPECT_EQ(info.rows, 9u);
  EXPECT_EQ(info.exponent, 3);
  EXPECT_EQ(info.spacing_x, 1 << 26);
  EXPECT_EQ(info.spacing_z, 3 << 25);
  EXPECT_TRUE(info.one_sided);
  EXPECT_LT(info.low, info.high);
}

DETENT_TEST(height_field, neighbours_are_mutual_and_edges_alike_from_both_sides) {
  const Bytes bytes = rough_field(11, 7, 2);
  HeightFieldView field;
  ASSERT_OK(read_height_field(asset_of(bytes), field));
  uint32_t shared = 0;
  for (uint32_t i = 0; i < field.triangle_count(); ++i) {
    if ((field.cell(i / 2 % 11, i / 2 / 11) & k_cell_hole) != 0) continue;
    const TerrainTriangle t = field.triangle(i);
    EXPECT_GT(area_vector(t.corner[0], t.corner[1], t.corner[2]).y, 0);
    for (uint32_t k = 0; k < 3; ++k) {
      if (t.neighbour[k] == k_no_triangle) {
        EXPECT_EQ(t.kind[k], EdgeKind::open);
        continue;
      }
      const TerrainTriangle other = field.triangle(t.neighbour[k]);
      uint32_t back = 3;
      for (uint32_t n = 0; n < 3; ++n) {
        if (other.corner[n] == t.corner[(k + 1) % 3] && other.corner[(n + 1) % 3] == t.corner[k]) back = n;
      }
      ASSERT_LT(back, 3u) << i << " " << k;
      EXPECT_EQ(other.neighbour[back], i);
      EXPECT_EQ(other.kind[back], t.kind[k]);
      ++shared;
    }
  }
  EXPECT_GT(shared, 200u);
}

DETENT_TEST(height_field, tree_finds_what_a_search_through_all_triangles_finds) {
  Samples samples = {6};
  const Bytes bytes = rough_field(40, 21, 3);
  HeightFieldView field;
  ASSERT_OK(read_height_field(asset_of(bytes), field));
  for (uint32_t n = 0; n < detent_oracle::rounds(500); ++n) {
    const auto some = [&](int power) { return static_cast<int32_t>(samples.integer(power)); };
    const Vec32 at = {some(30), some(27), some(30)};
    const GridBox box = {at, add(at, Vec32{1 << 27, 1 << 24, 1 << 27})};
    std::set<uint32_t> found, right;
    uint32_t asked = 0;
    const auto meets = [&](const GridBox& other) {
      ++asked;
      return meet(box, other);
    };
    field.walk(meets, [&](uint32_t i) { found.insert(i); });
    EXPECT_LE(asked, 500 + 4 * found.size()) << "nodes that the box does not meet are skipped";
    for (uint32_t i = 0; i < field.triangle_count(); ++i) {
      if ((field.cell(i / 2 % 40, i / 2 / 40) & k_cell_hole) != 0) continue;
      const TerrainTriangle t = field.triangle(i);
      if (meet(box, bounds_of(t.corner[0], t.corner[1], t.corner[2]))) right.insert(i);
    }
    EXPECT_EQ(found, right);
  }
}

DETENT_TEST(height_field, every_flipped_bit_is_refused_and_under_a_right_checksum_harmless) {
  Bytes bytes = rough_field(5, 4, 4);
  HeightFieldView field;
  ASSERT_OK(read_height_field(asset_of(bytes), field));
  uint32_t let_in = 0;
  for (uint32_t bit = 0; bit < 8 * bytes.count(); ++bit) {
    std::vector<uint8_t> copy(bytes.data(), bytes.data() + bytes.count());
    copy[bit / 8] = static_cast<uint8_t>(copy[bit / 8] ^ 1u << (bit % 8));
    Bytes flipped(copy);
    EXPECT_NE(read_height_field(asset_of(flipped), field), Status::ok) << bit;
    const uint32_t sum = crc32(flipped.data() + k_cooked_checksum_at + 4, flipped.count() - k_cooked_checksum_at - 4,
                               crc32(flipped.data(), k_cooked_checksum_at));
    for (uint32_t k = 0; k < 4; ++k) flipped.data()[k_cooked_checksum_at + k] = static_cast<uint8_t>(sum >> (8 * k));
    if (bit / 32 == k_cooked_checksum_at / 4 || read_height_field(asset_of(flipped), field) != Status::ok) continue;
    ++let_in;
    const GridBox all = field.bounds();
    field.walk([&](const GridBox& box) { return meet(box, all); },
               [&](uint32_t i) {
                 const TerrainTriangle t = field.triangle(i);
                 for (const uint32_t other : t.neighbour)
                   EXPECT_TRUE(other == k_no_triangle || other < field.triangle_count());
               });
  }
  EXPECT_GE(let_in, 5u * 4 * 8);  // each bit of a cell
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
