#pragma once
#include <btBulletDynamicsCommon.h>

#include <memory>
#include <vector>

#include "tests/bench/zoo/peer.h"

/// What Bullet's files share.
namespace detent_zoo {

inline btScalar bullet(double value) { return static_cast<btScalar>(value); }
inline btVector3 bullet(const Vector& v) { return {bullet(v.x), bullet(v.y), bullet(v.z)}; }
inline btQuaternion bullet(const Rotation& q) { return {bullet(q.x), bullet(q.y), bullet(q.z), bullet(q.w)}; }
inline btTransform bullet(const Rotation& q, const Vector& v) { return btTransform(bullet(q), bullet(v)); }
inline Vector from_bullet(const btVector3& v) {
  return {static_cast<double>(v.x()), static_cast<double>(v.y()), static_cast<double>(v.z())};
}
inline Rotation from_bullet(const btQuaternion& q) {
  return {static_cast<double>(q.x()), static_cast<double>(q.y()), static_cast<double>(q.z()),
          static_cast<double>(q.w())};
}

/// A shape, with all that it is made of.
struct BulletShape {
  std::vector<std::unique_ptr<btCollisionShape>> parts;
  std::vector<std::unique_ptr<btTriangleMesh>> meshes;
  btCollisionShape* whole = nullptr;
};
/// Empty, or why not.
std::string make_bullet_shape(const std::vector<Part>& parts, BulletShape& shape);

struct BulletJoint {
  std::unique_ptr<btTypedConstraint> constraint;  ///< null where a joint only keeps its bodies from colliding
  JointFrame frame;
};
/// Likewise.
std::string make_bullet_joint(const JointFrame& joint, const Ties& ties, btRigidBody& a, btRigidBody& b, double tick,
                              std::unique_ptr<btTypedConstraint>& constraint);
void set_bullet_springs(const JointFrame& joint, const JointState& state, btTypedConstraint& constraint);

}  // namespace detent_zoo
