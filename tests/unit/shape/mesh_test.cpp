#include "shape/mesh.h"

#include <math.h>

#include <algorithm>

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

/// Accepted meshes are traversed: a build with range checks stops at an invalid index.
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
  // Accepted changes: materials, the side flag, the exponent, and small displacements of vertices.
  EXPECT_GT(let_in, 18u * 8);
  EXPECT_LT(let_in, 18u * 8 + 32 + 16 * 3 * 31);
}

/// Returns the result of read_mesh() for the bytes with another word at `at`.
Status read_with(Bytes& bytes, uint32_t at, uint32_t word) {
  const Bytes before = bytes;
  for (uint32_t k = 0; k < 4; ++k) bytes.data()[at + k] = static_cast<uint8_t>(word >> (8 * k));
  seal(bytes);
  MeshView mesh;
  const Status status = read_mesh(asset_of(bytes), mesh);
  bytes = before;
  return status;
}

DETENT_TEST(mesh, with_edges_that_contradict_its_triangles_is_refused) {
  for (const Source& source : {ground(2, 1, bump), box_terrain(1, 2, 3, 1)}) {
    Bytes bytes = cooked(source);
    MeshView mesh;
    ASSERT_OK(read_mesh(asset_of(bytes), mesh));
    for (uint32_t i = 0; i < mesh.triangle_count; ++i) {
      for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t corner_at = mesh.triangles_at + k_mesh_triangle_bytes * i + 4 * k, edge_at = corner_at + 12;
        const uint32_t word = mesh.word(i, 3 + k), corner = mesh.word(i, k);
        ASSERT_OK(read_with(bytes, edge_at, word));
        // Every other neighbour or kind of edge.
        for (uint32_t kind = 0; kind < 5; ++kind) {
          for (uint32_t other = 0; other <= mesh.triangle_count + 1; ++other) {
            const uint32_t neighbour = other > mesh.triangle_count ? k_mesh_index_mask : other;
            const uint32_t wrong = kind << 24 | neighbour;
            if (wrong == word) continue;
            EXPECT_EQ(read_with(bytes, edge_at, wrong), Status::corrupt) << i << " " << k << " " << wrong;
          }
        }
        for (uint32_t other = 0; other <= mesh.vertex_count; ++other) {
          const uint32_t wrong = (corner & ~k_mesh_index_mask) | other;
          if (wrong == corner) continue;
          EXPECT_EQ(read_with(bytes, corner_at, wrong), Status::corrupt) << i << " " << k << " " << wrong;
        }
        if (k > 0) {
          EXPECT_EQ(read_with(bytes, corner_at, corner | 1u << 24), Status::corrupt);
        }
      }
    }
  }
}

DETENT_TEST(mesh, with_a_third_triangle_on_an_edge_is_refused) {
  Source source;
  const uint32_t a = add_vertex(source, 0, 0, 0), b = add_vertex(source, 1, 0, 0);
  add_triangle(source, a, b, add_vertex(source, 0, 1, 0));
  add_triangle(source, b, a, add_vertex(source, 0, -1, 0));
  // This triangle is separate from the other two until its bytes are replaced.
  add_triangle(source, add_vertex(source, 4, 0, 0), add_vertex(source, 5, 0, 0), add_vertex(source, 4, 0, 1));
  Bytes bytes = cooked(source);
  MeshView mesh;
  ASSERT_OK(read_mesh(asset_of(bytes), mesh));
  const auto edge_of = [&](uint32_t i) {
    for (uint32_t k = 0; k < 3; ++k) {
      if (mesh.neighbour(i, k) != k_no_triangle) return k;
    }
    return 3u;
  };
  uint32_t second = 0, third = 3;
  for (uint32_t i = 0; i < 3; ++i) {
    if (edge_of(i) == 3)
      third = i;
    else
      second = i;
  }
  ASSERT_LT(third, 3u);
  // Replaces the third triangle by a copy of one of the others, and updates the bounds of the leaf.
  std::vector<uint8_t> copy(bytes.data() + mesh.triangles_at + k_mesh_triangle_bytes * second,
                            bytes.data() + mesh.triangles_at + k_mesh_triangle_bytes * (second + 1));
  memcpy(bytes.data() + mesh.triangles_at + k_mesh_triangle_bytes * third, copy.data(), copy.size());
  uint16_t node[6];
  mesh_node(mesh, 0, 0, node);
  for (uint32_t k = 0; k < 6; ++k) {
    bytes.data()[mesh.nodes_at + 2 * k] = static_cast<uint8_t>(node[k]);
    bytes.data()[mesh.nodes_at + 2 * k + 1] = static_cast<uint8_t>(node[k] >> 8);
  }
  seal(bytes);
  MeshView wrong;
  EXPECT_EQ(read_mesh(asset_of(bytes), wrong), Status::corrupt);
}

DETENT_TEST(mesh, with_unused_bytes_that_are_not_zero_is_refused) {
  Bytes bytes = cooked(ground(2, 1, bump));
  MeshView mesh;
  ASSERT_OK(read_mesh(asset_of(bytes), mesh));
  const uint32_t vertices_end = mesh.vertices_at + k_mesh_vertex_bytes * mesh.vertex_count;
  const uint32_t nodes_end = mesh.nodes_at + k_mesh_node_bytes * mesh.level_start[mesh.level_count];
  ASSERT_EQ(mesh.triangles_at - vertices_end, 4u);
  ASSERT_EQ(mesh.end - nodes_end, 4u);
  const uint32_t spans[][2] = {
      {k_mesh_shift_at + 4, k_mesh_header_bytes}, {vertices_end, mesh.triangles_at}, {nodes_end, mesh.end}};
  for (const auto& span : spans) {
    for (uint32_t at = span[0]; at < span[1]; at += 4) {
      for (uint32_t byte = 0; byte < 4; ++byte)
        EXPECT_EQ(read_with(bytes, at, 1u << (8 * byte)), Status::corrupt) << at + byte;
    }
  }
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
    uint32_t asked = 0;
    const auto meets = [&](const GridBox& other) {
      ++asked;
      return meet(box, other);
    };
    mesh.walk(meets, [&](uint32_t i) { found.push_back(i); });
    EXPECT_LE(asked, 500 + 4 * found.size()) << "nodes that the box does not meet are skipped";
    for (uint32_t i = 0; i < mesh.triangle_count; ++i) {
      if (meet(box, mesh.triangle_bounds(i))) right.push_back(i);
    }
    EXPECT_EQ(found, right);
    most = std::max(most, static_cast<uint32_t>(found.size()));
  }
  EXPECT_GT(most, 50u);
}

DETENT_TEST(mesh, edges_are_known_for_what_they_are) {
  const Bytes bytes = cooked(box_terrain(1, 2, 3, 3));
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
