#pragma once
#include <detent/asset.h>

#include "base/check.h"
#include "shape/cooked.h"
#include "shape/terrain_triangle.h"

/// Offsets and readers of a cooked triangle mesh in flash or in a file; docs/mesh.md describes the format.
namespace detent {
inline namespace DETENT_NAMESPACE {

inline constexpr uint8_t k_mesh_magic[8] = {0x89, 'D', 'T', 'M', '\r', '\n', 0x1a, '\n'};
inline constexpr uint32_t k_mesh_format_version = 1;

/// Byte offsets of the header's fields after the fields that all formats have.
inline constexpr uint32_t k_mesh_exponent_at = 20;
inline constexpr uint32_t k_mesh_vertex_count_at = 24;
inline constexpr uint32_t k_mesh_triangle_count_at = 28;
inline constexpr uint32_t k_mesh_flags_at = 32;
inline constexpr uint32_t k_mesh_low_at = 36;  ///< three int32: the least coordinates of the vertices
/// The bounds of nodes are stored relative to `low`, in units of 2^shift coordinate units.
inline constexpr uint32_t k_mesh_shift_at = 48;
inline constexpr uint32_t k_mesh_header_bytes = 64;  ///< zero from 52 on

inline constexpr uint32_t k_mesh_one_sided = 1;  ///< a bit of the flags
inline constexpr uint32_t k_mesh_triangles_max = 1u << 20;
inline constexpr uint32_t k_mesh_vertices_max = 3 * k_mesh_triangles_max;
inline constexpr uint32_t k_mesh_vertex_bytes = 12;
/// A triangle has six words: three vertices and three neighbours. A word is a 24-bit index, and in the upper 8 bits the
/// material (first vertex) or the edge kind (neighbours).
inline constexpr uint32_t k_mesh_triangle_bytes = 24;
inline constexpr uint32_t k_mesh_index_mask = (1u << 24) - 1;  ///< the index with all bits set means: no neighbour
inline constexpr uint32_t k_mesh_node_bytes = 12;              ///< uint16: low x, y, z, high x, y, z
inline constexpr uint32_t k_mesh_leaf_triangles = 4;
inline constexpr uint32_t k_mesh_levels_max = 19;

/// A view of a cooked mesh; it copies nothing. Its tree has no pointers: leaf i contains the triangles 4 i to 4 i + 3,
/// and node i of a higher level contains the nodes 2 i and 2 i + 1 of the level below.
struct MeshView {
  const uint8_t* bytes = nullptr;
  uint32_t vertex_count = 0, triangle_count = 0;
  uint32_t vertices_at = 0, triangles_at = 0, nodes_at = 0, end = 0;
  uint32_t level_count = 0;
  uint32_t level_start[k_mesh_levels_max + 1] = {};  ///< the first node of each level; the leaves are level 0
  Vec32 low = {};
  int shift = 0;

  int32_t exponent() const { return cooked_i32(bytes + k_mesh_exponent_at); }
  bool one_sided() const { return (cooked_u32(bytes + k_mesh_flags_at) & k_mesh_one_sided) != 0; }
  Vec32 vertex(uint32_t i) const {
    DETENT_VERIFY_RANGE(i < vertex_count);
    const uint8_t* words = bytes + vertices_at + k_mesh_vertex_bytes * i;
    return {cooked_i32(words), cooked_i32(words + 4), cooked_i32(words + 8)};
  }
  uint32_t vertex_of(uint32_t triangle, uint32_t k) const { return word(triangle, k) & k_mesh_index_mask; }
  uint32_t neighbour(uint32_t triangle, uint32_t k) const {
    const uint32_t index = word(triangle, 3 + k) & k_mesh_index_mask;
    return index == k_mesh_index_mask ? k_no_triangle : index;
  }
  EdgeKind kind(uint32_t triangle, uint32_t k) const { return static_cast<EdgeKind>(word(triangle, 3 + k) >> 24); }
  uint8_t material(uint32_t triangle) const { return static_cast<uint8_t>(word(triangle, 0) >> 24); }
  uint32_t word(uint32_t triangle, uint32_t k) const {
    DETENT_VERIFY_RANGE(triangle < triangle_count && k < 6);
    return cooked_u32(bytes + triangles_at + k_mesh_triangle_bytes * triangle + 4 * k);
  }
  TerrainTriangle triangle(uint32_t i) const {
    TerrainTriangle result;
    for (uint32_t k = 0; k < 3; ++k) {
      result.corner[k] = vertex(vertex_of(i, k));
      result.neighbour[k] = neighbour(i, k);
      result.kind[k] = kind(i, k);
    }
    result.material = material(i);
    return result;
  }
  GridBox triangle_bounds(uint32_t i) const {
    return bounds_of(vertex(vertex_of(i, 0)), vertex(vertex_of(i, 1)), vertex(vertex_of(i, 2)));
  }
  uint32_t level_size(uint32_t level) const { return level_start[level + 1] - level_start[level]; }
  /// The node's bounds, rounded outwards. Overflow: the high end is clamped to the range of a coordinate.
  GridBox node_bounds(uint32_t level, uint32_t i) const {
    const uint8_t* words = bytes + nodes_at + k_mesh_node_bytes * (level_start[level] + i);
    const auto at = [&](uint32_t k, int32_t from, uint32_t more) {
      const int64_t value = from + ((static_cast<int64_t>(cooked_u16(words + 2 * k)) + more) << shift) - more;
      return static_cast<int32_t>(value > k_terrain_coordinate_max ? k_terrain_coordinate_max : value);
    };
    return {{at(0, low.x, 0), at(1, low.y, 0), at(2, low.z, 0)}, {at(3, low.x, 1), at(4, low.y, 1), at(5, low.z, 1)}};
  }
  GridBox bounds() const { return node_bounds(level_count - 1, 0); }

  /// Calls visit(index) for each triangle whose bounds, a GridBox, satisfy `meets`; in ascending order.
  template <class Meets, class Visit>
  void walk(Meets&& meets, Visit&& visit) const;
};

/// The mesh at `bytes`. read_mesh() must have accepted them; this function checks nothing.
MeshView mesh_view(const uint8_t* bytes);

/// Computes the values that the file stores for a node: the bounds of its triangles (level 0) or of its child nodes, in
/// units of 2^shift coordinate units, counted from `low`.
void mesh_node(const MeshView& mesh, uint32_t level, uint32_t i, uint16_t (&node)[6]);

/// Checks untrusted bytes. In an accepted mesh the indices are valid, neighbours are mutual, the edge kinds match the
/// corners, and the tree's bounds are the tightest possible. Errors: buffer_misaligned (8), not_detent,
/// format_unknown, truncated, corrupt, out_of_range (the exponent).
Status read_mesh(const Asset& asset, MeshView& mesh);

template <class Meets, class Visit>
void MeshView::walk(Meets&& meets, Visit&& visit) const {
  struct Entry {
    uint32_t level, node;
  };
  Entry stack[k_mesh_levels_max + 1];  // at most one node of each level waits: a second child
  uint32_t count = 0;
  stack[count++] = {level_count - 1, 0};
  while (count > 0) {
    const Entry entry = stack[--count];
    if (!meets(node_bounds(entry.level, entry.node))) continue;
    if (entry.level > 0) {
      const uint32_t child = 2 * entry.node;
      if (child + 1 < level_size(entry.level - 1)) stack[count++] = {entry.level - 1, child + 1};
      stack[count++] = {entry.level - 1, child};
      continue;
    }
    for (uint32_t k = 0; k < k_mesh_leaf_triangles; ++k) {
      const uint32_t i = k_mesh_leaf_triangles * entry.node + k;
      if (i < triangle_count && meets(triangle_bounds(i))) visit(i);
    }
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
