#pragma once
#include <stdint.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/common/support/stage_time.h"
#include "tests/common/support/thread_clock.h"

/// The time of whole steps, for every benchmark that steps a world.
namespace detent_bench {

/// us, over the ticks of a run.
struct StepTimes {
  double mean = 0, median = 0, p99 = 0, max = 0;
};

StepTimes step_times(const std::vector<double>& us);

/// For each tick, the least time of all repetitions: an engine does the same work in each of them, so what is above the
/// least is the machine's.
class LeastTimes {
 public:
  explicit LeastTimes(size_t ticks = 0);
  void take(size_t tick, double us);
  /// Of the ticks that were timed at least once.
  StepTimes summary() const;

 private:
  std::vector<double> us_;
};

/// Counts, and corrects, steps during which another process had the core.
class Interruptions {
 public:
  /// Calls `step`, which returns the ns that it took by a clock that does not stop. Returns those that count, us: of a
  /// step that was interrupted, the thread's own time.
  template <class Step>
  double us_of(const Step& step) {
    const uint64_t core_before = asks_ ? detent_test::thread_ns() : 0;
    double ns = step();
    if (asks_) ns = own(ns, core_before);
    asks_ = ns > k_asked_ns;
    return ns / 1000;
  }

  uint64_t asked() const { return asked_; }
  uint64_t interrupted() const { return interrupted_; }

 private:
  /// After shorter steps, those of sleepers, the core's time is not taken, because that takes longer than they do.
  static constexpr double k_asked_ns = 2000;

  double own(double ns, uint64_t core_before);

  bool asks_ = true;
  uint64_t asked_ = 0, interrupted_ = 0;
};

/// Stages of a step by name, in their order, and their shares of its time.
using StageShares = std::vector<std::pair<std::string, double>>;
/// Between two readings, of which the first may be empty. Empty if there are no stages, or no time has passed.
StageShares stage_shares(const detent_test::StageTimes& before, const detent_test::StageTimes& after);
/// The two greatest, such as "solve_islands 61 %, collide_pairs 20 %"; empty if there are none.
std::string stages_text(const StageShares& shares);

}  // namespace detent_bench
