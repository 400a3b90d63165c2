#include "tests/bench/rollback/engine.h"

#include <detent/rollback.h>

#include <algorithm>
#include <string>

#include "state/packed_state.h"
#include "tests/bench/heap.h"
#include "tests/campaigns/stress/run_detent.h"
#include "tests/campaigns/stress/scenes.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

using namespace detent_bench;

SparseRow measure_sparse(bool apart, uint32_t repetitions, const Clock& clock);

namespace {

constexpr uint32_t k_settling_ticks = 300, k_window = 8;
constexpr uint64_t k_pit_seed = 1;

const std::string& config_name() {
  static const std::string name = stress_engine().config;
  return name;
}

/// Times of one thing.
struct Times {
  std::vector<double> us;
  explicit Times(uint32_t repetitions) { us.reserve(repetitions); }
  double median() {
    std::sort(us.begin(), us.end());
    return us.empty() ? 0 : us[us.size() / 2];
  }
};

class Course {
 public:
  Course(World& world, uint32_t repetitions, const Clock& clock)
      : world_(world),
        repetitions_(repetitions),
        clock_(clock),
        capacity_(get_info(world).capacity),
        ring_words_(snapshot_ring_bytes(capacity_, k_window) / 8),
        base_(snapshot_bytes(capacity_) / 8),
        delta_(delta_bytes_max(capacity_)) {}

  void run(RollbackRow& row) {
    row.snapshot_bytes = snapshot_bytes(capacity_);
    good(ring_.begin(bytes_of(ring_words_), static_cast<uint32_t>(ring_words_.size() * 8), capacity_, k_window));
    Times step_times(repetitions_ * k_window), save_times(repetitions_ * k_window), restore_times(repetitions_),
        again_times(repetitions_), whole_save(repetitions_), whole_restore(repetitions_), make_delta(repetitions_),
        take_delta(repetitions_), digests(repetitions_);
    uint64_t delta_bytes = 0;
    const uint64_t allocations = heap_use().calls;
    for (uint32_t i = 0; i < repetitions_; ++i) {
      const uint64_t start = get_info(world_).tick;
      for (uint32_t tick = 0; tick < k_window; ++tick) {
        time(save_times, [&] { good(ring_.keep(world_)); });
        time(step_times, [&] { step(world_); });
      }
      const uint64_t reached = digest(world_);
      time(restore_times, [&] { good(ring_.restore(world_, start)); });
      for (uint32_t tick = 0; tick < k_window; ++tick) keep_and_step();
      time(again_times, [&] {
        good(ring_.restore(world_, start));
        for (uint32_t tick = 0; tick < k_window; ++tick) keep_and_step();
      });
      time(digests, [&] { same(row, reached); });
      time(whole_save, [&] { good(save(world_, bytes_of(base_), byte_count())); });
      time(whole_restore, [&] { good(restore(world_, bytes_of(base_), byte_count())); });
      step(world_);
      const uint64_t now = digest(world_);
      uint32_t bytes = 0;
      time(make_delta, [&] {
        good(save_delta(world_, bytes_of(base_), byte_count(), delta_.data(), static_cast<uint32_t>(delta_.size()),
                        bytes));
      });
      step(world_);
      time(take_delta, [&] { good(restore_delta(world_, bytes_of(base_), byte_count(), delta_.data(), bytes)); });
      same(row, now);
      delta_bytes += bytes;
    }
    row.allocations = heap_use().calls - allocations;
    row.exact = row.exact && good_;
    row.contacts = get_info(world_).contacts;
    std::vector<uint8_t> packed(packed_bytes_max(capacity_));
    row.bytes = pack_state(view_of(static_cast<const World&>(world_)), packed.data());
    row.delta_bytes = static_cast<uint32_t>(delta_bytes / repetitions_);
    row.step = step_times.median();
    row.save = save_times.median();
    row.restore = restore_times.median();
    row.resim8 = again_times.median();
    row.whole_save = whole_save.median();
    row.whole_restore = whole_restore.median();
    row.save_delta = make_delta.median();
    row.restore_delta = take_delta.median();
    row.digest = digests.median();
  }

 private:
  static uint8_t* bytes_of(std::vector<uint64_t>& words) { return reinterpret_cast<uint8_t*>(words.data()); }
  uint32_t byte_count() const { return static_cast<uint32_t>(base_.size() * 8); }
  void good(Status status) { good_ = good_ && status == Status::ok; }
  void same(RollbackRow& row, uint64_t expected) { row.exact = row.exact && digest(world_) == expected; }
  void keep_and_step() {
    good(ring_.keep(world_));
    step(world_);
  }
  template <class Work>
  void time(Times& times, const Work& work) {
    const uint64_t start = ticks();
    work();
    times.us.push_back(clock_.ns(ticks() - start) / 1000);
  }

  World& world_;
  const uint32_t repetitions_;
  const Clock& clock_;
  const Capacity capacity_;
  std::vector<uint64_t> ring_words_, base_;
  std::vector<uint8_t> delta_;
  SnapshotRing ring_;
  bool good_ = true;
};

RollbackRow measure(uint32_t bodies, uint32_t repetitions, const Clock& clock, const char*& problem) {
  RollbackRow row;
  row.config = config_name().c_str();
  row.bodies = bodies;
  static std::string reason;
  const auto run = stress_engine().make(detent_stress::pit(bodies, k_pit_seed), {}, reason);
  problem = run == nullptr ? reason.c_str() : nullptr;
  if (run == nullptr) return row;
  for (uint32_t tick = 0; tick < k_settling_ticks; ++tick) run->step();
  Course(world_of(*run), repetitions, clock).run(row);
  return row;
}

}  // namespace

/// Adds this configuration to those of the benchmark of rollback.
void add_rollback_engine(RollbackEngineList& engines) {
  engines.push_back({config_name().c_str(), measure, measure_sparse});
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
