#include "threads/thread_pool.h"

#include <system_error>

namespace detent_host {

ThreadPool::ThreadPool(uint32_t workers, std::chrono::nanoseconds awake) : awake_(awake) {
  if (workers == 0) workers = std::thread::hardware_concurrency();
  try {
    for (uint32_t i = 1; i < workers; ++i) threads_.emplace_back([this] { work(); });
  } catch (const std::system_error&) {  // the system gives no more threads: the pool has fewer
  }
}

ThreadPool::~ThreadPool() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stops_ = true;
    ++groups_;
  }
  begins_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void ThreadPool::run(void* context, uint32_t count, void (*task)(void*), void* argument) {
  ThreadPool& pool = *static_cast<ThreadPool*>(context);
  const std::unique_lock<std::mutex> step(pool.busy_, std::try_to_lock);
  if (!step.owns_lock()) {
    for (uint32_t i = 0; i < count; ++i) task(argument);
    return;
  }
  std::unique_lock<std::mutex> lock(pool.mutex_);
  pool.task_ = task;
  pool.argument_ = argument;
  pool.left_ = count;
  ++pool.groups_;
  pool.begins_.notify_all();
  while (pool.left_ != 0) pool.call(lock);
  pool.ends_.wait(lock, [&] { return pool.running_ == 0; });
}

void ThreadPool::work() {
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    begins_.wait(lock, [this] { return stops_ || left_ != 0; });
    if (stops_) return;
    const uint32_t group = groups_;
    call(lock);
    if (running_ == 0) ends_.notify_one();
    if (left_ != 0) continue;
    lock.unlock();
    stay_awake(group);
    lock.lock();
  }
}

void ThreadPool::stay_awake(uint32_t group) const {
  const auto begun = std::chrono::steady_clock::now();
  while (groups_ == group && std::chrono::steady_clock::now() - begun < awake_) std::this_thread::yield();
}

void ThreadPool::call(std::unique_lock<std::mutex>& lock) {
  --left_;
  ++running_;
  void (*const task)(void*) = task_;
  void* const argument = argument_;
  lock.unlock();
  task(argument);
  lock.lock();
  --running_;
}

}  // namespace detent_host
