#pragma once

/// DETENT_SPARSE is 1 if the library has sparse rollback (lib/replay/sparse_rollback.h). Microcontrollers have no
/// memory for it, so it is left out of their builds.
#ifndef DETENT_SPARSE
#if defined(__unix__) || defined(_WIN32) || defined(__APPLE__) || defined(__wasm__)
#define DETENT_SPARSE 1
#else
#define DETENT_SPARSE 0
#endif
#endif
