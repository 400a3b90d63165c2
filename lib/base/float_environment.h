#pragma once
#include <detent/config.h>

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || \
    (defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ != 0 && !DETENT_FIXED)
#error "detent: the library must be compiled without -ffast-math and, in f32 and f64, without x87 (-msse2 -mfpmath=sse)"
#endif

namespace detent {
inline namespace DETENT_NAMESPACE {

/// While a FloatEnvironment exists, the floating-point unit rounds to nearest and keeps denormals. Its destructor
/// restores the caller's settings. In f32 and f64, every public call that computes creates a FloatEnvironment. The
/// class is empty in the fixed-point configurations, and on targets without such settings.
#if DETENT_FIXED || defined(__wasm__)
#define DETENT_FLOAT_CONTROL 0
#elif defined(__x86_64__) || defined(__i386__)
#define DETENT_FLOAT_CONTROL 1
using FloatControl = uint32_t;
inline FloatControl float_control_read() {
  FloatControl value;
  __asm__ __volatile__("stmxcsr %0" : "=m"(value));
  return value;
}
inline void float_control_write(FloatControl value) { __asm__ __volatile__("ldmxcsr %0" : : "m"(value) : "memory"); }
inline constexpr FloatControl k_float_control_ieee = 0x1f80;  // all exceptions masked
#elif defined(__aarch64__)
#define DETENT_FLOAT_CONTROL 1
using FloatControl = uint64_t;
inline FloatControl float_control_read() {
  FloatControl value;
  __asm__ __volatile__("mrs %0, fpcr" : "=r"(value));
  return value;
}
inline void float_control_write(FloatControl value) { __asm__ __volatile__("msr fpcr, %0" : : "r"(value) : "memory"); }
inline constexpr FloatControl k_float_control_ieee = 0;
#elif defined(__arm__) && defined(__ARM_FP) && !defined(__SOFTFP__)
#define DETENT_FLOAT_CONTROL 1
using FloatControl = uint32_t;
inline FloatControl float_control_read() {
  FloatControl value;
  __asm__ __volatile__("vmrs %0, fpscr" : "=r"(value));
  return value;
}
inline void float_control_write(FloatControl value) {
  __asm__ __volatile__("vmsr fpscr, %0" : : "r"(value) : "memory");
}
#if defined(__ARM_FEATURE_MVE)
inline constexpr FloatControl k_float_control_ieee = 0x40000;  // LTPSIZE 4: no tail predication in vector loops
#else
inline constexpr FloatControl k_float_control_ieee = 0;
#endif
#elif defined(__riscv) && defined(__riscv_flen)
#define DETENT_FLOAT_CONTROL 1
using FloatControl = unsigned long;
inline FloatControl float_control_read() {
  FloatControl value;
  __asm__ __volatile__("frcsr %0" : "=r"(value));
  return value;
}
inline void float_control_write(FloatControl value) { __asm__ __volatile__("fscsr %0" : : "r"(value) : "memory"); }
inline constexpr FloatControl k_float_control_ieee = 0;
#elif defined(__s390x__)
#define DETENT_FLOAT_CONTROL 1
using FloatControl = uint32_t;
inline FloatControl float_control_read() {
  FloatControl value;
  __asm__ __volatile__("efpc %0" : "=d"(value));
  return value;
}
inline void float_control_write(FloatControl value) { __asm__ __volatile__("sfpc %0" : : "d"(value) : "memory"); }
inline constexpr FloatControl k_float_control_ieee = 0;
#elif defined(__powerpc64__)
#define DETENT_FLOAT_CONTROL 1
using FloatControl = double;
inline FloatControl float_control_read() {
  FloatControl value;
  __asm__ __volatile__("mffs %0" : "=d"(value));
  return value;
}
inline void float_control_write(FloatControl value) {
  __asm__ __volatile__("mtfsf 0xff, %0" : : "d"(value) : "memory");
}
inline constexpr FloatControl k_float_control_ieee = 0.0;
#elif defined(__mips__) && defined(__mips_hard_float)
#define DETENT_FLOAT_CONTROL 1
using FloatControl = uint32_t;
inline FloatControl float_control_read() {
  FloatControl value;
  __asm__ __volatile__("cfc1 %0, $31" : "=r"(value));
  return value;
}
inline void float_control_write(FloatControl value) { __asm__ __volatile__("ctc1 %0, $31" : : "r"(value) : "memory"); }
inline constexpr FloatControl k_float_control_ieee = 0;
#elif (defined(__arm__) && (defined(__SOFTFP__) || !defined(__ARM_FP))) || (defined(__riscv) && !defined(__riscv_flen))
#define DETENT_FLOAT_CONTROL 0  // software arithmetic has no modes
#else
#error "detent: f32 and f64 need to know this target's floating-point control register"
#endif

#if DETENT_FLOAT_CONTROL
struct FloatEnvironment {
  FloatControl callers;
  FloatEnvironment() : callers(float_control_read()) { float_control_write(k_float_control_ieee); }
  ~FloatEnvironment() { float_control_write(callers); }
  FloatEnvironment(const FloatEnvironment&) = delete;
  FloatEnvironment& operator=(const FloatEnvironment&) = delete;
};
#else
struct FloatEnvironment {
  FloatEnvironment() {}  // user-provided, so that an unused variable causes no warning
};
#endif

}  // namespace DETENT_NAMESPACE
}  // namespace detent
