#pragma once
#include <stdint.h>
#include <time.h>
#if defined(__x86_64__) || defined(__i386__)
#include <x86intrin.h>
#endif

/// The clock of the benchmark, in its own ticks.
namespace detent_bench {

inline uint64_t monotonic_ns() {
  timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<uint64_t>(now.tv_sec) * 1000000000u + static_cast<uint64_t>(now.tv_nsec);
}

/// Nothing before it is measured with what is after it.
inline uint64_t ticks() {
#if defined(__x86_64__) || defined(__i386__)
  _mm_lfence();
  const uint64_t now = __rdtsc();
  _mm_lfence();
  return now;
#else
  return monotonic_ns();
#endif
}

}  // namespace detent_bench
