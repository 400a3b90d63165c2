#pragma once
#include "math/vector_integer.h"

/// The parts that meshes and height fields have in common: triangles with integer coordinates. A coordinate is in 2^-30
/// of the terrain's unit of length, and less than 2^30 in magnitude. So differences of corners fit in 32 bits, and
/// their cross products in 64 bits.
namespace detent {
inline namespace DETENT_NAMESPACE {

inline constexpr int32_t k_terrain_exponent_min = -14;
inline constexpr int32_t k_terrain_exponent_max = 14;
inline constexpr int32_t k_terrain_coordinate_max = (1 << 30) - 1;

/// How the neighbouring triangle continues beyond an edge. Values are stored in files and never reused.
enum class EdgeKind : uint8_t {
  flat = 0,     ///< the normals differ by at most k_flat_angle: no body can catch on the edge
  convex = 1,   ///< a ridge, seen from the side from which the corners are counter-clockwise
  concave = 2,  ///< a valley, seen from the side from which the corners are counter-clockwise
  open = 3,     ///< no neighbour
};
inline constexpr double k_flat_angle = 0x1p-6;  ///< rad

inline constexpr uint32_t k_no_triangle = UINT32_MAX;

/// A triangle of a terrain. Edge k runs from corner k to the next corner; the neighbour has this edge in the opposite
/// direction.
struct TerrainTriangle {
  Vec32 corner[3];
  uint32_t neighbour[3];  ///< k_no_triangle beyond an open edge
  EdgeKind kind[3];
  uint8_t material;
};

/// An axis-aligned box; both ends are included.
struct GridBox {
  Vec32 low, high;
};
inline bool meet(const GridBox& a, const GridBox& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
         a.low.z <= b.high.z && b.low.z <= a.high.z;
}
inline void include(const Vec32& point, GridBox& box) {
  const auto take = [](int32_t value, int32_t& low, int32_t& high) {
    low = value < low ? value : low;
    high = value > high ? value : high;
  };
  take(point.x, box.low.x, box.high.x);
  take(point.y, box.low.y, box.high.y);
  take(point.z, box.low.z, box.high.z);
}
inline GridBox bounds_of(const Vec32& a, const Vec32& b, const Vec32& c) {
  GridBox box = {a, a};
  include(b, box);
  include(c, box);
  return box;
}

/// (b - a) x (c - a), exact.
inline Vec64 area_vector(const Vec32& a, const Vec32& b, const Vec32& c) {
  return cross(subtract(b, a), subtract(c, a));
}
/// The unit normal, Q30. Range: the corners are not on a line.
Vec32 normal_of(const Vec32& a, const Vec32& b, const Vec32& c);

/// The kind of the edge from a to b between the triangles (a, b, c) and (b, a, d). The decision between convex and
/// concave is exact; two triangles folded onto each other count as convex.
EdgeKind edge_kind(const Vec32& a, const Vec32& b, const Vec32& c, const Vec32& d);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
