#include "examples/scenes/jointed.h"

#include "examples/scenes/make.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace jointed {

namespace {

constexpr Quat k_straight = {0.0, 0.0, 0.0, 1.0};
constexpr Quat k_x_to_y = {0.5, 0.5, 0.5, 0.5};     ///< the frame's x along the world's y
constexpr Quat k_x_to_z = {-0.5, -0.5, -0.5, 0.5};  ///< along its z
constexpr uint32_t k_door = 0, k_lift = 1;          ///< joints, in slot order

BodyId make(Recorder& recorder, const Shape& shape, const Position& position, BodyType type = BodyType::dynamic) {
  BodyDef def;
  def.type = type;
  def.shape = shape;
  def.position = position;
  return make_body(recorder, def);
}

/// A joint at a point, as the bodies are now.
JointId join(Recorder& recorder, JointType type, BodyId a, BodyId b, const Position& point,
             const Quat& frame = k_straight, JointDef def = {}) {
  def.type = type;
  def.a = a;
  def.b = b;
  must(place_joint(recorder.world(), point, frame, def));
  JointId id;
  must(recorder.create_joint(def, id));
  return id;
}

JointId nth_joint(const World& world, uint32_t index) {
  JointId id = next_joint(world, {});
  while (index-- != 0 && !(id == JointId{})) id = next_joint(world, id);
  return id;
}

void make_door_and_lift(Recorder& recorder, BodyId wall) {
  const BodyId door = make(recorder, box({0.5, 0.75, 0.0625}), {0.75, 1.0, -3.0});
  JointDef swing;
  swing.axis.limited = true;
  swing.axis.lower = -1.25;
  swing.axis.upper = 1.25;
  swing.axis.speed = 1.5;
  swing.axis.force_max = 400.0;
  join(recorder, JointType::hinge, wall, door, {0.25, 1.0, -3.0}, k_x_to_y, swing);

  const BodyId lift = make(recorder, box({0.5, 0.125, 0.5}), {-1.5, 0.5, -3.0});
  JointDef rise;
  rise.axis.frequency = 2.0;
  rise.axis.damping_ratio = 0.75;
  rise.axis.target = 0.5;
  rise.axis.force_max = 4000.0;
  join(recorder, JointType::slider, wall, lift, {-1.5, 0.5, -3.0}, k_x_to_y, rise);
  make(recorder, box({0.25, 0.25, 0.25}), {-1.5, 0.875, -3.0});
}

void make_cart(Recorder& recorder) {
  const BodyId chassis = make(recorder, box({1.0, 0.25, 0.5}), {-4.0, 0.875, 2.0});
  JointDef wheel;
  wheel.axis.frequency = 3.0;
  wheel.axis.damping_ratio = 0.5;
  wheel.axis.limited = true;
  wheel.axis.lower = -0.25;
  wheel.axis.upper = 0.25;
  wheel.second.speed = -6.0;
  wheel.second.force_max = 300.0;
  const Coord ends[2] = {-4.75, -3.25};
  for (const Coord x : ends) {
    const BodyId round = make(recorder, sphere(0.375), {x, 0.375, 2.0});
    join(recorder, JointType::wheel, chassis, round, {x, 0.375, 2.0}, k_x_to_y, wheel);
  }
}

void make_figure(Recorder& recorder) {
  const BodyId trunk = make(recorder, box({0.25, 0.375, 0.125}), {3.0, 2.5, 2.0});
  JointDef shoulder;
  shoulder.second.limited = true;
  shoulder.second.upper = 1.0;
  shoulder.axis.limited = true;
  shoulder.axis.lower = -0.5;
  shoulder.axis.upper = 0.5;
  JointDef elbow;
  elbow.axis.limited = true;
  elbow.axis.lower = 0.0;
  elbow.axis.upper = 2.0;
  const Coord upper[2] = {2.5, 3.5}, lower[2] = {2.0, 4.0}, inner[2] = {2.75, 3.25}, outer[2] = {2.25, 3.75};
  for (int side = 0; side < 2; ++side) {
    const BodyId arm = make(recorder, box({0.25, 0.0625, 0.0625}), {upper[side], 2.75, 2.0});
    const BodyId hand = make(recorder, box({0.25, 0.0625, 0.0625}), {lower[side], 2.75, 2.0});
    join(recorder, JointType::cone_twist, trunk, arm, {inner[side], 2.75, 2.0}, k_straight, shoulder);
    join(recorder, JointType::hinge, arm, hand, {outer[side], 2.75, 2.0}, k_x_to_z, elbow);
  }
  const BodyId head = make(recorder, sphere(0.1875), {3.0, 3.125, 2.0});
  join(recorder, JointType::fixed, trunk, head, {3.0, 2.9375, 2.0});
}

void make_chain_and_ring(Recorder& recorder) {
  BodyDef turning;
  turning.type = BodyType::kinematic;
  turning.shape = box({0.75, 0.125, 0.125});
  turning.position = {0.0, 5.0, 0.0};
  turning.angular_velocity = {Real(0.0), Real(1.5), Real(0.0)};
  BodyId last = make_body(recorder, turning);
  Coord height = 5.0;
  for (uint32_t link = 0; link < 6; ++link) {
    const BodyId next = make(recorder, capsule(0.0625, 0.1875), {0.75, height - Coord(0.25), 0.0});
    join(recorder, JointType::ball, last, next, {0.75, height, 0.0});
    height = height - Coord(0.5);
    last = next;
  }
  const BodyId load = make(recorder, sphere(0.375), {0.75, height - Coord(0.5), 0.0});
  JointDef rope;
  rope.axis.limited = true;
  rope.axis.upper = 0.625;
  rope.break_force = 6500.0;
  rope.type = JointType::distance;
  rope.a = last;
  rope.b = load;
  rope.anchor_a = {Real(0.0), Real(-0.25), Real(0.0)};
  JointId id;
  must(recorder.create_joint(rope, id));

  BodyId ring[4];
  const Position corner[4] = {{-1.0, 3.0, 4.0}, {0.0, 3.0, 4.0}, {0.0, 4.0, 4.0}, {-1.0, 4.0, 4.0}};
  const Position middle[4] = {{-0.5, 3.0, 4.0}, {0.0, 3.5, 4.0}, {-0.5, 4.0, 4.0}, {-1.0, 3.5, 4.0}};
  for (int i = 0; i < 4; ++i) ring[i] = make(recorder, sphere(0.25), corner[i]);
  for (int i = 0; i < 4; ++i) join(recorder, JointType::ball, ring[i], ring[(i + 1) % 4], middle[i]);
}

}  // namespace

WorldDef world() {
  WorldDef def = world_of(36, 160);
  def.capacity.joints = 28;
  return def;
}

void build(Recorder& recorder) {
  make_ground(recorder);
  const BodyId wall = make(recorder, box({0.125, 1.5, 0.25}), {0.0, 1.5, -3.0}, BodyType::fixed);
  make_door_and_lift(recorder, wall);
  make_cart(recorder);
  make_figure(recorder);
  make_chain_and_ring(recorder);
}

void before_tick(Recorder& recorder, uint32_t tick) {
  const World& state = recorder.world();
  const auto change = [&](uint32_t index, auto&& how) {
    const JointId id = nth_joint(state, index);
    JointDef def;
    must(get_joint(state, id, def));
    how(def);
    must(recorder.set_joint(id, def));
  };
  if (tick % 60 == 30) change(k_door, [](JointDef& def) { def.axis.speed = Real(0.0) - def.axis.speed; });
  if (tick == 80) change(k_lift, [](JointDef& def) { def.axis.target = -0.25; });
  if (tick == 160) {
    must(recorder.destroy_joint(nth_joint(state, k_lift)));
    join(recorder, JointType::ball, nth_body(state, 0), nth_body(state, 4), {-1.5, 0.25, -3.0});
  }
}

}  // namespace jointed
}  // namespace DETENT_NAMESPACE
}  // namespace detent
