#include "cook.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <algorithm>

#include "describe.h"
#include "encode.h"

namespace detent_cook {
namespace {

constexpr double k_one = 0x1p30;
constexpr double k_coordinate_max = 0x1p31;  // m, the limit of world positions
constexpr int k_exponent_min = -14, k_exponent_max = 15;
// In steps of the grid: 2^-24 of the unit, which is the thickness that float rounding gives to a flat cloud.
constexpr double k_depth_min = 64;
constexpr int k_frame_passes = 4;  // the second pass already uses nearly the final axes
constexpr uint32_t k_vertices_max = 255;

template <class... Arguments>
std::string text(const char* format, Arguments... arguments) {
  char line[200];
  snprintf(line, sizeof line, format, arguments...);
  return line;
}

/// The body's frame in the source frame.
struct Placement {
  Point origin{};
  GridRotation rotation = k_no_rotation;

  Point to_body(const Point& p) const {
    const Matrix m = matrix_from(rotation);
    const Point d = {p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]};
    Point result;
    for (size_t i = 0; i < 3; ++i) result[i] = m[0][i] * d[0] + m[1][i] * d[1] + m[2][i] * d[2];
    return result;
  }
};

double length(const Point& p) { return sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]); }

/// Distinct points of the grid, ascending, each with one point of the cloud that it represents.
struct GridCloud {
  int exponent = 0;
  std::vector<GridPoint> points{};
  std::vector<Point> source{};
};

/// The cloud in the body's frame, in steps of 2^-30 of its unit of length. The unit is the least power of two above the
/// distances of all points from the origin, after rounding.
GridCloud to_grid(const std::vector<Point>& cloud, const Placement& placement) {
  std::vector<Point> local;
  double greatest = 0;
  for (const Point& p : cloud) {
    local.push_back(placement.to_body(p));
    for (const double value : local.back()) greatest = std::max(greatest, fabs(value));
  }
  GridCloud grid;
  frexp(greatest, &grid.exponent);  // below 2^exponent, which is the unit or half of it
  std::vector<std::pair<GridPoint, Point>> pairs;
  for (bool fits = false; !fits; grid.exponent += fits ? 0 : 1) {
    fits = true;
    pairs.clear();
    for (size_t i = 0; i < cloud.size() && fits; ++i) {
      std::array<int32_t, 3> v;
      int64_t square = 0;
      for (size_t k = 0; k < 3; ++k) {
        v[k] = static_cast<int32_t>(floor(ldexp(local[i][k], 30 - grid.exponent) + 0.5));
        square += int64_t{v[k]} * v[k];
      }
      fits = square < int64_t{1} << 60;
      pairs.push_back({{v[0], v[1], v[2]}, cloud[i]});
    }
  }
  std::sort(pairs.begin(), pairs.end());
  for (const auto& [v, p] : pairs) {
    if (!grid.points.empty() && grid.points.back() == v) continue;
    grid.points.push_back(v);
    grid.source.push_back(p);
  }
  return grid;
}

/// Visits the points in ascending order, and leaves out every point within `weld` of a point that was kept before.
std::vector<Point> welded(std::vector<Point> points, double weld) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (!(weld > 0)) return points;
  std::vector<Point> kept;
  size_t first = 0;  // earlier kept points are too far away along x
  for (const Point& p : points) {
    while (first < kept.size() && p[0] - kept[first][0] > weld) ++first;
    const bool near = std::any_of(kept.begin() + static_cast<ptrdiff_t>(first), kept.end(), [&](const Point& q) {
      return length({p[0] - q[0], p[1] - q[1], p[2] - q[2]}) <= weld;
    });
    if (!near) kept.push_back(p);
  }
  return kept;
}

/// The reason to refuse the cloud; empty if it may be cooked.
std::string reason_against(const std::vector<Point>& points, const CookOptions& options) {
  if (options.vertex_limit < 4 || options.vertex_limit > k_vertices_max) {
    return text("the vertex limit is %u; it must be from 4 to %u", options.vertex_limit, k_vertices_max);
  }
  if (!(options.weld >= 0) || options.weld > k_coordinate_max) return "the weld tolerance is no distance";
  for (size_t i = 0; i < points.size(); ++i) {
    for (const double value : points[i]) {
      if (!isfinite(value)) return text("point %zu has a coordinate that is not a finite number", i + 1);
      if (fabs(value) > k_coordinate_max) return text("point %zu lies beyond 2^31 m", i + 1);
    }
  }
  if (points.size() < 4) return text("a hull needs four points or more, not %zu", points.size());
  return {};
}

std::string reason_against(const GridCloud& grid, const ExactHull& hull) {
  switch (hull.span) {
    case Span::point:
      return "all points are equal: the hull has no volume";
    case Span::line:
      return "all points lie on one line: the hull has no volume";
    case Span::plane:
      return "all points lie in one plane: the hull has no volume";
    case Span::solid:
      break;
  }
  const double depth = least_depth(grid.points, hull);
  const double unit = ldexp(1, grid.exponent);
  if (depth < k_depth_min) {
    return text("all points lie in one plane but for %.3g m, less than 2^-24 of their unit, %g m", depth / k_one * unit,
                unit);
  }
  return {};
}

/// The centre of the cloud's bounds.
Point middle(const std::vector<Point>& points) {
  Point low = points[0], high = points[0];
  for (const Point& p : points) {
    for (size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  }
  return {(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2};
}

struct Body {
  Placement placement;
  GridCloud grid;
  ExactHull hull;
  Moments moments;
};

void set_hull(const std::vector<Point>& points, Body& body) {
  body.grid = to_grid(points, body.placement);
  body.hull = exact_hull(body.grid.points, k_vertices_max);
  if (body.hull.span == Span::solid) body.moments = moments(body.grid.points, body.hull);
}

/// Moves the frame to the centre of mass and rotates it to the principal axes.
Placement principal_placement(const Body& body) {
  const Matrix axes = matrix_from(body.placement.rotation);
  const double unit = ldexp(1, body.grid.exponent);
  Placement placement = body.placement;
  for (size_t i = 0; i < 3; ++i) {
    double shift = 0;
    for (size_t k = 0; k < 3; ++k) shift += axes[i][k] * body.moments.centre[k];
    placement.origin[i] += shift * unit;
  }
  placement.rotation = rotation_from(product(axes, principal_axes(body.moments.second)));
  return placement;
}

std::vector<Point> of_vertices(const GridCloud& grid, const ExactHull& hull) {
  std::vector<Point> points;
  for (const uint32_t vertex : hull.vertices) points.push_back(grid.source[vertex]);
  return points;
}

/// Removes all points except the hull's vertices, and numbers the vertices from 0 on.
void drop_others(Body& body) {
  std::vector<uint32_t> index(body.grid.points.size());
  std::vector<GridPoint> kept;
  for (const uint32_t vertex : body.hull.vertices) {
    index[vertex] = static_cast<uint32_t>(kept.size());
    kept.push_back(body.grid.points[vertex]);
  }
  for (Triangle& triangle : body.hull.triangles) {
    for (uint32_t& vertex : triangle) vertex = index[vertex];
  }
  for (uint32_t i = 0; i < kept.size(); ++i) body.hull.vertices[i] = i;
  body.hull.vertices.resize(kept.size());
  body.grid.points = kept;
  body.grid.source.clear();
}

/// Moves the origin to the grid point nearest to the centre of mass. The vertices keep their places: rounding them
/// again would move the centre of a thin hull. If a vertex would leave the unit, nothing is moved.
void centre(Body& body) {
  std::array<int32_t, 3> steps;
  for (size_t k = 0; k < 3; ++k) steps[k] = static_cast<int32_t>(floor(body.moments.centre[k] * k_one + 0.5));
  std::vector<GridPoint> moved;
  for (const GridPoint& v : body.grid.points) {
    moved.push_back({v.x - steps[0], v.y - steps[1], v.z - steps[2]});
    const int64_t x = moved.back().x, y = moved.back().y, z = moved.back().z;
    if (x * x + y * y + z * z >= int64_t{1} << 60) return;
  }
  body.grid.points = moved;
  const Matrix axes = matrix_from(body.placement.rotation);
  for (size_t i = 0; i < 3; ++i) {
    const double shift = axes[i][0] * steps[0] + axes[i][1] * steps[1] + axes[i][2] * steps[2];
    body.placement.origin[i] += ldexp(shift, body.grid.exponent - 30);
    body.moments.centre[i] -= steps[i] / k_one;
  }
}

double greatest_error(const std::vector<Point>& cloud, const Body& body, const std::vector<PolygonFace>& faces) {
  double greatest = 0;
  const double scale = ldexp(k_one, -body.grid.exponent);
  for (const Point& p : cloud) {
    const Point q = body.placement.to_body(p);
    for (const PolygonFace& face : faces) {
      const double height = (face.normal[0] * q[0] + face.normal[1] * q[1] + face.normal[2] * q[2]) / k_one;
      greatest = std::max(greatest, height - face.offset / scale);
    }
  }
  return greatest;
}

HullHeader header_of(const Body& body, bool principal) {
  HullHeader header;
  header.exponent = body.grid.exponent;
  header.principal = principal;
  header.volume = body.moments.volume;
  if (!principal) return header;
  const auto& second = body.moments.second;
  for (size_t axis = 0; axis < 3; ++axis)
    header.inverse_inertia[axis] = 1 / (second[(axis + 1) % 3] + second[(axis + 2) % 3]);
  for (size_t axis = 0; axis < 3; ++axis) header.origin[axis] = body.placement.origin[axis] + 0.0;  // never -0
  header.rotation = body.placement.rotation;
  return header;
}

}  // namespace

CookResult cook_hull(const std::vector<Point>& points, const CookOptions& options) {
  CookResult result;
  const auto refused = [&result](const std::string& reason) {
    result.reason = reason;
    return result;
  };
  std::string reason = reason_against(points, options);
  if (!reason.empty()) return refused(reason);
  const std::vector<Point> cloud = welded(points, options.weld);

  // First finds the vertices, with the origin at the middle; then fits the frame, which moves and rotates only the
  // vertices.
  Body body;
  body.placement.origin = middle(cloud);
  body.grid = to_grid(cloud, body.placement);
  body.hull = exact_hull(body.grid.points, options.vertex_limit);
  reason = reason_against(body.grid, body.hull);
  if (!reason.empty()) return refused(reason);
  if (body.hull.reduced && !options.reduce)
    return refused(text("the hull has more than %u vertices", options.vertex_limit));
  result.reduced = body.hull.reduced;
  const std::vector<Point> vertices = of_vertices(body.grid, body.hull);

  const bool principal = options.frame == Frame::principal;
  if (principal) {
    body.moments = moments(body.grid.points, body.hull);
    for (int pass = 0; pass < k_frame_passes; ++pass) {
      const Placement placement = principal_placement(body);
      if (pass > 0 && placement.origin == body.placement.origin && placement.rotation == body.placement.rotation) break;
      body.placement = placement;
      set_hull(vertices, body);
    }
  } else {
    body.placement = {};
    set_hull(vertices, body);
  }
  if (body.grid.exponent < k_exponent_min || body.grid.exponent > k_exponent_max) {
    return refused(text("the furthest point lies %.3g m from the origin; it must be from 2^-15 to 2^15 m",
                        ldexp(1, body.grid.exponent)));
  }
  reason = reason_against(body.grid, body.hull);
  if (!reason.empty()) return refused(reason);
  drop_others(body);
  if (principal) centre(body);

  const double width = least_depth(body.grid.points, body.hull);
  const int32_t tolerance = static_cast<int32_t>(std::clamp(width / 1024, 4.0, 1024.0));
  const HullHeader header = header_of(body, principal);
  std::vector<PolygonFace> faces;
  // If polygons joined within the tolerance do not form a solid, the separate triangles are used.
  for (const int32_t joined_within : {tolerance, -1}) {
    faces = join_faces(body.grid.points, body.hull, joined_within);
    result.bytes = encode_hull(body.grid.points, faces, header);
    reason = describe_hull(result.bytes).problem;
    if (reason.empty()) break;
  }
  if (!reason.empty()) {
    result.bytes.clear();
    return refused("the library refuses the cooked hull (" + reason + "): please report this");
  }

  const double unit = ldexp(1, body.grid.exponent);
  result.vertex_count = static_cast<uint32_t>(body.grid.points.size());
  result.face_count = static_cast<uint32_t>(faces.size());
  result.edge_count = result.vertex_count + result.face_count - 2;
  result.exponent = body.grid.exponent;
  result.volume = body.moments.volume * unit * unit * unit;
  const Matrix axes = matrix_from(body.placement.rotation);
  for (size_t i = 0; i < 3; ++i) {
    result.centre[i] = body.placement.origin[i];
    for (size_t k = 0; k < 3; ++k) result.centre[i] += axes[i][k] * body.moments.centre[k] * unit;
    result.inverse_inertia[i] = header.inverse_inertia[i];
  }
  for (size_t k = 0; k < 4; ++k) result.rotation[k] = body.placement.rotation[k] / k_one;
  result.width = width / k_one * unit;
  result.error = greatest_error(points, body, faces);
  return result;
}

}  // namespace detent_cook
