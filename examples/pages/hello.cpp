#include <detent/detent.h>
#include <math.h>

#include "examples/pages/check.h"

using namespace detent;

int main() {
  static WorldStorage<Capacity{.bodies = 2, .contacts = 4}> storage;
  World world;
  check(storage.create({}, world));

  BodyId ground, ball;
  check(create_body(world, {.type = BodyType::fixed, .shape = half_space()}, ground));
  check(create_body(world, {.position = {0.0, 5.0, 0.0}, .shape = sphere(0.5)}, ball));

  for (int tick = 0; tick < 120; ++tick) {
    const StepReport report = step(world);
    check(report.complete());
  }

  Pose pose;
  check(get_pose(world, ball, pose));
  const double height = coord_to_host(pose.position.y);  // 0.5 m: it lies on the ground
  check(fabs(height - 0.5) < 0.01);

  BodyId third;
  const Status status = create_body(world, {.shape = sphere(0.5)}, third);  // Status::pool_full
  printf("%s\n", status_text(status));
  check(status == Status::pool_full);

  const double wanted = 2.5;  // from a slider, a file, a network
  Real speed;
  check(real_from_host(wanted, speed));
  check(set_velocity(world, ball, {speed, 0.0, 0.0}, {}));

  Pose before, after;
  check(get_pose(world, ball, before));
  step(world);
  check(get_pose(world, ball, after));
  const Pose between = interpolate(before, after, Unit(0.25));
  const CameraRelative seen = relative_to_camera(between, {0.0, 1.0, 10.0});
  check(seen.position[2] < -9.0f && seen.position[0] > 0.0f);
}
