#pragma once
#include "toi/moving_pair.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// More intervals than this are not certified along one axis.
inline constexpr int k_passes_max = 24;

/// The motion of a pair over a horizon, a part of the step: everything per horizon.
struct Horizon {
  int64_t start, length;  ///< of the step
  Vec32 way;              ///< of B relative to A, Q29 of the pair's unit
  Vec32 spin_a, spin_b;   ///< rad, Q29

  /// The time at `part`, Q30, of the horizon, rounded down.
  int64_t time_at(int64_t part) const {
    if (part >= int64_t{1} << 30) return start + length;
    const Int128 product = Int128::product(length, part);
    return start +
           static_cast<int64_t>((static_cast<uint64_t>(product.high_word()) << 34) | (product.low_word() >> 30));
  }
};
/// The longest horizon that a search takes: 2 rad, in quarter radians. The formats of advance() hold 3.
inline constexpr int k_horizon_quarters = 8;

/// From `start` on, at most `length` of the step and at most so long that both bodies together turn by `turn` quarter
/// radians.
Horizon horizon_from(const MovingPair& pair, int64_t start, int64_t length, int turn_quarters);

/// From `start` on, exactly `length` of the step.
Horizon horizon_over(const MovingPair& pair, int64_t start, int64_t length);

/// How far from the horizon's start the shapes are certain to stay `floor` ulps apart, by the axis
/// n(t) = exp(t spin) normal; `frames` are those at its start: a part of the horizon, Q30. 0 if they are not even so at
/// the start. Range: |spin_x - spin| + 1 < 4 for both bodies, |spin| < 3. Derivation: DESIGN.md, "Never late".
int32_t advance(const MovingPair& pair, const Frames& frames, const Horizon& horizon, const Vec32& normal,
                const Vec32& spin, int32_t floor, uint32_t& passes);

/// The same on and on, horizon after horizon of the same length, until the axis leads no farther: a time.
int64_t advance_on(const MovingPair& pair, const Frames& frames, const Horizon& horizon, const Vec32& normal,
                   const Vec32& spin, int32_t floor, uint32_t& passes);
inline constexpr int k_horizons_max = 8;

/// The same by one step of the paper's bound, or of the first-order one.
int32_t advance_once(const MovingPair& pair, const Frames& frames, const Horizon& horizon, const Vec32& normal,
                     bool tight, int32_t floor, uint32_t& passes);

/// How far apart the cores are along `normal`, less `floor` ulps; Q56 of the pair's unit. Too large by no more than the
/// rounding budget (DESIGN.md), and negative where they overlap along it.
int64_t separation_along(const MovingPair& pair, const Frames& frames, const Vec32& normal, int32_t floor);

/// An axis that turns by `spin`, Q29, over a horizon.
class TurningAxis {
 public:
  TurningAxis(const Vec32& normal, const Vec32& spin);
  /// At a part of the horizon, Q30. Of length 1 within k_turning_axis_error.
  Vec32 at(int64_t part) const;

 private:
  Vec32 normal_, axis_, across_;  ///< across_ = axis x normal
  int64_t rate_, along_;          ///< |spin|, Q29; axis . normal
  bool turns_;
};
inline constexpr double k_turning_axis_error = 8.0;  ///< 2^-30

}  // namespace DETENT_NAMESPACE
}  // namespace detent
