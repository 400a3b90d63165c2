#pragma once
#include "tests/bench/zoo/script.h"

/// What the zoo asks of an engine that is not this library.
namespace detent_zoo {

/// Two bodies that touch, as the engine says.
struct Touch {
  Id a = 0, b = 0;
  double depth = 0;  ///< of the deepest point, m
};

/// A world of the engine's. What it cannot express it refuses with the reason, a few words: it plays no scene half.
class Peer {
 public:
  virtual ~Peer() = default;
  virtual void set_gravity(const Vector& gravity) = 0;
  virtual std::string add_body(Id id, const BodyFrame& body, const Properties& properties) = 0;
  /// It has no joints any more.
  virtual void remove_body(Id id) = 0;
  /// `state`: as the bodies lie now.
  virtual std::string add_joint(Id id, const JointFrame& joint, const Ties& ties, Id a, Id b,
                                const JointState& state) = 0;
  virtual void remove_joint(Id id) = 0;
  /// The springs' stiffness follows the mass that they feel, as the scenes define it: `state` before each step.
  virtual void set_springs(Id id, const JointFrame& joint, const JointState& state) = 0;
  /// Pose and velocities that a call gave.
  virtual void set_state(Id id, const BodyFrame& body) = 0;
  virtual void wake_all() = 0;

  virtual void step() = 0;
  /// Pose and velocities.
  virtual void read(Id id, BodyFrame& body) const = 0;
  virtual std::vector<Touch> contacts() const = 0;
  virtual uint32_t awake() const = 0;  ///< dynamic bodies
  /// Joints that broke in the last step.
  virtual std::vector<Id> broken() = 0;
};

using MakePeer = std::unique_ptr<Peer> (*)(double tick);

/// The scene of that file, on that ground if it has one, played by a peer; or null and why not.
std::unique_ptr<Play> open_peer_play(const std::string& path, detent_test::Ground ground, MakePeer make,
                                     std::string& problem);

/// c / m = 2 z w and k / m = w^2.
struct Spring {
  double stiffness = 0, damping = 0;
};
Spring spring_of(const AxisFrame& axis, double mass);
inline bool is_sprung(const AxisFrame& axis) { return axis.frequency > 0; }
inline bool is_driven(const AxisFrame& axis) { return axis.frequency == 0 && axis.force_max > 0; }

}  // namespace detent_zoo
