#include "shape/hull.h"

#include "base/binary_search.h"
#include "base/cycle.h"
#include "math/wide.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr uint32_t k_half_edges_max = 6 * k_hull_vertices_max - 12;

/// (b - a) x (c - a), exact: differences of vertices are shorter than 2^31, so each component is below 2^62.
Vec64 cross(const Vec32& a, const Vec32& b, const Vec32& c) {
  const int64_t bx = int64_t{b.x} - a.x, by = int64_t{b.y} - a.y, bz = int64_t{b.z} - a.z;
  const int64_t cx = int64_t{c.x} - a.x, cy = int64_t{c.y} - a.y, cz = int64_t{c.z} - a.z;
  return {by * cz - bz * cy, bz * cx - bx * cz, bx * cy - by * cx};
}

uint64_t square(int32_t value) { return static_cast<uint64_t>(int64_t{value} * value); }

bool gaps_are_zero(const HullView& hull) {
  const HullLayout& at = hull.at;
  const uint32_t half_edges = 6 * hull.vertex_count - 12;
  return cooked_is_zero(hull.bytes, k_hull_frame_at + 4, k_hull_header_bytes) &&
         cooked_is_zero(hull.bytes, at.loop_offsets + 2 * (hull.face_count + 1), at.loops) &&
         cooked_is_zero(hull.bytes, at.loops + 2 * hull.edge_count, at.neighbour_offsets) &&
         cooked_is_zero(hull.bytes, at.neighbour_offsets + 2 * (hull.vertex_count + 1), at.neighbours) &&
         cooked_is_zero(hull.bytes, at.neighbours + half_edges, at.triangles) &&
         cooked_is_zero(hull.bytes, at.triangles + half_edges, at.edges) &&
         cooked_is_zero(hull.bytes, at.edges + k_hull_edge_bytes * hull.edge_count, at.end);
}

/// Checks the lengths of the vertices, the core radius and the padding.
bool vertices_are_good(const HullView& hull) {
  uint64_t greatest = 0;
  for (uint32_t i = 0; i < hull.vertex_count; ++i) {
    const Vec32 v = hull.vertex(i);
    const uint64_t norm = square(v.x) + square(v.y) + square(v.z);  // at most 3 2^62
    if (norm >= k_one_squared) return false;
    if (norm > greatest) greatest = norm;
  }
  for (uint32_t i = hull.vertex_count; i < hull.padded_count; ++i) {
    if (hull.x(i) != hull.x(0) || hull.y(i) != hull.y(0) || hull.z(i) != hull.z(0)) return false;
  }
  const int32_t radius = hull.core_radius();
  // The unit is the least power of two above the lengths of all vertices, within the rounding of a vertex. So the
  // radius is at least half a unit.
  return radius >= (1 << 29) - 1 && radius <= (1 << 30) && greatest <= square(radius) && greatest > square(radius - 1);
}

/// Whether the offsets form `count` ranges of at least three values each, which together contain all `total` values.
bool offsets_are_good(const uint8_t* offsets, uint32_t count, uint32_t total) {
  if (cooked_u16(offsets) != 0 || cooked_u16(offsets + 2 * count) != total) return false;
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t from = cooked_u16(offsets + 2 * i), to = cooked_u16(offsets + 2 * i + 2);
    if (to < from + 3 || to > total) return false;
  }
  return true;
}

/// The index in the array `neighbours` of the entry for `b` in the list of vertex `a`; k_half_edges_max if `b` is not
/// in the list.
uint32_t half_edge(const HullView& hull, uint32_t a, uint32_t b) {
  const HullIndices around = hull.neighbours(a);
  const uint32_t at = partition_point(around.count, [&](uint32_t i) { return around.index[i] < b; });
  if (at == around.count || around.index[at] != b) return k_half_edges_max;
  return static_cast<uint32_t>(around.index + at - (hull.bytes + hull.at.neighbours));
}

/// Whether three conditions hold: the triangles form a closed surface whose directed sides are the entries of the
/// neighbour lists; no vertex lies above a triangle's plane; the surface encloses the stated volume. If they hold, the
/// triangles at each vertex cover the boundary around the vertex. Therefore a vertex that is not the farthest along a
/// direction has a neighbour that is farther. The triangles have as many directed sides as the lists have entries. So
/// if each side is found in the lists, and no entry is found twice, the lists are in range, ascending and complete.
bool triangles_are_good(const HullView& hull) {
  uint8_t seen[(k_half_edges_max + 7) / 8] = {};
  const Vec32 apex = hull.vertex(0);
  Int128 volume = Int128::from(0);  // the volume times 6 2^90; below 2^95
  const uint8_t* triangle = hull.bytes + hull.at.triangles;
  for (uint32_t i = 0; i < 2 * hull.vertex_count - 4; ++i, triangle += 3) {
    for (uint32_t k = 0; k < 3; ++k) {
      const uint32_t from = triangle[k], to = triangle[next_of_three(k)];
      if (from >= hull.vertex_count || to >= hull.vertex_count) return false;
      const uint32_t side = half_edge(hull, from, to);
      if (side == k_half_edges_max || half_edge(hull, to, from) == k_half_edges_max) return false;
      if ((seen[side / 8] >> (side % 8) & 1) != 0) return false;
      seen[side / 8] = static_cast<uint8_t>(seen[side / 8] | 1u << (side % 8));
    }
    const Vec32 a = hull.vertex(triangle[0]);
    const Vec64 normal = cross(a, hull.vertex(triangle[1]), hull.vertex(triangle[2]));
    if (normal.x == 0 && normal.y == 0 && normal.z == 0) return false;
    const Int128 offset = dot(normal, a);
    for (uint32_t k = 0; k < hull.vertex_count; ++k) {
      if (offset < dot(normal, hull.vertex(k))) return false;
    }
    volume = volume + (offset - dot(normal, apex));
  }
  const HullScaled stated = hull.volume();
  if (!stated.is_canonical(-130, -28)) return false;
  const int shift = stated.exponent + 90;  // in [-40, 62]
  const Int128 six = Int128::from(int64_t{6} * stated.mantissa).shift_left(shift > 0 ? shift : 0);
  const Int128 error =
      // The error must be at most one step of the mantissa. This also makes the volume positive.
      six - (shift < 0 ? volume.shift_left(-shift) : volume);
  const Int128 step = Int128::from(6).shift_left(shift > 0 ? shift : 0);
  return !(step < error) && !(step < -error);
}

/// Whether the vertices `from` and `to` follow each other in the loop.
bool has_side(const HullIndices& loop, uint32_t from, uint32_t to) {
  for (uint32_t k = 0; k < loop.count; ++k) {
    if (loop.index[k] == from) return loop.index[k + 1 == loop.count ? 0 : k + 1] == to;
  }
  return false;
}

bool has_triangle_side(const HullIndices& triangles, uint32_t from, uint32_t to) {
  for (uint32_t k = 0; k < triangles.count; ++k) {
    if (triangles.index[k] == from && triangles.index[k % 3 == 2 ? k - 2 : k + 1] == to) return true;
  }
  return false;
}

/// Whether the loop is the boundary of the face's triangles and has no vertex twice.
bool loop_is_good(const HullView& hull, uint32_t face) {
  const HullIndices loop = hull.face(face), triangles = hull.triangles(face);
  for (uint32_t k = 0; k < loop.count; ++k) {
    if (loop.index[k] >= hull.vertex_count) return false;
    for (uint32_t other = 0; other < k; ++other) {
      if (loop.index[other] == loop.index[k]) return false;
    }
  }
  for (uint32_t k = 0; k < loop.count; ++k) {
    if (!has_triangle_side(triangles, loop.index[k], loop.index[k + 1 == loop.count ? 0 : k + 1])) return false;
  }
  for (uint32_t k = 0; k < triangles.count; ++k) {
    const uint32_t from = triangles.index[k], to = triangles.index[k % 3 == 2 ? k - 2 : k + 1];
    if (!has_side(loop, from, to) && !has_triangle_side(triangles, to, from)) return false;
  }
  return true;
}

/// Whether the face's plane has a unit normal, no vertex lies above the plane, and the face is nearly flat and convex:
/// each vertex of the face lies at most k_hull_face_slack below the plane, and at most this far outside any of its
/// sides.
bool plane_is_good(const HullView& hull, uint32_t face) {
  const HullPlane plane = hull.plane(face);
  const auto& n = plane.normal;
  const uint64_t norm = square(n[0]) + square(n[1]) + square(n[2]);
  if (norm < k_one_squared - k_unit_vector_slack || norm > k_one_squared + k_unit_vector_slack) return false;
  const auto height = [&](const Vec32& v) { return int64_t{n[0]} * v.x + int64_t{n[1]} * v.y + int64_t{n[2]} * v.z; };
  const int64_t top = plane.offset * k_one_64;
  for (uint32_t i = 0; i < hull.vertex_count; ++i) {
    if (height(hull.vertex(i)) > top) return false;
  }
  const HullIndices loop = hull.face(face);
  for (uint32_t k = 0; k < loop.count; ++k) {
    const Vec32 a = hull.vertex(loop.index[k]);
    if (height(a) < top - k_hull_face_slack * k_one_64) return false;
    const Vec32 b = hull.vertex(loop.index[k + 1 == loop.count ? 0 : k + 1]);
    // The longest component of the side, which is at most the side's length.
    uint64_t side = magnitude_64(int64_t{b.x} - a.x);
    if (magnitude_64(int64_t{b.y} - a.y) > side) side = magnitude_64(int64_t{b.y} - a.y);
    if (magnitude_64(int64_t{b.z} - a.z) > side) side = magnitude_64(int64_t{b.z} - a.z);
    const Int128 least = -Int128::product(static_cast<int64_t>(side) * k_hull_face_slack, k_one_64);
    for (uint32_t other = 0; other < loop.count; ++other) {
      const Vec64 area = cross(a, b, hull.vertex(loop.index[other]));
      if (dot(area, Vec32{n[0], n[1], n[2]}) < least) return false;
    }
  }
  return true;
}

/// Whether the edges are in ascending order, and each edge lies between two faces whose loops run along it in opposite
/// directions.
/// Because read_hull() has checked the number of edges, no edge is missing.
bool edges_are_good(const HullView& hull) {
  uint32_t last = 0;
  for (uint32_t i = 0; i < hull.edge_count; ++i) {
    const HullEdge edge = hull.edge(i);
    const uint32_t key = uint32_t{edge.a} << 8 | edge.b;
    if (edge.a >= edge.b || key <= last || edge.left >= hull.face_count || edge.right >= hull.face_count) return false;
    if (!has_side(hull.face(edge.left), edge.a, edge.b) || !has_side(hull.face(edge.right), edge.b, edge.a))
      return false;
    last = key;
  }
  return true;
}

bool is_finite(uint64_t double_bits) { return (double_bits >> 52 & 0x7ff) != 0x7ff; }

bool frame_is_good(const HullView& hull) {
  const bool principal = hull.frame() == HullFrame::principal;
  if (!principal && hull.frame() != HullFrame::source) return false;
  for (uint32_t axis = 0; axis < 3; ++axis) {
    const HullScaled inverse_inertia = hull.inverse_inertia(axis);  // in (1, 2^70): all vertices are within one unit
    if (principal && !inverse_inertia.is_canonical(-30, 40)) return false;
    if (!principal && (inverse_inertia.mantissa != 0 || inverse_inertia.exponent != 0)) return false;
    const uint64_t origin = load_u64(hull.bytes + k_hull_origin_at + 8 * axis);
    if (principal ? !is_finite(origin) : origin != 0) return false;
  }
  uint64_t norm = 0;
  for (uint32_t k = 0; k < 4; ++k) {
    const int32_t component = cooked_i32(hull.bytes + k_hull_rotation_at + 4 * k);
    if (component < -k_one || component > k_one) return false;
    if (!principal && component != (k == 3 ? k_one : 0)) return false;
    norm += square(component);
  }
  return norm >= k_one_squared - k_unit_vector_slack && norm <= k_one_squared + k_unit_vector_slack;
}

}  // namespace

Status read_hull(const Asset& asset, HullView& hull) {
  if (const Status status = check_cooked(asset, k_hull_magic, k_hull_format_version, k_hull_header_bytes);
      status != Status::ok) {
    return status;
  }
  const uint8_t* const bytes = asset.bytes;
  const uint32_t vertices = cooked_u32(bytes + k_hull_vertex_count_at);
  const uint32_t faces = cooked_u32(bytes + k_hull_face_count_at);
  if (vertices < k_hull_vertices_min || vertices > k_hull_vertices_max || faces < 4 || faces > 2 * vertices - 4 ||
      // The number of edges follows from Euler's formula, which also implies 2 V - 4 triangles.
      cooked_u32(bytes + k_hull_edge_count_at) != vertices + faces - 2) {
    return Status::corrupt;
  }
  const HullView view = hull_view(bytes);
  if (view.at.end != asset.byte_count) return Status::corrupt;
  if (view.exponent() < k_hull_exponent_min || view.exponent() > k_hull_exponent_max) return Status::out_of_range;

  // The order matters: each check relies on the checks before it.
  if (!gaps_are_zero(view) || !frame_is_good(view) || !vertices_are_good(view) ||
      !offsets_are_good(bytes + view.at.loop_offsets, faces, 2 * view.edge_count) ||
      !offsets_are_good(bytes + view.at.neighbour_offsets, vertices, 6 * vertices - 12) || !triangles_are_good(view)) {
    return Status::corrupt;
  }
  for (uint32_t face = 0; face < faces; ++face) {
    if (!loop_is_good(view, face) || !plane_is_good(view, face)) return Status::corrupt;
  }
  if (!edges_are_good(view)) return Status::corrupt;
  hull = view;
  return Status::ok;
}

const HullOps k_hull_ops = {read_hull};

Status hull_info(const Asset& asset, HullInfo& info) {
  HullView hull;
  const Status status = read_hull(asset, hull);
  if (status != Status::ok) return status;
  info.vertex_count = hull.vertex_count;
  info.face_count = hull.face_count;
  info.edge_count = hull.edge_count;
  info.frame = hull.frame();
  info.exponent = hull.exponent();
  info.core_radius = hull.core_radius();
  info.volume_mantissa = hull.volume().mantissa;
  info.volume_exponent = hull.volume().exponent + 3 * hull.exponent();
  read_source_frame(hull.bytes + k_hull_origin_at, hull.bytes + k_hull_rotation_at, info.origin, info.rotation);
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
