#pragma once
#include <detent/tasks.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

/// Threads of the standard library for WorldHooks::tasks.
namespace detent_host {

/// A fixed number of threads that sleep while no step needs them. The steps of several worlds may use one pool. While a
/// stage of one world uses the pool, a stage of another world runs only on the thread that steps that world. The pool
/// must outlive the steps that use it.
class ThreadPool {
 public:
  /// `workers`: number of threads, including the thread that steps; 0: the number of processors. `awake`: how long a
  /// thread waits for the next stage before it sleeps. Waking a thread takes longer than most stages.
  explicit ThreadPool(uint32_t workers = 0, std::chrono::nanoseconds awake = std::chrono::microseconds(100));
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  uint32_t workers() const { return static_cast<uint32_t>(threads_.size()) + 1; }
  /// The value for WorldHooks::tasks. `Tasks`: the type of the configuration.
  template <class Tasks>
  Tasks tasks() {
    Tasks result;
    result.run = run;
    result.wait = [](void*) { std::this_thread::yield(); };
    result.context = this;
    result.workers = workers();
    return result;
  }

 private:
  static void run(void* context, uint32_t count, void (*task)(void*), void* argument);
  void work();
  /// Waits without sleeping until the next group of calls begins, but at most for `awake_`.
  void stay_awake(uint32_t group) const;
  /// Makes one of the calls that no thread has begun. Range: `lock` is held.
  void call(std::unique_lock<std::mutex>& lock);

  const std::chrono::nanoseconds awake_;
  std::atomic<uint32_t> groups_ = 0;  ///< number of calls of run() so far
  std::mutex busy_;                   ///< held while a stage uses the pool
  std::mutex mutex_;                  ///< protects the members below
  std::condition_variable begins_, ends_;
  void (*task_)(void*) = nullptr;
  void* argument_ = nullptr;
  uint32_t left_ = 0;     ///< calls that no thread has begun
  uint32_t running_ = 0;  ///< calls that have not returned
  bool stops_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace detent_host
