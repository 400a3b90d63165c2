#include <detent/numbers.h>
#include <inttypes.h>
#include <stdio.h>

#include "examples/joint_error.h"
#include "examples/ragdoll/ragdoll.h"

using namespace detent;

namespace {

constexpr uint32_t k_steps = 12, k_ticks = 240;

/// Stairs that go down along x, from the origin to the ground at y = 0.
Status make_stairs(World& world) {
  BodyId id;
  BodyDef ground;
  ground.type = BodyType::fixed;
  ground.shape = half_space();
  Status status = create_body(world, ground, id);
  BodyDef stair = ground;
  stair.position = {-1.0, 1.08, 0.0};
  stair.shape = box({Real(1.0), Real(1.08), Real(1.5)});
  if (status == Status::ok) status = create_body(world, stair, id);
  stair.position.x = Coord(0.15);
  stair.shape.half_extents.x = Real(0.15);
  for (uint32_t i = 1; i < k_steps && status == Status::ok; ++i) {
    stair.position.y -= Coord(0.09);
    stair.shape.half_extents.y -= Real(0.09);
    status = create_body(world, stair, id);
    stair.position.x += Coord(0.3);
  }
  return status;
}

}  // namespace

int main() {
  static WorldStorage<Capacity{.bodies = 1 + k_steps + ragdoll::k_parts, .contacts = 96, .joints = ragdoll::k_joints}>
      storage;
  World world;
  ragdoll::Ragdoll figure;
  if (storage.create({}, world) != Status::ok || make_stairs(world) != Status::ok ||
      ragdoll::make(world, {-0.5, 2.2, 0.0}, figure) != Status::ok ||
      ragdoll::throw_figure(world, figure, {Real(0.0), Real(1.0), Real(-0.3)}, {Real(2.0), Real(0.5), Real(0.2)}) !=
          Status::ok)
    return 1;

  double worst = 0;
  for (uint32_t tick = 1; tick <= k_ticks; ++tick) {
    if (!step(world).complete()) printf("tick %" PRIu32 ": something was lost\n", tick);
    for (const JointId joint : figure.joint) worst = fmax(worst, joint_error(world, joint));
    Pose hips;
    if (tick % 60 == 0 && get_pose(world, figure.part[0], hips) == Status::ok) {
      printf("%" PRIu32 " s: hips at x %.2f m, y %.2f m\n", tick / 60, coord_to_host(hips.position.x),
             coord_to_host(hips.position.y));
    }
  }
  printf("no joint was off by more than %.1f mm; digest %016" PRIx64 "\n", ceil(1e4 * worst) / 10, digest(world));
}
