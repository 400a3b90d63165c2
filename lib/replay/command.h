#pragma once
#include <detent/body.h>
#include <detent/recording.h>
#include <detent/world.h>

#include "replay/archive.h"

/// Commands: every call that changes a world, as a value. Each command lists its fields once (`visit`), for writing and
/// for reading, and has a function that makes the call (`apply`). In a recording, a call is a *record*: a tag and the
/// fields of the command.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The first byte of a record: which call it is. The values are stored in files, so a value that is no longer used is
/// never given to another tag.
enum class RecordTag : uint8_t {
  create_body = 1,
  destroy_body = 2,
  set_pose = 3,
  set_velocity = 4,
  apply_force = 5,
  apply_torque = 6,
  apply_impulse = 7,
  apply_impulse_at = 8,
  apply_angular_impulse = 9,
  set_gravity = 10,
  set_user_data = 11,
  bind_asset = 12,
  tick = 13,           ///< the call is step()
  tick_digested = 14,  ///< as `tick`; the record also has the digest of the state after the step
  wake_body = 15,
  sleep_body = 16,
  set_type = 32,
  set_shape = 33,
  set_mass = 34,
  set_density = 35,
  set_material = 36,
  set_damping = 37,
  set_gravity_scale = 38,
  set_rotation_locks = 39,
  set_settings = 40,
  apply_force_at = 41,
  apply_force_at_point = 42,
  apply_impulse_at_point = 43,
  explode = 44,
  move_kinematic = 45,
  set_sensor = 46,
  set_filter = 48,
  query = 49,  ///< the record has the length of its rest, a query, and the digest of the answer (query_command.h)
  set_inertia = 50,
  create_joint = 64,
  destroy_joint = 65,
  set_joint = 66,
};

/// Returns the enumerator's name, which for a call is also the call's name; "" for an unknown tag. Never null.
const char* record_name(RecordTag tag);

struct CreateBody {
  static constexpr RecordTag k_tag = RecordTag::create_body;
  BodyId id = {};  ///< the id that the call returned
  BodyDef def = {};
};
/// A call whose only argument is a body.
template <RecordTag tag, Status (*call)(World&, BodyId)>
struct OnBody {
  static constexpr RecordTag k_tag = tag;
  BodyId id = {};
};
using DestroyBody = OnBody<RecordTag::destroy_body, destroy_body>;
using WakeBody = OnBody<RecordTag::wake_body, wake_body>;
using SleepBody = OnBody<RecordTag::sleep_body, sleep_body>;
/// A call with a body and a pose.
template <RecordTag tag, Status (*call)(World&, BodyId, const Position&, const Quat&)>
struct ToPose {
  static constexpr RecordTag k_tag = tag;
  BodyId id = {};
  Position position = {};
  Quat rotation = {};
};
using SetPose = ToPose<RecordTag::set_pose, set_pose>;
using MoveKinematic = ToPose<RecordTag::move_kinematic, move_kinematic>;
struct SetVelocity {
  static constexpr RecordTag k_tag = RecordTag::set_velocity;
  BodyId id = {};
  Vec3<Real> linear_velocity = {};
  Vec3<Real> angular_velocity = {};
};
/// A call that applies a force or impulse at a place: a vector from the centre of mass, or a point of the world.
template <RecordTag tag, class Place, Status (*call)(World&, BodyId, const Vec3<Scaled>&, const Place&)>
struct PushAt {
  static constexpr RecordTag k_tag = tag;
  BodyId id = {};
  Vec3<Scaled> push = {};
  Place place = {};
};
using ApplyImpulseAt = PushAt<RecordTag::apply_impulse_at, Vec3<Real>, apply_impulse_at>;
using ApplyForceAt = PushAt<RecordTag::apply_force_at, Vec3<Real>, apply_force_at>;
using ApplyImpulseAtPoint = PushAt<RecordTag::apply_impulse_at_point, Position, apply_impulse_at_point>;
using ApplyForceAtPoint = PushAt<RecordTag::apply_force_at_point, Position, apply_force_at_point>;
/// A call that applies one vector (a force, torque, impulse or angular impulse) to a body.
template <RecordTag tag, Status (*call)(World&, BodyId, const Vec3<Scaled>&)>
struct Push {
  static constexpr RecordTag k_tag = tag;
  BodyId id = {};
  Vec3<Scaled> push = {};
};
using ApplyForce = Push<RecordTag::apply_force, apply_force>;
using ApplyTorque = Push<RecordTag::apply_torque, apply_torque>;
using ApplyImpulse = Push<RecordTag::apply_impulse, apply_impulse>;
using ApplyAngularImpulse = Push<RecordTag::apply_angular_impulse, apply_angular_impulse>;
struct SetGravity {
  static constexpr RecordTag k_tag = RecordTag::set_gravity;
  Vec3<Real> gravity = {};
};
/// A call that sets one value of a body.
template <RecordTag tag, class Value, auto call>
struct SetValue {
  static constexpr RecordTag k_tag = tag;
  BodyId id = {};
  Value value = {};
};
using SetUserData = SetValue<RecordTag::set_user_data, uint32_t, set_user_data>;
using SetType = SetValue<RecordTag::set_type, BodyType, set_type>;
using SetShape = SetValue<RecordTag::set_shape, Shape, set_shape>;
using SetMass = SetValue<RecordTag::set_mass, Scaled, set_mass>;
using SetInertia = SetValue<RecordTag::set_inertia, Vec3<Scaled>, set_inertia>;
using SetDensity = SetValue<RecordTag::set_density, Scaled, set_density>;
using SetMaterial = SetValue<RecordTag::set_material, Material, set_material>;
using SetGravityScale = SetValue<RecordTag::set_gravity_scale, Real, set_gravity_scale>;
using SetRotationLocks = SetValue<RecordTag::set_rotation_locks, uint32_t, set_rotation_locks>;
using SetSensor = SetValue<RecordTag::set_sensor, bool, set_sensor>;
struct SetDamping {
  static constexpr RecordTag k_tag = RecordTag::set_damping;
  BodyId id = {};
  Real linear = {};
  Real angular = {};
};
struct SetSettings {
  static constexpr RecordTag k_tag = RecordTag::set_settings;
  WorldDef def = {};
};
struct Explode {
  static constexpr RecordTag k_tag = RecordTag::explode;
  Explosion explosion = {};
};
struct SetFilter {
  static constexpr RecordTag k_tag = RecordTag::set_filter;
  BodyId id = {};
  Filter filter = {};
};
struct BindAsset {
  static constexpr RecordTag k_tag = RecordTag::bind_asset;
  uint32_t index = 0;
};
struct CreateJoint {
  static constexpr RecordTag k_tag = RecordTag::create_joint;
  JointId id = {};  ///< the id that the call returned
  JointDef def = {};
};
struct DestroyJoint {
  static constexpr RecordTag k_tag = RecordTag::destroy_joint;
  JointId id = {};
};
struct SetJoint {
  static constexpr RecordTag k_tag = RecordTag::set_joint;
  JointId id = {};
  JointDef def = {};
};
struct Tick {
  static constexpr RecordTag k_tag = RecordTag::tick;
};
struct TickDigested {
  static constexpr RecordTag k_tag = RecordTag::tick_digested;
  uint64_t digest = 0;
};

inline void visit(Archive& archive, BodyId& id) {
  visit_word(archive, "body slot", id.slot);
  visit_word(archive, "body generation", id.generation);
}

inline void visit(Archive& archive, Shape& shape) {
  visit_choice(archive, "shape type", shape.type, ShapeType::sphere, ShapeType::compound);
  visit_number(archive, "radius", shape.radius);
  visit_number(archive, "half length", shape.half_length);
  visit_number(archive, "half extents", shape.half_extents);
  visit_number(archive, "rounding", shape.rounding);
  visit_word(archive, "shape asset", shape.asset);
}

inline void visit(Archive& archive, Material& material) {
  visit_number(archive, "friction", material.friction);
  visit_number(archive, "restitution", material.restitution);
  visit_number(archive, "rolling resistance", material.rolling_resistance);
  visit_choice(archive, "restitution rule", material.restitution_rule, RestitutionRule::larger,
               RestitutionRule::smaller);
}

inline void visit(Archive& archive, Filter& filter) {
  visit_word(archive, "category", filter.category);
  visit_word(archive, "mask", filter.mask);
  uint32_t group = static_cast<uint32_t>(filter.group);
  visit_word(archive, "group", group);
  filter.group = static_cast<int32_t>(group);
  visit_word(archive, "rule", filter.rule);
}

inline void visit(Archive& archive, BodyDef& def) {
  visit_choice(archive, "body type", def.type, BodyType::fixed, BodyType::dynamic);
  visit_number(archive, "position", def.position);
  visit_number(archive, "rotation", def.rotation);
  visit_number(archive, "linear_velocity", def.linear_velocity);
  visit_number(archive, "angular_velocity", def.angular_velocity);
  visit(archive, def.shape);
  visit(archive, def.material);
  visit_number(archive, "density", def.density);
  visit_number(archive, "mass", def.mass);
  visit_number(archive, "linear damping", def.linear_damping);
  visit_number(archive, "angular damping", def.angular_damping);
  visit_number(archive, "gravity scale", def.gravity_scale);
  visit_word(archive, "user data", def.user_data);
  visit_word(archive, "rotation locks", def.rotation_locks);
  visit(archive, def.filter);
  visit_flag(archive, "sensor", def.sensor);
}

/// Visits all settings except the capacity, which is in the header of the recording.
inline void visit(Archive& archive, WorldDef& def) {
  visit_number(archive, "gravity", def.gravity);
  visit_number(archive, "tick", def.tick);
  visit_word(archive, "substeps", def.substeps);
  visit_word(archive, "most substeps", def.substeps_max);
  visit_number(archive, "resting_penetration", def.resting_penetration);
  visit_word(archive, "iterations", def.iterations);
  visit_word(archive, "convergence", def.convergence);
  visit_choice(archive, "stabilisation", def.stabilisation, Stabilisation::soft, Stabilisation::post);
  visit_number(archive, "relaxation", def.relaxation);
  visit_number(archive, "contact_frequency", def.contact_frequency);
  visit_number(archive, "damping ratio", def.damping_ratio);
  visit_number(archive, "restitution threshold", def.restitution_threshold);
  visit_flag(archive, "continuous", def.continuous);
  visit_flag(archive, "sleeping", def.sleeping);
  visit_number(archive, "contact_margin", def.contact_margin);
  visit_number(archive, "contact_recycle_distance", def.contact_recycle_distance);
  visit_choice(archive, "reduction", def.reduction, ManifoldReduction::projected_extremes,
               ManifoldReduction::deepest_area);
}

inline void visit(Archive& archive, Explosion& explosion) {
  visit_number(archive, "centre", explosion.centre);
  visit_number(archive, "radius", explosion.radius);
  visit_number(archive, "impulse", explosion.impulse);
}

inline void visit(Archive& archive, JointId& id) {
  visit_word(archive, "joint slot", id.slot);
  visit_word(archive, "joint generation", id.generation);
}

inline void visit(Archive& archive, JointAxis& axis) {
  visit_flag(archive, "limited", axis.limited);
  visit_number(archive, "lower limit", axis.lower);
  visit_number(archive, "upper limit", axis.upper);
  visit_number(archive, "frequency", axis.frequency);
  visit_number(archive, "damping ratio", axis.damping_ratio);
  visit_number(archive, "target", axis.target);
  visit_number(archive, "speed", axis.speed);
  visit_number(archive, "greatest force", axis.force_max);
}

inline void visit(Archive& archive, JointDef& def) {
  visit_choice(archive, "joint type", def.type, JointType::ball, k_joint_type_last);
  visit(archive, def.a);
  visit(archive, def.b);
  visit_number(archive, "anchor of A", def.anchor_a);
  visit_number(archive, "anchor of B", def.anchor_b);
  visit_number(archive, "frame of A", def.frame_a);
  visit_number(archive, "frame of B", def.frame_b);
  visit(archive, def.axis);
  visit(archive, def.second);
  visit_number(archive, "friction force", def.friction_force);
  visit_number(archive, "friction torque", def.friction_torque);
  visit_flag(archive, "collide", def.collide);
  visit_number(archive, "breaking force", def.break_force);
  visit_number(archive, "breaking torque", def.break_torque);
  visit_word(archive, "user data", def.user_data);
}

inline void visit(Archive& archive, CreateJoint& command) {
  visit(archive, command.def);
  visit(archive, command.id);
}
inline void visit(Archive& archive, DestroyJoint& command) { visit(archive, command.id); }
inline void visit(Archive& archive, SetJoint& command) {
  visit(archive, command.id);
  visit(archive, command.def);
}
inline void visit(Archive& archive, CreateBody& command) {
  visit(archive, command.def);
  visit(archive, command.id);
}
template <RecordTag tag, Status (*call)(World&, BodyId)>
void visit(Archive& archive, OnBody<tag, call>& command) {
  visit(archive, command.id);
}
template <RecordTag tag, Status (*call)(World&, BodyId, const Position&, const Quat&)>
void visit(Archive& archive, ToPose<tag, call>& command) {
  visit(archive, command.id);
  visit_number(archive, "position", command.position);
  visit_number(archive, "rotation", command.rotation);
}
inline void visit(Archive& archive, SetVelocity& command) {
  visit(archive, command.id);
  visit_number(archive, "linear_velocity", command.linear_velocity);
  visit_number(archive, "angular_velocity", command.angular_velocity);
}
template <RecordTag tag, class Place, Status (*call)(World&, BodyId, const Vec3<Scaled>&, const Place&)>
void visit(Archive& archive, PushAt<tag, Place, call>& command) {
  visit(archive, command.id);
  visit_number(archive, "push", command.push);
  visit_number(archive, "place", command.place);
}
template <RecordTag tag, Status (*call)(World&, BodyId, const Vec3<Scaled>&)>
void visit(Archive& archive, Push<tag, call>& command) {
  visit(archive, command.id);
  visit_number(archive, "push", command.push);
}
inline void visit(Archive& archive, SetGravity& command) { visit_number(archive, "gravity", command.gravity); }
inline void visit_value(Archive& archive, uint32_t& value) { visit_word(archive, "value", value); }
inline void visit_value(Archive& archive, bool& value) { visit_flag(archive, "value", value); }
inline void visit_value(Archive& archive, BodyType& type) {
  visit_choice(archive, "body type", type, BodyType::fixed, BodyType::dynamic);
}
inline void visit_value(Archive& archive, Shape& shape) { visit(archive, shape); }
inline void visit_value(Archive& archive, Material& material) { visit(archive, material); }
inline void visit_value(Archive& archive, Real& value) { visit_number(archive, "value", value); }
#if DETENT_FIXED
inline void visit_value(Archive& archive, Scaled& value) { visit_number(archive, "value", value); }
#endif
inline void visit_value(Archive& archive, Vec3<Scaled>& value) { visit_number(archive, "value", value); }
template <RecordTag tag, class Value, auto call>
void visit(Archive& archive, SetValue<tag, Value, call>& command) {
  visit(archive, command.id);
  visit_value(archive, command.value);
}
inline void visit(Archive& archive, SetDamping& command) {
  visit(archive, command.id);
  visit_number(archive, "linear damping", command.linear);
  visit_number(archive, "angular damping", command.angular);
}
inline void visit(Archive& archive, SetSettings& command) { visit(archive, command.def); }
inline void visit(Archive& archive, Explode& command) { visit(archive, command.explosion); }
inline void visit(Archive& archive, SetFilter& command) {
  visit(archive, command.id);
  visit(archive, command.filter);
}
inline void visit(Archive& archive, BindAsset& command) { visit_word(archive, "asset index", command.index); }
inline void visit(Archive&, Tick&) {}
inline void visit(Archive& archive, TickDigested& command) { archive.bits("digest", command.digest, 8); }

inline Status apply(World& world, CreateJoint& command) { return create_joint(world, command.def, command.id); }
inline Status apply(World& world, DestroyJoint& command) { return destroy_joint(world, command.id); }
inline Status apply(World& world, SetJoint& command) { return set_joint(world, command.id, command.def); }
inline Status apply(World& world, CreateBody& command) { return create_body(world, command.def, command.id); }
template <RecordTag tag, Status (*call)(World&, BodyId)>
Status apply(World& world, OnBody<tag, call>& command) {
  return call(world, command.id);
}
template <RecordTag tag, Status (*call)(World&, BodyId, const Position&, const Quat&)>
Status apply(World& world, ToPose<tag, call>& command) {
  return call(world, command.id, command.position, command.rotation);
}
inline Status apply(World& world, SetVelocity& command) {
  return set_velocity(world, command.id, command.linear_velocity, command.angular_velocity);
}
template <RecordTag tag, class Place, Status (*call)(World&, BodyId, const Vec3<Scaled>&, const Place&)>
Status apply(World& world, PushAt<tag, Place, call>& command) {
  return call(world, command.id, command.push, command.place);
}
template <RecordTag tag, Status (*call)(World&, BodyId, const Vec3<Scaled>&)>
Status apply(World& world, Push<tag, call>& command) {
  return call(world, command.id, command.push);
}
inline Status apply(World& world, SetGravity& command) { return set_gravity(world, command.gravity); }
template <RecordTag tag, class Value, auto call>
Status apply(World& world, SetValue<tag, Value, call>& command) {
  return call(world, command.id, command.value);
}
inline Status apply(World& world, SetDamping& command) {
  return set_damping(world, command.id, command.linear, command.angular);
}
inline Status apply(World& world, SetSettings& command) { return set_settings(world, command.def); }
inline Status apply(World& world, Explode& command) { return explode(world, command.explosion); }
inline Status apply(World& world, SetFilter& command) { return set_filter(world, command.id, command.filter); }
inline Status apply(World& world, BindAsset& command) { return bind_asset(world, command.index); }

/// The functions for one kind of call: `visit` reads or writes a command, `apply` makes its call. `command` points to a
/// command with this tag.
struct CommandCode {
  RecordTag tag;
  void (*visit)(Archive& archive, void* command);
  Status (*apply)(World& world, void* command);
};
template <class Command>
inline constexpr CommandCode k_command_code = {
    Command::k_tag, [](Archive& archive, void* command) { visit(archive, *static_cast<Command*>(command)); },
    [](World& world, void* command) { return apply(world, *static_cast<Command*>(command)); }};

/// The size of the largest command, bytes.
inline constexpr uint32_t k_command_bytes_max = sizeof(SetJoint) > sizeof(CreateBody) ? sizeof(SetJoint)
                                                                                      : sizeof(CreateBody);

/// Returns the functions for the call with this tag; null if no call has this tag.
const CommandCode* find_command(RecordTag tag);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
