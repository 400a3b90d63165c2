#pragma once
#include <detent/body.h>
#include <detent/numbers.h>
#include <detent/status.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The type of a joint: which relative motions of A and B are free. Each body has a joint frame at its anchor; x, y, z
/// are the axes of the joint frame. `axis` and `second` are the free motions to which JointDef::axis and
/// JointDef::second apply. Stored in snapshots and recordings: a value is never reused.
enum class JointType : uint32_t {
  /// The anchors coincide; rotation is free. `axis` is a spring that rotates B's frame to A's, with the same settings
  /// about each axis of A's frame. Only its `frequency`, `damping_ratio` and `force_max` are used.
  ball = 1,
  hinge = 2,       ///< the anchors and the x axes coincide; `axis`: the angle of B's frame relative to A's, about x
  slider = 3,      ///< the frames are parallel, B's anchor lies on A's x axis; `axis`: its position on this axis
  distance = 4,    ///< all motions are free; `axis`: the distance of the anchors. Rod: lower = upper; rope: lower = 0
  fixed = 5,       ///< the frames coincide
  cone_twist = 6,  ///< the anchors coincide; `axis`: the twist about x; `second`: the angle between the x axes
  /// A is the chassis: B's anchor lies on A's x axis (the suspension), and B's z axis stays parallel to A's (the axle).
  /// `axis`: the position along the suspension; `second`: the wheel's angle about the axle.
  wheel = 7,
  parallel = 8,  ///< the x axes are parallel, all else is free; can keep a body upright; `axis`: as for a hinge
  filter = 9,    ///< all motions are free; the joint only keeps A and B from colliding (if JointDef::collide is false)
};
inline constexpr JointType k_joint_type_last = JointType::filter;  ///< the largest value of a joint type

/// The limits, spring and motor of one free motion of a joint. The value x of the motion is an angle, rad, between -pi
/// and pi, or a length, m. A limit overrides a spring or motor that pushes x beyond the limit.
struct JointAxis {
  bool limited = false;  ///< whether the limits act
  Real lower = 0.0;      ///< rad or m, lower <= x; a length is within +-16384
  Real upper = 0.0;      ///< rad or m, x <= upper; not below `lower`; equal to `lower`: x is fixed there
  /// Hz, [0, 1024]: frequency at which the two bodies alone would oscillate on the spring; 0: no spring.
  Real frequency = 0.0;
  Real damping_ratio = 1.0;  ///< damping ratio of the spring, [0, 64]; 1 is critical damping
  Real target = 0.0;         ///< target of the spring, rad or m
  Real speed = 0.0;          ///< speed of the motor, or of the spring's target, rad/s or m/s; within +-1024
  /// N or N m, >= 0. If `frequency` is above 0: the largest force of the spring; 0 means no limit. If `frequency` is 0:
  /// the largest force of the motor; 0 means no motor.
  Scaled force_max = 0.0;
};

/// The definition of a joint. At least one of its two bodies is dynamic.
struct JointDef {
  JointType type = JointType::ball;       ///< which motions are free
  BodyId a;                               ///< the first body; of a wheel the chassis
  BodyId b;                               ///< the second body, which rotates or slides relative to A
  Vec3<Real> anchor_a = {0.0, 0.0, 0.0};  ///< from A's centre of mass, m, A's axes; each component within +-4096
  Vec3<Real> anchor_b = {0.0, 0.0, 0.0};  ///< from B's centre of mass, m, B's axes; each component within +-4096
  Quat frame_a = {0.0, 0.0, 0.0, 1.0};    ///< joint frame's axes to A's; length 1 within 2^-10, normalised on entry
  Quat frame_b = {0.0, 0.0, 0.0, 1.0};    ///< joint frame's axes to B's; length as that of frame_a
  JointAxis axis = {};                    ///< the first free motion (JointType)
  JointAxis second = {};                  ///< the second free motion (JointType)
  /// N, >= 0: largest friction force along the free translation of a slider, a wheel's suspension or a distance joint.
  /// The force of a limit can exceed it.
  Scaled friction_force = 0.0;
  /// N m, >= 0: largest friction torque about each free rotation of a ball, hinge, parallel or cone_twist joint, or of
  /// a wheel about its axle. The torque of a limit can exceed it.
  Scaled friction_torque = 0.0;
  bool collide = false;       ///< whether A and B collide with each other
  Scaled break_force = 0.0;   ///< N, >= 0: the joint breaks when its mean force over a tick exceeds it; 0: never
  Scaled break_torque = 0.0;  ///< N m, >= 0: the joint breaks when its mean torque over a tick exceeds it; 0: never
  uint32_t user_data = 0;     ///< stored, digested and recorded; the library does not use it
};

/// Names a joint by value, as a BodyId names a body.
struct JointId {
  uint32_t slot = 0;        ///< index of the joint's slot, plus 1; 0: the null id
  uint32_t generation = 0;  ///< number of the joint among the joints that its slot has had; the first has 1
  /// Whether `a` and `b` name the same joint.
  friend constexpr bool operator==(JointId a, JointId b) { return a.slot == b.slot && a.generation == b.generation; }
  /// An order for sorted containers: by slot, then by generation.
  friend constexpr bool operator<(JointId a, JointId b) {
    return a.slot < b.slot || (a.slot == b.slot && a.generation < b.generation);
  }
};
/// Whether the id is null. A null id names no joint.
constexpr bool is_null(JointId id) { return id.slot == 0; }
/// 64 bits for hash tables, different for different ids: the generation in the high half, the slot in the low half.
constexpr uint64_t hash_of(JointId id) { return uint64_t{id.generation} << 32 | id.slot; }

/// The mean force and torque over a tick that a joint applied to B, in the last step in which the joint took part. The
/// joint applied the opposite force and torque to A.
struct JointReaction {
  Vec3<Scaled> force = {};   ///< N, world, at B's anchor
  Vec3<Scaled> torque = {};  ///< N m, world
};

/// A joint that broke in a step. It no longer exists.
struct JointEvent {
  JointId joint;                ///< the id that the joint had; no longer valid
  BodyId a;                     ///< JointDef::a
  BodyId b;                     ///< JointDef::b
  uint32_t user_data = 0;       ///< JointDef::user_data
  JointReaction reaction = {};  ///< mean force and torque in the step in which the joint broke
};

/// The buffer to which a step writes its joint events, in the order of the joints' slots. The memory is the caller's,
/// and must stay valid as long as the world uses it. Events beyond `capacity` are dropped, and counted in the report;
/// their joints break nevertheless.
struct JointEventBuffer {
  JointEvent* data = nullptr;  ///< room for `capacity` events; null: no events are written
  uint32_t capacity = 0;       ///< the number of events that `data` has room for
};

struct World;

/// Creates a joint in the lowest free slot, and wakes both bodies. Bodies that are connected by a joint with `collide`
/// false do not collide with each other. Errors: pool_full, bad_id, bad_argument (an unknown type, one body twice, no
/// dynamic body), out_of_range, not_normalised, feature_missing.
Status create_joint(World& world, const JointDef& def, JointId& id);
/// Removes a joint, and wakes both bodies. destroy_body() also removes the joints of its body. Errors: bad_id.
Status destroy_joint(World& world, JointId id);
/// Replaces the definition of a joint, for example to change a motor, a limit or the steering. The joint keeps its id
/// and its bodies; `def.a` and `def.b` are not read. Wakes both bodies. Errors: bad_id, bad_argument (an unknown type),
/// out_of_range, not_normalised.
Status set_joint(World& world, JointId id, const JointDef& def);
/// Gets a definition that creates the same joint between the same bodies. Errors: bad_id.
Status get_joint(const World& world, JointId id, JointDef& def);
/// Gets the joint's force and torque in the last step in which it took part. Errors: bad_id.
Status get_joint_reaction(const World& world, JointId id, JointReaction& reaction);
/// Whether the id names a joint of this world.
bool is_valid(const World& world, JointId id);
/// Iterates over joints in slot order: the first valid id after `previous` (null to begin), or null at the end.
JointId next_joint(const World& world, JointId previous);
/// Sets the anchors and frames of `def` for the current poses of `def.a` and `def.b`. Both anchors are at `point`, m,
/// world. Both joint frames have the rotation `frame`, from the joint frame's axes to the world's. Errors: bad_id,
/// out_of_range (`point` is farther than 4096 m from a body, in a component), not_normalised.
Status place_joint(const World& world, const Position& point, const Quat& frame, JointDef& def);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
