#pragma once
#include <float.h>

#include <algorithm>
#include <vector>

#include "distance/support.h"
#include "tests/unit/distance/bodies_at.h"
#include "tests/unit/shape/hull_bytes.h"

/// Solids in doubles for the tests of lib/distance and lib/toi: the distance of a point from any shape in closed form,
/// and of two polytopes from all their features. Every size has the value that the configuration stores.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// A Convex, and its core and ball in doubles.
struct KnownShape {
  Convex convex;
  Vector size = {{0, 0, 0}};     ///< m; half extents, or radius and half length of a cylinder or cone
  double ball = 0;               ///< m
  std::vector<Vector> points{};  ///< m; the core's vertices; none of a cylinder, cone or half-space

  ShapeType type() const { return convex.type; }
  /// Greatest distance of a core point from the origin, m.
  double distance_max() const { return ldexp(convex.core_radius, convex.exponent - 30); }
};

inline Asset tetrahedron_bytes() { return {detent_hulls::k_tetrahedron, sizeof detent_hulls::k_tetrahedron}; }
inline Asset prism_bytes() { return {detent_hulls::k_prism, sizeof detent_hulls::k_prism}; }

inline KnownShape known(const Shape& shape) {
  KnownShape made;
  EXPECT_OK(make_convex(shape, made.convex));
  const double radius = host(shape.radius), half_length = host(shape.half_length);
  made.ball = host(shape.rounding);
  switch (shape.type) {
    case ShapeType::sphere:
      made.ball = radius;
      made.points = {{{0, 0, 0}}};
      break;
    case ShapeType::capsule:
      made.ball = radius;
      made.points = {{{0, half_length, 0}}, {{0, -half_length, 0}}};
      break;
    case ShapeType::box:
      made.size = host(shape.half_extents);
      for (int i = 0; i < 8; ++i) {
        made.points.push_back({{i & 1 ? -made.size[0] : made.size[0], i & 2 ? -made.size[1] : made.size[1],
                                i & 4 ? -made.size[2] : made.size[2]}});
      }
      break;
    case ShapeType::half_space:
      made.ball = 0;
      break;
    default:
      made.size = {{radius, half_length, 0}};
      break;
  }
  return made;
}

inline KnownShape known_triangle(const Vector (&corners)[3], double rounding) {
  KnownShape made;
  const Vec3<Real> held_corners[3] = {reals(corners[0]), reals(corners[1]), reals(corners[2])};
  EXPECT_OK(make_triangle(held_corners, real(rounding), made.convex));
  for (const Vec3<Real>& corner : held_corners) made.points.push_back(host(corner));
  made.ball = host(real(rounding));
  return made;
}

inline KnownShape known_hull(const Asset& asset, double rounding) {
  KnownShape made;
  EXPECT_OK(make_hull(asset, real(rounding), made.convex));
  CorePoint core;
  for (int i = 0; i < 255 && core_vertex(made.convex, static_cast<uint8_t>(i), core); ++i) {
    const double unit = ldexp(1, made.convex.exponent - 30);
    made.points.push_back({{core.local.x * unit, core.local.y * unit, core.local.z * unit}});
  }
  made.ball = host(real(rounding));
  return made;
}

/// One shape of each kind, of about `scale` m; `kind` is below k_known_kinds. The rounding is random if the shape can
/// have one.
inline constexpr uint32_t k_known_kinds = 8;
inline constexpr uint32_t k_known_hulls = 3;  ///< of the kinds after those: hulls of fixed size, and half-space
inline KnownShape random_shape(Samples& samples, uint32_t kind, double scale) {
  const auto size = [&] { return real(scale * uniform(samples, 0.1, 1)); };
  const Real ball = samples.below(2) == 0 ? real(0) : real(scale * uniform(samples, 0.05, 0.5));
  const auto corner = [&] { return random_direction(samples) * (scale * uniform(samples, 0.1, 1)); };
  switch (kind) {
    case 0:
      return known(sphere(size()));
    case 1:
      return known(capsule(size(), size()));
    case 2:
    case 3:
      return known(rounded(box({size(), size(), size()}), ball));
    case 4:
      return known(rounded(cylinder(size(), size()), ball));
    case 5:
      return known(rounded(cone(size(), size()), ball));
    case 6:
    case 7: {
      const Vector corners[3] = {corner(), corner(), corner()};
      return known_triangle(corners, host(ball));
    }
    case 8:
      return known_hull(tetrahedron_bytes(), host(ball));
    case 9:
      return known_hull(prism_bytes(), host(ball));
    default:
      return known(half_space());
  }
}

inline double clamped(double value, double low, double high) { return std::min(std::max(value, low), high); }

inline double distance_to_segment(const Vector& p, const Vector& a, const Vector& b) {
  const Vector edge = b - a;
  const double square = dot(edge, edge);
  const double t = square == 0 ? 0 : clamped(dot(p - a, edge) / square, 0, 1);
  return length(p - (a + edge * t));
}

/// The distance of a point from a triangle, which may be degenerate.
inline double distance_to_triangle(const Vector& p, const Vector& a, const Vector& b, const Vector& c) {
  const double to_edges =
      std::min({distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
  const Vector n = cross(b - a, c - a);
  const double square = dot(n, n);
  if (square == 0) return to_edges;
  const bool above =
      dot(cross(b - a, p - a), n) >= 0 && dot(cross(c - b, p - b), n) >= 0 && dot(cross(a - c, p - c), n) >= 0;
  return above ? std::min(to_edges, fabs(dot(p - a, n)) / sqrt(square)) : to_edges;
}

inline double distance_of_segments(const Vector& a, const Vector& b, const Vector& c, const Vector& d) {
  double least = std::min({distance_to_segment(a, c, d), distance_to_segment(b, c, d), distance_to_segment(c, a, b),
                           distance_to_segment(d, a, b)});
  const Vector u = b - a, v = d - c, w = c - a, n = cross(u, v);
  const double square = dot(n, n);
  if (square == 0) return least;
  const double s = dot(cross(w, v), n) / square, t = dot(cross(w, u), n) / square;
  if (s >= 0 && s <= 1 && t >= 0 && t <= 1) least = std::min(least, fabs(dot(w, n)) / sqrt(square));
  return least;
}

/// The distance of a point from the hull of points: the least over all triangles of the points. The hull need not have
/// a volume. For a point inside the hull, this is the distance from the nearest of these triangles.
inline double distance_to_points(const Vector& p, const std::vector<Vector>& points) {
  double least = DBL_MAX;
  const size_t count = points.size();
  if (count == 1) return length(p - points[0]);
  if (count == 2) return distance_to_segment(p, points[0], points[1]);
  for (size_t i = 0; i < count; ++i) {
    for (size_t j = i + 1; j < count; ++j) {
      for (size_t k = j + 1; k < count; ++k)
        least = std::min(least, distance_to_triangle(p, points[i], points[j], points[k]));
    }
  }
  return least;
}

/// The distance of a point from the core, m, local axes. For a point inside a polytope: the distance from the nearest
/// triangle of its vertices, not 0.
inline double core_distance(const KnownShape& shape, const Vector& p) {
  const double across = hypot(p[0], p[2]), radius = shape.size[0], half = shape.size[1];
  switch (shape.type()) {
    case ShapeType::half_space:
      return p[1];
    case ShapeType::box:
      return length(Vector{{std::max(fabs(p[0]) - radius, 0.0), std::max(fabs(p[1]) - half, 0.0),
                            std::max(fabs(p[2]) - shape.size[2], 0.0)}});
    case ShapeType::cylinder:
      return hypot(std::max(across - radius, 0.0), std::max(fabs(p[1]) - half, 0.0));
    case ShapeType::cone: {
      const Vector at = {{across, p[1], 0}}, apex = {{0, 1.5 * half, 0}}, rim = {{radius, -half / 2, 0}};
      const bool under_side = (at[0] - rim[0]) * (2 * half) + (at[1] - rim[1]) * radius <= 0;
      if (under_side && at[1] >= -half / 2) return 0;
      return std::min(distance_to_segment(at, apex, rim), distance_to_segment(at, {{0, -half / 2, 0}}, rim));
    }
    default:
      return distance_to_points(p, shape.points);
  }
}

/// The least direction.p over the core, world axes. Range: no half-space.
inline double lowest(const KnownShape& shape, const BodyAt& body, const Vector& direction) {
  const Vector d = {{dot(direction, axis_of(body.rotation, 0)), dot(direction, axis_of(body.rotation, 1)),
                     dot(direction, axis_of(body.rotation, 2))}};
  const double across = hypot(d[0], d[2]), radius = shape.size[0], half = shape.size[1];
  double least = DBL_MAX;
  if (shape.type() == ShapeType::cylinder) least = -across * radius - fabs(d[1]) * half;
  if (shape.type() == ShapeType::cone) least = std::min(1.5 * half * d[1], -half / 2 * d[1] - across * radius);
  for (const Vector& p : shape.points) least = std::min(least, dot(d, p));
  return least + dot(direction, body.position);
}

/// The distance of two separated polytope cores: the least over all pairs of features.
inline double polytope_distance(const KnownShape& a, const BodyAt& body_a, const KnownShape& b, const BodyAt& body_b) {
  std::vector<Vector> p, q;
  for (const Vector& v : a.points) p.push_back(body_a.to_world(v) - body_a.position);
  for (const Vector& v : b.points) q.push_back(body_b.to_world(v) - body_a.position);
  double least = DBL_MAX;
  for (const Vector& v : p) least = std::min(least, distance_to_points(v, q));
  for (const Vector& v : q) least = std::min(least, distance_to_points(v, p));
  for (size_t i = 0; i < p.size(); ++i) {
    for (size_t j = i + 1; j < p.size(); ++j) {
      for (size_t k = 0; k < q.size(); ++k) {
        for (size_t l = k + 1; l < q.size(); ++l) least = std::min(least, distance_of_segments(p[i], p[j], q[k], q[l]));
      }
    }
  }
  return least;
}

/// The scale of the error of a distance, m: both core diameters plus the distance of the centres; for a plane, the
/// distance from the plane.
inline double extent_of(const KnownShape& a, const BodyAt& body_a, const KnownShape& b, const BodyAt& body_b) {
  const Vector centres = body_b.position - body_a.position;
  double apart = length(centres);
  if (a.type() == ShapeType::half_space) apart = fabs(dot(centres, axis_of(body_a.rotation, 1)));
  if (b.type() == ShapeType::half_space) apart = fabs(dot(centres, axis_of(body_b.rotation, 1)));
  return 2 * (a.distance_max() + b.distance_max()) + apart;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
