#pragma once
#include <detent/scalar.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

template <class T>
struct Vec3 {
  T x, y, z;
  friend constexpr bool operator==(const Vec3& a, const Vec3& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }
};

using Position = Vec3<Coord>;

/// A rotation as a unit quaternion, w + xi + yj + zk, from local to world: v_world = q v_local q*.
struct Quat {
  Unit x, y, z, w;
  friend constexpr bool operator==(const Quat& a, const Quat& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z && a.w == b.w;
  }
};

/// A rotation by columns: the images of the local axes.
struct Matrix3 {
  Vec3<Unit> column[3];
};

/// Where a body is: the world position of its centre of mass, m, and its rotation from local to world.
struct Pose {
  Position position;
  Quat rotation;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
