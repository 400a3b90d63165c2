#pragma once
/// @file
/// Selects which of the four math configurations this translation unit uses.
///
/// Define exactly one of DETENT_FX64, DETENT_FX32, DETENT_F32, DETENT_F64, or none for fx64. The CMake targets
/// detent::fx64, ... define it. Every name is in an inline namespace of the configuration. Therefore code that was
/// built for one configuration does not link with the library of another, and all four can be linked into one program.

#if __cplusplus <= 201703L && (!defined(_MSVC_LANG) || _MSVC_LANG <= 201703L)
#error "detent: needs C++20, or later (-std=c++20)"
#endif
#if defined(DETENT_FX64) + defined(DETENT_FX32) + defined(DETENT_F32) + defined(DETENT_F64) > 1
#error "detent: define one of DETENT_FX64, DETENT_FX32, DETENT_F32, DETENT_F64, not several"
#endif
/// @cond
#if defined(DETENT_FX32)
#define DETENT_NAMESPACE fx32
#define DETENT_FIXED 1
#elif defined(DETENT_F32)
#define DETENT_NAMESPACE f32
#define DETENT_FIXED 0
#elif defined(DETENT_F64)
#define DETENT_NAMESPACE f64
#define DETENT_FIXED 0
#else
#if !defined(DETENT_FX64)
#define DETENT_FX64 1
#endif
#define DETENT_NAMESPACE fx64
#define DETENT_FIXED 1
#endif

// 1 if the library has sparse rollback (RollbackDef::sparse). Machines without an operating system have no memory for
// it, so it is left out of their builds.
#ifndef DETENT_SPARSE
#if defined(__unix__) || defined(_WIN32) || defined(__APPLE__) || defined(__wasm__)
#define DETENT_SPARSE 1
#else
#define DETENT_SPARSE 0
#endif
#endif
/// @endcond

#include <stdint.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The configuration as data: the value stored in snapshots and recordings. A value is never reused.
enum class Config : uint32_t {
  fx64 = 1,  ///< fixed point, positions of 64 bits
  fx32 = 2,  ///< fixed point, positions of 32 bits
  f32 = 3,   ///< float, positions of 64 bits in fixed point
  f64 = 4,   ///< double
};

/// The configuration that this translation unit uses.
#if defined(DETENT_FX64)
inline constexpr Config k_config = Config::fx64;
#elif defined(DETENT_FX32)
inline constexpr Config k_config = Config::fx32;
#elif defined(DETENT_F32)
inline constexpr Config k_config = Config::f32;
#else
inline constexpr Config k_config = Config::f64;
#endif

/// The simulation version. It increases with every change of the library that can alter the result of a step, and
/// thereby a digest. Stored in snapshots and recordings.
inline constexpr uint32_t k_simulation_version = 36;

}  // namespace DETENT_NAMESPACE
}  // namespace detent
