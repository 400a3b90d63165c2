#pragma once
#include <detent/rollback.h>
#include <detent/tasks.h>

#include <atomic>
#include <vector>

/// Many independent worlds in one process.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace worlds {

/// A state from which other worlds of the same capacity begin, and against which they can be kept.
class Snapshot {
 public:
  explicit Snapshot(const World& world);
  void restore_to(World& world) const;

  /// What differs between the world and this state.
  std::vector<uint8_t> difference(const World& world) const;
  /// The state of which difference() was taken.
  void restore_to(World& world, const std::vector<uint8_t>& difference) const;

  /// The size of this state.
  uint32_t byte_count() const { return static_cast<uint32_t>(bytes_.size()); }

 private:
  std::vector<uint8_t> bytes_;
};

/// One number for the states of all worlds, in the order in which they are added.
class DigestOfAll {
 public:
  void add(const World& world);
  uint64_t value() const { return value_; }

 private:
  uint64_t value_ = 0;
};

/// Calls work(i, worker) once for each i below `count`, on the threads of `tasks`, whose `run` must not be null. A
/// thread that is free takes the next i. `worker`: below tasks.workers; two calls that run at the same time have
/// different ones.
template <class Work>
void for_each(const Tasks& tasks, uint32_t count, const Work& work) {
  struct Shared {
    const Work& work;
    const uint32_t count;
    std::atomic<uint32_t> next = 0, workers = 0;
  };
  Shared shared{work, count};
  const auto take = [](void* argument) {
    Shared& all = *static_cast<Shared*>(argument);
    const uint32_t worker = all.workers++;
    for (uint32_t i = all.next++; i < all.count; i = all.next++) all.work(i, worker);
  };
  tasks.run(tasks.context, tasks.workers, take, &shared);
}

}  // namespace worlds
}  // namespace DETENT_NAMESPACE
}  // namespace detent
