#include "tests/campaigns/zoo/opened_scene.h"

#include <detent/body.h>
#include <detent/contact.h>
#include <detent/world.h>

#include <algorithm>
#include <map>

#include "file.h"
#include "scene_repeat.h"
#include "tests/campaigns/zoo/scene_ground.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

namespace {

using detent_zoo::AxisFrame;
using detent_zoo::BodyFrame;
using detent_zoo::ContactFrame;
using detent_zoo::Frame;
using detent_zoo::JointFrame;
using detent_zoo::Rotation;
using detent_zoo::Vector;

Vector vector_of(const Vec3<Real>& v) { return {real_to_host(v.x), real_to_host(v.y), real_to_host(v.z)}; }
Vector scaled_vector_of(const Vec3<Scaled>& v) {
  return {scaled_to_host(v.x), scaled_to_host(v.y), scaled_to_host(v.z)};
}
Vector place_of(const Position& p) { return {coord_to_host(p.x), coord_to_host(p.y), coord_to_host(p.z)}; }
Rotation rotation_of(const Quat& q) {
  return {unit_to_host(q.x), unit_to_host(q.y), unit_to_host(q.z), unit_to_host(q.w)};
}
AxisFrame axis_of(const JointAxis& axis) {
  return {axis.limited,
          real_to_host(axis.lower),
          real_to_host(axis.upper),
          real_to_host(axis.frequency),
          real_to_host(axis.damping_ratio),
          real_to_host(axis.target),
          real_to_host(axis.speed),
          scaled_to_host(axis.force_max)};
}

}  // namespace

std::unique_ptr<OpenedScene> OpenedScene::open(const std::string& path, detent_test::Ground ground,
                                               std::string& problem) {
  std::unique_ptr<OpenedScene> scene(new OpenedScene);
  if (!scene->read(path, ground, problem)) return nullptr;
  return scene;
}

bool OpenedScene::read(const std::string& path, detent_test::Ground ground, std::string& problem) {
  std::vector<uint8_t> bytes;
  problem = read_file(path, bytes, k_json_bytes_max);
  if (!problem.empty()) return false;
  Problem first;
  if (!parse_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, root_, first)) {
    problem = problem_text(path, first);
    return false;
  }
  path_ = path;
  write_out_repeats(root_, reading_.problems);
  read_scene(root_, reading_);
  if (SceneBody* const body = ground_of(reading_.scene); body != nullptr) {
    has_ground_ = true;
    replace_ground(*body, ground);
  }
  RunRequest request;
  request.path = path;
  if (reading_.problems.empty() && assets_.read(reading_, request) &&
      make_world(reading_, assets_, request.world_bytes_max, owned_)) {
    recorder_ = std::make_unique<Recorder>(owned_.world, Sink{}, nullptr, 0);
    player_ = std::make_unique<ScenePlayer>(reading_, *recorder_, prints_, print_);
    player_->build();
  }
  return take_problem(problem);
}

bool OpenedScene::call(uint32_t tick, std::string& problem) {
  const uint64_t before = player_->calls();
  player_->before_tick(tick);
  return take_problem(problem) && player_->calls() != before;
}

std::vector<BodyId> OpenedScene::bodies() const {
  std::vector<BodyId> ids;
  for (BodyId id = next_body(owned_.world, {}); id.slot != 0; id = next_body(owned_.world, id)) ids.push_back(id);
  return ids;
}

std::vector<JointId> OpenedScene::joints() const {
  std::vector<JointId> ids;
  for (JointId id = next_joint(owned_.world, {}); id.slot != 0; id = next_joint(owned_.world, id)) ids.push_back(id);
  return ids;
}

Frame OpenedScene::frame() const {
  const World& world = owned_.world;
  Frame frame;
  const WorldDef settings = get_settings(world);
  frame.tick_time = real_to_host(settings.tick);
  frame.gravity = vector_of(settings.gravity);
  std::map<uint32_t, uint32_t> places;
  for (const BodyId id : bodies()) {
    places[id.slot] = static_cast<uint32_t>(frame.bodies.size());
    frame.bodies.push_back(body_of(id));
  }
  for (const JointId id : joints()) {
    JointDef def;
    if (get_joint(world, id, def) != Status::ok) continue;
    JointFrame joint;
    joint.type = static_cast<detent_zoo::Held>(def.type);
    joint.a = places[def.a.slot];
    joint.b = places[def.b.slot];
    joint.anchor_a = vector_of(def.anchor_a);
    joint.anchor_b = vector_of(def.anchor_b);
    joint.frame_a = rotation_of(def.frame_a);
    joint.frame_b = rotation_of(def.frame_b);
    joint.axes[0] = axis_of(def.axis);
    joint.axes[1] = axis_of(def.second);
    frame.joints.push_back(joint);
  }
  const uint32_t contacts = get_info(world).contacts;
  for (uint32_t i = 0; i < contacts; ++i) {
    Contact contact;
    if (get_contact(world, i, contact) != Status::ok || contact.point_count == 0) continue;
    ContactFrame deepest = {places[contact.a.slot], places[contact.b.slot], -real_to_host(contact.point[0].separation)};
    for (uint32_t j = 1; j < contact.point_count; ++j)
      deepest.depth = std::max(deepest.depth, -real_to_host(contact.point[j].separation));
    frame.contacts.push_back(deepest);
  }
  return frame;
}

BodyFrame OpenedScene::body_of(BodyId id) const {
  const World& world = owned_.world;
  BodyFrame body;
  BodyDef def;
  Vec3<Scaled> inertia;
  if (get_body_def(world, id, def) != Status::ok || get_inertia(world, id, inertia) != Status::ok) return body;
  body.kind = def.type == BodyType::dynamic     ? detent_zoo::Kind::dynamic
              : def.type == BodyType::kinematic ? detent_zoo::Kind::kinematic
                                                : detent_zoo::Kind::fixed;
  body.mass = scaled_to_host(def.mass);
  body.inertia = scaled_vector_of(inertia);
  body.gravity_scale = real_to_host(def.gravity_scale);
  body.position = place_of(def.position);
  body.rotation = rotation_of(def.rotation);
  body.linear_velocity = vector_of(def.linear_velocity);
  body.angular_velocity = vector_of(def.angular_velocity);
  return body;
}

/// Returns false and sets `problem` to the first problem, if there is one.
bool OpenedScene::take_problem(std::string& problem) const {
  if (reading_.problems.empty()) return true;
  problem = problem_text(path_, reading_.problems.front());
  return false;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
