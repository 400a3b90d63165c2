#include <detent/body.h>
#include <detent/contact.h>
#include <detent/sensor.h>
#include <stdlib.h>

#include "fields.h"
#include "session.h"

/// Functions that read a world and do not change it.
namespace detent_web {
namespace {

BodyId taken_body(uint32_t slot, uint32_t generation) { return {slot, generation}; }

void give(Giver& out, const Contact& contact) {
  BodyId a = contact.a, b = contact.b;
  Vec3<Unit> normal = contact.normal;
  Vec3<Scaled> friction = contact.friction_impulse;
  visit(out, a);
  visit(out, b);
  visit_units(out, normal);
  out.word(contact.part);
  out.flag(contact.touching);
  out.word(contact.age);
  visit_scaleds(out, friction);
  out.scaled(contact.normal_impulse);
  out.scaled(contact.normal_force);
  out.word(contact.point_count);
  for (uint32_t i = 0; i < contact.point_count; ++i) {
    const ContactPoint& point = contact.point[i];
    Position position = point.position;
    visit_position(out, position);
    out.real(point.separation);
    out.word(point.feature);
    out.word(point.child_a);
    out.word(point.child_b);
    out.scaled(point.normal_impulse);
  }
}

}  // namespace

/// Gives the body's definition, its mass, its inertia and whether it is awake.
DETENT_WEB(world_body) uint32_t world_body(const Session* session, uint32_t slot, uint32_t generation) {
  const BodyId id = taken_body(slot, generation);
  BodyDef def;
  Scaled mass = 0.0;
  Vec3<Scaled> inertia = {};
  bool awake = false;
  if (const Status status = get_body_def(session->world, id, def); status != Status::ok)
    return static_cast<uint32_t>(status);
  if (get_mass(session->world, id, mass) != Status::ok || get_inertia(session->world, id, inertia) != Status::ok ||
      is_awake(session->world, id, awake) != Status::ok)
    return static_cast<uint32_t>(Status::bad_id);
  Giver out;
  visit(out, def);
  out.scaled(mass);
  visit_scaleds(out, inertia);
  out.flag(awake);
  return 0;
}

DETENT_WEB(world_info) void world_info(const Session* session) {
  WorldInfo info = get_info(session->world);
  Giver out;
  visit(out, info.capacity);
  out.count64(info.tick);
  out.word(info.bodies);
  out.word(info.contacts);
  out.word(info.joints);
  out.word(info.sensed);
  out.word(info.slots_retired);
}
DETENT_WEB(world_settings) void world_settings(const Session* session) {
  WorldDef def = get_settings(session->world);
  Giver out;
  visit(out, def);
}
DETENT_WEB(world_report) void world_report(const Session* session) {
  Giver out;
  give(out, session->report);
}

/// Gives the joint's definition and its force and torque.
DETENT_WEB(world_joint) uint32_t world_joint(const Session* session, uint32_t slot, uint32_t generation) {
  const JointId id = {slot, generation};
  JointDef def;
  JointReaction reaction;
  if (const Status status = get_joint(session->world, id, def); status != Status::ok)
    return static_cast<uint32_t>(status);
  if (const Status status = get_joint_reaction(session->world, id, reaction); status != Status::ok)
    return static_cast<uint32_t>(status);
  Giver out;
  visit(out, def);
  visit_scaleds(out, reaction.force);
  visit_scaleds(out, reaction.torque);
  return 0;
}
/// Gives the ids of all joints. Returns their number.
DETENT_WEB(world_joints) uint32_t world_joints(const Session* session) {
  Giver out;
  uint32_t count = 0;
  for (JointId id = next_joint(session->world, {}); id.slot != 0; id = next_joint(session->world, id), ++count)
    visit(out, id);
  return count;
}
/// Takes a point (3 doubles), a rotation (4 doubles) and a JointDef. Gives the definition with its anchors and frames
/// set.
DETENT_WEB(world_place_joint) uint32_t world_place_joint(const Session* session, uint32_t count) {
  Taker in(count);
  Position point = {};
  Quat frame = {};
  JointDef def;
  visit_position(in, point);
  visit(in, frame);
  visit(in, def);
  if (in.status != Status::ok) return static_cast<uint32_t>(in.status);
  const Status status = place_joint(session->world, point, frame, def);
  Giver out;
  if (status == Status::ok) visit(out, def);
  return static_cast<uint32_t>(status);
}

/// Gives all contacts, or those of one body (slot 0: all). Returns their number.
DETENT_WEB(world_contacts) uint32_t world_contacts(const Session* session, uint32_t slot, uint32_t generation) {
  const World& world = session->world;
  const BodyId id = taken_body(slot, generation);
  const auto next = [&](uint32_t index) { return slot == 0 ? index : next_contact(world, id, index); };
  Giver out;
  uint32_t count = 0;
  for (uint32_t i = next(0); i < get_info(world).contacts; i = next(i + 1)) {
    Contact contact;
    if (get_contact(world, i, contact) != Status::ok) continue;
    give(out, contact);
    ++count;
  }
  return count;
}

/// Gives the number of bodies within a sensor, then their ids.
DETENT_WEB(world_sensed) uint32_t world_sensed(const Session* session, uint32_t slot, uint32_t generation) {
  const BodyId sensor = taken_body(slot, generation);
  uint32_t count = 0;
  if (const Status status = get_sensed(session->world, sensor, nullptr, 0, count); status != Status::ok)
    return static_cast<uint32_t>(status);
  BodyId* bodies = static_cast<BodyId*>(calloc(count + 1, sizeof(BodyId)));
  if (bodies == nullptr) return static_cast<uint32_t>(Status::buffer_too_small);
  const Status status = get_sensed(session->world, sensor, bodies, count, count);
  Giver out;
  out.word(count);
  for (uint32_t i = 0; i < count; ++i) visit(out, bodies[i]);
  free(bodies);
  return static_cast<uint32_t>(status);
}

/// Gives the events of the last step: for each kind the number of events, then the events.
DETENT_WEB(world_events) void world_events(const Session* session) {
  const WorldHooks& hooks = session->world.hooks;
  const EventReport& counts = session->report.events;
  Giver out;
  const auto pair = [&out](uint32_t type, BodyId a, BodyId b) {
    out.word(type);
    visit(out, a);
    visit(out, b);
  };
  out.word(counts.contact);
  for (uint32_t i = 0; i < counts.contact; ++i) {
    ContactEvent event = hooks.contact_events.data[i];
    pair(static_cast<uint32_t>(event.type), event.a, event.b);
    visit_units(out, event.normal);
    visit_position(out, event.point);
    out.real(event.approach_speed);
  }
  out.word(counts.joint);
  for (uint32_t i = 0; i < counts.joint; ++i) {
    JointEvent event = hooks.joint_events.data[i];
    visit(out, event.joint);
    visit(out, event.a);
    visit(out, event.b);
    out.word(event.user_data);
    visit_scaleds(out, event.reaction.force);
    visit_scaleds(out, event.reaction.torque);
  }
  out.word(counts.sensor);
  for (uint32_t i = 0; i < counts.sensor; ++i) {
    const SensorEvent& event = hooks.sensor_events.data[i];
    pair(static_cast<uint32_t>(event.type), event.sensor, event.body);
  }
  out.word(counts.body);
  for (uint32_t i = 0; i < counts.body; ++i) {
    BodyEvent event = hooks.body_events.data[i];
    out.choice(event.type);
    visit(out, event.body);
  }
  out.word(counts.capacity);
  for (uint32_t i = 0; i < counts.capacity; ++i) {
    const CapacityEvent& event = hooks.capacity_events.data[i];
    pair(static_cast<uint32_t>(event.type), event.a, event.b);
  }
}

}  // namespace detent_web
