#pragma once
#include "exact_hull.h"

namespace detent_cook {

/// A face of the cooked hull: a polygon of triangles that lie in one plane within a tolerance.
struct PolygonFace {
  std::vector<uint32_t> loop{};       ///< counter-clockwise from outside, its least index first
  std::vector<Triangle> triangles{};  ///< loop.size() - 2 of them, ascending, each with its least index first
  std::array<int32_t, 3> normal{};    ///< unit, in 2^-30
  int32_t offset = 0;                 ///< of the plane, rounded up, so that no vertex lies above the plane
};

/// Joins neighbouring triangles to polygons, the flattest edge first. Two polygons are joined if all corners of the new
/// polygon lie within `tolerance` of one plane, and the new polygon is convex within `tolerance`. `tolerance` is in
/// steps of the grid; if it is negative, no triangles are joined. The faces are ascending by their loops.
std::vector<PolygonFace> join_faces(const std::vector<GridPoint>& points, const ExactHull& hull, int32_t tolerance);

}  // namespace detent_cook
