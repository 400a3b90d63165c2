#pragma once
#include <stdint.h>

/// The CMSDK timer of the board mps2-an385. It counts down at 25 MHz, and under `-icount shift=6` an instruction takes
/// 64 ns: 1.6 ticks.
inline volatile uint32_t* timer_registers() { return reinterpret_cast<volatile uint32_t*>(0x40000000); }

inline void start_timer() {
  volatile uint32_t* const timer = timer_registers();
  timer[2] = 0xffffffff;  // reload
  timer[1] = 0xffffffff;  // value
  timer[0] = 1;           // on
}

inline uint32_t timer_value() {
  __asm__ volatile("" ::: "memory");
  const uint32_t value = timer_registers()[1];
  __asm__ volatile("" ::: "memory");
  return value;
}

/// To the nearest.
constexpr uint64_t instructions_of(uint64_t ticks) { return (ticks * 5 + 4) / 8; }
