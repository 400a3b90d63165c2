#pragma once

/// Before a function that many call and that takes more code than a call of it: built for size (-Os) a program has one
/// copy of it. At other levels the compiler decides.
#if !defined(__OPTIMIZE_SIZE__)
#define DETENT_SHARED
#elif defined(__clang__)
#define DETENT_SHARED __attribute__((noinline))
#else
#define DETENT_SHARED __attribute__((noinline, noclone))  // GCC would clone it for each file
#endif
