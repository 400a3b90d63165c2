#include "exact_hull.h"

#include <math.h>

#include <algorithm>

#include "integers.h"

namespace detent_cook {
namespace {

constexpr uint32_t k_none = ~uint32_t{0};

/// A triangle's plane. The sign of a point's height above the plane is exact. The magnitude of a height is the volume
/// of a parallelepiped, below 2^94.
struct Plane {
  std::array<int64_t, 3> normal;
  Int128 offset;
  double length;

  Int128 height(const GridPoint& p) const {
    return Int128::product_narrow(normal[0], p.x) + Int128::product_narrow(normal[1], p.y) +
           Int128::product_narrow(normal[2], p.z) - offset;
  }
};

bool is_positive(Int128 value) { return Int128::from(0) < value; }
bool is_zero(Int128 value) { return value == Int128::from(0); }
Plane plane_through(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  Plane plane = {area_normal(a, b, c), Int128::from(0), 0};
  plane.offset = plane.height(a);
  const double x = static_cast<double>(plane.normal[0]), y = static_cast<double>(plane.normal[1]),
               z = static_cast<double>(plane.normal[2]);
  plane.length = sqrt(x * x + y * y + z * z);
  return plane;
}

struct Face {
  Triangle vertex;
  std::array<uint32_t, 3> across;  ///< the face beyond the edge from vertex k to vertex k + 1
  Plane plane;
  std::vector<uint32_t> outside{};  ///< points above this face; each point is in the list of one face
  uint32_t furthest = k_none;
  double distance = 0;  ///< of the furthest point
  bool alive = true;
};

/// Faces under construction.
class Builder {
 public:
  explicit Builder(const std::vector<GridPoint>& points) : points_(points) {}

  /// Finds the points of a first tetrahedron, or the cloud's lower dimension.
  Span start() {
    if (points_.size() < 2) return Span::point;
    const uint32_t a = 0, b = static_cast<uint32_t>(points_.size() - 1);
    uint32_t c = k_none;
    double area = 0;
    for (uint32_t i = 0; i < points_.size(); ++i) {
      const Plane plane = plane_through(points_[a], points_[b], points_[i]);
      if (plane.length > area) {  // 0 only if it is exactly 0
        area = plane.length;
        c = i;
      }
    }
    if (c == k_none) return Span::line;
    const Plane base = plane_through(points_[a], points_[b], points_[c]);
    uint32_t d = k_none;
    Int128 greatest = Int128::from(0);
    bool above = false;
    for (uint32_t i = 0; i < points_.size(); ++i) {
      const Int128 height = base.height(points_[i]);
      const Int128 size = is_positive(height) ? height : -height;
      if (greatest < size) {
        greatest = size;
        above = is_positive(height);
        d = i;
      }
    }
    if (d == k_none) return Span::plane;
    if (above) {
      add(a, c, b), add(a, b, d), add(b, c, d), add(c, a, d);
    } else {
      add(a, b, c), add(b, a, d), add(c, b, d), add(a, c, d);
    }
    link_all();
    for (uint32_t i = 0; i < points_.size(); ++i) {
      if (i != a && i != b && i != c && i != d) assign(i, 0);
    }
    return Span::solid;
  }

  /// The face with the point that lies furthest outside; k_none if no point does.
  uint32_t face_to_grow() const {
    uint32_t best = k_none;
    for (uint32_t i = 0; i < faces_.size(); ++i) {
      if (!faces_[i].alive || faces_[i].furthest == k_none) continue;
      if (best == k_none || faces_[i].distance > faces_[best].distance) best = i;
    }
    return best;
  }

  /// Replaces the faces visible from the face's furthest point by a cone from that point.
  void grow(uint32_t face) {
    const uint32_t apex = faces_[face].furthest;
    std::vector<uint32_t> seen = {face};
    faces_[face].alive = false;
    struct Side {
      uint32_t from, to, beyond;
    };
    std::vector<Side> horizon;
    for (size_t next = 0; next < seen.size(); ++next) {
      for (uint32_t k = 0; k < 3; ++k) {
        const uint32_t other = faces_[seen[next]].across[k];
        if (faces_[other].alive && is_positive(faces_[other].plane.height(points_[apex]))) {
          faces_[other].alive = false;
          seen.push_back(other);
        }
      }
    }
    for (const uint32_t i : seen) {
      for (uint32_t k = 0; k < 3; ++k) {
        const Face& old = faces_[i];
        if (faces_[old.across[k]].alive) horizon.push_back({old.vertex[k], old.vertex[(k + 1) % 3], old.across[k]});
      }
    }
    const uint32_t first = static_cast<uint32_t>(faces_.size());
    for (const Side& side : horizon) {
      const uint32_t made = add(side.from, side.to, apex);
      faces_[made].across[0] = side.beyond;
      Face& beyond = faces_[side.beyond];
      for (uint32_t k = 0; k < 3; ++k) {
        if (beyond.vertex[k] == side.to && beyond.vertex[(k + 1) % 3] == side.from) beyond.across[k] = made;
      }
    }
    for (uint32_t i = first; i < faces_.size(); ++i) {
      for (uint32_t j = first; j < faces_.size(); ++j) {
        if (faces_[i].vertex[1] != faces_[j].vertex[0]) continue;
        faces_[i].across[1] = j;
        faces_[j].across[2] = i;
      }
    }
    for (const uint32_t i : seen) {
      std::vector<uint32_t> outside;
      outside.swap(faces_[i].outside);
      for (const uint32_t point : outside) {
        if (point != apex) assign(point, first);
      }
    }
  }

  std::vector<Triangle> triangles() const {
    std::vector<Triangle> result;
    for (const Face& face : faces_) {
      if (face.alive) result.push_back(face.vertex);
    }
    return result;
  }

 private:
  uint32_t add(uint32_t a, uint32_t b, uint32_t c) {
    faces_.push_back({{a, b, c}, {k_none, k_none, k_none}, plane_through(points_[a], points_[b], points_[c])});
    return static_cast<uint32_t>(faces_.size() - 1);
  }
  void link_all() {
    for (Face& face : faces_) {
      for (uint32_t k = 0; k < 3; ++k) {
        for (uint32_t j = 0; j < faces_.size(); ++j) {
          for (uint32_t m = 0; m < 3; ++m) {
            if (faces_[j].vertex[m] == face.vertex[(k + 1) % 3] && faces_[j].vertex[(m + 1) % 3] == face.vertex[k]) {
              face.across[k] = j;
            }
          }
        }
      }
    }
  }
  /// Adds the point to the list of the face that it lies furthest above, among the faces from `first` on, if any.
  void assign(uint32_t point, uint32_t first) {
    uint32_t best = k_none;
    double distance = -1;
    for (uint32_t i = first; i < faces_.size(); ++i) {
      const Int128 height = faces_[i].plane.height(points_[point]);
      if (!is_positive(height)) continue;
      const double away = to_double(height) / faces_[i].plane.length;
      if (away > distance) {
        distance = away;
        best = i;
      }
    }
    if (best == k_none) return;
    Face& face = faces_[best];
    face.outside.push_back(point);
    if (distance > face.distance || (distance == face.distance && point < face.furthest)) {
      face.distance = distance;
      face.furthest = point;
    }
  }

  const std::vector<GridPoint>& points_;
  std::vector<Face> faces_{};
};

std::vector<uint32_t> vertices_of(const std::vector<Triangle>& triangles) {
  std::vector<uint32_t> vertices;
  for (const Triangle& triangle : triangles) vertices.insert(vertices.end(), triangle.begin(), triangle.end());
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

/// The vertices that touch three or more planes. The other vertices lie inside a face or an edge; they were inserted
/// because they were as far outside as the corners of that face or edge.
std::vector<uint32_t> extreme_vertices(const std::vector<GridPoint>& points, const std::vector<Triangle>& triangles) {
  std::vector<std::vector<uint32_t>> around(points.size());
  for (uint32_t i = 0; i < triangles.size(); ++i) {
    for (const uint32_t vertex : triangles[i]) around[vertex].push_back(i);
  }
  std::vector<uint32_t> extreme;
  for (uint32_t vertex = 0; vertex < points.size(); ++vertex) {
    std::vector<Plane> planes;
    for (const uint32_t i : around[vertex]) {
      const GridPoint &a = points[triangles[i][0]], &b = points[triangles[i][1]], &c = points[triangles[i][2]];
      const bool known = std::any_of(planes.begin(), planes.end(), [&](const Plane& plane) {
        return is_zero(plane.height(a)) && is_zero(plane.height(b)) && is_zero(plane.height(c));
      });
      if (!known) planes.push_back(plane_through(a, b, c));
    }
    if (planes.size() >= 3) extreme.push_back(vertex);
  }
  return extreme;
}

}  // namespace

std::array<int64_t, 3> area_normal(const GridPoint& a, const GridPoint& b, const GridPoint& c) {
  const int64_t bx = int64_t{b.x} - a.x, by = int64_t{b.y} - a.y, bz = int64_t{b.z} - a.z;
  const int64_t cx = int64_t{c.x} - a.x, cy = int64_t{c.y} - a.y, cz = int64_t{c.z} - a.z;
  return {by * cz - bz * cy, bz * cx - bx * cz, bx * cy - by * cx};
}

ExactHull exact_hull(const std::vector<GridPoint>& points, uint32_t vertex_limit) {
  ExactHull hull;
  Builder builder(points);
  hull.span = builder.start();
  if (hull.span != Span::solid) return hull;
  uint32_t count = 4;
  for (uint32_t face = builder.face_to_grow(); face != k_none; face = builder.face_to_grow()) {
    if (count == vertex_limit) {
      hull.reduced = true;
      break;
    }
    builder.grow(face);
    ++count;
  }
  hull.triangles = builder.triangles();
  hull.vertices = vertices_of(hull.triangles);
  const std::vector<uint32_t> extreme = extreme_vertices(points, hull.triangles);
  if (extreme.size() == hull.vertices.size()) return hull;

  // Builds the hull again from the extreme vertices only; each of them must be inserted.
  std::vector<GridPoint> kept;
  for (const uint32_t vertex : extreme) kept.push_back(points[vertex]);
  ExactHull smaller = exact_hull(kept, ~uint32_t{0});
  for (Triangle& triangle : smaller.triangles) {
    for (uint32_t& vertex : triangle) vertex = extreme[vertex];
  }
  hull.triangles = smaller.triangles;
  hull.vertices = vertices_of(hull.triangles);
  return hull;
}

double least_depth(const std::vector<GridPoint>& points, const ExactHull& hull) {
  double least = 0x1p32;
  for (const Triangle& triangle : hull.triangles) {
    const Plane plane = plane_through(points[triangle[0]], points[triangle[1]], points[triangle[2]]);
    double deepest = 0;
    for (const uint32_t vertex : hull.vertices) {
      deepest = std::max(deepest, -to_double(plane.height(points[vertex])) / plane.length);
    }
    least = std::min(least, deepest);
  }
  return least;
}

}  // namespace detent_cook
