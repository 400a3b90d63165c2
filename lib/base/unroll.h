#pragma once

/// Place this macro before a loop with a small constant number of rounds. GCC then unrolls the loop, so that the arrays
/// in it are in registers. The macro is empty in builds for size. It is also empty with clang, which unrolls such loops
/// by itself, and which would warn about a loop that it cannot unroll.
#if defined(__OPTIMIZE_SIZE__) || defined(__clang__)
#define DETENT_UNROLL
#else
#define DETENT_UNROLL _Pragma("GCC unroll 8")
#endif
