#include <detent/numbers.h>
#include <detent/world.h>
#include <stdio.h>

#include <thread>
#include <vector>

#include "examples/pages/check.h"
#include "threads/thread_pool.h"

using namespace detent;

namespace {

constexpr Capacity k_capacity = {.bodies = 400, .contacts = 1600};

void build(World& world) {
  BodyId id;
  check(create_body(world, {.type = BodyType::fixed, .shape = half_space()}, id));
  for (int32_t i = 0; i < 343; ++i) {
    Position place;
    check(coord_from_host(1.01 * (i % 7), place.x));
    check(coord_from_host(1.01 * (i / 49) + 0.5, place.y));
    check(coord_from_host(1.01 * (i / 7 % 7), place.z));
    check(create_body(world, {.position = place, .shape = box({0.5, 0.5, 0.5})}, id));
  }
}

/// Runs each call on a thread of its own.
void run_on_threads(void*, uint32_t count, void (*task)(void*), void* argument) {
  std::vector<std::thread> threads;
  for (uint32_t i = 1; i < count; ++i) threads.emplace_back(task, argument);
  task(argument);
  for (std::thread& thread : threads) thread.join();
}

uint64_t step_with(const Tasks& tasks) {
  static WorldStorage<k_capacity> storage;
  World world;
  check(storage.create({}, world));
  build(world);
  world.hooks.tasks = tasks;
  for (int tick = 0; tick < 30; ++tick) step(world);
  return digest(world);
}

}  // namespace

int main() {
  detent_host::ThreadPool pool;  // as many threads as the machine has processors
  const Tasks tasks = pool.tasks<Tasks>();

  const uint64_t alone = step_with({});
  check(step_with(tasks) == alone);
  check(step_with({.run = run_on_threads, .workers = 4}) == alone);
  printf("the same on 1, %u and 4 threads: %016llx\n", pool.workers(), static_cast<unsigned long long>(alone));
}
