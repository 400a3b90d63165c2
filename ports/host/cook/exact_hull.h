#pragma once
#include <stdint.h>

#include <array>
#include <vector>

namespace detent_cook {

/// A point of the grid of a hull's vertices. Each coordinate is at most 2^30 from the origin.
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
  bool reduced = false;  ///< the limit left some points outside
  /// The boundary, triangulated: 2 V - 4 triangles. Each vertex is extreme: it touches three or more planes.
  std::vector<Triangle> triangles{};
  std::vector<uint32_t> vertices{};  ///< ascending indices of points
};

/// Twice the area of the triangle, times its outward normal: (b - a) x (c - a). Exact: each component is below 2^62.
std::array<int64_t, 3> area_normal(const GridPoint& a, const GridPoint& b, const GridPoint& c);

/// Convex hull in integers, without rounding: the same on every machine. The points are distinct and ascending, so the
/// order of the cloud does not matter. Inserts the point that lies furthest outside, until none does or the limit is
/// reached. Source: Barber, Dobkin, Huhdanpaa, The Quickhull Algorithm for Convex Hulls, 1996.
ExactHull exact_hull(const std::vector<GridPoint>& points, uint32_t vertex_limit);

/// The least depth, over the triangles' planes, of the deepest point below the plane. It is an upper bound of the
/// width, at most a few times the width. In steps of the grid.
double least_depth(const std::vector<GridPoint>& points, const ExactHull& hull);

}  // namespace detent_cook
