#pragma once
#include <detent/config.h>

/// @file
/// Threads that a caller lends to the steps and batches of queries of a world. The library starts no thread of its own.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Watches how the loops of a step are shared, for tests and measurements. A loop consists of parts; the threads take
/// one part after the other. All functions may be null.
struct TaskProbe {
  /// Returns which part of a loop of `parts` parts a thread tries to take as its `i`th. For i = 0, 1, ... parts - 1 the
  /// results must be all the numbers 0 to parts - 1, in any order. Null: each thread begins at a part of its own and
  /// goes on in ascending order.
  uint32_t (*part)(void* context, uint32_t i, uint32_t parts) = nullptr;
  void (*loop_begins)(void* context, uint32_t parts) = nullptr;  ///< called by the thread that runs the stage
  void (*loop_ends)(void* context) = nullptr;                    ///< as `loop_begins`
  void (*part_begins)(void* context) = nullptr;                  ///< called by the thread that has taken a part
  void (*part_ends)(void* context) = nullptr;                    ///< as `part_begins`
  void* context = nullptr;                                       ///< passed to the functions
};

/// Runs parts of a step, and the queries of a batch (query_batch()), on the caller's threads. Set WorldHooks::tasks to
/// use it. The number of threads, and the order in which they run, do not change any result: a step computes the same
/// bits as on one thread.
struct Tasks {
  /// Calls task(argument) `count` times, on any threads, in any order, and returns after the last call has returned.
  /// The calls may run at the same time, and may also run one after the other. The threads must have the same priority,
  /// because a thread waits until the other threads have finished the parts that they have begun. Null: the step runs
  /// on the thread that called it.
  void (*run)(void* context, uint32_t count, void (*task)(void* argument), void* argument) = nullptr;
  /// Called again and again by a thread that waits for the work of another thread. It may let other threads of the
  /// machine run (std::this_thread::yield()). May be null.
  void (*wait)(void* context) = nullptr;
  void* context = nullptr;  ///< passed to `run` and `wait`
  uint32_t workers = 0;     ///< the `count` of each call of `run`: the number of free threads. Below 2: as a null `run`
  /// A stage with fewer bodies or pairs, or a batch with fewer queries, runs on one thread, because to start more
  /// threads takes longer than they save. 0 means 96. 1 is for tests: then each element of a loop is a part of its own.
  uint32_t least = 0;
  const TaskProbe* probe = nullptr;  ///< see TaskProbe
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
