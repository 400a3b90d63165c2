#pragma once
#include "tests/joint_fuzz/scene.h"
#include "tests/queries/random.h"

/// The parts that random scenes are put together from.
namespace detent_joint_fuzz {

using detent_queries::Random;

/// What all bodies and joints of a scene have in common.
struct Style {
  double reach = 1;        ///< m: the longest arm
  double size = 1;         ///< of a body, of the arm
  double mass = 1;         ///< kg: the least
  double mass_ratio = 1;   ///< the greatest over the least
  bool mixed = false;      ///< joints of any type
  Hold hold = Hold::ball;  ///< else all of this one
  bool limits = false;     ///< half of the free motions have them
  bool drives = false;     ///< and motors and springs
};

/// Log-uniform, a float: libraries whose logarithms differ in the last bit make the same scene.
double spread(Random& random, double low, double high);
/// Of any direction, and of a length up to `most`.
Triple any_vector(Random& random, double most);

/// Puts bodies and joints into a scene.
class Builder {
 public:
  Builder(Scene& scene, const Style& style, Random& random) : scene_(scene), style_(style), random_(random) {}

  const Style& style() const { return style_; }
  /// m; from a body's centre to a joint: seldom 0.
  Triple arm();

  /// A body of random shape and pose. Its index.
  uint32_t add_body(const Triple& position);
  /// A small body that does not move.
  uint32_t add_wall(const Triple& position);
  /// The next joint's type, as the style has it.
  Hold any_hold();
  /// A joint between two bodies where they are, with A's anchor at `point`, m, world.
  void join(uint32_t a, uint32_t b, const Triple& point, Hold hold);
  /// A joint whose frame is given, and how far B's anchor lies from A's where they may be apart, m, along x.
  void join(uint32_t a, uint32_t b, const Triple& point, Hold hold, const Rotation& frame, double apart);

 private:
  void add_limits(SceneJoint& joint, double apart, double lean);
  void add_drives(SceneJoint& joint);

  Scene& scene_;
  Style style_;
  Random& random_;
};

/// Sets velocities that fit the joints: of a tree whose joints come in the order of its bodies, from the first on, any;
/// else of the whole as one piece, and none where a wall holds it.
void set_fitting_velocities(Scene& scene, bool is_tree, double speed, double spin, Random& random);
/// Sets velocities at random.
void set_any_velocities(Scene& scene, double speed, double spin, Random& random);

}  // namespace detent_joint_fuzz
