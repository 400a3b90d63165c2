#pragma once
#include <stdint.h>

#include <array>
#include <vector>

namespace detent_cook {

/// A point of the grid of a hull's vertices. The magnitude of each coordinate is at most 2^30.
struct GridPoint {
  int32_t x, y, z;
  friend auto operator<=>(const GridPoint&, const GridPoint&) = default;
};

/// Three indices of points, counter-clockwise from outside.
using Triangle = std::array<uint32_t, 3>;

/// The dimension of a cloud.
enum class Span { point, line, plane, solid };

struct ExactHull {
  Span span = Span::point;
  bool reduced = false;  ///< some points lie outside the hull because of the vertex limit
  /// The boundary as 2 V - 4 triangles, for V vertices. Each vertex is extreme: it touches three or more planes.
  std::vector<Triangle> triangles{};
  std::vector<uint32_t> vertices{};  ///< ascending indices of points
};

/// Twice the area of the triangle, times its outward normal: (b - a) x (c - a). Exact: each component is below 2^62.
std::array<int64_t, 3> area_normal(const GridPoint& a, const GridPoint& b, const GridPoint& c);

/// Computes the convex hull in integers, without rounding, so the result is the same on every machine. The points must
/// be distinct and ascending, so that the order of the cloud does not matter. Inserts the point that lies furthest
/// outside, again and again, until no point lies outside or the limit is reached. Source: Barber, Dobkin, Huhdanpaa,
/// The Quickhull Algorithm for Convex Hulls, 1996.
ExactHull exact_hull(const std::vector<GridPoint>& points, uint32_t vertex_limit);

/// For each triangle's plane, takes the depth of the deepest point below the plane. Returns the least of these depths,
/// in steps of the grid. It is an upper bound of the hull's width, and at most a few times the width.
double least_depth(const std::vector<GridPoint>& points, const ExactHull& hull);

}  // namespace detent_cook
