#include "shape/mesh.h"
#include "base/cycle.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

bool in_range(const Vec32& v) {
  const auto component = [](int32_t a) { return a >= -k_terrain_coordinate_max && a <= k_terrain_coordinate_max; };
  return component(v.x) && component(v.y) && component(v.z);
}

/// Whether the vertices' bounding box starts at `low`, and `shift` is the least number of bits by which the extents of
/// the box must be shifted to fit in 16 bits.
bool vertices_are_good(const MeshView& mesh) {
  GridBox box = {mesh.vertex(0), mesh.vertex(0)};
  for (uint32_t i = 0; i < mesh.vertex_count; ++i) {
    if (!in_range(mesh.vertex(i))) return false;
    include(mesh.vertex(i), box);
  }
  if (!(box.low == mesh.low)) return false;
  const Vec32 size = subtract(box.high, box.low);
  const auto fits = [&](int shift) { return ((size.x | size.y | size.z) >> shift) < 1 << 16; };
  return fits(mesh.shift) && (mesh.shift == 0 || !fits(mesh.shift - 1));
}

/// Whether the triangle's words are in range, no neighbour is the triangle itself, exactly the edges without a
/// neighbour are marked open, and the corners are not on a line.
bool triangle_is_good(const MeshView& mesh, uint32_t i) {
  for (uint32_t k = 0; k < 3; ++k) {
    if (mesh.vertex_of(i, k) >= mesh.vertex_count || (k > 0 && mesh.word(i, k) >> 24 != 0)) return false;
    const uint32_t other = mesh.neighbour(i, k), kind = mesh.word(i, 3 + k) >> 24;
    if (other != k_no_triangle && (other >= mesh.triangle_count || other == i)) return false;
    if (kind > static_cast<uint32_t>(EdgeKind::open)) return false;
    if ((other == k_no_triangle) != (mesh.kind(i, k) == EdgeKind::open)) return false;
  }
  const Vec32 a = mesh.vertex(mesh.vertex_of(i, 0)), b = mesh.vertex(mesh.vertex_of(i, 1)),
              c = mesh.vertex(mesh.vertex_of(i, 2));
  return !is_zero(area_vector(a, b, c));
}

/// Whether edge k of triangle i is open or agrees with its neighbour. It agrees if the neighbour has this edge in the
/// opposite direction, names triangle i as its own neighbour there, and the stored kind of the edge matches the
/// corners.
bool edge_is_good(const MeshView& mesh, uint32_t i, uint32_t k) {
  const uint32_t other = mesh.neighbour(i, k);
  if (other == k_no_triangle) return true;
  const uint32_t from = mesh.vertex_of(i, k), to = mesh.vertex_of(i, next_of_three(k));
  for (uint32_t n = 0; n < 3; ++n) {
    if (mesh.vertex_of(other, n) != to || mesh.vertex_of(other, next_of_three(n)) != from) continue;
    return mesh.neighbour(other, n) == i &&
           mesh.kind(i, k) == edge_kind(mesh.vertex(from), mesh.vertex(to),
                                        mesh.vertex(mesh.vertex_of(i, previous_of_three(k))),
                                        mesh.vertex(mesh.vertex_of(other, previous_of_three(n))));
  }
  return false;
}

bool node_is_good(const MeshView& mesh, uint32_t level, uint32_t i) {
  const uint8_t* stored = mesh.bytes + mesh.nodes_at + k_mesh_node_bytes * (mesh.level_start[level] + i);
  uint16_t node[6];
  mesh_node(mesh, level, i, node);
  for (uint32_t k = 0; k < 6; ++k) {
    if (cooked_u16(stored + 2 * k) != node[k]) return false;
  }
  return true;
}

}  // namespace

MeshView mesh_view(const uint8_t* bytes) {
  MeshView mesh;
  mesh.bytes = bytes;
  mesh.vertex_count = cooked_u32(bytes + k_mesh_vertex_count_at);
  mesh.triangle_count = cooked_u32(bytes + k_mesh_triangle_count_at);
  mesh.low = {cooked_i32(bytes + k_mesh_low_at), cooked_i32(bytes + k_mesh_low_at + 4),
              cooked_i32(bytes + k_mesh_low_at + 8)};
  mesh.shift = static_cast<int>(cooked_u32(bytes + k_mesh_shift_at) & 31);
  mesh.vertices_at = k_mesh_header_bytes;
  mesh.triangles_at = align_8(mesh.vertices_at + k_mesh_vertex_bytes * mesh.vertex_count);
  mesh.nodes_at = mesh.triangles_at + k_mesh_triangle_bytes * mesh.triangle_count;
  uint32_t count = (mesh.triangle_count + k_mesh_leaf_triangles - 1) / k_mesh_leaf_triangles;
  for (;;) {
    mesh.level_start[mesh.level_count + 1] = mesh.level_start[mesh.level_count] + count;
    ++mesh.level_count;
    if (count == 1) break;
    count = (count + 1) / 2;
  }
  mesh.end = align_8(mesh.nodes_at + k_mesh_node_bytes * mesh.level_start[mesh.level_count]);
  return mesh;
}

void mesh_node(const MeshView& mesh, uint32_t level, uint32_t i, uint16_t (&node)[6]) {
  if (level == 0) {
    GridBox box = mesh.triangle_bounds(k_mesh_leaf_triangles * i);
    for (uint32_t k = 1; k < k_mesh_leaf_triangles; ++k) {
      const uint32_t triangle = k_mesh_leaf_triangles * i + k;
      if (triangle >= mesh.triangle_count) break;
      const GridBox more = mesh.triangle_bounds(triangle);
      include(more.low, box);
      include(more.high, box);
    }
    const auto at = [&](int32_t value, int32_t low) { return static_cast<uint16_t>((value - low) >> mesh.shift); };
    node[0] = at(box.low.x, mesh.low.x);
    node[1] = at(box.low.y, mesh.low.y);
    node[2] = at(box.low.z, mesh.low.z);
    node[3] = at(box.high.x, mesh.low.x);
    node[4] = at(box.high.y, mesh.low.y);
    node[5] = at(box.high.z, mesh.low.z);
    return;
  }
  const uint8_t* child = mesh.bytes + mesh.nodes_at + k_mesh_node_bytes * (mesh.level_start[level - 1] + 2 * i);
  const bool both = 2 * i + 1 < mesh.level_size(level - 1);
  for (uint32_t k = 0; k < 6; ++k) {
    const uint32_t first = cooked_u16(child + 2 * k);
    const uint32_t second = both ? cooked_u16(child + k_mesh_node_bytes + 2 * k) : first;
    node[k] = static_cast<uint16_t>((k < 3) == (first < second) ? first : second);
  }
}

Status read_mesh(const Asset& asset, MeshView& mesh) {
  if (const Status status = check_cooked(asset, k_mesh_magic, k_mesh_format_version, k_mesh_header_bytes);
      status != Status::ok) {
    return status;
  }
  const uint8_t* const bytes = asset.bytes;
  const uint32_t vertices = cooked_u32(bytes + k_mesh_vertex_count_at);
  const uint32_t triangles = cooked_u32(bytes + k_mesh_triangle_count_at);
  if (vertices < 3 || vertices > k_mesh_vertices_max || triangles < 1 || triangles > k_mesh_triangles_max ||
      cooked_u32(bytes + k_mesh_flags_at) > k_mesh_one_sided || cooked_u32(bytes + k_mesh_shift_at) > 15) {
    return Status::corrupt;
  }
  const MeshView view = mesh_view(bytes);
  if (view.end != asset.byte_count) return Status::corrupt;
  if (view.exponent() < k_terrain_exponent_min || view.exponent() > k_terrain_exponent_max) return Status::out_of_range;
  if (!cooked_is_zero(bytes, k_mesh_shift_at + 4, k_mesh_header_bytes) ||
      !cooked_is_zero(bytes, view.vertices_at + k_mesh_vertex_bytes * vertices, view.triangles_at) ||
      !cooked_is_zero(bytes, view.nodes_at + k_mesh_node_bytes * view.level_start[view.level_count], view.end) ||
      !vertices_are_good(view)) {
    return Status::corrupt;
  }
  for (uint32_t i = 0; i < triangles; ++i) {
    if (!triangle_is_good(view, i)) return Status::corrupt;
  }
  for (uint32_t i = 0; i < triangles; ++i) {
    for (uint32_t k = 0; k < 3; ++k) {
      if (!edge_is_good(view, i, k)) return Status::corrupt;
    }
  }
  for (uint32_t level = 0; level < view.level_count; ++level) {
    for (uint32_t i = 0; i < view.level_size(level); ++i) {
      if (!node_is_good(view, level, i)) return Status::corrupt;
    }
  }
  mesh = view;
  return Status::ok;
}

Status mesh_info(const Asset& asset, MeshInfo& info) {
  MeshView mesh;
  if (const Status status = read_mesh(asset, mesh); status != Status::ok) return status;
  info.vertex_count = mesh.vertex_count;
  info.triangle_count = mesh.triangle_count;
  info.node_count = mesh.level_start[mesh.level_count];
  info.exponent = mesh.exponent();
  info.one_sided = mesh.one_sided();
  GridBox box = {mesh.low, mesh.low};
  for (uint32_t i = 0; i < mesh.vertex_count; ++i) include(mesh.vertex(i), box);
  const Vec32 ends[2] = {box.low, box.high};
  for (uint32_t n = 0; n < 2; ++n) {
    int32_t(&to)[3] = n == 0 ? info.low : info.high;
    to[0] = ends[n].x;
    to[1] = ends[n].y;
    to[2] = ends[n].z;
  }
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
