#pragma once
#include "tests/common/queries/triple.h"

/// Products of unit quaternions x, y, z, w.
namespace detent_joint_fuzz {

using detent_queries::Rotation;
using detent_queries::Triple;
using detent_queries::operator+;
using detent_queries::operator-;
using detent_queries::operator*;
using detent_queries::cross;
using detent_queries::dot;
using detent_queries::length;
using detent_queries::rotate;

inline Rotation conjugate(const Rotation& q) { return {-q[0], -q[1], -q[2], q[3]}; }

/// The rotation b followed by a.
inline Rotation product(const Rotation& a, const Rotation& b) {
  return {a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1], a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
          a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3], a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
}

/// Scales the quaternion to length 1.
inline Rotation normalised(const Rotation& q) {
  const double scale = 1 / sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  return {q[0] * scale, q[1] * scale, q[2] * scale, q[3] * scale};
}

inline Triple unrotate(const Rotation& q, const Triple& v) { return detent_queries::rotate(conjugate(q), v); }

}  // namespace detent_joint_fuzz
