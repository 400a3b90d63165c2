#pragma once
#include <cmath>

#include "tests/unit/world/lab.h"

/// Jointed bodies for tests, and the errors of their joints.
namespace detent {
inline namespace DETENT_NAMESPACE {

struct Vector {
  double x, y, z;
  friend Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vector operator*(Vector a, double s) { return {a.x * s, a.y * s, a.z * s}; }
};
inline double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vector cross(Vector a, Vector b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vector a) { return std::sqrt(dot(a, a)); }

struct Turned {
  Vector vector;
  double w;
  explicit Turned(const Quat& q)
      : vector{unit_to_host(q.x), unit_to_host(q.y), unit_to_host(q.z)}, w(unit_to_host(q.w)) {}
  Vector apply(Vector v) const {
    const Vector t = cross(vector, v) * 2;
    return v + t * w + cross(vector, t);
  }
};

/// The pose of a joint's frame on one of its bodies.
struct JointEnd {
  Vector anchor;   ///< world, from the world's origin
  Vector axis[3];  ///< of the frame
};

inline JointEnd joint_end(const World& world, BodyId id, const Vec3<Real>& anchor, const Quat& frame) {
  Pose pose;
  EXPECT_OK(get_pose(world, id, pose));
  const Turned body(pose.rotation), own(frame);
  const Vector arm = {real_to_host(anchor.x), real_to_host(anchor.y), real_to_host(anchor.z)};
  const Vector at = {coord_to_host(pose.position.x), coord_to_host(pose.position.y), coord_to_host(pose.position.z)};
  JointEnd end = {at + body.apply(arm), {}};
  const Vector axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int i = 0; i < 3; ++i) end.axis[i] = body.apply(own.apply(axes[i]));
  return end;
}

struct JointEnds {
  JointEnd a, b;
  Vector gap() const { return b.anchor - a.anchor; }
  /// The angle between the x, y or z axes, rad.
  double between(int i) const {
    return std::atan2(length(cross(a.axis[i], b.axis[i])), detent::dot(a.axis[i], b.axis[i]));
  }
  /// The rotation of B about axis `i` of A, rad, if that axis is common to both.
  double turned(int i) const {
    const int next = (i + 1) % 3, last = (i + 2) % 3;
    return std::atan2(detent::dot(b.axis[next], a.axis[last]), detent::dot(b.axis[next], a.axis[next]));
  }
};

inline JointEnds joint_ends(const World& world, JointId id) {
  JointDef def;
  EXPECT_OK(get_joint(world, id, def));
  return {joint_end(world, def.a, def.anchor_a, def.frame_a), joint_end(world, def.b, def.anchor_b, def.frame_b)};
}

inline BodyId add_shape(Lab& lab, const Shape& shape, double x, double y, double z, BodyType type = BodyType::dynamic) {
  BodyDef def;
  def.type = type;
  def.shape = shape;
  def.position = position(x, y, z);
  return lab.add(def);
}

/// Adds a joint at a point, for the current poses of the bodies; its frame has the axes of the world unless it is
/// rotated.
inline JointId add_joint(Lab& lab, JointType type, BodyId a, BodyId b, double x, double y, double z,
                         const JointDef& rest = {}, const Quat& frame = {0.0, 0.0, 0.0, 1.0}) {
  JointDef def = rest;
  def.type = type;
  def.a = a;
  def.b = b;
  EXPECT_OK(place_joint(lab.world, position(x, y, z), frame, def));
  JointId id;
  EXPECT_OK(create_joint(lab.world, def, id));
  return id;
}

/// From the frame's axes to the world's: x to y, y to z, z to x; and x to z.
inline constexpr Quat k_x_to_y = {0.5, 0.5, 0.5, 0.5};
inline constexpr Quat k_x_to_z = {-0.5, -0.5, -0.5, 0.5};

inline constexpr double k_pi = 3.14159265358979323846;

inline Capacity room(uint32_t bodies, uint32_t joints) { return {bodies, 4 * bodies, 0, true, joints}; }

/// Two bricks in free space with a joint half-way between them, which move and rotate.
struct Pair {
  Lab lab;
  BodyId a, b;
  JointId joint;

  explicit Pair(JointType type, const JointDef& rest = {}, uint32_t substeps = 0)
      : lab(room(2, 1), weightless(substeps)) {
    a = add_shape(lab, box(reals(0.4, 0.2, 0.3)), 0, 0, 0);
    b = add_shape(lab, box(reals(0.5, 0.1, 0.2)), 1.2, 0, 0);
    joint = add_joint(lab, type, a, b, 0.5, 0, 0, rest);
    EXPECT_OK(set_velocity(lab.world, a, reals(0.5, -1, 2), reals(1, 2, -3)));
    EXPECT_OK(set_velocity(lab.world, b, reals(0.5, 1, -0.5), reals(-2, 1, 2)));
  }
};

inline constexpr JointType k_joint_types[] = {JointType::ball,     JointType::hinge,   JointType::slider,
                                              JointType::distance, JointType::fixed,   JointType::cone_twist,
                                              JointType::wheel,    JointType::parallel};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
