#pragma once
#include "scene_fields.h"

/// The keys of an action: the keys that all actions have, and the keys of each kind of call.
namespace detent {
inline namespace DETENT_NAMESPACE {

template <class F>
void visit_query(F& fields, SceneAction& action) {
  fields.text({"name", "for the output"}, action.name);
  fields.object({"filter", "which bodies it tests"}, action.asked);
  fields.flag({"all", "all hits, not only the first"}, action.flag);
}

/// A query's shape and its pose in the world.
template <class F>
void visit_asking_shape(F& fields, SceneAction& action) {
  fields.named(required({"shape", "convex"}), action.shape);
  fields.position(required({"position", "m, world"}), action.position);
  fields.rotation({"rotation", "local to world"}, action.rotation);
}

template <class F>
void visit_push(F& fields, SceneAction& action, const char* key, const char* doc) {
  fields.scaleds(required({key, doc}), action.push);
}

/// The point where a force or impulse acts.
template <class F>
void visit_place_of_push(F& fields, SceneAction& action) {
  action.at_arm =
      fields.vector(optional({"arm", "where it acts, from the centre of mass, m, world axes"}), action.displacement);
  action.at_point = fields.position(optional({"point", "where it acts, m, world"}), action.position);
  if (action.at_arm && action.at_point) fields.problem("point", "does not go with `arm`");
}

template <class F>
void visit_one_body(F& fields, SceneAction& action) {
  switch (action.call) {
    case Call::set_pose:
    case Call::move_kinematic:
      fields.position(required({"position", "m, world"}), action.position);
      fields.rotation(required({"rotation", "local to world"}), action.rotation);
      break;
    case Call::set_velocity:
      fields.vector(required({"linear_velocity", "m/s, world", within(16384)}), action.displacement);
      fields.vector(required({"angular_velocity", "rad/s, world"}), action.rotation_vector);
      break;
    case Call::apply_force:
      visit_push(fields, action, "force", "N, world, during the tick");
      visit_place_of_push(fields, action);
      break;
    case Call::apply_torque:
      visit_push(fields, action, "torque", "N m, world, during the tick");
      break;
    case Call::apply_impulse:
      visit_push(fields, action, "impulse", "N s, world");
      visit_place_of_push(fields, action);
      break;
    case Call::apply_angular_impulse:
      visit_push(fields, action, "impulse", "N m s, world");
      break;
    case Call::set_user_data:
      fields.integer(required({"user_data", "kept and recorded", k_word}), action.number);
      break;
    case Call::set_filter:
      fields.named(required({"filter", "what it collides with"}), action.filter);
      break;
    case Call::set_type:
      type_of_body(fields, action.type, true);
      break;
    case Call::set_shape:
      fields.named(required({"shape", "in its frame"}), action.shape);
      break;
    case Call::set_mass:
      fields.scaled(required({"mass", "kg", above(0)}), action.mass);
      break;
    case Call::set_inertia:
      fields.scaleds(required({"inertia", "about the body's axes, kg m^2"}), action.push);
      break;
    case Call::set_density:
      fields.scaled(required({"density", "kg/m^3", above(0)}), action.mass);
      break;
    case Call::set_material:
      fields.named(required({"material", "of the whole surface"}), action.material);
      break;
    case Call::set_damping:
      fields.real(required({"linear", "1/s", between(0, 1024)}), action.first);
      fields.real(required({"angular", "1/s", between(0, 1024)}), action.second);
      break;
    case Call::set_gravity_scale:
      fields.real(required({"scale", "times the world's gravity", within(1024)}), action.first);
      break;
    case Call::set_rotation_locks:
      rotation_locks_of_body(fields, action.number, true);
      break;
    case Call::set_sensor:
      fields.flag(required({"sensor", "it applies no forces, and reports the bodies inside it"}), action.flag);
      break;
    default:  // destroy_body, wake_body, sleep_body: no key but the body
      break;
  }
}

template <class F>
void visit(F& fields, SceneAction& action) {
  fields.origin(action.origin);
  fields.repeated();
  fields.integer(required({"tick", "completed ticks before it", between(0, 1e9)}), action.tick);
  action.until = action.tick;
  if (fields.integer(optional({"until", "it is repeated before each tick up to this one", between(0, 1e9)}),
                     action.until) &&
      action.until < action.tick) {
    fields.problem("until", "is below `tick`");
  }
  if (!fields.tag({"call", "the function"}, action.call, k_calls)) return;
  switch (action.call) {
    case Call::create_body:
      fields.object(required({"body", "the definition"}), action.new_body);
      break;
    case Call::create_joint:
      fields.object(required({"joint", "the definition"}), action.new_joint);
      break;
    case Call::destroy_joint:
      fields.joint(required({"joint", "which"}), action.joint);
      break;
    case Call::set_joint:
      fields.joint(required({"joint", "which"}), action.joint);
      fields.template changes<JointDef>(required({"changes", "other values stay"}), action.changes);
      break;
    case Call::set_settings:
      fields.template changes<WorldDef>(required({"changes", "other values stay"}), action.changes);
      break;
    case Call::set_gravity:
      fields.vector(required({"gravity", "m/s^2", within(1024)}), action.displacement);
      break;
    case Call::explode:
      fields.position(required({"centre", "m, world"}), action.position);
      fields.real(required({"radius", "m; bodies farther away are not pushed", k_size}), action.first);
      fields.scaled(required({"impulse", "N s/m^2 at the centre; negative: it pulls"}), action.mass);
      break;
    case Call::query_ray:
      fields.position(required({"origin", "m, world"}), action.position);
      fields.vector(required({"displacement", "m, world", within(0x1p14)}), action.displacement);
      visit_query(fields, action);
      break;
    case Call::query_cast:
      visit_asking_shape(fields, action);
      fields.vector(required({"displacement", "m, world", within(0x1p14)}), action.displacement);
      fields.vector({"rotation_vector", "rotation vector, world, rad", within(0x1p16)}, action.rotation_vector);
      visit_query(fields, action);
      break;
    case Call::query_overlap:
      visit_asking_shape(fields, action);
      visit_query(fields, action);
      break;
    case Call::query_bounds:
      fields.position(required({"lower", "m, world"}), action.position);
      fields.position(required({"upper", "m, world; not below lower"}), action.upper);
      visit_query(fields, action);
      break;
    case Call::query_closest:
      visit_asking_shape(fields, action);
      fields.real(required({"distance_max", "between the surfaces, m", between(0, 0x1p14)}), action.first);
      visit_query(fields, action);
      break;
    default:
      fields.body(required({"body", "which"}), action.body);
      visit_one_body(fields, action);
      break;
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
