#pragma once
#include <detent/query.h>
#include <detent/rollback.h>
#include <detent/world.h>

#include "desk.h"

/// The fields of each definition, in the order in which they lie on the desk. `F` is Taker or Giver. src/fields.ts has
/// the same lists; tests/web/fields_test.mjs passes every field through the lists here and there.
namespace detent_web {

template <class F>
void visit_reals(F& f, Vec3<Real>& v) {
  f.real(v.x);
  f.real(v.y);
  f.real(v.z);
}
template <class F>
void visit_units(F& f, Vec3<Unit>& v) {
  f.unit(v.x);
  f.unit(v.y);
  f.unit(v.z);
}
template <class F>
void visit_scaleds(F& f, Vec3<Scaled>& v) {
  f.scaled(v.x);
  f.scaled(v.y);
  f.scaled(v.z);
}
template <class F>
void visit_position(F& f, Position& v) {
  f.coord(v.x);
  f.coord(v.y);
  f.coord(v.z);
}
template <class F>
void visit(F& f, Quat& q) {
  f.unit(q.x);
  f.unit(q.y);
  f.unit(q.z);
  f.unit(q.w);
}
template <class F>
void visit(F& f, BodyId& id) {
  f.word(id.slot);
  f.word(id.generation);
}
template <class F>
void visit(F& f, JointId& id) {
  f.word(id.slot);
  f.word(id.generation);
}
template <class F>
void visit(F& f, Shape& shape) {
  f.choice(shape.type);
  f.real(shape.radius);
  f.real(shape.half_length);
  visit_reals(f, shape.half_extents);
  f.real(shape.rounding);
  f.word(shape.asset);
}
template <class F>
void visit(F& f, Material& material) {
  f.real(material.friction);
  f.real(material.restitution);
  f.real(material.rolling_resistance);
  f.choice(material.restitution_rule);
}
template <class F>
void visit(F& f, Filter& filter) {
  f.word(filter.category);
  f.word(filter.mask);
  f.integer(filter.group);
}
template <class F>
void visit(F& f, BodyDef& def) {
  f.choice(def.type);
  visit_position(f, def.position);
  visit(f, def.rotation);
  visit_reals(f, def.linear_velocity);
  visit_reals(f, def.angular_velocity);
  visit(f, def.shape);
  visit(f, def.material);
  f.scaled(def.density);
  f.scaled(def.mass);
  f.real(def.linear_damping);
  f.real(def.angular_damping);
  f.real(def.gravity_scale);
  f.word(def.user_data);
  f.word(def.rotation_locks);
  visit(f, def.filter);
  f.flag(def.sensor);
}
template <class F>
void visit(F& f, Capacity& capacity) {
  f.word(capacity.bodies);
  f.word(capacity.contacts);
  f.word(capacity.assets);
  f.flag(capacity.manifolds);
  f.word(capacity.joints);
  f.word(capacity.sensed);
}
template <class F>
void visit(F& f, WorldDef& def) {
  visit(f, def.capacity);
  visit_reals(f, def.gravity);
  f.real(def.tick);
  f.word(def.substeps);
  f.word(def.substeps_max);
  f.real(def.resting_penetration);
  f.word(def.iterations);
  f.word(def.convergence);
  f.choice(def.stabilisation);
  f.real(def.relaxation);
  f.real(def.contact_frequency);
  f.real(def.damping_ratio);
  f.real(def.restitution_threshold);
  f.flag(def.continuous);
  f.flag(def.sleeping);
  f.real(def.contact_margin);
  f.real(def.contact_recycle_distance);
  f.choice(def.reduction);
}
template <class F>
void visit(F& f, JointAxis& axis) {
  f.flag(axis.limited);
  f.real(axis.lower);
  f.real(axis.upper);
  f.real(axis.frequency);
  f.real(axis.damping_ratio);
  f.real(axis.target);
  f.real(axis.speed);
  f.scaled(axis.force_max);
}
template <class F>
void visit(F& f, JointDef& def) {
  f.choice(def.type);
  visit(f, def.a);
  visit(f, def.b);
  visit_reals(f, def.anchor_a);
  visit_reals(f, def.anchor_b);
  visit(f, def.frame_a);
  visit(f, def.frame_b);
  visit(f, def.axis);
  visit(f, def.second);
  f.scaled(def.friction_force);
  f.scaled(def.friction_torque);
  f.flag(def.collide);
  f.scaled(def.break_force);
  f.scaled(def.break_torque);
  f.word(def.user_data);
}
template <class F>
void visit(F& f, Explosion& explosion) {
  visit_position(f, explosion.centre);
  f.real(explosion.radius);
  f.scaled(explosion.impulse);
}
template <class F>
void visit(F& f, QueryFilter& filter) {
  f.word(filter.category);
  f.word(filter.mask);
  visit(f, filter.ignore);
}
template <class F>
void visit(F& f, RollbackDef& def) {
  f.word(def.players);
  f.word(def.local);
  f.word(def.input_bytes);
  f.word(def.delay);
  f.word(def.window);
  f.word(def.checksum_interval);
  f.word(def.game_bytes);
}

/// Gives the counts of the report, group by group.
inline void give(Giver& out, const StepReport& report) {
  out.count64(report.tick);
  out.words(report.bodies, report.awake, report.islands, report.substeps_max, report.woke, report.fell_asleep,
            report.saturations);
  const ContactReport& contacts = report.contacts;
  out.words(contacts.pairs, contacts.count, contacts.points, contacts.recycled, contacts.capped, contacts.sweeps_saved,
            contacts.colour_overflows);
  out.count64(contacts.substeps);
  out.words(report.joints.count, report.joints.broken, report.joints.undecided);
  const CcdReport& ccd = report.ccd;
  out.words(ccd.impacts, ccd.undecided, ccd.overlaps_left, ccd.bodies_stopped, ccd.tests, ccd.skipped, ccd.kept_apart);
  out.real(ccd.lost_time);
  const LossReport& lost = report.lost;
  out.words(lost.pairs, lost.contacts, lost.contact_parts, lost.joint_couplings, lost.impacts, lost.sensed,
            lost.sensed_undecided);
  const EventReport& events = report.events;
  out.words(events.contact, events.joint, events.sensor, events.body, events.capacity, events.contact_dropped,
            events.joint_dropped, events.sensor_dropped, events.body_dropped);
}

}  // namespace detent_web
