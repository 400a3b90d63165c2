#pragma once

/// Before a loop of a few rounds, known at compile time, whose body the compiler should write out: its arrays then live
/// in registers. Not where code must be small. Clang does so by itself, and complains of loops that it does not.
#if defined(__OPTIMIZE_SIZE__) || defined(__clang__)
#define DETENT_UNROLL
#else
#define DETENT_UNROLL _Pragma("GCC unroll 8")
#endif
