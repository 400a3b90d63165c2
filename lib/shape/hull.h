#pragma once
#include <detent/asset.h>
#include <detent/detail/shared.h>
#include <detent/features.h>

#include "base/check.h"
#include "math/vector_integer.h"
#include "shape/cooked.h"

/// Offsets and readers of a cooked convex hull in flash or in a file; docs/hull.md describes the format.
namespace detent {
inline namespace DETENT_NAMESPACE {

inline constexpr uint8_t k_hull_magic[8] = {0x89, 'D', 'T', 'H', '\r', '\n', 0x1a, '\n'};
inline constexpr uint32_t k_hull_format_version = 1;

/// Byte offsets of the header's fields.
inline constexpr uint32_t k_hull_version_at = 8;
inline constexpr uint32_t k_hull_byte_count_at = 12;
inline constexpr uint32_t k_hull_checksum_at = 16;  ///< CRC-32 of all bytes except these four
inline constexpr uint32_t k_hull_exponent_at = 20;
inline constexpr uint32_t k_hull_core_radius_at = 24;
inline constexpr uint32_t k_hull_vertex_count_at = 28;
inline constexpr uint32_t k_hull_face_count_at = 32;
inline constexpr uint32_t k_hull_edge_count_at = 36;
inline constexpr uint32_t k_hull_volume_at = 40;           ///< mantissa, exponent
inline constexpr uint32_t k_hull_inverse_inertia_at = 48;  ///< mantissa, exponent; for each of the three axes
inline constexpr uint32_t k_hull_origin_at = 72;           ///< three doubles
inline constexpr uint32_t k_hull_rotation_at = 96;         ///< x, y, z, w
inline constexpr uint32_t k_hull_frame_at = 112;
inline constexpr uint32_t k_hull_header_bytes = 128;  ///< zero from 116 on

inline constexpr uint32_t k_hull_vertices_min = 4;
inline constexpr uint32_t k_hull_vertices_max = 255;
inline constexpr uint32_t k_hull_padding = 16;  ///< vertices are padded to a multiple of this by copies of vertex 0
inline constexpr int32_t k_hull_exponent_min = -14;
inline constexpr int32_t k_hull_exponent_max = 15;
/// Every vertex of a face lies at most this far below the plane of the face, in 2^-30 of the unit. No vertex lies above
/// the plane.
inline constexpr int32_t k_hull_face_slack = 1 << 10;

/// Byte offsets of the parts after the header, from the start of the file; all are multiples of 8. With V vertices, F
/// faces and E edges, the boundary has 2 V - 4 triangles with 3 V - 6 sides, and all face loops together have 2 E
/// vertices.
struct HullLayout {
  uint32_t x, y, z;       ///< padded_count int32 each, in 2^-30 of the unit
  uint32_t planes;        ///< F times four int32: unit normal x, y, z in 2^-30; offset in 2^-30 of the unit
  uint32_t loop_offsets;  ///< F + 1 uint16: the start of each face's loop in `loops`; the last one is 2 E
  uint32_t loops;         ///< 2 E uint8
  /// V + 1 uint16: the start of each vertex's list in `neighbours`; the last one is 6 V - 12.
  uint32_t neighbour_offsets;
  uint32_t neighbours;  ///< 6 V - 12 uint8
  uint32_t triangles;   ///< 2 V - 4 times three uint8
  uint32_t edges;       ///< E times HullEdge: uint8 a, b; uint16 left, right
  uint32_t end;
};
inline constexpr uint32_t k_hull_plane_bytes = 16;
inline constexpr uint32_t k_hull_edge_bytes = 6;

constexpr uint32_t hull_padded_count(uint32_t vertex_count) {
  return (vertex_count + k_hull_padding - 1) / k_hull_padding * k_hull_padding;
}
/// Computes the offsets from the counts. Range: vertex_count from k_hull_vertices_min to k_hull_vertices_max;
/// face_count and edge_count below 2^16.
DETENT_SHARED constexpr HullLayout hull_layout(uint32_t vertex_count, uint32_t face_count, uint32_t edge_count) {
  const auto aligned = [](uint32_t bytes) { return (bytes + 7) / 8 * 8; };
  const uint32_t column = 4 * hull_padded_count(vertex_count);
  HullLayout at = {};
  at.x = k_hull_header_bytes;
  at.y = at.x + column;
  at.z = at.y + column;
  at.planes = at.z + column;
  at.loop_offsets = at.planes + k_hull_plane_bytes * face_count;
  at.loops = aligned(at.loop_offsets + 2 * (face_count + 1));
  at.neighbour_offsets = aligned(at.loops + 2 * edge_count);
  at.neighbours = aligned(at.neighbour_offsets + 2 * (vertex_count + 1));
  at.triangles = aligned(at.neighbours + 6 * vertex_count - 12);
  at.edges = aligned(at.triangles + 3 * (2 * vertex_count - 4));
  at.end = aligned(at.edges + k_hull_edge_bytes * edge_count);
  return at;
}

/// An outward face plane: every vertex has normal . vertex <= offset 2^30, exactly.
struct HullPlane {
  int32_t normal[3];  ///< unit normal, in 2^-30; its length is 1 within 2^-29 (its square within 2^-28)
  int32_t offset;     ///< distance of the plane from the origin, in 2^-30 of the hull's unit
};
/// An edge and its two faces. The loop of face `left` runs along the edge from vertex a to b, the loop of `right` from
/// b to a; a < b.
struct HullEdge {
  uint8_t a, b;
  uint16_t left, right;
};
/// The number mantissa 2^exponent, with 2^30 <= mantissa < 2^31; for the number 0 both members are 0. The fixed
/// configurations represent a Scaled in the same way.
struct HullScaled {
  int32_t mantissa, exponent;

  bool is_canonical(int32_t exponent_min, int32_t exponent_max) const {
    return mantissa >= k_one && exponent >= exponent_min && exponent <= exponent_max;
  }
};
/// A list of vertex indices; the indices stay in the asset.
struct HullIndices {
  const uint8_t* index;
  uint32_t count;
};

/// A view of a cooked hull; it copies nothing. Vertices are in 2^-30 of the unit, |vertex| < 2^30.
struct HullView {
  const uint8_t* bytes = nullptr;
  uint32_t vertex_count = 0;
  uint32_t padded_count = 0;  ///< a multiple of 16; from vertex_count on, x, y and z repeat vertex 0
  uint32_t face_count = 0;
  uint32_t edge_count = 0;
  HullLayout at = {};

  Vec32 vertex(uint32_t i) const { return {x(i), y(i), z(i)}; }
  int32_t x(uint32_t i) const { return coordinate(at.x, i); }
  int32_t y(uint32_t i) const { return coordinate(at.y, i); }
  int32_t z(uint32_t i) const { return coordinate(at.z, i); }
  /// The vertex's neighbours on the triangulated boundary of the exact hull, ascending. If no neighbour lies farther
  /// along a direction than the vertex, then no vertex of the hull does.
  HullIndices neighbours(uint32_t vertex) const { return range(at.neighbour_offsets, at.neighbours, vertex); }
  /// The face's vertices, counter-clockwise from outside. The face is flat and convex within k_hull_face_slack.
  HullIndices face(uint32_t i) const { return range(at.loop_offsets, at.loops, i); }
  HullPlane plane(uint32_t face) const {
    DETENT_VERIFY_RANGE(face < face_count);
    const uint8_t* words = bytes + at.planes + k_hull_plane_bytes * face;
    return {{cooked_i32(words), cooked_i32(words + 4), cooked_i32(words + 8)}, cooked_i32(words + 12)};
  }
  /// Those triangles of the exact hull's boundary that form the face: three vertex indices each, counter-clockwise from
  /// outside.
  HullIndices triangles(uint32_t face) const {
    DETENT_VERIFY_RANGE(face < face_count);
    const uint8_t* offsets = bytes + at.loop_offsets + 2 * face;
    const uint32_t from = cooked_u16(offsets), to = cooked_u16(offsets + 2);
    return {bytes + at.triangles + 3 * (from - 2 * face), 3 * (to - from - 2)};
  }
  HullEdge edge(uint32_t i) const {
    DETENT_VERIFY_RANGE(i < edge_count);
    const uint8_t* words = bytes + at.edges + k_hull_edge_bytes * i;
    return {words[0], words[1], static_cast<uint16_t>(cooked_u16(words + 2)),
            static_cast<uint16_t>(cooked_u16(words + 4))};
  }

  int32_t exponent() const { return cooked_i32(bytes + k_hull_exponent_at); }
  int32_t core_radius() const { return cooked_i32(bytes + k_hull_core_radius_at); }
  HullFrame frame() const { return static_cast<HullFrame>(cooked_u32(bytes + k_hull_frame_at)); }
  /// The volume, in unit^3.
  HullScaled volume() const { return scaled(k_hull_volume_at); }
  /// Inverse inertia (per unit mass), m unit^2 / I, about the body axis `axis` (0 to 2), for uniform density; 0 if the
  /// vertices are in the source frame (HullFrame::source).
  HullScaled inverse_inertia(uint32_t axis) const { return scaled(k_hull_inverse_inertia_at + 8 * axis); }

 private:
  int32_t coordinate(uint32_t column, uint32_t i) const {
    DETENT_VERIFY_RANGE(i < padded_count);
    return cooked_i32(bytes + column + 4 * i);
  }
  DETENT_SHARED HullIndices range(uint32_t offsets_at, uint32_t values_at, uint32_t i) const {
    const uint8_t* offsets = bytes + offsets_at + 2 * i;
    const uint32_t from = cooked_u16(offsets);
    return {bytes + values_at + from, cooked_u16(offsets + 2) - from};
  }
  HullScaled scaled(uint32_t field) const { return {cooked_i32(bytes + field), cooked_i32(bytes + field + 4)}; }
};

/// The hull at `bytes`. read_hull() must have accepted them; this function checks nothing.
DETENT_SHARED inline HullView hull_view(const uint8_t* bytes) {
  HullView hull;
  hull.bytes = bytes;
  hull.vertex_count = cooked_u32(bytes + k_hull_vertex_count_at);
  hull.padded_count = hull_padded_count(hull.vertex_count);
  hull.face_count = cooked_u32(bytes + k_hull_face_count_at);
  hull.edge_count = cooked_u32(bytes + k_hull_edge_count_at);
  hull.at = hull_layout(hull.vertex_count, hull.face_count, hull.edge_count);
  return hull;
}

/// Checks untrusted bytes. An accepted hull is a convex solid in range. Its indices are valid, and hill climbing along
/// neighbours finds the farthest vertex exactly. Inverse inertia, origin and rotation are checked only for their
/// ranges, not against the vertices. With V vertices, this takes about 2 V^2 exact plane tests. Errors:
/// buffer_misaligned (8), not_detent, format_unknown, truncated, corrupt, out_of_range (the exponent).
Status read_hull(const Asset& asset, HullView& hull);

/// The hull reader, for a feature table.
struct HullOps {
  decltype(&read_hull) read;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
