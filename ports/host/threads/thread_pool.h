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

/// A fixed number of threads that sleep while no step needs them. Steps of several worlds may use one pool; while a
/// stage of one uses it, the stages of others run on their own threads alone. Must outlive the steps that use it.
class ThreadPool {
 public:
  /// `workers`: the thread that steps and `workers` - 1 others; 0: as many as the machine has processors. `awake`: for
  /// so long a thread waits for the next stage before it sleeps; to wake it takes longer than most stages.
  explicit ThreadPool(uint32_t workers = 0, std::chrono::nanoseconds awake = std::chrono::microseconds(100));
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  uint32_t workers() const { return static_cast<uint32_t>(threads_.size()) + 1; }
  /// For WorldHooks::tasks of the configuration with this Tasks.
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
  /// Waits for the next group of calls, without sleeping.
  void stay_awake(uint32_t group) const;
  /// Makes one of the calls that are left. Range: `lock` is held.
  void call(std::unique_lock<std::mutex>& lock);

  const std::chrono::nanoseconds awake_;
  std::atomic<uint32_t> groups_ = 0;  ///< number of calls of run() so far
  std::mutex busy_;                   ///< held while a stage uses the pool
  std::mutex mutex_;                  ///< of the members below
  std::condition_variable begins_, ends_;
  void (*task_)(void*) = nullptr;
  void* argument_ = nullptr;
  uint32_t left_ = 0;     ///< calls that no thread has begun
  uint32_t running_ = 0;  ///< calls that have not returned
  bool stops_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace detent_host
