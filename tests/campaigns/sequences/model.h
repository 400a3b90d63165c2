#pragma once
#include <detent/body.h>
#include <detent/joint.h>
#include <detent/world.h>

#include <map>
#include <utility>
#include <vector>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The world's filter rule.
inline bool may_meet(const FilterBody& own, const FilterBody& other) {
  return own.user_data % 4 != other.user_data % 4 && (own.filter.category & other.filter.category) == 0;
}

/// What is known of a body without asking.
struct Known {
  BodyType type = BodyType::dynamic;
  Shape shape = {};
  Material material = {};
  Real linear_damping = 0.0, angular_damping = 0.0, gravity_scale = 1.0;
  Scaled mass = 0.0;  ///< 0: not known
  uint32_t user_data = 0, rotation_locks = 0;
  Filter filter = {};
  bool sensor = false;

  bool plane() const { return shape.type == ShapeType::half_space; }
  /// Without a volume, and so never dynamic.
  bool open() const { return plane() || shape.type == ShapeType::terrain; }
};

/// A world, as the documentation of the calls made so far has it.
struct Model {
  std::map<uint32_t, std::pair<BodyId, Known>> bodies;  ///< by slot
  std::vector<BodyId> gone;
  std::map<uint32_t, std::pair<JointId, JointDef>> joints;  ///< by slot
  std::vector<JointId> joints_gone;
  uint32_t bound = 0;  ///< bits: the assets

  /// Null if there is none.
  Known* find(BodyId id) {
    const auto body = bodies.find(id.slot);
    return body != bodies.end() && body->second.first == id ? &body->second.second : nullptr;
  }
  JointDef* find(JointId id) {
    const auto joint = joints.find(id.slot);
    return joint != joints.end() && joint->second.first == id ? &joint->second.second : nullptr;
  }
  void forget(JointId id) {
    joints_gone.push_back(id);
    joints.erase(id.slot);
  }
  /// And the joints with it.
  void forget(BodyId id) {
    bodies.erase(id.slot);
    gone.push_back(id);
    for (auto joint = joints.begin(); joint != joints.end();) {
      const auto& [joint_id, def] = (joint++)->second;
      if (def.a == id || def.b == id) forget(joint_id);
    }
  }
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
