#pragma once

/// Traps if `condition`, for example on a range or an index, is false. Active only in builds with DETENT_VERIFY (the
/// tests), so a check may be expensive. A check does not change a computed value.
#if defined(DETENT_VERIFY)
#define DETENT_VERIFY_RANGE(condition) ((condition) ? static_cast<void>(0) : __builtin_trap())
#else
#define DETENT_VERIFY_RANGE(condition) static_cast<void>(0)
#endif
