#pragma once
#include <detent/id.h>
#include <detent/math.h>
#include <detent/scaled.h>
#include <detent/status.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// What a joint leaves free. Each body has a frame at its anchor; x, y, z are the frame's axes. Stored in snapshots and
/// recordings: a value is never reused.
enum class JointType : uint32_t {
  ball = 1,        ///< the anchors are one; all turning is free. `axis`: a spring, which turns B's frame to A's; of it
                   ///< `frequency`, `damping_ratio` and `force_max`, about each of A's axes, have a meaning
  hinge = 2,       ///< and the x axes are one; `axis`: the angle of B's frame against A's about x
  slider = 3,      ///< the frames are parallel, B's anchor lies on A's x; `axis`: how far along it
  distance = 4,    ///< nothing but `axis`: how far the anchors are apart. Rod: lower = upper; rope: lower = 0
  fixed = 5,       ///< the frames are one
  cone_twist = 6,  ///< the anchors are one; `axis`: the twist about x; `second`: the angle between the x axes
  wheel = 7,       ///< A is the chassis: B's anchor lies on A's x, the suspension, and B's z stays A's, the axle;
                   ///< `axis`: along the suspension; `second`: the wheel's angle about the axle
  parallel = 8,    ///< the x axes are parallel, nothing else: what stays upright; `axis`: as a hinge's
  filter = 9,      ///< all is free: A and B do not collide
};
inline constexpr JointType k_joint_type_last = JointType::filter;  ///< those before it are types, too

/// The limits, spring and motor of one free motion x of a joint: an angle, rad, in (-pi, pi), or a length, m.
/// A limit goes before a spring or motor that pushes into it.
struct JointAxis {
  bool limited = false;      ///< whether the limits hold
  Real lower = 0.0;          ///< rad or m, lower <= x; a length is within +-16384
  Real upper = 0.0;          ///< x <= upper, not below `lower`; equal: held there
  Real frequency = 0.0;      ///< Hz, [0, 1024]: of the spring towards `target`, as if only the two bodies were
                             ///< there; 0: no spring
  Real damping_ratio = 1.0;  ///< of the spring, [0, 64]; 1 is critical
  Real target = 0.0;         ///< rad or m
  Real speed = 0.0;          ///< of the motor, or of the spring's target, rad/s or m/s; within +-1024
  Scaled force_max = 0.0;    ///< N or N m, >= 0: the motor's, 0: no motor; of a spring the limit, 0: none
};

/// What `create_joint` makes. Names two bodies, of which one at least is dynamic.
struct JointDef {
  JointType type = JointType::ball;       ///< what it leaves free
  BodyId a;                               ///< the first body: of a wheel the chassis
  BodyId b;                               ///< the second: what turns or slides on A
  Vec3<Real> anchor_a = {0.0, 0.0, 0.0};  ///< from A's centre of mass, m, A's axes; each component within
                                          ///< +-4096
  Vec3<Real> anchor_b = {0.0, 0.0, 0.0};  ///< likewise, from B's, in B's axes
  Quat frame_a = {0.0, 0.0, 0.0, 1.0};    ///< from the frame's axes to A's; length 1 within 2^-10, normalised on entry
  Quat frame_b = {0.0, 0.0, 0.0, 1.0};    ///< likewise, to B's
  JointAxis axis = {};                    ///< of the first free motion (JointType)
  JointAxis second = {};                  ///< of the second
  Scaled friction_force = 0.0;   ///< N, >= 0: brakes a slider, a wheel's suspension and the distance by no more
                                 ///< than this. A limit goes before it
  Scaled friction_torque = 0.0;  ///< N m, >= 0: likewise each turn of a ball, hinge, cone_twist, and a wheel's
                                 ///< about its axle
  bool collide = false;                   ///< whether A and B collide with each other
  Scaled break_force = 0.0;   ///< N, >= 0: the joint breaks when its mean force over a tick exceeds it; 0: never
  Scaled break_torque = 0.0;  ///< N m, likewise
  uint32_t user_data = 0;     ///< kept, digested and recorded; never read
};

/// Names a joint by value, as a BodyId names a body.
struct JointId {
  uint32_t slot = 0;        ///< index + 1; 0 is null
  uint32_t generation = 0;  ///< 1 for the first joint of a slot
  /// The same joint.
  friend constexpr bool operator==(JointId a, JointId b) { return a.slot == b.slot && a.generation == b.generation; }
};

/// What a joint did to B, and the opposite to A, in the last step that it took part in: means over the tick.
struct JointReaction {
  Vec3<Scaled> force = {};   ///< N, world, at B's anchor
  Vec3<Scaled> torque = {};  ///< N m, world
};

/// A joint that broke in a step, and is gone.
struct JointEvent {
  JointId joint;                ///< names nothing any more
  BodyId a;                     ///< JointDef::a
  BodyId b;                     ///< JointDef::b
  uint32_t user_data = 0;       ///< JointDef::user_data
  JointReaction reaction = {};  ///< of the step in which it broke
};

/// Where a step puts its joint events, in the order of the joints' slots. The caller's memory: it must outlive the
/// world's use of it. Beyond `capacity` they are dropped and counted in the report; the joints break all the same.
struct JointEventBuffer {
  JointEvent* data = nullptr;  ///< filled from its front
  uint32_t capacity = 0;       ///< events that `data` has room for
};

struct World;

/// Makes a joint in the lowest free slot, and wakes both bodies. Bodies that a joint with `collide` false connects do
/// not touch each other. Errors: pool_full, bad_id, bad_argument (a type that is none, one body twice, no dynamic
/// body), out_of_range, not_normalised, feature_missing.
Status create_joint(World& world, const JointDef& def, JointId& id);
/// Takes a joint away, and wakes both bodies. A body that is destroyed takes its joints with it. Errors: bad_id.
Status destroy_joint(World& world, JointId id);
/// Makes the joint anew from `def` under the same name: motors, limits, steering. The bodies stay: `def.a`, `def.b` are
/// not read. Wakes both. Errors: as create_joint.
Status set_joint(World& world, JointId id, const JointDef& def);
/// A definition that creates the same joint between the same bodies. Errors: bad_id.
Status get_joint(const World& world, JointId id, JointDef& def);
/// What the joint bore in the last step that it took part in. Errors: bad_id.
Status get_joint_reaction(const World& world, JointId id, JointReaction& reaction);
/// Whether the id names a joint of this world.
bool is_valid(const World& world, JointId id);
/// Visits joints in slot order: the first valid id after `previous` (null to begin), or null at the end.
JointId next_joint(const World& world, JointId previous);
/// Sets anchors and frames of `def` so that the joint is at rest where `def.a` and `def.b` are now, with its anchor at
/// `point`, world, and its frame `frame`, from the frame's axes to the world's. Errors: bad_id, out_of_range (farther
/// than 4096 m), not_normalised.
Status place_joint(const World& world, const Position& point, const Quat& frame, JointDef& def);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
