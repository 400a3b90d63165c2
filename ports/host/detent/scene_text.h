#pragma once
#include <detent/numbers.h>
#include <detent/recording.h>

#include <map>
#include <string>
#include <vector>

#include "scene_format.h"
#include "scene_json.h"

/// The content of a scene.
namespace detent {
inline namespace DETENT_NAMESPACE {

using namespace detent_tool;

template <class T>
struct Choice {
  const char* name;
  T value;
};

/// The place of a value in the file.
struct SceneOrigin {
  uint32_t line = 0;
  std::string path;
};

/// A cooked file.
struct SceneAsset {
  ShapeType type = ShapeType::hull;
  SceneOrigin file_origin, digest_origin;
  std::string file;    ///< relative to the scene's folder
  std::string digest;  ///< 16 hexadecimal digits, or empty: any
};

struct SceneBody {
  SceneOrigin origin;
  std::string name;
  BodyDef def;
};

struct SceneJoint {
  SceneOrigin origin;
  std::string name;
  std::string a, b;
  bool placed = false;  ///< placed at `point` with the bodies' present poses, not by its anchors
  Position point = {0.0, 0.0, 0.0};
  Quat frame = {0.0, 0.0, 0.0, 1.0};
  JointDef def;
};

enum class Call : uint32_t {
  create_body,
  destroy_body,
  create_joint,
  destroy_joint,
  set_joint,
  set_pose,
  move_kinematic,
  set_velocity,
  apply_force,
  apply_torque,
  apply_impulse,
  apply_angular_impulse,
  explode,
  set_gravity,
  set_settings,
  wake_body,
  sleep_body,
  set_user_data,
  set_filter,
  set_type,
  set_shape,
  set_mass,
  set_inertia,
  set_density,
  set_material,
  set_damping,
  set_gravity_scale,
  set_rotation_locks,
  set_sensor,
  query_ray,
  query_cast,
  query_overlap,
  query_bounds,
  query_closest,
};

constexpr Choice<Call> k_calls[] = {
    {"create_body", Call::create_body},
    {"destroy_body", Call::destroy_body},
    {"create_joint", Call::create_joint},
    {"destroy_joint", Call::destroy_joint},
    {"set_joint", Call::set_joint},
    {"set_pose", Call::set_pose},
    {"move_kinematic", Call::move_kinematic},
    {"set_velocity", Call::set_velocity},
    {"apply_force", Call::apply_force},
    {"apply_torque", Call::apply_torque},
    {"apply_impulse", Call::apply_impulse},
    {"apply_angular_impulse", Call::apply_angular_impulse},
    {"explode", Call::explode},
    {"set_gravity", Call::set_gravity},
    {"set_settings", Call::set_settings},
    {"wake_body", Call::wake_body},
    {"sleep_body", Call::sleep_body},
    {"set_user_data", Call::set_user_data},
    {"set_filter", Call::set_filter},
    {"set_type", Call::set_type},
    {"set_shape", Call::set_shape},
    {"set_mass", Call::set_mass},
    {"set_inertia", Call::set_inertia},
    {"set_density", Call::set_density},
    {"set_material", Call::set_material},
    {"set_damping", Call::set_damping},
    {"set_gravity_scale", Call::set_gravity_scale},
    {"set_rotation_locks", Call::set_rotation_locks},
    {"set_sensor", Call::set_sensor},
    {"query_ray", Call::query_ray},
    {"query_cast", Call::query_cast},
    {"query_overlap", Call::query_overlap},
    {"query_bounds", Call::query_bounds},
    {"query_closest", Call::query_closest},
};
inline const char* call_name(Call call) { return k_calls[static_cast<uint32_t>(call)].name; }

/// Which bodies a query tests: a QueryFilter in which `ignore` is the name of a body.
struct SceneQueryFilter {
  std::string ignore;
  QueryFilter filter;
};

/// A call before a tick. Each kind uses some of the members.
struct SceneAction {
  SceneOrigin origin;
  uint32_t tick = 0;
  uint32_t until = 0;
  Call call = Call::create_body;
  std::string name;
  std::string body;
  std::string joint;
  SceneBody new_body;
  SceneJoint new_joint;
  const Node* changes = nullptr;  ///< the changed fields of a definition; all its other fields stay
  Position position = {0.0, 0.0, 0.0};
  Position upper = {0.0, 0.0, 0.0};
  Quat rotation = {0.0, 0.0, 0.0, 1.0};
  Vec3<Real> displacement = {0.0, 0.0, 0.0};
  Vec3<Real> rotation_vector = {0.0, 0.0, 0.0};
  Vec3<Scaled> push = {0.0, 0.0, 0.0};
  bool at_arm = false;    ///< applied at `displacement` from the centre of mass
  bool at_point = false;  ///< applied at `position`
  Real first = 0.0;
  Real second = 0.0;
  Scaled mass = 0.0;
  uint32_t number = 0;
  bool flag = false;
  BodyType type = BodyType::dynamic;
  Shape shape = {};
  Material material = {};
  Filter filter = {};
  SceneQueryFilter asked = {};
};

/// The value of a capacity that the file leaves out, so that it is computed from the scene.
constexpr uint32_t k_counted = UINT32_MAX;

struct SceneText {
  uint32_t format = 0;
  std::string schema;
  std::string description;
  uint32_t ticks = 600;
  WorldDef world;
  std::map<std::string, Material> materials;
  std::map<std::string, Shape> shapes;
  std::map<std::string, Filter> filters;
  std::vector<SceneBody> bodies;
  std::vector<SceneJoint> joints;
  std::vector<SceneAction> actions;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
