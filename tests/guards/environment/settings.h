#pragma once
#include <fenv.h>
#include <stdint.h>

/// A program's floating-point settings, as a host may have changed them before it calls the library.
struct FloatSettings {
  int rounding;
  uint32_t control;  ///< the control register of the unit that can flush denormals to zero; 0 where there is none
  friend bool operator==(FloatSettings a, FloatSettings b) {
    return a.rounding == b.rounding && a.control == b.control;
  }
};

#if defined(__x86_64__) || defined(__i386__)
inline constexpr uint32_t k_flush = 0x8040;         // results, and operands
inline constexpr uint32_t k_control_sticky = 0x3f;  // exceptions seen so far: no setting
inline uint32_t read_control() {
  uint32_t value;
  __asm__ __volatile__("stmxcsr %0" : "=m"(value));
  return value;
}
inline void write_control(uint32_t value) { __asm__ __volatile__("ldmxcsr %0" : : "m"(value) : "memory"); }
#elif defined(__aarch64__)
inline constexpr uint32_t k_flush = 1u << 24;
inline constexpr uint32_t k_control_sticky = 0;
inline uint32_t read_control() {
  uint64_t value;
  __asm__ __volatile__("mrs %0, fpcr" : "=r"(value));
  return static_cast<uint32_t>(value);
}
inline void write_control(uint32_t value) { __asm__ __volatile__("msr fpcr, %0" : : "r"(uint64_t{value}) : "memory"); }
#elif defined(__arm__)
inline constexpr uint32_t k_flush = 1u << 24;
inline constexpr uint32_t k_control_sticky = 0xf800009f;  // and the flags of the last comparison
inline uint32_t read_control() {
  uint32_t value;
  __asm__ __volatile__("vmrs %0, fpscr" : "=r"(value));
  return value;
}
inline void write_control(uint32_t value) { __asm__ __volatile__("vmsr fpscr, %0" : : "r"(value) : "memory"); }
#elif defined(__mips__)
inline constexpr uint32_t k_flush = 1u << 24;
inline constexpr uint32_t k_control_sticky = 0xfe83f07c;  // and the flags of comparisons
inline uint32_t read_control() {
  uint32_t value;
  __asm__ __volatile__("cfc1 %0, $31" : "=r"(value));
  return value;
}
inline void write_control(uint32_t value) { __asm__ __volatile__("ctc1 %0, $31" : : "r"(value) : "memory"); }
#else
inline constexpr uint32_t k_flush = 0;
inline constexpr uint32_t k_control_sticky = 0;
inline uint32_t read_control() { return 0; }
inline void write_control(uint32_t) {}
#endif

inline FloatSettings float_settings() { return {fegetround(), read_control() & ~k_control_sticky}; }

inline bool flushes_to_zero() { return (read_control() & k_flush) == k_flush; }

/// Rounds upwards, and flushes denormals to zero, as far as the target can. False if it refused.
inline bool set_unusual_floats() {
#if defined(FE_UPWARD)
  if (fesetround(FE_UPWARD) != 0) return false;
#endif
  write_control(read_control() | k_flush);
  return flushes_to_zero();
}
