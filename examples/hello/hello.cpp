#include <detent/numbers.h>
#include <detent/world.h>
#include <stdio.h>
using namespace detent;

int main() {
  static WorldStorage<Capacity{.bodies = 2, .contacts = 4}> storage;
  World world;
  BodyId ground, ball;
  if (storage.create({}, world) != Status::ok ||
      create_body(world, {.type = BodyType::fixed, .shape = half_space()}, ground) != Status::ok ||
      create_body(world, {.position = {0.0, 5.0, 0.0}, .shape = sphere(0.5)}, ball) != Status::ok) {
    return 1;
  }
  for (int tick = 1; tick <= 120; ++tick) {
    step(world);
    Pose pose;
    if (tick % 10 == 0 && get_pose(world, ball, pose) == Status::ok) {
      printf("tick %3d: %.3f m\n", tick, coord_to_host(pose.position.y));
    }
  }
}
