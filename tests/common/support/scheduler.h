#pragma once
#include <detent/tasks.h>

#include <chrono>
#include <thread>
#include <vector>

#include "tests/common/support/random.h"

/// Schedulers for WorldHooks::tasks that try to break a step.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// How a scheduler makes the calls of Tasks::run.
enum class Calls {
  one_by_one,  ///< one after the other, on the thread that steps
  threads,     ///< each on a thread of its own
  late,        ///< as `threads`, begun after a random time
};
/// In which order a thread tries to take the parts of a loop.
enum class Parts { in_order, backwards, shuffled };

struct Scheduler {
  Calls calls = Calls::threads;
  Parts parts = Parts::in_order;
  uint32_t workers = 2;
  bool delayed = false;  ///< parts take a random time
  uint32_t least = 1;    ///< Tasks::least; 1: each element of a loop is a part of its own
  uint64_t seed = 1;
  TaskProbe probe = {};

  Tasks tasks() {
    probe.context = this;
    if (parts != Parts::in_order) probe.part = part;
    if (delayed) probe.part_begins = probe.part_ends = pause;
    return {run, [](void*) { std::this_thread::yield(); }, this, workers, least, &probe};
  }

 private:
  static void run(void* context, uint32_t count, void (*task)(void*), void* argument) {
    Scheduler& self = *static_cast<Scheduler*>(context);
    ++self.seed;
    if (self.calls == Calls::one_by_one) {
      for (uint32_t i = 0; i < count; ++i) task(argument);
      return;
    }
    std::vector<std::thread> threads;
    for (uint32_t i = 0; i < count; ++i) {
      threads.emplace_back([&self, i, task, argument] {
        if (self.calls == Calls::late) sleep_up_to(self.seed + i);
        task(argument);
      });
    }
    for (std::thread& thread : threads) thread.join();
  }
  static uint32_t part(void* context, uint32_t i, uint32_t parts) {
    const Scheduler& self = *static_cast<Scheduler*>(context);
    if (self.parts == Parts::backwards) return parts - 1 - i;
    // Multiplying by a number without a common factor permutes the parts.
    uint32_t factor = static_cast<uint32_t>(self.seed % 61) + 1;
    while (common_factor(factor, parts) != 1) ++factor;
    return static_cast<uint32_t>((uint64_t{i} * factor + self.seed) % parts);
  }
  static uint32_t common_factor(uint32_t a, uint32_t b) { return b == 0 ? a : common_factor(b, a % b); }
  static void pause(void*) {
    thread_local uint64_t calls = 0;
    if (++calls % 8 == 0) sleep_up_to(calls);
  }
  static void sleep_up_to(uint64_t seed) {
    std::this_thread::sleep_for(std::chrono::microseconds((seed * 0x9e3779b97f4a7c15u >> 58)));
  }
};

/// One of each kind, with few and with many threads.
inline const Scheduler k_schedulers[] = {
    {Calls::one_by_one, Parts::in_order, 2},
    {Calls::one_by_one, Parts::backwards, 3},
    {Calls::one_by_one, Parts::shuffled, 8},
    {Calls::threads, Parts::in_order, 2},
    {Calls::threads, Parts::backwards, 3},
    {Calls::threads, Parts::shuffled, 3, true},
    {Calls::late, Parts::in_order, 8},
    {Calls::late, Parts::shuffled, 8, true},
    {Calls::late, Parts::backwards, 64},
    {Calls::threads, Parts::shuffled, 3, false, 2},
    {Calls::threads, Parts::shuffled, 3, false, 9},
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
