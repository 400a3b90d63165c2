#pragma once
#include <detent/tasks.h>

#include "tests/bench/scaling/engine.h"
#include "tests/bench/timer.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Records the parts of the loops of a tick, which one thread runs one after the other.
class Recorded {
 public:
  Tasks tasks() {
    probe_ = {nullptr, loop_begins, nullptr, part_begins, part_ends, this};
    Tasks tasks;
    tasks.run = run;
    tasks.context = this;
    tasks.workers = 2;
    tasks.probe = &probe_;
    return tasks;
  }
  detent_bench::TickRecord tick;

 private:
  static Recorded& self(void* context) { return *static_cast<Recorded*>(context); }
  static void run(void* context, uint32_t count, void (*task)(void*), void* argument) {
    ++self(context).tick.groups;
    for (uint32_t i = 0; i < count; ++i) task(argument);
  }
  static void loop_begins(void* context, uint32_t) { self(context).tick.loops.push_back({}); }
  static void part_begins(void* context) { self(context).start_ = detent_bench::monotonic_ns(); }
  static void part_ends(void* context) {
    Recorded& recorded = self(context);
    recorded.tick.loops.back().parts.push_back(static_cast<double>(detent_bench::monotonic_ns() - recorded.start_));
  }

  TaskProbe probe_;
  uint64_t start_ = 0;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
