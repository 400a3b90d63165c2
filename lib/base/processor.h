#pragma once
#include <stdint.h>

namespace detent {

#if defined(__x86_64__)
/// True if the processor has AVX2 and FMA, and the operating system saves their registers.
inline bool has_avx2_and_fma() {
  struct Registers {
    uint32_t a, b, c, d;
  };
  const auto ask = [](uint32_t leaf) {
    Registers r;
    __asm__("cpuid" : "=a"(r.a), "=b"(r.b), "=c"(r.c), "=d"(r.d) : "a"(leaf), "c"(0));
    return r;
  };
  constexpr uint32_t k_fma_and_saves_registers = 1u << 12 | 1u << 27, k_avx2 = 1u << 5, k_wide_registers = 6;
  if (ask(0).a < 7 || (ask(1).c & k_fma_and_saves_registers) != k_fma_and_saves_registers) return false;
  uint32_t low = 0, high = 0;
  __asm__("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
  return (low & k_wide_registers) == k_wide_registers && (ask(7).b & k_avx2) != 0;
}
#endif

}  // namespace detent
