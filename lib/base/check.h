#pragma once

/// Checks a range or an index in builds with DETENT_VERIFY (the tests), even if that is expensive; traps if it fails.
/// It never changes a computed value.
#if defined(DETENT_VERIFY)
#define DETENT_VERIFY_RANGE(condition) ((condition) ? static_cast<void>(0) : __builtin_trap())
#else
#define DETENT_VERIFY_RANGE(condition) static_cast<void>(0)
#endif
