#pragma once
#include <detent/tasks.h>

#include "base/float_environment.h"
#include "base/span.h"

/// Shares the loops of a stage among threads that the caller lends (detent/tasks.h). One thread runs the code of the
/// stage. In each loop that the stage passes to share(), all threads take the elements chunk by chunk. Therefore a
/// stage with several loops needs only one call of Tasks::run.
#ifndef DETENT_TASKS
#if defined(__unix__) || defined(_WIN32) || defined(__APPLE__)
#define DETENT_TASKS 1
#else
#define DETENT_TASKS 0
#endif
#endif

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The least number of elements, by kind, that a thread takes at once from a shared loop: the argument `grain` below.
inline constexpr uint32_t k_bodies_shared = 32, k_pairs_shared = 16, k_contacts_shared = 8, k_islands_shared = 8,
                          k_queries_shared = 1;

#if DETENT_TASKS

/// The number of elements below which a stage runs on one thread.
inline uint32_t least_of(const Tasks& tasks) { return tasks.least == 0 ? 96 : tasks.least; }

class Team {
 public:
  explicit Team(const Tasks& tasks) : tasks_(tasks) {}
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  /// Calls work() once, on one of the threads. The other threads help with the shared loops of work(). A helping thread
  /// leaves if it finds no loop for a while.
  template <class Work>
  void run(const Work& work) {
    work_ = [](const void* of) { (*static_cast<const Work*>(of))(); };
    of_work_ = &work;
    tasks_.run(
        tasks_.context, tasks_.workers, [](void* team) { static_cast<Team*>(team)->enter(); }, this);
    enter();  // in case Tasks::run has made no call
  }

  /// Divides `count` elements into consecutive ranges, and calls body(first, last) for each range, in any order, on any
  /// of the threads. Every range but the last has at least `grain` elements. Returns after the last call. Range: only
  /// the thread that runs work() may call this function, and `body` must not call it.
  template <class Body>
  void each(uint32_t count, uint32_t grain, const Body& body) {
    if (load(loop_) / k_chunk_codes == k_loops_max) {  // the number of the next loop would wrap
      body(0, count);
      return;
    }
    if (tasks_.least == 1) grain = 1;
    chunk_ = [](const void* of, uint32_t first, uint32_t last) { (*static_cast<const Body*>(of))(first, last); };
    of_chunk_ = &body;
    count_ = count;
    grain_ = (count + k_chunks_max - 1) / k_chunks_max;
    if (grain_ < grain) grain_ = grain;
    const uint32_t chunks = (count + grain_ - 1) / grain_;
    store(unfinished_, chunks);
    const uint32_t loop = (load(loop_) / k_chunk_codes + 1) * k_chunk_codes + chunks;
    const TaskProbe* const probe = tasks_.probe;
    if (probe != nullptr && probe->loop_begins != nullptr) probe->loop_begins(probe->context, chunks);
    store(loop_, loop);
    take_chunks(loop, 0);
    for (uint32_t pauses = 0; load(unfinished_) != 0; ++pauses) pause(pauses);
    if (probe != nullptr && probe->loop_ends != nullptr) probe->loop_ends(probe->context);
  }
  /// A loop with at most this number of elements is not shared: it runs on one thread.
  uint32_t few(uint32_t grain) const { return tasks_.least == 1 ? 0 : grain; }
  /// The least number of bodies or of contacts of an island whose loops the threads share.
  uint32_t many() const { return tasks_.least == 1 ? 4 : least_of(tasks_); }

  /// Adds `value` to `sum`, to which other threads may add at the same time. Returns `sum` before the addition.
  static uint32_t take(uint32_t& sum, uint32_t value) { return __atomic_fetch_add(&sum, value, __ATOMIC_RELAXED); }
  static void add(uint32_t& sum, uint32_t value) {
    if (value != 0) take(sum, value);
  }
  /// Calls work(), and makes other threads that call this function wait until work() has returned.
  template <class Work>
  void alone(const Work& work) {
    for (uint32_t pauses = 0; __atomic_exchange_n(&locked_, 1u, __ATOMIC_ACQUIRE) != 0; ++pauses) pause(pauses);
    work();
    store(locked_, 0);
  }

 private:
  static constexpr uint32_t k_waiting = 0, k_begun = 1, k_ended = 2;
  static constexpr uint32_t k_chunks_max = 64, k_chunk_codes = 128;
  static constexpr uint32_t k_loops_max = UINT32_MAX / k_chunk_codes - 1;
  /// A thread that waits calls Tasks::wait in every pause after the first k_pauses pauses. A helper leaves if it has
  /// found no loop for k_idle_pauses pauses.
  static constexpr uint32_t k_pauses = 2000, k_idle_pauses = 20000;

  static uint32_t load(const uint32_t& from) { return __atomic_load_n(&from, __ATOMIC_ACQUIRE); }
  static void store(uint32_t& to, uint32_t value) { __atomic_store_n(&to, value, __ATOMIC_RELEASE); }

  void pause(uint32_t pauses) const {
    if (pauses > k_pauses && tasks_.wait != nullptr) tasks_.wait(tasks_.context);
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#elif defined(__aarch64__) || (defined(__arm__) && __ARM_ARCH >= 7)
    __asm__ __volatile__("yield");
#endif
  }

  /// The first thread that enters runs the stage; the others help.
  void enter() {
    uint32_t none = k_waiting;
    if (__atomic_compare_exchange_n(&state_, &none, k_begun, false, __ATOMIC_ACQ_REL, __ATOMIC_ACQUIRE)) {
      const FloatEnvironment environment;
      work_(of_work_);
      store(state_, k_ended);
    } else if (none == k_begun) {
      help(__atomic_add_fetch(&helpers_, 1u, __ATOMIC_RELAXED));
    }
  }
  void help(uint32_t helper) {
    const FloatEnvironment environment;
    uint32_t last = 0;
    for (uint32_t pauses = 0; load(state_) != k_ended && pauses < k_idle_pauses;) {
      const uint32_t loop = load(loop_);
      if (loop == last) {
        pause(++pauses);
        continue;
      }
      take_chunks(loop, helper);
      last = loop;
      pauses = 0;
    }
  }
  /// Runs the chunks of a loop that no other thread has taken. Each thread begins at a chunk of its own. This first
  /// chunk is the same in every loop with the same number of chunks, so that the thread's cache keeps the data.
  void take_chunks(uint32_t loop, uint32_t thread) {
    const uint32_t chunks = loop % k_chunk_codes;
    const TaskProbe* const probe = tasks_.probe;
    uint32_t taken = 0;
    for (uint32_t i = 0, next = thread % tasks_.workers * chunks / tasks_.workers; i < chunks; ++i) {
      const uint32_t chunk = probe != nullptr && probe->part != nullptr ? probe->part(probe->context, i, chunks) : next;
      if (++next == chunks) next = 0;
      if (!take_chunk(chunk, loop)) continue;
      // The loop cannot end before this chunk is finished, so the description of the loop stays valid.
      if (probe != nullptr && probe->part_begins != nullptr) probe->part_begins(probe->context);
      const uint32_t first = chunk * grain_, rest = count_ - first;
      chunk_(of_chunk_, first, first + (rest < grain_ ? rest : grain_));
      if (probe != nullptr && probe->part_ends != nullptr) probe->part_ends(probe->context);
      ++taken;
    }
    if (taken != 0) __atomic_fetch_sub(&unfinished_, taken, __ATOMIC_RELEASE);
  }
  /// Takes a chunk for this thread. Returns false if a thread has already taken the chunk in this loop, or in a later
  /// loop, which means that this loop has ended.
  bool take_chunk(uint32_t chunk, uint32_t loop) {
    uint32_t taken_in = load(taken_in_[chunk]);
    do {
      if (taken_in >= loop / k_chunk_codes) return false;
    } while (!__atomic_compare_exchange_n(&taken_in_[chunk], &taken_in, loop / k_chunk_codes, true, __ATOMIC_ACQ_REL,
                                          __ATOMIC_ACQUIRE));
    return true;
  }

  const Tasks& tasks_;
  void (*work_)(const void* work) = nullptr;
  const void* of_work_ = nullptr;
  uint32_t state_ = k_waiting, locked_ = 0, helpers_ = 0;
  // The present loop. `loop_`: the number of the loop times k_chunk_codes, plus its number of chunks. Then its number
  // of elements, the elements per chunk, and the body of the loop.
  alignas(64) uint32_t loop_ = 0;
  uint32_t count_ = 0, grain_ = 1;
  void (*chunk_)(const void* body, uint32_t first, uint32_t last) = nullptr;
  const void* of_chunk_ = nullptr;
  alignas(64) uint32_t unfinished_ = 0;
  alignas(64) uint32_t taken_in_[k_chunks_max] = {};  ///< number of the loop in which each chunk was taken last
};

/// Calls work(team) on one of the caller's threads. If the caller lends no threads (Tasks::run, Tasks::workers), calls
/// it on this thread with a null `team`.
template <class Work>
void with_team(const Tasks& tasks, const Work& work) {
  if (tasks.run == nullptr || tasks.workers < 2) {
    work(static_cast<Team*>(nullptr));
    return;
  }
  Team team(tasks);
  team.run([&] { work(&team); });
}
/// As with_team() above, but `team` is null also if there are fewer than least_of(tasks) elements.
template <class Work>
void with_team(const Tasks& tasks, uint32_t elements, const Work& work) {
  if (elements >= least_of(tasks))
    with_team(tasks, work);
  else
    work(static_cast<Team*>(nullptr));
}

/// Calls body(first, last) for ranges that together are [0, count), as Team::each() does. There is only one range, on
/// this thread, if `team` is null or if there are at most `grain` elements.
template <class Body>
void share(Team* team, uint32_t count, uint32_t grain, const Body& body) {
  if (team != nullptr && count > team->few(grain))
    team->each(count, grain, body);
  else
    body(0, count);
}
/// Calls work() while no other thread of the team is in a call of this function (Team::alone()).
template <class Work>
void alone(Team* team, const Work& work) {
  if (team != nullptr)
    team->alone(work);
  else
    work();
}
/// As share(), and returns the sum of the values that `body` returns.
template <class Body>
uint32_t share_sum(Team* team, uint32_t count, uint32_t grain, const Body& body) {
  if (team == nullptr || count <= team->few(grain)) return body(0, count);
  uint32_t sum = 0;
  team->each(count, grain, [&](uint32_t first, uint32_t last) { Team::add(sum, body(first, last)); });
  return sum;
}

#else

class Team {
 public:
  static uint32_t take(uint32_t& sum, uint32_t value) { return (sum += value) - value; }
  static void add(uint32_t& sum, uint32_t value) { sum += value; }
  uint32_t many() const { return 0; }
};
template <class Work>
inline void with_team(const Tasks&, uint32_t, const Work& work) {
  work(static_cast<Team*>(nullptr));
}
template <class Body>
inline void share(Team*, uint32_t count, uint32_t, const Body& body) {
  body(0, count);
}
template <class Work>
inline void alone(Team*, const Work& work) {
  work();
}
template <class Body>
inline uint32_t share_sum(Team*, uint32_t count, uint32_t, const Body& body) {
  return body(0, count);
}

#endif

/// As share_sum() and share() above, for the elements of the list `all`: calls body(part) with parts of the list
/// instead of ranges of indices.
template <class T, class Body>
uint32_t share_sum(Team* team, Span<T> all, uint32_t grain, const Body& body) {
  return share_sum(team, all.count, grain, [&](uint32_t first, uint32_t last) {
    return body(Span<T>{all.data + first, last - first});
  });
}
template <class T, class Body>
void share(Team* team, Span<T> all, uint32_t grain, const Body& body) {
  share(team, all.count, grain, [&](uint32_t first, uint32_t last) { body(Span<T>{all.data + first, last - first}); });
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
