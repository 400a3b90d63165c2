#include "scene_player.h"

#include <algorithm>

namespace detent {
inline namespace DETENT_NAMESPACE {

bool ScenePlayer::fail(const SceneOrigin& origin, const std::string& text) {
  reading_.problem(origin, text);
  return false;
}

bool ScenePlayer::build() {
  for (uint32_t i = 0; i < reading_.assets.size(); ++i) {
    const SceneAsset& asset = reading_.assets[i];
    const Status status = recorder_.bind_asset(i);
    if (status != Status::ok) return fail(asset.file_origin, asset.file + ": " + status_text(status));
  }
  for (const SceneBody& body : reading_.scene.bodies) {
    if (!make(body)) return false;
  }
  for (const SceneJoint& joint : reading_.scene.joints) {
    if (!make(joint)) return false;
  }
  const std::vector<SceneAction>& actions = reading_.scene.actions;
  for (uint32_t i = 0; i < actions.size(); ++i) order_.push_back(i);
  std::stable_sort(order_.begin(), order_.end(),
                   [&actions](uint32_t a, uint32_t b) { return actions[a].tick < actions[b].tick; });
  return true;
}

bool ScenePlayer::make(const SceneBody& body) {
  if (!body.name.empty() && is_valid(recorder_.world(), bodies_.find(body.name))) {
    return fail(body.origin, "a body of the name \"" + body.name + "\" is there");
  }
  BodyId id;
  const Status status = recorder_.create_body(body.def, id);
  if (status != Status::ok) return fail(body.origin, std::string("cannot be made: ") + status_text(status));
  bodies_.add(body.name, id);
  return true;
}

bool ScenePlayer::make(const SceneJoint& joint) {
  if (!joint.name.empty() && is_valid(recorder_.world(), joints_.find(joint.name))) {
    return fail(joint.origin, "a joint of the name \"" + joint.name + "\" is there");
  }
  JointDef def = joint.def;
  def.a = bodies_.find(joint.a);
  def.b = bodies_.find(joint.b);
  JointId id;
  Status status = Status::ok;
  if (joint.placed) status = place_joint(recorder_.world(), joint.point, joint.frame, def);
  if (status == Status::ok) status = recorder_.create_joint(def, id);
  const char* const what = status == Status::bad_argument ? "neither body is dynamic" : status_text(status);
  if (status != Status::ok) return fail(joint.origin, std::string("cannot be made: ") + what);
  joints_.add(joint.name, id);
  return true;
}

bool ScenePlayer::before_tick(uint32_t tick) {
  const std::vector<SceneAction>& actions = reading_.scene.actions;
  for (; next_ < order_.size() && actions[order_[next_]].tick == tick; ++next_) running_.push_back(order_[next_]);
  std::sort(running_.begin(), running_.end());  // actions of one tick are made in the file's order
  for (const uint32_t index : running_) {
    if (!play(actions[index], tick)) return false;
  }
  running_.erase(std::remove_if(running_.begin(), running_.end(),
                                [&actions, tick](uint32_t index) { return actions[index].until <= tick; }),
                 running_.end());
  return true;
}

bool ScenePlayer::play(const SceneAction& action, uint32_t tick) {
  ++calls_;
  if (action.call == Call::create_body) return make(action.new_body);
  if (action.call == Call::create_joint) return make(action.new_joint);
  const Status status = call(action);
  if (status == Status::ok) return true;
  const char* const what = status == Status::bad_id ? "what it names is not there" : status_text(status);
  return fail(action.origin,
              std::string(call_name(action.call)) + " before tick " + std::to_string(tick) + ": " + what);
}

Status ScenePlayer::call(const SceneAction& action) {
  const JointId joint = joints_.find(action.joint);
  switch (action.call) {
    case Call::destroy_joint:
      return recorder_.destroy_joint(joint);
    case Call::set_joint: {
      JointDef def;
      if (const Status status = get_joint(recorder_.world(), joint, def); status != Status::ok) return status;
      ObjectReader::read(reading_, *action.changes, action.origin.path + ".changes", def);
      return recorder_.set_joint(joint, def);
    }
    case Call::set_settings: {
      WorldDef def = get_settings(recorder_.world());
      ObjectReader::read(reading_, *action.changes, action.origin.path + ".changes", def);
      return recorder_.set_settings(def);
    }
    case Call::set_gravity:
      return recorder_.set_gravity(action.displacement);
    case Call::explode:
      return recorder_.explode({action.position, action.first, action.mass});
    case Call::query_ray:
    case Call::query_cast:
    case Call::query_overlap:
    case Call::query_bounds:
    case Call::query_closest:
      return ask(action);
    default:
      return call_of_body(action, bodies_.find(action.body));
  }
}

Status ScenePlayer::call_of_body(const SceneAction& action, BodyId id) {
  switch (action.call) {
    case Call::destroy_body:
      return recorder_.destroy_body(id);
    case Call::set_pose:
      return recorder_.set_pose(id, action.position, action.rotation);
    case Call::move_kinematic:
      return recorder_.move_kinematic(id, action.position, action.rotation);
    case Call::set_velocity:
      return recorder_.set_velocity(id, action.displacement, action.rotation_vector);
    case Call::apply_torque:
      return recorder_.apply_torque(id, action.push);
    case Call::apply_angular_impulse:
      return recorder_.apply_angular_impulse(id, action.push);
    case Call::wake_body:
      return recorder_.wake_body(id);
    case Call::sleep_body:
      return recorder_.sleep_body(id);
    case Call::set_user_data:
      return recorder_.set_user_data(id, action.number);
    case Call::set_filter:
      return recorder_.set_filter(id, action.filter);
    case Call::set_type:
      return recorder_.set_type(id, action.type);
    case Call::set_shape:
      return recorder_.set_shape(id, action.shape);
    case Call::set_mass:
      return recorder_.set_mass(id, action.mass);
    case Call::set_inertia:
      return recorder_.set_inertia(id, action.push);
    case Call::set_density:
      return recorder_.set_density(id, action.mass);
    case Call::set_material:
      return recorder_.set_material(id, action.material);
    case Call::set_damping:
      return recorder_.set_damping(id, action.first, action.second);
    case Call::set_gravity_scale:
      return recorder_.set_gravity_scale(id, action.first);
    case Call::set_rotation_locks:
      return recorder_.set_rotation_locks(id, action.number);
    case Call::set_sensor:
      return recorder_.set_sensor(id, action.flag);
    default:
      return push(action, id);
  }
}

Status ScenePlayer::push(const SceneAction& action, BodyId id) {
  const bool force = action.call == Call::apply_force;
  if (action.at_arm) {
    return force ? recorder_.apply_force_at(id, action.push, action.displacement)
                 : recorder_.apply_impulse_at(id, action.push, action.displacement);
  }
  if (action.at_point) {
    return force ? recorder_.apply_force_at_point(id, action.push, action.position)
                 : recorder_.apply_impulse_at_point(id, action.push, action.position);
  }
  return force ? recorder_.apply_force(id, action.push) : recorder_.apply_impulse(id, action.push);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
