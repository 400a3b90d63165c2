#pragma once

/// Checks a range or an index, and traps if the condition is false. Active only in builds with DETENT_VERIFY (the
/// tests), so a check may be expensive. A check does not change a computed value.
#if defined(DETENT_VERIFY)
#define DETENT_VERIFY_RANGE(condition) ((condition) ? static_cast<void>(0) : __builtin_trap())
#else
#define DETENT_VERIFY_RANGE(condition) static_cast<void>(0)
#endif
