#pragma once

/// An expensive proof of a range or index, in builds with DETENT_VERIFY (the tests). It never changes a computed value.
#if defined(DETENT_VERIFY)
#define DETENT_VERIFY_RANGE(condition) ((condition) ? static_cast<void>(0) : __builtin_trap())
#else
#define DETENT_VERIFY_RANGE(condition) static_cast<void>(0)
#endif
