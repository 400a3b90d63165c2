#pragma once
#include "tests/common/oracle/vectors.h"

/// Motions that lead from one pose to another in the time 0 to 1, and how far apart they are in between.
namespace detent_oracle {

struct Placed {
  Vector position;
  Quaternion rotation;
};

/// Two poses: the second is the first after a way, m, and a turn about the position, rad, at most half of one.
struct PosesOfStep {
  Placed start;
  Vector displacement, rotation_vector;
};

/// On the screw through both poses, when `time` of the way along its axis is done and `angle` of its turn: the position
/// is on the arc whose chord across the axis is known.
inline Placed screw_at(const PosesOfStep& poses, double time, double angle) {
  const double whole = length(poses.rotation_vector);
  const Vector& displacement = poses.displacement;
  if (whole == 0) return {poses.start.position + displacement * time, poses.start.rotation};
  const Vector axis = poses.rotation_vector * (1 / whole), along = axis * dot(axis, displacement),
               across = displacement - along;
  const double to_chord = (angle - whole) / 2;
  const Vector arc = (across * cos(to_chord) + cross(axis, across) * sin(to_chord)) * (sin(angle / 2) / sin(whole / 2));
  return {poses.start.position + along * time + arc, rotation_by(axis * angle) * poses.start.rotation};
}

/// The screw at constant speed.
inline Placed even_screw_at(const PosesOfStep& poses, double time) {
  return screw_at(poses, time, time * length(poses.rotation_vector));
}

/// The screw with the tangent of half the angle as its clock: that of feature_toi_screw().
inline Placed tangent_screw_at(const PosesOfStep& poses, double time) {
  return screw_at(poses, time, 2 * atan(time * tan(length(poses.rotation_vector) / 2)));
}

/// Position and quaternion each on the chord.
inline Placed normalised_lerp_at(const PosesOfStep& poses, double time) {
  const Quaternion p = poses.start.rotation, q = rotation_by(poses.rotation_vector) * p;
  const double rest = 1 - time;
  return {
      poses.start.position + poses.displacement * time,
      normalised({rest * p.x + time * q.x, rest * p.y + time * q.y, rest * p.z + time * q.z, rest * p.w + time * q.w})};
}

/// `count` steps of constant velocity and angular velocity, one after the other, through poses of the even screw.
inline Placed pieces_at(const PosesOfStep& poses, int count, double time) {
  const double piece = fmin(floor(time * count), count - 1), part = time * count - piece;
  const Vector from = even_screw_at(poses, piece / count).position,
               to = even_screw_at(poses, (piece + 1) / count).position;
  return {from + (to - from) * part, rotation_by(poses.rotation_vector * time) * poses.start.rotation};
}

/// How far two motions are apart.
struct Apart {
  double distance = 0;  ///< m, of the point of the body within its radius where it is greatest
  double angle = 0;     ///< rad
};

inline Quaternion conjugate(const Quaternion& q) { return {-q.x, -q.y, -q.z, q.w}; }

/// Points within `radius` are moved apart by the way between the positions and by whatever a disc across the axis of
/// the turn between the rotations holds.
inline Apart apart(const Placed& a, const Placed& b, double radius) {
  const Quaternion rotation_vector = normalised(a.rotation) * conjugate(normalised(b.rotation));
  const Vector v = {{rotation_vector.x, rotation_vector.y, rotation_vector.z}}, displacement = a.position - b.position;
  const double sine = length(v), disc = 2 * radius * sine;
  if (sine == 0) return {length(displacement), 0};
  const double along = dot(displacement, v) / sine, across = length(displacement - v * (along / sine));
  return {hypot(along, across + disc), 2 * atan2(sine, fabs(rotation_vector.w))};
}

/// The greatest of `samples` + 1 times.
template <class MotionA, class MotionB>
Apart farthest_apart(const MotionA& a, const MotionB& b, double radius, int samples = 1024) {
  Apart greatest;
  for (int i = 0; i <= samples; ++i) {
    const double time = static_cast<double>(i) / samples;
    const Apart now = apart(a(time), b(time), radius);
    greatest = {fmax(greatest.distance, now.distance), fmax(greatest.angle, now.angle)};
  }
  return greatest;
}

/// The sagitta of an arc `lever` from the axis: what a point on it is off its chord at most, at the same time. At half
/// of the arc, up to half a turn.
inline double sagitta(double lever, double angle) { return 2 * lever * sin(angle / 4) * sin(angle / 4); }

/// max |t angle - 2 atan(t tan(angle / 2))| for t in [0, 1]: where both go at the same rate.
inline double tangent_error(double angle) {
  const double tangent = tan(angle / 2), there = sqrt(fmax(0, 2 * tangent / angle - 1));
  return 2 * atan(there) - angle * there / tangent;
}

/// max |t angle - 2 atan2(t sin(angle / 2), 1 - t + t cos(angle / 2))|: seen from the middle, each half is a tangent's.
inline double normalised_lerp_error(double angle) { return tangent_error(angle / 2); }

}  // namespace detent_oracle
