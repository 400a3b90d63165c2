#pragma once

/// Put before a loop with a small constant number of rounds. The compiler unrolls the loop, so that its arrays live in
/// registers. Empty if code must be small, and with clang, which unrolls by itself and warns about loops that it does
/// not unroll.
#if defined(__OPTIMIZE_SIZE__) || defined(__clang__)
#define DETENT_UNROLL
#else
#define DETENT_UNROLL _Pragma("GCC unroll 8")
#endif
