#pragma once
#include <stdint.h>
#include <time.h>

namespace detent_test {

/// ns that the thread has had a core: it stands still while other processes have it.
inline uint64_t thread_ns() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<uint64_t>(now.tv_sec) * 1000000000u + static_cast<uint64_t>(now.tv_nsec);
}

/// The least ns between two readings.
inline uint64_t thread_clock_overhead() {
  uint64_t least = UINT64_MAX;
  for (int i = 0; i < 1000; ++i) {
    const uint64_t start = thread_ns(), ns = thread_ns() - start;
    if (ns < least) least = ns;
  }
  return least;
}

}  // namespace detent_test
