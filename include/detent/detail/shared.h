#pragma once

/// DETENT_SHARED marks a function that has many callers and is larger than a call. With -Os the function is never
/// inlined, so a program has one copy of it. At other optimisation levels the compiler decides.
///
/// DETENT_PASSING marks a function that only passes its arguments to a DETENT_SHARED function: at -Os it is always
/// inlined.
///
/// DETENT_SPECIALISED marks an inline function that is fast if its arguments are constants. At -Os it is the same as
/// DETENT_SHARED. At other optimisation levels the function is always inlined.
#if !defined(__OPTIMIZE_SIZE__)
#define DETENT_SHARED
#define DETENT_PASSING
#define DETENT_SPECIALISED __attribute__((always_inline))
#elif defined(__clang__)
#define DETENT_SHARED __attribute__((noinline))
#define DETENT_PASSING __attribute__((always_inline))
#else
#define DETENT_SHARED __attribute__((noinline, noclone))  // GCC would clone it for each file
#define DETENT_PASSING __attribute__((always_inline))
#endif
#if defined(__OPTIMIZE_SIZE__)
#define DETENT_SPECIALISED DETENT_SHARED
#endif
