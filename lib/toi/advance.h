#pragma once
#include "toi/moving_pair.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The maximum number of passes of a call of advance(). Each pass certifies one interval along the axis.
inline constexpr int k_passes_max = 24;

/// The motion of a pair over a horizon, which is a part of the step. Displacements and rotation vectors are those over
/// the whole horizon.
struct Horizon {
  int64_t start, length;                         ///< start and length of the horizon, 2^-62 of the step
  Vec32 displacement;                            ///< translation of B relative to A, Q29 of the pair's unit of length
  Vec32 angular_velocity_a, angular_velocity_b;  ///< rotation vectors of A and of B, rad, Q29

  /// The time, 2^-62 of the step, at which the part `part` (Q30) of the horizon has passed; rounded down.
  int64_t time_at(int64_t part) const {
    if (part >= int64_t{1} << 30) return start + length;
    const Int128 product = Int128::product(length, part);
    return start +
           static_cast<int64_t>((static_cast<uint64_t>(product.high_word()) << 34) | (product.low_word() >> 30));
  }
};
/// The largest sum of both bodies' rotation angles over a horizon of a search, in quarter radians: 2 rad. The number
/// formats of advance() hold 3 rad.
inline constexpr int k_horizon_quarters = 8;

/// The horizon that begins at `start` and lasts at most `length`, both in 2^-62 of the step. It is shortened so that
/// the rotation angles of both bodies add up to at most `angle_quarters` quarter radians.
Horizon horizon_from(const MovingPair& pair, int64_t start, int64_t length, int angle_quarters);

/// The horizon that begins at `start` and lasts exactly `length`, both in 2^-62 of the step.
Horizon horizon_over(const MovingPair& pair, int64_t start, int64_t length);

/// Certifies how long the cores stay at least `floor` apart (in ulps of the pair's block) along the rotating axis n(t)
/// = exp(t angular_velocity) normal, where t is a part of the horizon and `angular_velocity` the rotation vector of the
/// axis over the whole horizon. `frames` are the poses at the horizon's start. Adds the number of its passes to
/// `passes`. Returns the certified part of the horizon, Q30; 0 if the cores are closer than `floor` at the start.
/// Range, rad: |w - angular_velocity| + 1 < 4 for the rotation vector w of each body, |angular_velocity| < 3.
/// Derivation: docs/design/time_of_impact.md, "Conservative advancement, never late".
int32_t advance(const MovingPair& pair, const Frames& frames, const Horizon& horizon, const Vec32& normal,
                const Vec32& angular_velocity, int32_t floor, uint32_t& passes);

/// Calls advance() for consecutive horizons of the same length, at most k_horizons_max of them. Stops at the first
/// horizon of which advance() certifies only a part, or when the window in which the bounding spheres touch ends
/// (MovingPair::to). Returns the time, 2^-62 of the step, up to which the axis certifies the separation.
int64_t advance_on(const MovingPair& pair, const Frames& frames, const Horizon& horizon, const Vec32& normal,
                   const Vec32& angular_velocity, int32_t floor, uint32_t& passes);
inline constexpr int k_horizons_max = 8;

/// Certifies a part of the horizon as advance() does, but in a single pass along the fixed axis n = `normal`. The speed
/// of the points of a body with rotation vector w and core radius rho is bounded by rho |n x w| if `tight`, otherwise
/// by rho |w| (as ToiMethod::paper does).
int32_t advance_once(const MovingPair& pair, const Frames& frames, const Horizon& horizon, const Vec32& normal,
                     bool tight, int32_t floor, uint32_t& passes);

/// Returns the separation of the cores along `normal` minus `floor` (in ulps of the pair's block); Q56 of the pair's
/// unit of length. The result is too large by at most the rounding budget (docs/design/time_of_impact.md, "The rounding
/// budget"). It is negative if the cores are closer than `floor` along `normal`.
int64_t separation_along(const MovingPair& pair, const Frames& frames, const Vec32& normal, int32_t floor);

/// An axis that rotates by the rotation vector `angular_velocity`, Q29, over a horizon.
class RotatingAxis {
 public:
  RotatingAxis(const Vec32& normal, const Vec32& angular_velocity);
  /// The axis at a part of the horizon, Q30. Its length is 1 within k_turning_axis_error.
  Vec32 at(int64_t part) const;

 private:
  Vec32 normal_, axis_, across_;  ///< across_ = axis x normal
  int64_t rate_, along_;          ///< |angular velocity|, Q29; axis . normal
  bool turns_;
};
inline constexpr double k_turning_axis_error = 8.0;  ///< units of 2^-30

}  // namespace DETENT_NAMESPACE
}  // namespace detent
