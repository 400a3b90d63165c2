#pragma once
#include "tests/campaigns/joint_fuzz/scene.h"
#include "tests/common/queries/random.h"

/// The parts of random scenes.
namespace detent_joint_fuzz {

using detent_queries::Random;

/// Common properties of a scene's bodies and joints.
struct Style {
  double distance_max = 1;  ///< m: the longest arm
  double size = 1;          ///< of a body, relative to the longest arm
  double mass = 1;          ///< kg: the smallest mass
  double mass_ratio = 1;    ///< greatest over smallest mass
  bool mixed = false;       ///< joints of any type
  Hold hold = Hold::ball;   ///< the type of all joints if not mixed
  bool limits = false;      ///< half of the free motions have limits
  bool drives = false;      ///< the joints have motors and springs
};

/// Log-uniform and rounded to float, so that C libraries whose logarithms differ in the last bit make the same scene.
double spread(Random& random, double low, double high);
/// A vector of random direction and of a length up to `most`.
Triple any_vector(Random& random, double most);

/// Adds bodies and joints to a scene.
class Builder {
 public:
  Builder(Scene& scene, const Style& style, Random& random) : scene_(scene), style_(style), random_(random) {}

  const Style& style() const { return style_; }
  /// A random vector from a body's centre to a joint, m; seldom 0.
  Triple arm();

  /// Adds a body of random shape and rotation; returns its index.
  uint32_t add_body(const Triple& position);
  /// Adds a small fixed body; returns its index.
  uint32_t add_wall(const Triple& position);
  /// The type of the next joint, by the style.
  Hold any_hold();
  /// Adds a joint between two bodies at their present poses, with A's anchor at `point`, m, world.
  void join(uint32_t a, uint32_t b, const Triple& point, Hold hold);
  /// Adds a joint with a given frame. `apart`: distance of B's anchor from A's along the frame's x, m, if the type
  /// allows one.
  void join(uint32_t a, uint32_t b, const Triple& point, Hold hold, const Rotation& frame, double apart);

 private:
  void add_limits(SceneJoint& joint, double apart, double lean);
  void add_drives(SceneJoint& joint);

  Scene& scene_;
  Style style_;
  Random& random_;
};

/// Sets velocities that fit the joints. In a tree whose joints are in the order of its bodies the motion of each joint
/// is random. In any other scene all bodies move as one rigid body, or not at all if a wall holds them.
void set_fitting_velocities(Scene& scene, bool is_tree, double speed, double angular_velocity, Random& random);
/// Sets random velocities.
void set_any_velocities(Scene& scene, double speed, double angular_velocity, Random& random);

}  // namespace detent_joint_fuzz
