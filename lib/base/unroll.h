#pragma once

/// Before a loop of a few rounds, known at compile time, whose body the compiler should write out: its arrays then live
/// in registers. Not where code must be small.
#if defined(__OPTIMIZE_SIZE__)
#define DETENT_UNROLL
#elif defined(__clang__)
#define DETENT_UNROLL _Pragma("clang loop unroll(full)")
#else
#define DETENT_UNROLL _Pragma("GCC unroll 8")
#endif
