#pragma once
#include <stdint.h>

namespace detent {

#if defined(__x86_64__)
/// The registers that the instruction CPUID returns.
struct ProcessorRegisters {
  uint32_t a, b, c, d;
};
inline ProcessorRegisters ask_processor(uint32_t leaf) {
  ProcessorRegisters r;
  __asm__("cpuid" : "=a"(r.a), "=b"(r.b), "=c"(r.c), "=d"(r.d) : "a"(leaf), "c"(0));
  return r;
}

/// Whether the processor has the features `extended` (register b of leaf 7), FMA and AVX, and the operating system
/// saves the registers `saved` (register XCR0).
inline bool has_vectors(uint32_t extended, uint32_t saved) {
  constexpr uint32_t k_fma_and_saves_registers = 1u << 12 | 1u << 27;
  if (ask_processor(0).a < 7 || (ask_processor(1).c & k_fma_and_saves_registers) != k_fma_and_saves_registers)
    return false;
  uint32_t low = 0, high = 0;
  __asm__("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
  return (low & saved) == saved && (ask_processor(7).b & extended) == extended;
}
/// Whether the program may use AVX2 and FMA.
inline bool has_avx2_and_fma() { return has_vectors(1u << 5, 0x6); }
/// Whether the program may use AVX2, FMA, and AVX-512 F, DQ, CD, BW and VL.
inline bool has_avx512() { return has_vectors(1u << 5 | 1u << 16 | 1u << 17 | 1u << 28 | 1u << 30 | 1u << 31, 0xe6); }
#endif

}  // namespace detent
