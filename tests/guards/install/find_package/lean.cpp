#include <detent/world.h>
using namespace detent;

// A program of a few features, which links no more than those.
int main() {
  static WorldStorage<Capacity{.bodies = 2, .contacts = 4}> storage;
  World world;
  BodyId ground, ball;
  constexpr Features features = Features::sphere | Features::half_space;
  if (storage.create({.continuous = false, .sleeping = false}, {}, feature_table<features>, world) != Status::ok ||
      create_body(world, {.type = BodyType::fixed, .shape = half_space()}, ground) != Status::ok ||
      create_body(world, {.position = {0.0, 1.0, 0.0}, .shape = sphere(0.5)}, ball) != Status::ok) {
    return 1;
  }
  for (int tick = 0; tick < 60; ++tick) step(world);
  return get_info(world).contacts == 1 ? 0 : 1;
}
