#include <detent/numbers.h>
#include <detent/world.h>
#include <stdlib.h>

#include "examples/pages/check.h"

using namespace detent;

namespace {

void fixed_at_compile_time() {
  constexpr Capacity capacity = {.bodies = 100, .contacts = 300};
  static WorldStorage<capacity> storage;
  static_assert(sizeof storage == world_bytes(capacity));
  World world;
  check(storage.create({.gravity = {0.0, 0.0, 0.0}}, world));
}

void chosen_at_run_time(uint32_t bodies) {
  const WorldDef def = {.capacity = {.bodies = bodies, .contacts = 4 * bodies}};
  const uint32_t bytes = world_bytes(def.capacity);
  check(bytes != 0);                                      // 0: an invalid capacity
  uint8_t* block = static_cast<uint8_t*>(malloc(bytes));  // aligned to 8
  World world;
  check(create_world(block, bytes, def, {}, world));
  step(world);
  free(block);  // ends the world, which owns nothing else
}

void full() {
  static WorldStorage<Capacity{.bodies = 3, .contacts = 1}> storage;
  World world;
  check(storage.create({}, world));
  BodyId id;
  check(create_body(world, {.type = BodyType::fixed, .shape = half_space()}, id));
  check(create_body(world, {.position = {-2.0, 0.5, 0.0}, .shape = sphere(0.5)}, id));
  check(create_body(world, {.position = {2.0, 0.5, 0.0}, .shape = sphere(0.5)}, id));
  check(create_body(world, {}, id) == Status::pool_full);

  const StepReport report = step(world);
  if (!report.complete()) printf("%u contacts did not fit\n", static_cast<unsigned>(report.lost.contacts));
  check(!report.complete() && report.lost.contacts == 1);
}

void fitted() {
  static WorldStorage<Capacity{.bodies = 20, .contacts = 100}> storage;
  World world;
  check(storage.create({}, world));
  BodyId id;
  check(create_body(world, {.type = BodyType::fixed, .shape = half_space()}, id));
  for (Coord x = -4.0; x < Coord(5.0); x += Coord(2.0))
    check(create_body(world, {.position = {x, 0.5, 0.0}, .shape = sphere(0.5)}, id));

  CapacityUse use;
  for (int tick = 0; tick < 600; ++tick) note_use(step(world), get_info(world), use);
  const Capacity fit = suggest_capacity(use, get_info(world).capacity);
  printf("a capacity of %u contacts would do\n", static_cast<unsigned>(fit.contacts));
  check(use.contacts == 5 && fit.contacts == 7 && fit.bodies == 8 && use.steps_full == 0);
}

void sizes() {
  constexpr Capacity roomy = {.bodies = 100, .contacts = 300};
  constexpr Capacity small = {.bodies = 100, .contacts = 300, .manifolds = false};
  static_assert(world_bytes(small) < world_bytes(roomy));
  static_assert(snapshot_bytes(roomy) < world_bytes(roomy));
  constexpr Capacity another_body = {.bodies = 101, .contacts = 300},
                     another_contact = {.bodies = 100, .contacts = 301};
  static_assert(world_bytes(another_body) - world_bytes(roomy) < 1500);
  static_assert(world_bytes(another_contact) - world_bytes(roomy) < 1500);
}

}  // namespace

int main() {
  fixed_at_compile_time();
  chosen_at_run_time(10);
  full();
  fitted();
  sizes();
}
