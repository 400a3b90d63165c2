#pragma once
#include <stdint.h>

#include <string>
#include <vector>

#include "tests/common/queries/triple.h"

/// A graph of jointed bodies, in plain numbers that are the same for every configuration. SI units, Y up.
namespace detent_joint_fuzz {

using detent_queries::Rotation;
using detent_queries::Triple;

/// The kind of a scene. Kinds before `contact` have neither contacts nor drives, so their energy must not grow.
enum class Kind : uint32_t {
  pair,  ///< two bodies, one or two joints
  tree,  ///< up to 24 bodies
  loop,  ///< one ring, with or without attached trees
  net,   ///< many loops: a grid, or a tree with more joints between its bodies
  rope,  ///< two to four bodies on short ropes or rods at long arms
  /// A straight chain between two walls, exactly as long as their distance.
  taut,
  contact,  ///< a tree or net whose bodies collide
  ground,   ///< a tree or net that falls onto the ground
  drive,    ///< a tree, loop or net with motors and springs
};
inline constexpr uint32_t k_kinds = 9;
const char* name_of(Kind kind);

/// JointType, with the same numbers.
enum class Hold : uint32_t { ball = 1, hinge, slider, distance, fixed, cone_twist, wheel };
inline constexpr uint32_t k_holds = 7;
const char* name_of(Hold hold);

enum class Solid : uint32_t {
  sphere,   ///< size[0]: radius
  box,      ///< size: half extents
  capsule,  ///< size[0]: radius; size[1]: half length of the core, along y
};

struct SceneBody {
  bool fixed = false;
  Solid solid = Solid::box;
  Triple size = {0.5, 0.5, 0.5};
  Triple position = {};  ///< m
  Rotation rotation = {0, 0, 0, 1};
  double mass = 1;               ///< kg
  Triple linear_velocity = {};   ///< m/s
  Triple angular_velocity = {};  ///< rad/s, world
};

/// As detent::JointAxis.
struct SceneAxis {
  bool limited = false;
  double lower = 0, upper = 0;  ///< rad or m
  double frequency = 0;         ///< Hz
  double damping_ratio = 0;
  double target = 0;     ///< rad or m
  double speed = 0;      ///< rad/s or m/s
  double force_max = 0;  ///< N or N m
};

/// As detent::JointDef.
struct SceneJoint {
  Hold hold = Hold::ball;
  uint32_t a = 0, b = 0;  ///< indices of bodies
  Triple anchor_a = {}, anchor_b = {};
  Rotation frame_a = {0, 0, 0, 1}, frame_b = {0, 0, 0, 1};
  SceneAxis axis = {}, second = {};
};

struct Scene {
  uint64_t seed = 0;
  Kind kind = Kind::pair;
  double gravity = 0;       ///< m/s^2, downwards
  double extent = 0;        ///< m: the diagonal of the box about all centres and anchors
  bool collisions = false;  ///< whether bodies without a common joint collide
  bool ground = false;      ///< y <= 0 is solid
  std::vector<SceneBody> bodies;
  std::vector<SceneJoint> joints;
};

/// The name of the type of all joints; "mixed" if there are several types, "none" without joints.
inline const char* types_of(const Scene& scene) {
  for (const SceneJoint& joint : scene.joints) {
    if (joint.hold != scene.joints[0].hold) return "mixed";
  }
  return scene.joints.empty() ? "none" : name_of(scene.joints[0].hold);
}

}  // namespace detent_joint_fuzz
