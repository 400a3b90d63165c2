#pragma once
#include <stdint.h>

#include <memory>
#include <string>
#include <vector>

#include "tests/common/support/ground.h"
#include "tests/common/support/stage_time.h"

/// The harness's view of a world, in doubles, independent of the configuration. m, kg, s, rad; world frame unless
/// stated otherwise.
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
  Vector linear_velocity, angular_velocity;
};

/// As JointType.
enum class Held : uint32_t { ball = 1, hinge, slider, distance, fixed, cone_twist, wheel, parallel, filter };

struct AxisFrame {
  bool limited = false;
  double lower = 0, upper = 0;
  double frequency = 0, damping_ratio = 0, target = 0;
  double speed = 0, force_max = 0;
};

struct JointFrame {
  Held type = Held::ball;
  uint32_t a = 0, b = 0;  ///< indices into Frame::bodies
  Vector anchor_a, anchor_b;
  Rotation frame_a, frame_b;
  AxisFrame axes[2];
};

/// Two bodies in contact; a pair may occur several times.
struct ContactFrame {
  uint32_t a = 0, b = 0;  ///< indices into Frame::bodies
  double depth = 0;       ///< of the deepest point, m; negative for a gap
};

struct Frame {
  double tick_time = 0;  ///< of one step, s
  Vector gravity;
  std::vector<BodyFrame> bodies;
  std::vector<JointFrame> joints;
  std::vector<ContactFrame> contacts;
};

/// Counts of a step's report.
struct StepFigures {
  /// Pairs, contacts and ranges that were dropped or clamped, joint decisions left, bodies stopped.
  uint64_t lost = 0;
  uint32_t substeps = 0;  ///< greatest of any island
  uint32_t awake = 0;
  double seconds = 0;
  uint32_t islands = 0;
  uint32_t impacts = 0, tests = 0;  ///< of continuous collision
  const char* lost_most = "";       ///< the greatest of the counts in `lost`
};

/// A change of a scene's settings.
struct Variation {
  double gravity = 1;  ///< times the scene's gravity
  double tick = 1;     ///< times the scene's tick; the scene takes as long, and its calls are made at the same times
};

/// A scene that runs in one configuration.
class Play {
 public:
  virtual ~Play() = default;
  /// Makes the calls before the next tick. Returns whether there were any; on failure sets `problem`.
  virtual bool call(std::string& problem) = 0;
  virtual StepFigures step() = 0;
  /// Changes the settings, before the first tick. Returns false if they would leave their range, or if the engine
  /// cannot change them.
  virtual bool vary(const Variation&) { return false; }
  /// From here on stages() counts, ns.
  virtual void start_profile() {}
  virtual detent_test::StageTimes stages() const { return {}; }
  virtual Frame frame() const = 0;
  virtual uint32_t ticks() const = 0;  ///< the scene's length, with its variation
  /// The name of a body of Frame::bodies, for messages.
  virtual std::string body_name(uint32_t index) const = 0;
  /// The name of a joint of Frame::joints, for messages.
  virtual std::string joint_name(uint32_t index) const = 0;
};

/// The library in one configuration.
struct Engine {
  const char* config;
  /// Opens a scene file at its start, on that ground if it has one; null, with the problem, on failure.
  std::unique_ptr<Play> (*open)(const std::string& path, detent_test::Ground ground, std::string& problem);
};
std::vector<Engine> all_engines();

}  // namespace detent_zoo
