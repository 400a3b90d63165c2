/// Steps a heap of boxes on the threads of oneTBB, and on one thread: the digests agree.
#include <detent/numbers.h>
#include <detent/world.h>
#include <inttypes.h>
#include <stdio.h>

#include "threads/tbb_tasks.h"

using namespace detent;

namespace {

constexpr Capacity k_capacity = {.bodies = 400, .contacts = 1600};

bool build(World& world) {
  BodyId id;
  bool ok = create_body(world, {.type = BodyType::fixed, .shape = half_space()}, id) == Status::ok;
  for (int32_t i = 0; ok && i < 343; ++i) {
    BodyDef def = {.shape = box({0.5, 0.5, 0.5})};
    ok = coord_from_host(1.1 * (i % 7), def.position.x) == Status::ok &&
         coord_from_host(1.1 * (i / 49) + 0.6, def.position.y) == Status::ok &&
         coord_from_host(1.1 * (i / 7 % 7), def.position.z) == Status::ok &&
         create_body(world, def, id) == Status::ok;
  }
  return ok;
}

/// The digest after two seconds; 0 if the world cannot be made.
uint64_t digest_with(const Tasks& tasks) {
  static WorldStorage<k_capacity> storage;
  World world;
  if (storage.create({}, world) != Status::ok || !build(world)) return 0;
  world.hooks.tasks = tasks;
  for (int tick = 0; tick < 120; ++tick) step(world);
  return digest(world);
}

}  // namespace

int main() {
  const Tasks tasks = detent_host::tbb_tasks<Tasks>();
  const uint64_t alone = digest_with({}), shared = digest_with(tasks);
  printf("one thread: %016" PRIx64 "\noneTBB, %" PRIu32 " threads: %016" PRIx64 "\n", alone, tasks.workers, shared);
  return alone != 0 && alone == shared ? 0 : 1;
}
