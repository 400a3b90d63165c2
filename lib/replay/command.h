#pragma once
#include <detent/world.h>

#include "replay/archive.h"

/// Every mutating call of world.h as a value. Each command lists its fields once (`visit`), for writing and reading
/// alike, and says how it is made (`apply`).
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The first byte of a record. Stored: a value is never reused.
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
  tick = 13,           ///< a step
  tick_digested = 14,  ///< a step, and the digest after it
  wake_body = 15,
  put_to_sleep = 16,
  create_joint = 64,
  destroy_joint = 65,
  set_joint = 66,
};

struct CreateBody {
  static constexpr RecordTag k_tag = RecordTag::create_body;
  BodyDef def = {};
  BodyId id = {};  ///< what the call gave
};
/// The calls that need no more than a body.
template <RecordTag tag, Status (*call)(World&, BodyId)>
struct OnBody {
  static constexpr RecordTag k_tag = tag;
  BodyId id = {};
};
using DestroyBody = OnBody<RecordTag::destroy_body, destroy_body>;
using WakeBody = OnBody<RecordTag::wake_body, wake_body>;
using PutToSleep = OnBody<RecordTag::put_to_sleep, put_to_sleep>;
struct SetPose {
  static constexpr RecordTag k_tag = RecordTag::set_pose;
  BodyId id = {};
  Position position = {};
  Quat rotation = {};
};
struct SetVelocity {
  static constexpr RecordTag k_tag = RecordTag::set_velocity;
  BodyId id = {};
  Vec3<Real> velocity = {};
  Vec3<Real> spin = {};
};
struct ApplyImpulseAt {
  static constexpr RecordTag k_tag = RecordTag::apply_impulse_at;
  BodyId id = {};
  Vec3<Scaled> impulse = {};
  Vec3<Real> arm = {};
};
/// The four calls that push a body by one vector.
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
struct SetUserData {
  static constexpr RecordTag k_tag = RecordTag::set_user_data;
  BodyId id = {};
  uint32_t user_data = 0;
};
struct BindAsset {
  static constexpr RecordTag k_tag = RecordTag::bind_asset;
  uint32_t index = 0;
};
struct CreateJoint {
  static constexpr RecordTag k_tag = RecordTag::create_joint;
  JointDef def = {};
  JointId id = {};  ///< what the call gave
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

template <class Archive>
void visit(Archive& archive, BodyId& id) {
  visit_word(archive, "body slot", id.slot);
  visit_word(archive, "body generation", id.generation);
}

template <class Archive>
void visit(Archive& archive, Shape& shape) {
  visit_choice(archive, "shape type", shape.type, ShapeType::sphere, ShapeType::hull);
  visit_number(archive, "radius", shape.radius);
  visit_number(archive, "half length", shape.half_length);
  visit_number(archive, "half extents", shape.half_extents);
  visit_number(archive, "rounding", shape.rounding);
  visit_word(archive, "shape asset", shape.asset);
}

template <class Archive>
void visit(Archive& archive, Material& material) {
  visit_number(archive, "friction", material.friction);
  visit_number(archive, "restitution", material.restitution);
  visit_number(archive, "rolling resistance", material.rolling_resistance);
  visit_choice(archive, "restitution rule", material.restitution_rule, RestitutionRule::larger,
               RestitutionRule::smaller);
}

template <class Archive>
void visit(Archive& archive, BodyDef& def) {
  visit_choice(archive, "body type", def.type, BodyType::fixed, BodyType::dynamic);
  visit_number(archive, "position", def.position);
  visit_number(archive, "rotation", def.rotation);
  visit_number(archive, "velocity", def.velocity);
  visit_number(archive, "spin", def.spin);
  visit(archive, def.shape);
  visit(archive, def.material);
  visit_number(archive, "density", def.density);
  visit_number(archive, "mass", def.mass);
  visit_number(archive, "linear damping", def.linear_damping);
  visit_number(archive, "angular damping", def.angular_damping);
  visit_number(archive, "gravity scale", def.gravity_scale);
  visit_word(archive, "user data", def.user_data);
}

template <class Archive>
void visit(Archive& archive, JointId& id) {
  visit_word(archive, "joint slot", id.slot);
  visit_word(archive, "joint generation", id.generation);
}

template <class Archive>
void visit(Archive& archive, JointAxis& axis) {
  visit_flag(archive, "limited", axis.limited);
  visit_number(archive, "lower limit", axis.lower);
  visit_number(archive, "upper limit", axis.upper);
  visit_number(archive, "frequency", axis.frequency);
  visit_number(archive, "damping ratio", axis.damping_ratio);
  visit_number(archive, "target", axis.target);
  visit_number(archive, "speed", axis.speed);
  visit_number(archive, "greatest force", axis.force_max);
}

template <class Archive>
void visit(Archive& archive, JointDef& def) {
  visit_choice(archive, "joint type", def.type, JointType::ball, JointType::wheel);
  visit(archive, def.a);
  visit(archive, def.b);
  visit_number(archive, "anchor of A", def.anchor_a);
  visit_number(archive, "anchor of B", def.anchor_b);
  visit_number(archive, "frame of A", def.frame_a);
  visit_number(archive, "frame of B", def.frame_b);
  visit(archive, def.axis);
  visit(archive, def.second);
  visit_flag(archive, "collide", def.collide);
  visit_number(archive, "breaking force", def.break_force);
  visit_number(archive, "breaking torque", def.break_torque);
  visit_word(archive, "user data", def.user_data);
}

template <class Archive>
void visit(Archive& archive, CreateJoint& command) {
  visit(archive, command.def);
  visit(archive, command.id);
}
template <class Archive>
void visit(Archive& archive, DestroyJoint& command) {
  visit(archive, command.id);
}
template <class Archive>
void visit(Archive& archive, SetJoint& command) {
  visit(archive, command.id);
  visit(archive, command.def);
}
template <class Archive>
void visit(Archive& archive, CreateBody& command) {
  visit(archive, command.def);
  visit(archive, command.id);
}
template <class Archive, RecordTag tag, Status (*call)(World&, BodyId)>
void visit(Archive& archive, OnBody<tag, call>& command) {
  visit(archive, command.id);
}
template <class Archive>
void visit(Archive& archive, SetPose& command) {
  visit(archive, command.id);
  visit_number(archive, "position", command.position);
  visit_number(archive, "rotation", command.rotation);
}
template <class Archive>
void visit(Archive& archive, SetVelocity& command) {
  visit(archive, command.id);
  visit_number(archive, "velocity", command.velocity);
  visit_number(archive, "spin", command.spin);
}
template <class Archive>
void visit(Archive& archive, ApplyImpulseAt& command) {
  visit(archive, command.id);
  visit_number(archive, "impulse", command.impulse);
  visit_number(archive, "arm", command.arm);
}
template <class Archive, RecordTag tag, Status (*call)(World&, BodyId, const Vec3<Scaled>&)>
void visit(Archive& archive, Push<tag, call>& command) {
  visit(archive, command.id);
  visit_number(archive, "push", command.push);
}
template <class Archive>
void visit(Archive& archive, SetGravity& command) {
  visit_number(archive, "gravity", command.gravity);
}
template <class Archive>
void visit(Archive& archive, SetUserData& command) {
  visit(archive, command.id);
  visit_word(archive, "user data", command.user_data);
}
template <class Archive>
void visit(Archive& archive, BindAsset& command) {
  visit_word(archive, "asset index", command.index);
}
template <class Archive>
void visit(Archive&, Tick&) {}
template <class Archive>
void visit(Archive& archive, TickDigested& command) {
  archive.bits("digest", command.digest, 8);
}

inline Status apply(World& world, CreateJoint& command) { return create_joint(world, command.def, command.id); }
inline Status apply(World& world, DestroyJoint& command) { return destroy_joint(world, command.id); }
inline Status apply(World& world, SetJoint& command) { return set_joint(world, command.id, command.def); }
inline Status apply(World& world, CreateBody& command) { return create_body(world, command.def, command.id); }
template <RecordTag tag, Status (*call)(World&, BodyId)>
Status apply(World& world, OnBody<tag, call>& command) {
  return call(world, command.id);
}
inline Status apply(World& world, SetPose& command) {
  return set_pose(world, command.id, command.position, command.rotation);
}
inline Status apply(World& world, SetVelocity& command) {
  return set_velocity(world, command.id, command.velocity, command.spin);
}
inline Status apply(World& world, ApplyImpulseAt& command) {
  return apply_impulse_at(world, command.id, command.impulse, command.arm);
}
template <RecordTag tag, Status (*call)(World&, BodyId, const Vec3<Scaled>&)>
Status apply(World& world, Push<tag, call>& command) {
  return call(world, command.id, command.push);
}
inline Status apply(World& world, SetGravity& command) { return set_gravity(world, command.gravity); }
inline Status apply(World& world, SetUserData& command) { return set_user_data(world, command.id, command.user_data); }
inline Status apply(World& world, BindAsset& command) { return bind_asset(world, command.index); }

template <class Command, class Visitor>
bool visit_new(const Visitor& visitor) {
  Command command = {};
  visitor(command);
  return true;
}

/// Calls `visitor(command)` with a default command of the tag's type. False if no call has this tag.
template <class Visitor>
bool with_command(RecordTag tag, const Visitor& visitor) {
  switch (tag) {
    case RecordTag::create_body:
      return visit_new<CreateBody>(visitor);
    case RecordTag::destroy_body:
      return visit_new<DestroyBody>(visitor);
    case RecordTag::set_pose:
      return visit_new<SetPose>(visitor);
    case RecordTag::set_velocity:
      return visit_new<SetVelocity>(visitor);
    case RecordTag::apply_force:
      return visit_new<ApplyForce>(visitor);
    case RecordTag::apply_torque:
      return visit_new<ApplyTorque>(visitor);
    case RecordTag::apply_impulse:
      return visit_new<ApplyImpulse>(visitor);
    case RecordTag::apply_impulse_at:
      return visit_new<ApplyImpulseAt>(visitor);
    case RecordTag::apply_angular_impulse:
      return visit_new<ApplyAngularImpulse>(visitor);
    case RecordTag::set_gravity:
      return visit_new<SetGravity>(visitor);
    case RecordTag::set_user_data:
      return visit_new<SetUserData>(visitor);
    case RecordTag::bind_asset:
      return visit_new<BindAsset>(visitor);
    case RecordTag::wake_body:
      return visit_new<WakeBody>(visitor);
    case RecordTag::put_to_sleep:
      return visit_new<PutToSleep>(visitor);
    case RecordTag::create_joint:
      return visit_new<CreateJoint>(visitor);
    case RecordTag::destroy_joint:
      return visit_new<DestroyJoint>(visitor);
    case RecordTag::set_joint:
      return visit_new<SetJoint>(visitor);
    case RecordTag::tick:
    case RecordTag::tick_digested:
      break;
  }
  return false;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
