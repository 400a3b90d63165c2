#pragma once
#include <detent/tasks.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <thread>

/// oneTBB for WorldHooks::tasks.
namespace detent_host {

/// Returns tasks that run on the threads of the arena in which step() is called. `workers`: number of calls that a
/// stage asks for; 0: the number of slots of the arena.
template <class Tasks>
Tasks tbb_tasks(uint32_t workers = 0) {
  Tasks tasks;
  tasks.run = [](void*, uint32_t count, void (*task)(void*), void* argument) {
    // Isolated: a thread that waits for the end of the stage does not begin other work of the program within the step.
    tbb::this_task_arena::isolate([=] {
      tbb::parallel_for(
          tbb::blocked_range<uint32_t>(0, count, 1),
          [=](const tbb::blocked_range<uint32_t>& range) {
            for (uint32_t i = range.begin(); i < range.end(); ++i) task(argument);
          },
          tbb::simple_partitioner());
    });
  };
  tasks.wait = [](void*) { std::this_thread::yield(); };
  tasks.workers = workers != 0 ? workers : static_cast<uint32_t>(tbb::this_task_arena::max_concurrency());
  return tasks;
}

}  // namespace detent_host
