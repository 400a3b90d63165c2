#pragma once
#include <math.h>

#include "tests/campaigns/zoo/frame.h"

/// Mechanics of the harness's frames.
namespace detent_zoo {

inline Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vector operator*(double s, const Vector& v) { return {s * v.x, s * v.y, s * v.z}; }
inline double dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Vector& v) { return sqrt(dot(v, v)); }
Rotation operator*(const Rotation& a, const Rotation& b);
Rotation inverse(const Rotation& rotation);
Vector rotate(const Rotation& rotation, const Vector& v);

/// I w, kg m^2/s.
Vector angular_momentum_of(const BodyFrame& body);
/// Kinetic energy, J.
double kinetic_energy(const BodyFrame& body);
/// Potential energy, J, 0 at the origin.
double potential_energy(const BodyFrame& body, const Vector& gravity);
/// The length of a rod with the body's greatest moment of inertia, m; for a ball 2.2 radii. 0 if it cannot rotate.
double size_of(const BodyFrame& body);
/// The least side of a box with the body's moments of inertia, m; for a ball 1.55 radii. 0 if it can rotate about fewer
/// than three axes.
double thickness_of(const BodyFrame& body);

/// The errors of a joint and its free motions.
struct JointState {
  /// Distance of the anchors, m, without the part along a sliding axis; for `distance` the part beyond its limits.
  double gap = 0;
  double angle = 0;  ///< between axes that should coincide, rad
  double limit = 0;  ///< beyond a limit, rad or m
  /// Values of the free motions; for a ball joint with a spring: the rotation vector in A's axes, rad.
  double values[3] = {};
  bool free[3] = {};      ///< whether the motion exists
  double masses[3] = {};  ///< effective masses that its springs act on, kg or kg m^2
};
JointState state_of(const JointFrame& joint, const Frame& frame);

}  // namespace detent_zoo
