#include "faces.h"

#include <math.h>
#include <stdlib.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "integers.h"

namespace detent_cook {
namespace {

constexpr int64_t k_one = int64_t{1} << 30;

using Side = std::pair<uint32_t, uint32_t>;  ///< from one vertex to another

/// The loop around the triangles, its least index first; empty if they do not form a disc without an inner vertex.
std::vector<uint32_t> loop_about(const std::vector<Triangle>& triangles) {
  std::map<Side, uint32_t> sides;
  for (const Triangle& t : triangles) {
    for (uint32_t k = 0; k < 3; ++k) sides[{t[k], t[(k + 1) % 3]}] = 0;
  }
  std::map<uint32_t, uint32_t> next;
  for (const auto& [side, unused] : sides) {
    if (sides.count({side.second, side.first}) != 0) continue;
    if (!next.insert(side).second) return {};  // the loop would pass a vertex twice
  }
  std::vector<uint32_t> loop;
  uint32_t at = next.begin()->first;
  do {
    loop.push_back(at);
    at = next[at];
  } while (at != loop[0] && loop.size() <= next.size());
  if (loop.size() != next.size() || loop.size() != triangles.size() + 2) return {};
  return loop;
}

int64_t height(const PolygonFace& face, const GridPoint& p) {
  return int64_t{face.normal[0]} * p.x + int64_t{face.normal[1]} * p.y + int64_t{face.normal[2]} * p.z;
}

/// The plane with the triangles' mean normal, above every vertex.
void set_plane(const std::vector<GridPoint>& points, const ExactHull& hull, PolygonFace& face) {
  std::array<double, 3> sum{};
  for (const Triangle& t : face.triangles) {
    const auto normal = area_normal(points[t[0]], points[t[1]], points[t[2]]);
    for (size_t k = 0; k < 3; ++k) sum[k] += static_cast<double>(normal[k]);
  }
  const double length = sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
  for (size_t k = 0; k < 3; ++k) {
    face.normal[k] = static_cast<int32_t>(floor(sum[k] / length * static_cast<double>(k_one) + 0.5));
  }
  int64_t top = height(face, points[hull.vertices[0]]);
  for (const uint32_t vertex : hull.vertices) top = std::max(top, height(face, points[vertex]));
  face.offset = static_cast<int32_t>((top + k_one - 1) >> 30);
}

/// Whether the loop lies within the tolerance of the plane, and is convex within the tolerance.
bool is_flat_and_convex(const std::vector<GridPoint>& points, const PolygonFace& face, int32_t tolerance) {
  const auto& n = face.normal;
  for (size_t k = 0; k < face.loop.size(); ++k) {
    const GridPoint& a = points[face.loop[k]];
    const GridPoint& b = points[face.loop[(k + 1) % face.loop.size()]];
    if (height(face, a) < (int64_t{face.offset} - tolerance) * k_one) return false;
    const int64_t side = std::max({std::abs(int64_t{b.x} - a.x), std::abs(int64_t{b.y} - a.y),
                                   std::abs(int64_t{b.z} - a.z)});  // at most its length
    const Int128 least = -Int128::product(side * tolerance, k_one);
    for (const uint32_t other : face.loop) {
      const auto area = area_normal(a, b, points[other]);
      const Int128 out = Int128::product_narrow(area[0], n[0]) + Int128::product_narrow(area[1], n[1]) +
                         Int128::product_narrow(area[2], n[2]);
      if (out < least) return false;
    }
  }
  return true;
}

struct Seam {
  double bend;  ///< depth of each triangle's free corner below the other's plane: the greater
  Side side;
  uint32_t left, right;
};

/// The edges between two triangles, the flattest first.
std::vector<Seam> seams_of(const std::vector<GridPoint>& points, const ExactHull& hull) {
  std::map<Side, uint32_t> owner;
  for (uint32_t i = 0; i < hull.triangles.size(); ++i) {
    const Triangle& t = hull.triangles[i];
    for (uint32_t k = 0; k < 3; ++k) owner[{t[k], t[(k + 1) % 3]}] = i;
  }
  const auto depth = [&](uint32_t under, uint32_t of) {  // of the corner of triangle `of` that `under` does not have
    const Triangle& t = hull.triangles[under];
    const auto normal = area_normal(points[t[0]], points[t[1]], points[t[2]]);
    std::array<double, 3> n;
    for (size_t k = 0; k < 3; ++k) n[k] = static_cast<double>(normal[k]);
    const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    double deepest = 0;
    const GridPoint& a = points[t[0]];
    for (const uint32_t vertex : hull.triangles[of]) {
      const GridPoint& p = points[vertex];
      const Int128 out = Int128::product(normal[0], int64_t{p.x} - a.x) +
                         Int128::product(normal[1], int64_t{p.y} - a.y) +
                         Int128::product(normal[2], int64_t{p.z} - a.z);
      deepest = std::max(deepest, -to_double(out) / length);
    }
    return deepest;
  };
  std::vector<Seam> seams;
  for (const auto& [side, left] : owner) {
    if (side.first > side.second) continue;
    const uint32_t right = owner[{side.second, side.first}];
    seams.push_back({std::max(depth(left, right), depth(right, left)), side, left, right});
  }
  std::sort(seams.begin(), seams.end(),
            [](const Seam& a, const Seam& b) { return a.bend != b.bend ? a.bend < b.bend : a.side < b.side; });
  return seams;
}

}  // namespace

std::vector<PolygonFace> join_faces(const std::vector<GridPoint>& points, const ExactHull& hull, int32_t tolerance) {
  const uint32_t count = static_cast<uint32_t>(hull.triangles.size());
  std::vector<PolygonFace> groups(count);
  std::vector<uint32_t> group_of(count);
  std::iota(group_of.begin(), group_of.end(), 0u);
  for (uint32_t i = 0; i < count; ++i) {
    Triangle t = hull.triangles[i];
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    groups[i].triangles = {t};
    groups[i].loop.assign(t.begin(), t.end());
    set_plane(points, hull, groups[i]);
  }
  if (tolerance >= 0) {
    for (const Seam& seam : seams_of(points, hull)) {
      const uint32_t left = group_of[seam.left], right = group_of[seam.right];
      if (left == right) continue;
      PolygonFace joined;
      joined.triangles = groups[left].triangles;
      joined.triangles.insert(joined.triangles.end(), groups[right].triangles.begin(), groups[right].triangles.end());
      joined.loop = loop_about(joined.triangles);
      if (joined.loop.empty()) continue;
      set_plane(points, hull, joined);
      if (!is_flat_and_convex(points, joined, tolerance)) continue;
      groups[left] = joined;
      groups[right] = {};
      for (uint32_t& group : group_of) group = group == right ? left : group;
    }
  }
  std::vector<PolygonFace> faces;
  for (PolygonFace& group : groups) {
    if (group.triangles.empty()) continue;
    std::sort(group.triangles.begin(), group.triangles.end());
    set_plane(points, hull, group);  // again, because the sum's rounding depends on the order
    faces.push_back(group);
  }
  // The vectors' own < is not used: on big-endian machines GCC 12's compares only a quarter of their bytes.
  std::sort(faces.begin(), faces.end(), [](const PolygonFace& a, const PolygonFace& b) {
    return std::lexicographical_compare(a.loop.begin(), a.loop.end(), b.loop.begin(), b.loop.end());
  });
  return faces;
}

}  // namespace detent_cook
