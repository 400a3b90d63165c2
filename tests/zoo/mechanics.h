#pragma once
#include <math.h>

#include "tests/zoo/frame.h"

/// Mechanics of what the harness sees.
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
Vector angular_momentum(const BodyFrame& body);
/// J.
double kinetic_energy(const BodyFrame& body);
/// J, 0 at the origin.
double potential_energy(const BodyFrame& body, const Vector& gravity);
/// The length of a rod with the body's greatest moment of inertia, m: of a ball 2.2 radii. 0 if it does not turn.
double size_of(const BodyFrame& body);
/// The least side of a box with the body's moments of inertia, m: of a ball 1.55 radii. 0 if it turns about fewer than
/// three axes.
double thickness_of(const BodyFrame& body);

/// What a joint does not hold, and where its free motions are.
struct JointState {
  double gap =
      0;  ///< between the anchors, m, but for what the type lets slide; of `distance` what is beyond its limits
  double angle = 0;       ///< between axes that should be one, rad
  double limit = 0;       ///< beyond the limits of an angle, rad, or of a length, m
  double values[3] = {};  ///< of the free motions; of a ball with a spring: the turn, as a vector in A's axes, rad
  bool free[3] = {};      ///< whether there is one
  double masses[3] = {};  ///< that its springs feel, kg or kg m^2
};
JointState state_of(const JointFrame& joint, const Frame& frame);

}  // namespace detent_zoo
