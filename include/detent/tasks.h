#pragma once
#include <detent/config.h>

/// @file
/// Threads that a caller lends to the steps and batches of queries of a world. The library starts no thread of its own.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Watches how threads share the loops of a step, for tests and measurements. A loop consists of parts; each thread
/// takes one part after the other. All functions may be null.
struct TaskProbe {
  /// Returns the index of the part that a thread tries to take in its attempt number `i`, from 0 on, in a loop of
  /// `parts` parts. For i = 0, 1, ... parts - 1 the results must be all the numbers 0 to parts - 1, in any order. Null:
  /// each thread begins at a part of its own and goes on in ascending order.
  uint32_t (*part)(void* context, uint32_t i, uint32_t parts) = nullptr;
  void (*loop_begins)(void* context, uint32_t parts) = nullptr;  ///< called by the thread that runs the stage
  void (*loop_ends)(void* context) = nullptr;                    ///< called by the thread that runs the stage
  void (*part_begins)(void* context) = nullptr;                  ///< called by the thread that has taken the part
  void (*part_ends)(void* context) = nullptr;                    ///< called by the thread that has taken the part
  void* context = nullptr;                                       ///< passed to these functions
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
  /// The number of threads that the caller can lend; the library passes it to `run` as `count`. If it is below 2, `run`
  /// is not called: all work runs on the calling thread.
  uint32_t workers = 0;
  /// A stage with fewer bodies or pairs than this, or a batch with fewer queries, runs on one thread, because starting
  /// more threads takes longer than they save. 0 means 96. 1 is for tests: loops then have as many parts as possible,
  /// at most 64.
  uint32_t least = 0;
  const TaskProbe* probe = nullptr;  ///< watches how the threads share loops; may be null
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
