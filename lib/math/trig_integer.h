#pragma once
#include "math/wide.h"

/// Integer functions of angles. fx64, fx32 and f32 use them for all angles; lib/distance and lib/toi use them in every
/// configuration.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Sine and cosine, Q2.30, of the angle phase x 2^-34 turns.
struct SineCosineRaw {
  int32_t sine;
  int32_t cosine;
};
SineCosineRaw sine_cosine_raw(int64_t phase);

/// atan2(y, x) in 2^-32 turns. (0, 0) gives 0. Range: |y|, |x| <= 2^31. y and x may have any common scale. A caller
/// that must round them to integers should first scale the larger one to at least 2^29: the rounding then changes the
/// angle by at most 2^-29 rad.
uint32_t arc_tangent_raw(int32_t y, int32_t x);

/// Converts an angle from rad, Q46, to 2^-(32 + extra_bits) turns. Range: 0 <= extra_bits <= 2.
int64_t turns_from_radians_raw(int64_t angle, int extra_bits);
/// Converts signed 2^-32 turns to rad with `frac` fraction bits. Range: 28 < frac <= 60. Rounding: to nearest.
int64_t radians_raw(int32_t turns, int frac);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
