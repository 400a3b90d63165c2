#pragma once
#include <detent/fixed.h>

/// @file
/// The number types by their use. All code above lib/math uses these names and is compiled once per configuration.
/// Ranges, resolutions and their derivation: SPEC.md, "Numbers".
namespace detent {
inline namespace DETENT_NAMESPACE {

#if defined(DETENT_FX64)
using Coord = Fixed<int64_t, 32>;  ///< a coordinate of a world position, m: +-2^31 m in steps of 2.3e-10 m
#elif defined(DETENT_FX32)
using Coord = Fixed<int32_t, 16>;  ///< m: +-32 km in steps of 1.5e-5 m; the integrator keeps the remainder
#elif defined(DETENT_F32)
using Coord = Fixed<int64_t, 32>;  ///< m: as in fx64
#else
using Coord = double;  ///< m
#endif

#if DETENT_FIXED
using Real = Fixed<int64_t, 46>;  ///< lengths, times, speeds, m, s, m/s: +-131 km/s in steps of 1.4e-14
using Unit = Fixed<int32_t, 30>;  ///< dimensionless, in (-2, 2): rotations, normals, lengths relative to a power of two
#elif defined(DETENT_F32)
using Real = float;
using Unit = float;
#else
using Real = double;
using Unit = double;
#endif

}  // namespace DETENT_NAMESPACE
}  // namespace detent
