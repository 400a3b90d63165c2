#pragma once
#include <algorithm>

#include "tests/common/oracle/vectors.h"

/// Slow, plain references for what lies between two shapes: every pair of features is tried.
namespace detent_oracle {

enum class Kind { half_space, box, round };

/// A half-space (y <= 0), a box, or a ball swept along y: size is (half extents), or (radius, half length, 0).
struct Solid {
  Kind kind;
  Vector centre;
  Vector axis[3];
  Vector size;
};

inline Vector box_vertex(const Solid& box, int which) {
  Vector p = box.centre;
  for (int i = 0; i < 3; ++i) p = p + box.axis[i] * ((which >> i & 1) != 0 ? box.size[i] : -box.size[i]);
  return p;
}

/// How far the solid reaches along a unit vector, from its own centre. Not for a half-space.
inline double extent_along(const Solid& solid, const Vector& n) {
  if (solid.kind == Kind::round) return fabs(dot(solid.axis[1], n)) * solid.size[1] + solid.size[0];
  double sum = 0;
  for (int i = 0; i < 3; ++i) sum += fabs(dot(solid.axis[i], n)) * solid.size[i];
  return sum;
}

/// Room between A and B along the unit vector n from A to B; negative when they overlap along it.
inline double gap_along(const Solid& a, const Solid& b, const Vector& n) {
  const double between = dot(b.centre - a.centre, n) - extent_along(b, n);
  return a.kind == Kind::half_space ? between : between - extent_along(a, n);
}

struct Segment {
  Vector centre, direction;
  double half_length;
};
inline Segment core_of(const Solid& round) { return {round.centre, round.axis[1], round.size[1]}; }
inline Vector end_of(const Segment& s, int side) {
  return s.centre + s.direction * (side == 0 ? s.half_length : -s.half_length);
}
inline double distance_to_segment(const Segment& s, const Vector& p) {
  const double along = std::clamp(dot(p - s.centre, s.direction), -s.half_length, s.half_length);
  return length(p - (s.centre + s.direction * along));
}

inline double distance_of_segments(const Segment& a, const Segment& b) {
  double best = std::min(std::min(distance_to_segment(a, end_of(b, 0)), distance_to_segment(a, end_of(b, 1))),
                         std::min(distance_to_segment(b, end_of(a, 0)), distance_to_segment(b, end_of(a, 1))));
  const Vector across = cross(a.direction, b.direction);
  const double sine = length(across);
  if (sine < 1e-7) return best;  // the ends are then as near as anything, to 1e-14
  const Vector offset = b.centre - a.centre;
  const double along_a = dot(cross(offset, b.direction), across) / (sine * sine);
  const double along_b = dot(cross(offset, a.direction), across) / (sine * sine);
  if (fabs(along_a) <= a.half_length && fabs(along_b) <= b.half_length) {
    best = std::min(best, fabs(dot(offset, across)) / sine);
  }
  return best;
}

/// Signed: below 0 inside.
inline double distance_to_box(const Solid& box, const Vector& p) {
  Vector beyond;
  double inside = -HUGE_VAL;
  for (int i = 0; i < 3; ++i) {
    const double excess = fabs(dot(p - box.centre, box.axis[i])) - box.size[i];
    beyond[i] = std::max(excess, 0.0);
    inside = std::max(inside, excess);
  }
  return inside < 0 ? inside : length(beyond);
}

/// Signed distance of a point to the solid's surface: below 0 inside.
inline double distance_to_surface(const Solid& solid, const Vector& p) {
  switch (solid.kind) {
    case Kind::half_space:
      return dot(p - solid.centre, solid.axis[1]);
    case Kind::box:
      return distance_to_box(solid, p);
    default:
      return distance_to_segment(core_of(solid), p) - solid.size[0];
  }
}

inline Segment edge_of(const Solid& box, int axis, int which) {
  Segment edge = {box.centre, box.axis[axis], box.size[axis]};
  for (int k = 1; k < 3; ++k) {
    const int other = (axis + k) % 3;
    edge.centre = edge.centre + box.axis[other] * ((which >> (k - 1) & 1) != 0 ? box.size[other] : -box.size[other]);
  }
  return edge;
}

inline bool segment_meets_box(const Solid& box, const Segment& s) {
  double from = -s.half_length, to = s.half_length;
  for (int i = 0; i < 3; ++i) {
    const double at = dot(s.centre - box.centre, box.axis[i]), speed = dot(s.direction, box.axis[i]);
    if (fabs(speed) < 1e-300) {
      if (fabs(at) > box.size[i]) return false;
      continue;
    }
    const double p = (-box.size[i] - at) / speed, q = (box.size[i] - at) / speed;
    from = std::max(from, std::min(p, q));
    to = std::min(to, std::max(p, q));
  }
  return from <= to;
}

/// The largest gap along the separating axes of A with B: the faces of the boxes and what is across a pair of edges.
/// Below 0, minus the depth of the overlap; above 0 a lower bound of the distance.
inline double largest_gap(const Solid& a, const Solid& b) {
  double best = -HUGE_VAL;
  const auto consider = [&](const Vector& axis) {
    const double size = length(axis);
    if (size < 1e-9) return;
    const Vector n = axis * (1 / size);
    best = std::max(best, std::max(gap_along(a, b, n), gap_along(a, b, n * -1)));
  };
  const int edges_b = b.kind == Kind::box ? 3 : 1;
  for (int i = 0; i < 3; ++i) {
    consider(a.axis[i]);
    if (b.kind == Kind::box) consider(b.axis[i]);
    for (int j = 0; j < edges_b; ++j) consider(cross(a.axis[i], b.axis[edges_b == 1 ? 1 : j]));
  }
  return best;
}

/// The distance of two boxes that do not overlap: every vertex with the other box, every edge with every edge.
inline double distance_of_boxes(const Solid& a, const Solid& b) {
  double best = HUGE_VAL;
  for (int i = 0; i < 8; ++i) {
    best = std::min(best, std::min(distance_to_box(a, box_vertex(b, i)), distance_to_box(b, box_vertex(a, i))));
  }
  for (int i = 0; i < 12; ++i) {
    for (int j = 0; j < 12; ++j) {
      best = std::min(best, distance_of_segments(edge_of(a, i / 4, i % 4), edge_of(b, j / 4, j % 4)));
    }
  }
  return best;
}

struct Separation {
  double value;
  bool is_depth;  ///< cores meet: the value is that of the best separating axis, and no distance
};

/// Signed separation of A and B, where A is of no later kind than B.
inline Separation separation_of(const Solid& a, const Solid& b) {
  if (a.kind == Kind::half_space) return {gap_along(a, b, a.axis[1]), false};
  if (b.kind == Kind::box) {
    const double gap = largest_gap(a, b);
    return {gap, true};
  }
  if (a.kind == Kind::round) return {distance_of_segments(core_of(a), core_of(b)) - a.size[0] - b.size[0], false};
  const Segment core = core_of(b);
  if (segment_meets_box(a, core)) return {largest_gap(a, b), true};
  double best = std::min(distance_to_box(a, end_of(core, 0)), distance_to_box(a, end_of(core, 1)));
  for (int i = 0; i < 12; ++i) best = std::min(best, distance_of_segments(edge_of(a, i / 4, i % 4), core));
  return {best - b.size[0], false};
}

}  // namespace detent_oracle
