#pragma once
#include <math.h>

#include <type_traits>
#include <vector>

#include "tests/common/queries/query.h"

/// Convex solids and their motions for the oracles of distance and of time of impact: tests/common/queries/query.h in
/// `long double`. Nothing here is shared with the library.
namespace detent_oracle {

using Number = long double;

template <class T>
struct Vector3 {
  T x, y, z;
};
template <class T>
Vector3<T> operator+(const Vector3<T>& a, const Vector3<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
Vector3<T> operator-(const Vector3<T>& a, const Vector3<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
Vector3<T> operator-(const Vector3<T>& a) {
  return {-a.x, -a.y, -a.z};
}
template <class T>
Vector3<T> operator*(const Vector3<T>& a, std::type_identity_t<T> s) {
  return {a.x * s, a.y * s, a.z * s};
}
template <class T>
T dot(const Vector3<T>& a, const Vector3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
Vector3<T> cross(const Vector3<T>& a, const Vector3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
using Arrow = Vector3<Number>;
inline Number length(const Arrow& a) { return sqrtl(dot(a, a)); }

/// A rotation, by the images of the local axes.
struct Frame {
  Arrow axis[3];
};
inline Arrow to_world(const Frame& frame, const Arrow& v) {
  return frame.axis[0] * v.x + frame.axis[1] * v.y + frame.axis[2] * v.z;
}
inline Arrow to_local(const Frame& frame, const Arrow& v) {
  return {dot(frame.axis[0], v), dot(frame.axis[1], v), dot(frame.axis[2], v)};
}

/// v turned by |turn| rad about turn.
Arrow turned(const Arrow& v, const Arrow& rotation_vector);
/// The rotation of a quaternion (x, y, z, w) of any length but 0.
Frame frame_of(const std::array<double, 4>& rotation);

enum class CoreKind { points, cylinder, cone, half_space };

/// A core and the radius of the ball that rounds it. A sphere's core is a point, a capsule's a segment.
struct ConvexSolid {
  CoreKind core = CoreKind::points;
  std::vector<Arrow> points{};  ///< m, body frame; their hull is the core
  Number radius = 0;            ///< m; of a cylinder, or a cone's base
  Number half_length = 0;       ///< m; of a cylinder or cone
  Number rounding = 0;          ///< m; of the ball
  Number distance_max = 0;      ///< m; the greatest distance of a core point from the body's origin; 0 for a half-space
};
ConvexSolid solid_of(const detent_queries::Solid& solid);

/// The greatest direction.p over the core's points p; of a half-space along its own normal: 0. Body frame, any length.
Number support_value(const ConvexSolid& solid, const Arrow& direction);
/// The greatest distance of a core point from the line through the body's origin along `line` (a unit vector).
Number reach_from_line(const ConvexSolid& solid, const Arrow& line);
/// The unit of all tolerances, m: the larger diameter of the cores' bounding spheres about the bodies' origins; if both
/// cores are points, of the whole solids. A half-space has none.
Number size_of(const ConvexSolid& a, const ConvexSolid& b);

/// Two solids at one moment, seen from A's position. Their distance does not depend on more.
struct Placement {
  Frame a, b;
  Arrow offset;  ///< B's position less A's, m
};

/// Two moving solids. Only the difference of the positions is kept, taken before anything is rounded.
struct Encounter {
  ConvexSolid a, b;
  Frame frame_a, frame_b;  ///< at the start
  Arrow offset;            ///< of the positions at the start, m
  Arrow displacement;      ///< B's less A's, m over the step
  Arrow turn_a, turn_b;    ///< rad over the step, world axes
  Number size;             ///< size_of()
};
Encounter encounter_of(const detent_queries::Query& query);
Placement placement_at(const Encounter& encounter, Number time);

}  // namespace detent_oracle
