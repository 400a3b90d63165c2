#include "geometry/mesh.h"

#include <math.h>

#include <algorithm>

#include "base/crc.h"
#include "geometry/surface.h"
#include "tests/geometry/surfaces.h"
#include "tests/math/samples.h"
#include "tests/oracle/effort.h"
#include "tests/support/test.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using namespace detent_surfaces;

Asset asset_of(const Bytes& bytes) { return {bytes.data(), bytes.count()}; }

void seal(Bytes& bytes) {
  uint8_t* data = bytes.data();
  const uint32_t sum = crc32(data + k_cooked_checksum_at + 4, bytes.count() - k_cooked_checksum_at - 4,
                             crc32(data, k_cooked_checksum_at));
  for (uint32_t k = 0; k < 4; ++k) data[k_cooked_checksum_at + k] = static_cast<uint8_t>(sum >> (8 * k));
}

double bump(double x, double z) { return 0.3 * x * z / (1 + x * x + z * z); }

DETENT_TEST(mesh, is_read_as_it_was_cooked) {
  const Source source = ground(9, 0.5, bump);
  const Bytes bytes = cooked(source, true);
  MeshView mesh;
  ASSERT_OK(read_mesh(asset_of(bytes), mesh));
  EXPECT_EQ(mesh.triangle_count, 162u);
  EXPECT_EQ(mesh.vertex_count, 100u);
  EXPECT_TRUE(mesh.one_sided());
  MeshInfo info;
  ASSERT_OK(mesh_info(asset_of(bytes), info));
  EXPECT_EQ(info.triangle_count, 162u);
  EXPECT_EQ(info.exponent, 2);
  EXPECT_EQ(info.low[0], -9 * (1 << 26));
  EXPECT_EQ(info.high[0], 9 * (1 << 26));
}

DETENT_TEST(mesh, every_flipped_bit_is_refused) {
  Bytes bytes = cooked(ground(3, 1, bump));
  MeshView mesh;
  ASSERT_OK(read_mesh(asset_of(bytes), mesh));
  for (uint32_t bit = 0; bit < 8 * bytes.count(); ++bit) {
    bytes.data()[bit / 8] = static_cast<uint8_t>(bytes.data()[bit / 8] ^ 1u << (bit % 8));
    EXPECT_NE(read_mesh(asset_of(bytes), mesh), Status::ok) << bit;
    bytes.data()[bit / 8] = static_cast<uint8_t>(bytes.data()[bit / 8] ^ 1u << (bit % 8));
  }
}

/// What is let in is walked through: a verifying build stops at an index that is none.
DETENT_TEST(mesh, every_flipped_bit_under_a_right_checksum_is_refused_or_harmless) {
  Bytes bytes = cooked(ground(3, 1, bump));
  uint32_t let_in = 0;
  for (uint32_t bit = 0; bit < 8 * bytes.count(); ++bit) {
    if (bit / 32 == k_cooked_checksum_at / 4) continue;
    bytes.data()[bit / 8] = static_cast<uint8_t>(bytes.data()[bit / 8] ^ 1u << (bit % 8));
    seal(bytes);
    MeshView mesh;
    if (read_mesh(asset_of(bytes), mesh) == Status::ok) {
      ++let_in;
      uint32_t count = 0;
      const GridBox all = mesh.bounds();
      mesh.walk([&](const GridBox& box) { return meet(box, all); },
                [&](uint32_t i) {
                  for (const uint32_t other : mesh.triangle(i).neighbour)
                    count += other == k_no_triangle || other < 18 ? 1u : 0u;
                });
      EXPECT_EQ(count, 3 * mesh.triangle_count);
    }
    bytes.data()[bit / 8] = static_cast<uint8_t>(bytes.data()[bit / 8] ^ 1u << (bit % 8));
  }
  // Materials, the side, the exponent, and small moves of vertices.
  EXPECT_GT(let_in, 18u * 8);
  EXPECT_LT(let_in, 18u * 8 + 32 + 16 * 3 * 31);
}

DETENT_TEST(mesh, cut_short_at_any_byte_is_refused) {
  const Bytes whole = cooked(plane(2, 1));
  const std::vector<uint8_t> all(whole.data(), whole.data() + whole.count());
  MeshView mesh;
  for (uint32_t count = 0; count < whole.count(); ++count) {
    std::vector<uint64_t> words(count / 8 + 1);
    if (count > 0) memcpy(words.data(), all.data(), count);
    EXPECT_NE(read_mesh({reinterpret_cast<const uint8_t*>(words.data()), count}, mesh), Status::ok);
  }
  EXPECT_EQ(read_mesh({nullptr, 0}, mesh), Status::truncated);
  EXPECT_EQ(read_mesh({whole.data() + 4, whole.count() - 4}, mesh), Status::buffer_misaligned);
}

DETENT_TEST(mesh, tree_finds_what_a_search_through_all_triangles_finds) {
  Samples samples = {5};
  const Bytes bytes = cooked(ground(20, 0.25, bump));
  MeshView mesh;
  ASSERT_OK(read_mesh(asset_of(bytes), mesh));
  uint32_t most = 0;
  for (uint32_t n = 0; n < detent_oracle::rounds(1000); ++n) {
    const auto some = [&](int power) { return static_cast<int32_t>(samples.integer(power)); };
    const Vec32 at = {some(29), some(28), some(29)};
    const GridBox box = {at, add(at, Vec32{1 << (20 + n % 9), 1 << 27, 1 << (20 + n % 9)})};
    std::vector<uint32_t> found, right;
    mesh.walk([&](const GridBox& other) { return meet(box, other); }, [&](uint32_t i) { found.push_back(i); });
    for (uint32_t i = 0; i < mesh.triangle_count; ++i) {
      if (meet(box, mesh.triangle_bounds(i))) right.push_back(i);
    }
    EXPECT_EQ(found, right);
    most = std::max(most, static_cast<uint32_t>(found.size()));
  }
  EXPECT_GT(most, 50u);
}

DETENT_TEST(mesh, edges_are_known_for_what_they_are) {
  const Bytes bytes = cooked(box_surface(1, 2, 3, 3));
  MeshView mesh;
  ASSERT_OK(read_mesh(asset_of(bytes), mesh));
  uint32_t count[4] = {};
  for (uint32_t i = 0; i < mesh.triangle_count; ++i) {
    for (uint32_t k = 0; k < 3; ++k) ++count[static_cast<uint32_t>(mesh.kind(i, k))];
  }
  EXPECT_EQ(count[static_cast<uint32_t>(EdgeKind::convex)], 12u * 3 * 2);
  EXPECT_EQ(count[static_cast<uint32_t>(EdgeKind::concave)], 0u);
  EXPECT_EQ(count[static_cast<uint32_t>(EdgeKind::open)], 0u);

  const Bytes valley = cooked(ground(4, 1, [](double x, double) { return 0.5 * fabs(x); }));
  MeshView second;
  ASSERT_OK(read_mesh(asset_of(valley), second));
  uint32_t concave = 0, convex = 0, open = 0;
  for (uint32_t i = 0; i < second.triangle_count; ++i) {
    for (uint32_t k = 0; k < 3; ++k) {
      concave += second.kind(i, k) == EdgeKind::concave ? 1u : 0u;
      convex += second.kind(i, k) == EdgeKind::convex ? 1u : 0u;
      open += second.kind(i, k) == EdgeKind::open ? 1u : 0u;
    }
  }
  EXPECT_EQ(concave, 8u);
  EXPECT_EQ(convex, 0u);
  EXPECT_EQ(open, 16u);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
