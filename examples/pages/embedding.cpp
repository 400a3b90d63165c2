#include <detent/numbers.h>
#include <detent/world.h>
#include <math.h>

#include "examples/pages/check.h"

using namespace detent;

namespace {

constexpr Features k_features = Features::sphere | Features::half_space;
WorldStorage<Capacity{.bodies = 6, .contacts = 8, .manifolds = false}> storage;
World world;
BodyId ball;

Status start() {
  Status status = storage.create({.continuous = false, .sleeping = false}, {}, feature_table<k_features>, world);
  if (status != Status::ok) return status;
  BodyId ground;
  status = create_body(world, {.type = BodyType::fixed, .shape = half_space()}, ground);
  if (status != Status::ok) return status;
  return create_body(world, {.position = {0.0, 2.0, 0.0}, .shape = sphere(0.5)}, ball);
}

void every_tick() { step(world); }

}  // namespace

int main() {
  check(start());
  for (int tick = 0; tick < 120; ++tick) every_tick();
  Pose pose;
  check(get_pose(world, ball, pose));
  check(fabs(coord_to_host(pose.position.y) - 0.5) < 0.01);

  BodyId crate;
  const Status status = create_body(world, {.shape = box({0.5, 0.5, 0.5})}, crate);  // Status::feature_missing
  check(status == Status::feature_missing);
}
