#include "toi_methods/ballistic.h"

#include "math/root.h"
#include "math/trig_integer.h"
#include "toi/advance.h"
#include "toi/axis_by_axis.h"
#include "toi/conservative_advancement.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr int k_steps_max = 12;                       ///< steps of Newton's method along one normal, all certified
constexpr int64_t k_quarter_turn = int64_t{1} << 32;  ///< 2^-34 revolutions
constexpr int64_t k_phase_error = 2;  ///< error of a half angle, 2^-34 revolutions, by the roundings of rate and shift
constexpr int64_t k_sine_error_above = 1;  ///< error of sine_cosine_raw(), 2^-30, rounded up

/// Bounds on how much a motion has reduced the separation, and on the speed at which the separation decreases further.
struct Taken {
  int64_t displacement;  ///< ulps of the pair's block
  int64_t speed;         ///< ulps of the pair's block over the step
};

/// A bound on the amount by which a body's rotation reduces the separation along a normal.
class Swing {
 public:
  /// `core`: the core radius of the body, ulps.
  Swing(const Turning& turning, const Vec32& normal, int64_t core) : turning_(turning) {
    if (!turning.turns || core == 0) return;
    const Vec32 across = round_shift(cross(normal, turning.axis), 30);
    // The errors of the axis, of both lengths and of these roundings add up to less than 20 2^-30.
    const int64_t length = int64_t{square_root_nearest(static_cast<uint64_t>(dot(across, across)))} + 20;
    chord_ = ((2 * core * length) >> 30) + 1;
  }

  Taken at(int64_t elapsed) const {
    if (chord_ == 0) return {0, 0};
    const int64_t half_angle = (over_time(turning_.rate, elapsed) >> 13) + k_phase_error;
    if (half_angle >= k_quarter_turn) return {chord_, 0};
    const SineCosineRaw half = sine_cosine_raw(half_angle);
    const auto part = [this](int64_t of_one) { return ((chord_ * of_one) >> 30) + 1; };
    const int64_t lever = part(half.cosine + k_sine_error_above + 2 * k_phase_error);  // phase error < 2^-31 rad
    return {part(half.sine + k_sine_error_above), Int128::product(lever, turning_.angle).round_shift(47) + 1};
  }

 private:
  const Turning& turning_;
  int64_t chord_ = 0;  ///< 2 rho |n x axis|, ulps, rounded up
};

/// The speed at which B moves away from A along a normal: ulps over the step, rounded down.
int64_t leaving_speed(const MovingPair& pair, const Vec32& normal) {
  return ((dot(pair.displacement, normal).round_shift(30) - 1) >> (pair.exponent + 16)) - 1;
}

/// The time up to which the normal certifies the separation.
int64_t ballistic_time(const MovingPair& pair, const Frames& frames, const Vec32& normal, int32_t floor,
                       uint32_t& passes) {
  const int64_t room = separation_along(pair, frames, normal, floor) >> 26;  // ulps
  const int64_t speed = leaving_speed(pair, normal), rest = pair.to - frames.time;
  const Swing swing_a(pair.turning_a, normal, pair.core_a), swing_b(pair.turning_b, normal, pair.core_b);
  int64_t elapsed = 0;
  for (int step = 0; step < k_steps_max; ++step) {
    ++passes;
    const Taken a = swing_a.at(elapsed), b = swing_b.at(elapsed);
    const int64_t left = room + over_time(speed, elapsed) - a.displacement - b.displacement;
    if (left <= 0) break;
    const int64_t fall = a.speed + b.speed - speed;
    if (fall <= 0) return pair.to;  // `fall` only decreases with time, so the gap does not close
    const int64_t gain = time_quotient(left, fall);
    if (gain >= rest - elapsed) return pair.to;
    elapsed += gain;
    if (gain < elapsed >> 5) break;  // a new normal would gain more time
  }
  return frames.time + elapsed;
}

}  // namespace

void ballistic_advancement(const MovingPair& pair, TimeOfImpact& result) {
  const Turning& plane = pair.a->type == ShapeType::half_space ? pair.turning_a : pair.turning_b;
  if (pair.planar && plane.turns) return conservative_advancement(pair, ToiMethod::paper, result);
  advance_by_axes(pair, k_toi_iterations_compared_max, INT32_MAX, result,
                  [&](const Frames& frames, const Simplex&, const GjkResult& nearest, int, int32_t floor) {
                    return ballistic_time(pair, frames, nearest.normal, floor, result.passes);
                  });
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
