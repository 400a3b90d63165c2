#pragma once
#include "tests/bench/timer.h"

namespace detent_bench {

/// What the ticks of timer.h are worth.
struct Clock {
  double ns_per_tick = 1;
  uint64_t overhead = 0;  ///< ticks, of a measurement of nothing

  double ns(uint64_t ticks) const {
    return static_cast<double>(ticks - (ticks < overhead ? ticks : overhead)) * ns_per_tick;
  }
};

/// `time_nothing` gives the ticks of nothing, timed as that which is to be measured.
template <class TimeNothing>
Clock calibrated_clock(const TimeNothing& time_nothing) {
  constexpr uint64_t k_span = 50000000;  // ns
  Clock clock;
  const uint64_t start_ns = monotonic_ns(), start = ticks();
  while (monotonic_ns() - start_ns < k_span) {
  }
  clock.ns_per_tick = static_cast<double>(monotonic_ns() - start_ns) / static_cast<double>(ticks() - start);
  clock.overhead = UINT64_MAX;
  for (int i = 0; i < 10000; ++i) {
    const uint64_t time = time_nothing();
    if (time < clock.overhead) clock.overhead = time;
  }
  return clock;
}

}  // namespace detent_bench
