#pragma once
#include <stdint.h>

#include <memory>
#include <string>
#include <vector>

/// What the harness sees of a world, in doubles. Of no configuration. m, kg, s, rad; world frame where nothing else is
/// said.
namespace detent_zoo {

struct Vector {
  double x = 0, y = 0, z = 0;
};
struct Rotation {
  double x = 0, y = 0, z = 0, w = 1;
};

enum class Kind : uint32_t { fixed, kinematic, dynamic };

struct BodyFrame {
  Kind kind = Kind::fixed;
  double mass = 0;
  Vector inertia;  ///< about its own axes, kg m^2; 0 about a locked one
  double gravity_scale = 1;
  Vector position;
  Rotation rotation;
  Vector velocity, spin;
};

/// As JointType has them.
enum class Held : uint32_t { ball = 1, hinge, slider, distance, fixed, cone_twist, wheel, parallel, filter };

struct AxisFrame {
  bool limited = false;
  double lower = 0, upper = 0;
  double frequency = 0, damping_ratio = 0, target = 0;
  double speed = 0, force_max = 0;
};

struct JointFrame {
  Held type = Held::ball;
  uint32_t a = 0, b = 0;  ///< of Frame::bodies
  Vector anchor_a, anchor_b;
  Rotation frame_a, frame_b;
  AxisFrame axes[2];
};

/// Two bodies that touch; a pair may be there several times.
struct ContactFrame {
  uint32_t a = 0, b = 0;  ///< of Frame::bodies
  double depth = 0;       ///< of the deepest point, m; negative if there is a gap
};

struct Frame {
  double tick_time = 0;  ///< of one step, s
  Vector gravity;
  std::vector<BodyFrame> bodies;
  std::vector<JointFrame> joints;
  std::vector<ContactFrame> contacts;
};

/// What a step told.
struct StepFigures {
  uint64_t lost = 0;      ///< pairs, contacts and ranges that were dropped or clamped, decisions left, bodies stopped
  uint32_t substeps = 0;  ///< greatest of any island
  uint32_t awake = 0;
  double seconds = 0;
};

/// A scene that plays in one configuration.
class Play {
 public:
  virtual ~Play() = default;
  /// The calls before the next tick. Whether there were any, or `problem`.
  virtual bool call(std::string& problem) = 0;
  virtual StepFigures step() = 0;
  virtual Frame frame() const = 0;
  virtual uint32_t ticks() const = 0;  ///< the scene's length
  /// The body of Frame::bodies, as messages name it.
  virtual std::string body_name(uint32_t index) const = 0;
  /// The joint of Frame::joints, likewise.
  virtual std::string joint_name(uint32_t index) const = 0;
};

/// The library in one configuration.
struct Engine {
  const char* config;
  /// The scene of that file at its beginning, or null and what is wrong.
  std::unique_ptr<Play> (*open)(const std::string& path, std::string& problem);
};
std::vector<Engine> all_engines();

}  // namespace detent_zoo
