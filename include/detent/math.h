#pragma once
#include <detent/detail/shared.h>
#include <detent/scalar.h>

/// @file
/// Vectors, rotations, poses.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Three components along right-handed axes.
template <class T>
struct Vec3 {
  T x;  ///< along the first axis
  T y;  ///< along the second axis
  T z;  ///< along the third axis
  /// Equal in each component.
  DETENT_SHARED friend constexpr bool operator==(const Vec3& a, const Vec3& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
  }
};

/// A position in the world, m.
using Position = Vec3<Coord>;

/// A rotation as a unit quaternion, w + xi + yj + zk, from local to world: v_world = q v_local q*.
struct Quat {
  Unit x;  ///< the part of i
  Unit y;  ///< the part of j
  Unit z;  ///< the part of k
  Unit w;  ///< the real part
  /// Equal in each component; q and -q, the same rotation, are not.
  friend constexpr bool operator==(const Quat& a, const Quat& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z && a.w == b.w;
  }
};

/// A rotation matrix, by columns.
struct Matrix3 {
  Vec3<Unit> column[3];  ///< column[i] is the image of local axis i
};

/// Position and rotation of a body.
struct Pose {
  Position position;  ///< of the centre of mass, m, world
  Quat rotation;      ///< local to world, of length 1
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
