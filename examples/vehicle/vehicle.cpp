#include <detent/numbers.h>
#include <inttypes.h>
#include <stdio.h>

#include "examples/joint_error.h"

using namespace detent;

namespace {

constexpr uint32_t k_bumps = 18, k_wheels = 4, k_ticks = 900, k_turn_ticks = 90;
constexpr Real k_half_track = Real(0.75), k_half_base = Real(1.3);  // m
constexpr Quat k_upright = {Unit(0.0), Unit(0.0), Unit(0.0), Unit(1.0)};
constexpr Quat k_across = {Unit(0.70710678118), Unit(0.0), Unit(0.0), Unit(0.70710678118)};  ///< y to z
/// The frame of a wheel's joint: x, the suspension, points up; z, the axle, lies across.
constexpr Quat k_suspension = {Unit(0.0), Unit(0.0), Unit(0.70710678118), Unit(0.70710678118)};
constexpr Real k_wheel_speed = Real(-24.0);                                ///< rad/s: 30 km/h along x
constexpr Real k_steering_max = Real(0.12), k_steering_step = Real(0.01);  ///< rad; rad a tick

/// Bodies and joints are made in this order: front left, front right, rear left, rear right.
struct Vehicle {
  BodyId chassis, wheel[k_wheels];
  JointId joint[k_wheels];
  JointDef straight[k_wheels];  ///< the joints when the wheels steer straight ahead
};

Status make_road(World& world) {
  BodyId id;
  BodyDef def;
  def.type = BodyType::fixed;
  def.shape = half_space();
  Status status = create_body(world, def, id);
  def.shape = capsule(Real(0.15), Real(15.0));  // a bump of 5 cm across the road
  def.rotation = k_across;
  def.position = {10.0, -0.1, 0.0};
  for (uint32_t i = 0; i < k_bumps && status == Status::ok; ++i) {
    status = create_body(world, def, id);
    def.position.x += Coord(5.0);
  }
  return status;
}

Status make_vehicle(World& world, Vehicle& vehicle) {
  BodyDef chassis;
  chassis.shape = box({Real(1.8), Real(0.3), Real(0.6)});
  chassis.mass = Scaled(1000.0);
  chassis.position = {0.0, 0.75, 0.0};
  Status status = create_body(world, chassis, vehicle.chassis);
  const Pose ground = {{0.0, 0.35, 0.0}, k_upright};
  for (uint32_t i = 0; i < k_wheels && status == Status::ok; ++i) {
    BodyDef wheel;
    wheel.shape = rounded(cylinder(Real(0.3), Real(0.05)), Real(0.05));
    wheel.mass = Scaled(20.0);
    wheel.material.friction = Real(1.0);
    const bool front = i < 2, left = i % 2 == 0;
    wheel.position =
        to_world(ground, {front ? k_half_base : -k_half_base, Real(0.0), left ? -k_half_track : k_half_track});
    wheel.rotation = k_across;
    status = create_body(world, wheel, vehicle.wheel[i]);
    if (status != Status::ok) break;

    JointDef& joint = vehicle.straight[i];
    joint.type = JointType::wheel;
    joint.a = vehicle.chassis;
    joint.b = vehicle.wheel[i];
    joint.axis.limited = true;  // 15 cm of travel in each direction
    joint.axis.lower = Real(-0.15);
    joint.axis.upper = Real(0.15);
    // Hz, for the effective mass of wheel and chassis, which is about the wheel's. The chassis itself oscillates at 1.7
    // Hz.
    joint.axis.frequency = Real(6.0);
    joint.axis.damping_ratio = Real(1.5);
    joint.axis.target = Real(-0.09);  // m; the chassis' weight compresses the spring again by as much
    joint.second.speed = k_wheel_speed;
    joint.second.force_max = Scaled(150.0);
    status = place_joint(world, wheel.position, k_suspension, joint);
    if (status == Status::ok) status = create_joint(world, joint, vehicle.joint[i]);
  }
  return status;
}

/// Rotates the front wheels' axles by an angle about the chassis' y.
Status steer(World& world, const Vehicle& vehicle, Real angle) {
  Status status = Status::ok;
  for (uint32_t i = 0; i < 2 && status == Status::ok; ++i) {
    JointDef turned = vehicle.straight[i];
    turned.frame_a = rotated_by(turned.frame_a, {Real(0.0), angle, Real(0.0)});
    status = set_joint(world, vehicle.joint[i], turned);
  }
  return status;
}

}  // namespace

int main() {
  static WorldStorage<Capacity{.bodies = 2 + k_bumps + k_wheels, .contacts = 64, .joints = k_wheels}> storage;
  World world;
  Vehicle vehicle;
  if (storage.create({}, world) != Status::ok || make_road(world) != Status::ok ||
      make_vehicle(world, vehicle) != Status::ok)
    return 1;

  Real steering = Real(0.0);
  double worst = 0, left = 0, right = 0;
  for (uint32_t tick = 1; tick <= k_ticks; ++tick) {
    // Steers from the middle to one side, then from side to side.
    const bool to_left = (tick + k_turn_ticks / 2) / k_turn_ticks % 2 == 0;
    if (tick > 60 && (to_left ? steering < k_steering_max : -k_steering_max < steering)) {
      steering += to_left ? k_steering_step : -k_steering_step;
      if (steer(world, vehicle, steering) != Status::ok) return 1;
    }
    if (!step(world).complete()) printf("tick %" PRIu32 ": something was lost\n", tick);
    for (const JointId joint : vehicle.joint) worst = fmax(worst, joint_error(world, joint));
    Pose pose;
    if (get_pose(world, vehicle.chassis, pose) != Status::ok) return 1;
    const double aside = coord_to_host(pose.position.z);
    left = fmin(left, aside);
    right = fmax(right, aside);
    if (tick % 60 == 0) {
      printf("%2" PRIu32 " s: x %5.1f m, y %.2f m, z %5.2f m\n", tick / 60, coord_to_host(pose.position.x),
             coord_to_host(pose.position.y), aside);
    }
  }
  printf("it swerved by %.1f m, no wheel was off by more than %.1f mm; digest %016" PRIx64 "\n", right - left,
         ceil(1e4 * worst) / 10, digest(world));
}
