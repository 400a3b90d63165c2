#include <detent/numbers.h>
#include <detent/world.h>
#include <math.h>

#include "examples/pages/check.h"

using namespace detent;

namespace {

constexpr Quat k_x_is_up = {Unit(0.5), Unit(0.5), Unit(0.5), Unit(0.5)};  // the frame's x to the world's y

double height_of(const World& world, BodyId id) {
  Pose pose;
  check(get_pose(world, id, pose));
  return coord_to_host(pose.position.y);
}

void run(World& world, int ticks) {
  for (int tick = 0; tick < ticks; ++tick) step(world);
}

}  // namespace

int main() {
  static WorldStorage<Capacity{.bodies = 8, .contacts = 8, .joints = 4}> storage;
  World world;
  static JointEvent broken[4];
  check(storage.create({}, {.joint_events = {broken, 4}}, world));

  BodyId post, door, ball, lift;
  check(create_body(world, {.type = BodyType::fixed, .shape = box({0.1, 1.0, 0.1})}, post));
  check(create_body(world, {.position = {0.6, 0.0, 0.0}, .shape = box({0.5, 1.0, 0.05})}, door));
  check(create_body(world, {.position = {0.0, -1.5, 3.0}, .shape = sphere(0.1), .mass = 10.0}, ball));
  check(create_body(world, {.position = {0.0, 0.0, 6.0}, .shape = box({0.2, 0.2, 0.2}), .mass = 10.0}, lift));

  // A hinge at the bodies' present poses, about the world's y. It opens by at most 1.5 rad.
  JointDef hinge = {.type = JointType::hinge, .a = post, .b = door};
  check(place_joint(world, {0.1, 0.0, 0.0}, k_x_is_up, hinge));
  hinge.axis.limited = true;
  hinge.axis.lower = Real(-0.1);
  hinge.axis.upper = Real(1.5);
  hinge.axis.frequency = Real(0.5);  // a spring closes it
  JointId id;
  check(create_joint(world, hinge, id));

  // A motor opens it.
  hinge.axis.speed = Real(2.0);
  hinge.axis.frequency = Real(0.0);
  hinge.axis.force_max = Scaled(5000.0);  // N m
  check(set_joint(world, id, hinge));
  run(world, 60);
  Pose pose;
  check(get_pose(world, door, pose));
  check(coord_to_host(pose.position.z) < -0.4);

  // A rope of 2 m, and then a rope that breaks.
  JointDef rope = {.type = JointType::distance, .a = post, .b = ball};
  rope.anchor_a = {0.0, 0.0, 3.0};
  rope.axis.limited = true;
  rope.axis.upper = Real(2.0);  // lower is 0
  JointId hung;
  check(create_joint(world, rope, hung));
  run(world, 240);
  check(fabs(height_of(world, ball) + 2.0) < 0.01);

  JointReaction reaction;
  check(get_joint_reaction(world, hung, reaction));
  check(fabs(scaled_to_host(reaction.force.y) - 98.1) < 1.0);  // the ball's weight

  rope.break_force = Scaled(50.0);
  check(set_joint(world, hung, rope));
  const StepReport report = step(world);
  for (uint32_t i = 0; i < report.events.joint; ++i) check(broken[i].joint == hung);
  check(report.joints.broken == 1 && !is_valid(world, hung));

  // A slider with a spring: the lift returns to its first position.
  JointDef rail = {.type = JointType::slider, .a = post, .b = lift};
  check(set_pose(world, lift, {0.0, 0.0, 6.0}, {0.0, 0.0, 0.0, 1.0}));
  check(set_velocity(world, lift, {}, {}));
  check(place_joint(world, {0.0, 0.0, 6.0}, k_x_is_up, rail));
  rail.axis.frequency = Real(2.0);
  rail.axis.damping_ratio = Real(0.7);
  check(create_joint(world, rail, id));
  run(world, 240);
  check(fabs(height_of(world, lift) + 9.81 / (12.566 * 12.566)) < 0.001);  // g over (2 pi f)^2
}
