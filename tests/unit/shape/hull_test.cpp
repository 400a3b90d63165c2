#include "shape/hull.h"

#include <math.h>

#include <string>
#include <utility>
#include <vector>

#include "base/crc.h"
#include "math/wide.h"
#include "tests/common/support/test.h"
#include "tests/unit/math/samples.h"
#include "tests/unit/shape/hull_bytes.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_hulls::k_prism;
using detent_hulls::k_tetrahedron;

/// Bytes at an address that is a multiple of 8, in an allocation of exactly their size, so that a sanitizer detects
/// reads beyond it.
class Bytes {
 public:
  template <uint32_t n>
  explicit Bytes(const uint8_t (&from)[n]) : byte_count_(n), words_(n / 8) {
    static_assert(n % 8 == 0);
    memcpy(data(), from, n);
  }
  uint8_t* data() { return reinterpret_cast<uint8_t*>(words_.data()); }
  uint32_t count() const { return byte_count_; }
  void put(uint32_t at, uint32_t value) {
    for (uint32_t k = 0; k < 4; ++k) data()[at + k] = static_cast<uint8_t>(value >> (8 * k));
  }
  void seal() {
    put(k_hull_checksum_at, crc32(data() + k_hull_checksum_at + 4, byte_count_ - k_hull_checksum_at - 4,
                                  crc32(data(), k_hull_checksum_at)));
  }
  Status read(HullView& hull) { return read_hull({data(), byte_count_}, hull); }

 private:
  uint32_t byte_count_;
  std::vector<uint64_t> words_;
};

int64_t along(const HullView& hull, uint32_t vertex, const int32_t (&direction)[3]) {
  return int64_t{direction[0]} * hull.x(vertex) + int64_t{direction[1]} * hull.y(vertex) +
         int64_t{direction[2]} * hull.z(vertex);
}

/// The vertex at which hill climbing over neighbours ends.
uint32_t climb(const HullView& hull, uint32_t vertex, const int32_t (&direction)[3]) {
  for (;;) {
    uint32_t best = vertex;
    const HullIndices around = hull.neighbours(vertex);
    for (uint32_t k = 0; k < around.count; ++k) {
      if (along(hull, around.index[k], direction) > along(hull, best, direction)) best = around.index[k];
    }
    if (best == vertex) return vertex;
    vertex = best;
  }
}

/// Exact test, by the 2 by 2 minors of the differences from `vertex`.
bool is_above(const HullView& hull, uint32_t vertex, uint32_t a, uint32_t b, uint32_t c) {
  const auto x = [&](uint32_t i) { return int64_t{hull.x(i)} - hull.x(vertex); };
  const auto y = [&](uint32_t i) { return int64_t{hull.y(i)} - hull.y(vertex); };
  const auto z = [&](uint32_t i) { return int64_t{hull.z(i)} - hull.z(vertex); };
  const auto term = [&](uint32_t i, uint32_t j, uint32_t k) {
    return Int128::product(x(j) * y(k) - x(k) * y(j), z(i));
  };
  return term(a, b, c) + term(b, c, a) + term(c, a, b) < Int128::from(0);
}

/// The first property that accepted bytes violate, although read_hull() guarantees it. The bytes may be hostile.
std::string broken_promise(const HullView& hull, Samples& samples) {
  for (uint32_t i = 0; i < hull.vertex_count; ++i) {
    const int64_t x = hull.x(i), y = hull.y(i), z = hull.z(i);
    if (x * x + y * y + z * z >= int64_t{1} << 60) return "a vertex is too far away";
  }
  for (uint32_t i = 0; i < hull.vertex_count; ++i) {
    const HullIndices around = hull.neighbours(i);
    for (uint32_t k = 0; k < around.count; ++k) {
      if (around.index[k] >= hull.vertex_count) return "a neighbour is out of range";
    }
  }
  for (uint32_t i = 0; i < hull.face_count; ++i) {
    const HullIndices loop = hull.face(i), triangles = hull.triangles(i);
    if (triangles.count != 3 * (loop.count - 2)) return "a face's triangles do not match its loop";
    const HullPlane plane = hull.plane(i);
    const int64_t top = plane.offset * (int64_t{1} << 30);
    for (uint32_t k = 0; k < hull.vertex_count; ++k) {
      if (along(hull, k, plane.normal) > top) return "a vertex lies above a face";
    }
    for (uint32_t k = 0; k < loop.count; ++k) {
      if (loop.index[k] >= hull.vertex_count) return "a corner is out of range";
      if (along(hull, loop.index[k], plane.normal) < top - (int64_t{k_hull_face_slack} << 30)) return "a face is bent";
    }
    for (uint32_t k = 0; k < triangles.count; ++k) {
      if (triangles.index[k] >= hull.vertex_count) return "a triangle is out of range";
    }
  }
  for (uint32_t i = 0; i < hull.face_count; ++i) {
    const HullIndices triangles = hull.triangles(i);
    for (uint32_t k = 0; k < triangles.count; k += 3) {
      for (uint32_t other = 0; other < hull.vertex_count; ++other) {
        const uint8_t* corner = triangles.index + k;
        if (is_above(hull, other, corner[0], corner[1], corner[2])) return "a seam is concave";
      }
    }
  }
  for (uint32_t i = 0; i < hull.edge_count; ++i) {
    const HullEdge edge = hull.edge(i);
    if (edge.a >= edge.b || edge.b >= hull.vertex_count) return "an edge is out of range";
    if (edge.left >= hull.face_count || edge.right >= hull.face_count) return "an edge's face is out of range";
  }
  for (int round = 0; round < 4; ++round) {
    int32_t direction[3];
    for (int32_t& component : direction) component = static_cast<int32_t>(samples.bits() >> 34) - (1 << 29);
    int64_t furthest = along(hull, 0, direction);
    for (uint32_t i = 0; i < hull.vertex_count; ++i) {
      if (along(hull, i, direction) > furthest) furthest = along(hull, i, direction);
    }
    for (uint32_t i = 0; i < hull.vertex_count; ++i) {
      if (along(hull, climb(hull, i, direction), direction) != furthest) return "climbing ends too early";
    }
  }
  return {};
}

DETENT_TEST(hull, of_a_tetrahedron_reads_as_it_was_cooked) {
  HullView hull;
  ASSERT_OK(read_hull({k_tetrahedron, sizeof k_tetrahedron}, hull));
  EXPECT_EQ(hull.vertex_count, 4u);
  EXPECT_EQ(hull.padded_count, 16u);
  EXPECT_EQ(hull.face_count, 4u);
  EXPECT_EQ(hull.edge_count, 6u);
  EXPECT_EQ(hull.exponent(), 0);
  EXPECT_EQ(hull.frame(), HullFrame::principal);
  EXPECT_NEAR(hull.core_radius(), 0.82915619758885 * 0x1p30, 2);  // sqrt(11) / 4
  const double volume = hull.volume().mantissa * exp2(hull.volume().exponent);
  EXPECT_NEAR(volume, 1.0 / 6, 1e-8);
  // Second moments about the centre: 3/80 along the axes of the source, products -1/80; so 1/80 along (1, 1, 1) and
  // 4/80 across.
  double inverse_inertia[3];
  for (uint32_t axis = 0; axis < 3; ++axis)
    inverse_inertia[axis] = hull.inverse_inertia(axis).mantissa * exp2(hull.inverse_inertia(axis).exponent);
  int along_diagonal = 0;
  for (const double value : inverse_inertia) {
    if (fabs(value - 10) < 1e-7)
      ++along_diagonal;
    else
      EXPECT_NEAR(value, 16, 1e-7);
  }
  EXPECT_EQ(along_diagonal, 1);
  for (uint32_t i = 4; i < 16; ++i) EXPECT_EQ(hull.x(i), hull.x(0));
  for (uint32_t i = 0; i < 4; ++i) EXPECT_EQ(hull.neighbours(i).count, 3u);
}

DETENT_TEST(hull, of_a_prism_has_polygons_for_faces) {
  HullView hull;
  ASSERT_OK(read_hull({k_prism, sizeof k_prism}, hull));
  EXPECT_EQ(hull.vertex_count, 12u);
  EXPECT_EQ(hull.face_count, 8u);
  EXPECT_EQ(hull.edge_count, 18u);
  int hexagons = 0, rectangles = 0;
  for (uint32_t i = 0; i < 8; ++i) {
    hexagons += hull.face(i).count == 6;
    rectangles += hull.face(i).count == 4;
  }
  EXPECT_EQ(hexagons, 2);
  EXPECT_EQ(rectangles, 6);
  uint32_t neighbours = 0;  // the seams within faces that are flat to rounding are theirs too
  for (uint32_t i = 0; i < 12; ++i) neighbours += hull.neighbours(i).count;
  EXPECT_EQ(neighbours, 6u * 12 - 12);
  Samples samples = {1};
  EXPECT_EQ(broken_promise(hull, samples), "");
}

DETENT_TEST(hull, info_says_where_the_body_lies_in_its_source) {
  HullInfo info;
  ASSERT_OK(hull_info({k_prism, sizeof k_prism}, info));
  EXPECT_NEAR(info.origin[0], 3, 1e-8);
  EXPECT_NEAR(info.origin[1], -2, 1e-8);
  EXPECT_NEAR(info.origin[2], 1, 1e-8);
  double square = 0;
  for (const int32_t component : info.rotation) square += component * 0x1p-30 * component * 0x1p-30;
  EXPECT_NEAR(square, 1, 1e-9);
  EXPECT_NEAR(info.volume_mantissa * exp2(info.volume_exponent), 0.6651075101, 1e-8);  // 1.5 sqrt(3) 0.4^2 1.6
}

DETENT_TEST(hull, with_any_single_bit_flipped_is_refused) {
  Bytes bytes(k_prism);
  HullView hull;
  ASSERT_OK(bytes.read(hull));
  for (uint32_t bit = 0; bit < 8 * bytes.count(); ++bit) {
    bytes.data()[bit / 8] = static_cast<uint8_t>(bytes.data()[bit / 8] ^ 1u << (bit % 8));
    const Status status = bytes.read(hull);
    EXPECT_NE(status, Status::ok) << "bit " << bit;
    if (bit < 96) {
      EXPECT_EQ(status, bit < 64 ? Status::not_detent : Status::format_unknown);
    }
    bytes.data()[bit / 8] = static_cast<uint8_t>(bytes.data()[bit / 8] ^ 1u << (bit % 8));
  }
}

DETENT_TEST(hull, of_any_other_length_is_refused) {
  HullView hull;
  for (uint32_t count = 0; count < sizeof k_prism; ++count) {
    std::vector<uint64_t> words((count + 7) / 8);  // no more, for a sanitizer to see
    if (count != 0) memcpy(words.data(), k_prism, count);
    EXPECT_EQ(read_hull({reinterpret_cast<const uint8_t*>(words.data()), count}, hull), Status::truncated) << count;
  }
  std::vector<uint64_t> words(sizeof k_prism / 8 + 1);
  memcpy(words.data(), k_prism, sizeof k_prism);
  constexpr uint32_t k_count = sizeof k_prism;
  for (uint32_t more = 1; more <= 8; ++more) {
    EXPECT_EQ(read_hull({reinterpret_cast<const uint8_t*>(words.data()), k_count + more}, hull), Status::corrupt);
  }
  EXPECT_EQ(read_hull({nullptr, 0}, hull), Status::truncated);
}

DETENT_TEST(hull, at_an_address_that_is_no_multiple_of_8_is_refused) {
  std::vector<uint64_t> words(sizeof k_prism / 8 + 1);
  HullView hull;
  for (uint32_t shift = 1; shift < 8; ++shift) {
    uint8_t* const bytes = reinterpret_cast<uint8_t*>(words.data()) + shift;
    memcpy(bytes, k_prism, sizeof k_prism);
    EXPECT_EQ(read_hull({bytes, sizeof k_prism}, hull), Status::buffer_misaligned);
  }
}

DETENT_TEST(hull, of_another_format_version_is_refused_as_such) {
  Bytes bytes(k_prism);
  HullView hull;
  for (const uint32_t version : {0u, 2u, 0xffffffffu}) {
    bytes.put(k_hull_version_at, version);
    bytes.seal();
    EXPECT_EQ(bytes.read(hull), Status::format_unknown);
  }
}

DETENT_TEST(hull, with_a_hostile_header_and_a_right_checksum_is_refused_or_keeps_its_promises) {
  constexpr uint32_t k_values[] = {0,       1,         2,          3,          4,          5,          8,
                                   11,      13,        16,         255,        256,        0x7fff,     0xffff,
                                   0x10000, 1u << 29,  1u << 30,   1u << 31,   0x7fffffff, 0xfffffff1, 0xfffffff2,
                                   0xffff,  0xfffffff, 0x40000001, 0xffffffff, 0x3fffffff, 0x7ff00000, 0xfff80000};
  HullView hull;
  Samples samples = {2};
  for (uint32_t at = 0; at < k_hull_header_bytes; at += 4) {
    for (const uint32_t value : k_values) {
      Bytes bytes(k_prism);
      if (cooked_u32(bytes.data() + at) == value) continue;
      bytes.put(at, value);
      bytes.seal();
      if (bytes.read(hull) != Status::ok) continue;
      EXPECT_EQ(broken_promise(hull, samples), "") << at << " " << value;
      const bool free = at == k_hull_checksum_at || at == k_hull_exponent_at ||
                        (at >= k_hull_inverse_inertia_at && at < k_hull_rotation_at + 16);
      EXPECT_TRUE(free) << "accepted " << value << " at " << at;
    }
  }
  for (const int32_t exponent : {-15, 16, 1000, -1000}) {
    Bytes bytes(k_prism);
    bytes.put(k_hull_exponent_at, static_cast<uint32_t>(exponent));
    bytes.seal();
    EXPECT_EQ(bytes.read(hull), Status::out_of_range);
  }
}

DETENT_TEST(hull, with_hostile_counts_and_a_right_checksum_never_reads_beyond_its_bytes) {
  HullView hull;
  for (uint32_t vertices = 0; vertices <= 256; ++vertices) {
    for (uint32_t faces = 0; faces <= 24; ++faces) {
      Bytes bytes(k_prism);
      if (vertices == 12 && faces == 8) continue;
      bytes.put(k_hull_vertex_count_at, vertices);
      bytes.put(k_hull_face_count_at, faces);
      bytes.put(k_hull_edge_count_at, vertices + faces - 2);
      bytes.seal();
      EXPECT_NE(bytes.read(hull), Status::ok);
    }
  }
}

DETENT_TEST(hull, with_any_byte_altered_and_a_right_checksum_is_refused_or_keeps_its_promises) {
  HullView hull;
  ASSERT_OK(read_hull({k_prism, sizeof k_prism}, hull));
  const HullLayout at = hull.at;
  Samples samples = {4};
  uint32_t accepted = 0, tried = 0;
  for (uint32_t i = k_hull_checksum_at + 4; i < sizeof k_prism; ++i) {
    for (const uint32_t flip : {1u, 2u, 4u, 8u, 16u, 32u, 64u, 128u, 255u, 3u, 7u}) {
      Bytes bytes(k_prism);
      bytes.data()[i] = static_cast<uint8_t>(bytes.data()[i] ^ flip);
      bytes.seal();
      ++tried;
      if (bytes.read(hull) != Status::ok) continue;
      ++accepted;
      EXPECT_EQ(broken_promise(hull, samples), "") << i << " " << flip;
      EXPECT_LT(i, at.loop_offsets) << "accepted another topology";
      if (i >= at.x && i < at.planes) {  // a step or so, within the rounding of a flat face
        EXPECT_LT((i - at.x) % 4, 2u) << "accepted another vertex at " << i;
      }
    }
  }
  EXPECT_GT(accepted, 0u) << "nothing of the kind was tried";
  EXPECT_LT(accepted, tried / 4);
}

DETENT_TEST(hull, with_many_bytes_altered_and_a_right_checksum_is_refused_or_keeps_its_promises) {
  HullView hull;
  Samples samples = {5};
  int accepted = 0;
  for (int round = 0; round < 3000; ++round) {
    Bytes bytes(k_prism);
    const uint64_t alterations = 1 + samples.bits() % 6;
    for (uint64_t k = 0; k < alterations; ++k) {
      const uint64_t where = k_hull_checksum_at + 4 + samples.bits() % (sizeof k_prism - k_hull_checksum_at - 4);
      const uint8_t small[] = {0, 1, 3, 5, 6, 11, 12, 255};
      bytes.data()[where] =
          (samples.bits() & 1) != 0 ? small[samples.bits() % 8] : static_cast<uint8_t>(samples.bits());
    }
    bytes.seal();
    if (bytes.read(hull) != Status::ok) continue;
    ++accepted;
    EXPECT_EQ(broken_promise(hull, samples), "");
  }
  EXPECT_GT(accepted, 0) << "nothing of the kind was tried";
}

DETENT_TEST(hull, mirrored_or_with_a_vertex_pushed_in_is_refused) {
  Bytes bytes(k_prism);
  HullView hull;
  ASSERT_OK(bytes.read(hull));
  const HullLayout at = hull.at;
  for (uint32_t i = 0; i < hull.padded_count; ++i)
    bytes.put(at.x + 4 * i, static_cast<uint32_t>(-cooked_i32(bytes.data() + at.x + 4 * i)));
  bytes.seal();
  EXPECT_EQ(bytes.read(hull), Status::corrupt);
  for (uint32_t vertex = 1; vertex < 12; ++vertex) {
    Bytes dented(k_prism);
    for (const uint32_t column : {at.x, at.y, at.z}) {
      dented.put(column + 4 * vertex,
                 static_cast<uint32_t>(cooked_i32(dented.data() + column + 4 * vertex) / 1024 * 1023));
    }
    dented.seal();
    EXPECT_EQ(dented.read(hull), Status::corrupt) << vertex;
  }
}

/// Alters a prism by `alter`, gives it a correct checksum, and expects it to be refused.
template <class Alter>
void expect_corrupt(const char* what, const Alter& alter) {
  Bytes bytes(k_prism);
  HullView hull;
  ASSERT_OK(bytes.read(hull));
  alter(bytes, hull.at);
  bytes.seal();
  EXPECT_EQ(bytes.read(hull), Status::corrupt) << what;
}

DETENT_TEST(hull, with_a_right_checksum_but_wrong_contents_is_refused) {
  const auto swap_bytes = [](Bytes& bytes, uint32_t at, uint32_t other, uint32_t count) {
    for (uint32_t k = 0; k < count; ++k) std::swap(bytes.data()[at + k], bytes.data()[other + k]);
  };
  expect_corrupt("edges out of order", [&](Bytes& bytes, const HullLayout& at) {
    swap_bytes(bytes, at.edges, at.edges + k_hull_edge_bytes, k_hull_edge_bytes);
  });
  expect_corrupt("an edge twice", [](Bytes& bytes, const HullLayout& at) {
    memcpy(bytes.data() + at.edges, bytes.data() + at.edges + k_hull_edge_bytes, k_hull_edge_bytes);
  });
  expect_corrupt("an edge's faces exchanged",
                 [&](Bytes& bytes, const HullLayout& at) { swap_bytes(bytes, at.edges + 2, at.edges + 4, 2); });
  expect_corrupt("neighbours out of order",
                 [&](Bytes& bytes, const HullLayout& at) { swap_bytes(bytes, at.neighbours, at.neighbours + 1, 1); });
  expect_corrupt("a vertex its own neighbour",
                 [](Bytes& bytes, const HullLayout& at) { bytes.data()[at.neighbours] = 0; });
  expect_corrupt("triangles of two faces exchanged", [&](Bytes& bytes, const HullLayout& at) {
    swap_bytes(bytes, at.triangles, at.neighbours + 3 * 19, 3);
  });
  expect_corrupt("a triangle inside out",
                 [&](Bytes& bytes, const HullLayout& at) { swap_bytes(bytes, at.triangles, at.triangles + 1, 1); });
  expect_corrupt("a loop inside out",
                 [&](Bytes& bytes, const HullLayout& at) { swap_bytes(bytes, at.loops, at.loops + 2, 1); });
  expect_corrupt("a normal of half the length", [](Bytes& bytes, const HullLayout& at) {
    for (uint32_t k = 0; k < 16; k += 4) {
      bytes.put(at.planes + k, static_cast<uint32_t>((cooked_i32(bytes.data() + at.planes + k) + 1) / 2));
    }
  });
  expect_corrupt("planes of two faces exchanged", [&](Bytes& bytes, const HullLayout& at) {
    swap_bytes(bytes, at.planes, at.planes + k_hull_plane_bytes, k_hull_plane_bytes);
  });
  expect_corrupt("a plane too low", [](Bytes& bytes, const HullLayout& at) {
    bytes.put(at.planes + 12, cooked_u32(bytes.data() + at.planes + 12) - 8);
  });
  expect_corrupt("a plane too high", [](Bytes& bytes, const HullLayout& at) {
    bytes.put(at.planes + 12, cooked_u32(bytes.data() + at.planes + 12) + k_hull_face_slack + 1);
  });
  expect_corrupt("two vertices exchanged", [&](Bytes& bytes, const HullLayout& at) {
    for (const uint32_t column : {at.x, at.y, at.z}) swap_bytes(bytes, column + 4, column + 8, 4);
  });
  expect_corrupt("padding", [](Bytes& bytes, const HullLayout& at) { bytes.put(at.y + 4 * 15, 0); });
  expect_corrupt("an infinite origin",
                 [](Bytes& bytes, const HullLayout&) { bytes.put(k_hull_origin_at + 4, 0x7ff00000); });
  expect_corrupt("no inverse_inertia", [](Bytes& bytes, const HullLayout&) {
    bytes.put(k_hull_inverse_inertia_at + 8, 0);
    bytes.put(k_hull_inverse_inertia_at + 12, 0);
  });
  expect_corrupt("an inverse inertia whose mantissa is not canonical",
                 [](Bytes& bytes, const HullLayout&) { bytes.put(k_hull_inverse_inertia_at, (1u << 30) - 1); });
  expect_corrupt("an inverse inertia less than any of this size", [](Bytes& bytes, const HullLayout&) {
    bytes.put(k_hull_inverse_inertia_at + 4, static_cast<uint32_t>(-31));
  });
  expect_corrupt("a rotation of another length",
                 [](Bytes& bytes, const HullLayout&) { bytes.put(k_hull_rotation_at + 12, 1u << 29); });
  expect_corrupt("an unknown frame", [](Bytes& bytes, const HullLayout&) { bytes.put(k_hull_frame_at, 3); });
  expect_corrupt("the source's frame, but turned", [](Bytes& bytes, const HullLayout&) {
    bytes.put(k_hull_frame_at, 2);
    memset(bytes.data() + k_hull_inverse_inertia_at, 0, k_hull_rotation_at - k_hull_inverse_inertia_at);
  });
  expect_corrupt("the source's frame, but moved and with inverse_inertia", [](Bytes& bytes, const HullLayout&) {
    bytes.put(k_hull_frame_at, 2);
    memset(bytes.data() + k_hull_rotation_at, 0, 12);
    bytes.put(k_hull_rotation_at + 12, 1u << 30);
  });
  expect_corrupt("a volume a step off", [](Bytes& bytes, const HullLayout&) {
    bytes.put(k_hull_volume_at, cooked_u32(bytes.data() + k_hull_volume_at) + 2);
  });
  expect_corrupt("a core radius a step too large", [](Bytes& bytes, const HullLayout&) {
    bytes.put(k_hull_core_radius_at, cooked_u32(bytes.data() + k_hull_core_radius_at) + 1);
  });
}

DETENT_TEST(hull, with_vertices_moved_by_a_few_steps_is_refused_or_exactly_convex) {
  HullView hull;
  Samples samples = {6};
  int accepted = 0, refused = 0;
  for (int round = 0; round < 400; ++round) {
    Bytes bytes(k_prism);
    for (uint32_t vertex = 1; vertex < 12; ++vertex) {
      for (const uint32_t column : {hull_layout(12, 8, 18).x, hull_layout(12, 8, 18).y, hull_layout(12, 8, 18).z}) {
        uint8_t* const word = bytes.data() + column + 4 * vertex;
        if (samples.below(8) == 0) bytes.put(column + 4 * vertex, cooked_u32(word) + samples.below(5) - 2);
      }
    }
    for (uint32_t face = 0; face < 8; ++face) {  // so that only the seams can be wrong
      const uint32_t at = hull_layout(12, 8, 18).planes + k_hull_plane_bytes * face + 12;
      bytes.put(at, cooked_u32(bytes.data() + at) + 8);
    }
    bytes.seal();
    if (bytes.read(hull) != Status::ok) {
      ++refused;
      continue;
    }
    ++accepted;
    EXPECT_EQ(broken_promise(hull, samples), "");
  }
  EXPECT_GT(accepted, 0);
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
