#pragma once
#include "exact_hull.h"

namespace detent_cook {

/// A face of the cooked hull: a polygon of triangles that lie in one plane within a tolerance.
struct PolygonFace {
  std::vector<uint32_t> loop{};       ///< counter-clockwise from outside, its least index first
  std::vector<Triangle> triangles{};  ///< loop.size() - 2 of them, ascending, each with its least index first
  std::array<int32_t, 3> normal{};    ///< unit, in 2^-30
  int32_t offset = 0;                 ///< rounded up, so that no vertex lies above the plane
};

/// Joins neighbouring triangles, the flattest edge first, while all corners of the polygon lie within `tolerance` of
/// one plane and it is convex within `tolerance`, in steps of the grid. Below 0 it joins none. Faces are ascending by
/// their loops.
std::vector<PolygonFace> join_faces(const std::vector<GridPoint>& points, const ExactHull& hull, int32_t tolerance);

}  // namespace detent_cook
