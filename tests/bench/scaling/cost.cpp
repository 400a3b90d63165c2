#include <detent/tasks.h>

#include <algorithm>

#include "base/team.h"
#include "tests/bench/scaling/engine.h"
#include "tests/bench/timer.h"
#include "threads/thread_pool.h"

namespace detent_bench {

namespace {

/// Keeps the thread busy.
void work_for(uint64_t ns) {
  const uint64_t start = monotonic_ns();
  while (monotonic_ns() - start < ns) {
  }
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0 : values[values.size() / 2];
}

}  // namespace

SharingCost measure_sharing_cost() {
  constexpr uint32_t k_rounds = 50, k_loops = 200;
  constexpr uint64_t k_part = 5000;  // ns
  detent_host::ThreadPool pool(2);
  const detent::Tasks tasks = pool.tasks<detent::Tasks>();
  std::vector<double> loops, groups;
  for (uint32_t round = 0; round < k_rounds; ++round) {
    const uint64_t begun = monotonic_ns();
    bool helped = false;
    detent::with_team(tasks, [&](detent::Team* team) {
      for (uint32_t i = 0; i < k_loops; ++i) {
        const uint64_t start = monotonic_ns();
        detent::share(team, 2, 1, [&](uint32_t, uint32_t) { work_for(k_part); });
        const uint64_t ns = monotonic_ns() - start;
        if (ns > k_part + k_part / 2) continue;  // one thread has worked on both parts
        if (!helped) groups.push_back(static_cast<double>(start - begun));
        helped = true;
        loops.push_back(static_cast<double>(ns - k_part));
      }
    });
  }
  return {median(loops), median(groups)};
}

}  // namespace detent_bench
