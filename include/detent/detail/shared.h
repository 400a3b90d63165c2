#pragma once

/// DETENT_SHARED: before a function that many call and that takes more code than a call of it. Built for size (-Os) a
/// program has one copy of it; at other levels the compiler decides.
///
/// DETENT_PASSING: before a function that only passes words on to such a one: at -Os it is never a call of its own.
#if !defined(__OPTIMIZE_SIZE__)
#define DETENT_SHARED
#define DETENT_PASSING
#elif defined(__clang__)
#define DETENT_SHARED __attribute__((noinline))
#define DETENT_PASSING __attribute__((always_inline))
#else
#define DETENT_SHARED __attribute__((noinline, noclone))  // GCC would clone it for each file
#define DETENT_PASSING __attribute__((always_inline))
#endif
