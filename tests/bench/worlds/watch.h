#pragma once
#include <time.h>

#include "tests/bench/timer.h"

namespace detent_bench {

/// Seconds since its making: by the wall clock, and of the processors that the threads of this process had.
class Watch {
 public:
  double wall() const { return static_cast<double>(monotonic_ns() - wall_) * 1e-9; }
  double cpu() const { return static_cast<double>(cpu_ns() - cpu_) * 1e-9; }

 private:
  static uint64_t cpu_ns() {
    timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<uint64_t>(now.tv_sec) * 1000000000u + static_cast<uint64_t>(now.tv_nsec);
  }

  uint64_t wall_ = monotonic_ns();
  uint64_t cpu_ = cpu_ns();
};

}  // namespace detent_bench
