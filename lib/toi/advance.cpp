#include "toi/advance.h"

#include "math/root.h"
#include "math/trig_integer.h"

// Number formats. Q30: parts of the horizon, lengths in the block. Q29: rotation vectors, translations, directions.
// Q56: separations.

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// Returns n x u in Q29, for n in Q30 and u in Q29.
Vec32 cross_29(const Vec32& n, const Vec32& u) { return round_shift(cross(n, u), 30); }

/// An upper bound of a b 2^-n, too large by at most 1. Range: a, b >= 0.
int64_t product_above(int64_t a, int64_t b, int n) { return ((a * b) >> n) + 1; }

/// The vector v in a body's axes, with one fractional bit less than v.
Vec32 to_local_29(const Matrix32& rotation, const Vec32& v) {
  const auto component = [&](const Vec32& column) {
    return static_cast<int32_t>((dot(v, column) + (int64_t{1} << 30)) >> 31);
  };
  return {component(rotation.column[0]), component(rotation.column[1]), component(rotation.column[2])};
}

/// The contribution of one body to the separation along an axis, and to K, the bound on the second derivative of this
/// separation (Separation::curvature()). The axis rotates by `angular_velocity`, rad, over the horizon (Horizon).
class Side {
 public:
  /// `sign`: -1 for A, which contributes its farthest point along the axis; 1 for B, which contributes its farthest
  /// point against the axis.
  Side(const Convex& convex, const Turning& turning, const Vec32& own_angular_velocity, const Vec32& angular_velocity,
       int32_t core, int pair_exponent, int sign)
      : convex_(convex),
        hull_(hull_of(convex)),
        turning_(turning),
        core_(core),
        shift_(pair_exponent - convex.exponent),
        sign_(sign) {
    present_ = core != 0;
    relative_ = subtract(own_angular_velocity, angular_velocity);
    still_ = is_zero(relative_);
    if (!present_ || still_) return;
    speed_ = length_bound_32(relative_);
    // w: the body's own angular velocity; u = w - angular_velocity. So |w x angular_velocity| is equal to
    // |u x angular_velocity|.
    twist_ = is_zero(own_angular_velocity) || is_zero(angular_velocity)
                 ? 0
                 : length_bound_32(round_shift(cross(relative_, angular_velocity), 29));
  }

  /// Sets the axis at the start of a pass. If the body rotates with the axis, one call is enough for all passes.
  void look(const Matrix32& rotation, const Vec32& normal) {
    normal_ = to_local_29(rotation, normal);
    if (still_) {
      value_ = share({0, 0, 0}, 0).value;
      return;
    }
    const Vec32 slope = cross_29(normal, relative_);
    across_ = length_bound_32(slope);
    slope_ = rotate_inverse(rotation, slope);
  }
  bool moves() const { return present_ && !still_; }
  bool present() const { return present_; }
  Matrix32 rotation_at(int64_t time) const { return turning_.at(time); }

  /// Returns a bound, Q26, on the magnitude of the second derivative of this body's part of the separation: rho (|n x
  /// u| |u| + |w x angular_velocity|). Here n is the axis, rho the core radius, w the body's own angular velocity and u
  /// = w - angular_velocity. In the time `rest`, |n x u| grows by at most |n x angular_velocity| |u| `rest`. `tilt` is
  /// |n x angular_velocity|.
  int64_t curvature(int64_t tilt, int64_t rest) const {
    if (!moves()) return 0;
    const int64_t grown = across_ + (tilt == 0 ? 0 : product_above(product_above(tilt, speed_, 29), rest, 30));
    return product_above(product_above(grown < speed_ ? grown : speed_, speed_, 29) + twist_, core_, 33);
  }

  struct Share {
    int64_t value;  ///< Q56
    int64_t slope;  ///< Q30
  };
  Share at(int64_t x) const {
    if (!present_) return {0, 0};
    return still_ ? Share{value_, 0} : share(slope_, x);
  }

 private:
  Share share(const Vec32& slope, int64_t x) const {
    const auto along = [&](int32_t n, int32_t m) { return n + static_cast<int32_t>((m * x) >> 30); };
    const Vec32 direction = {along(normal_.x, slope.x), along(normal_.y, slope.y), along(normal_.z, slope.z)};
    const SupportValue farthest = sign_ < 0 ? support_value(convex_, hull_, direction, slope, start_)
                                            : support_value(convex_, hull_, negate(direction), negate(slope), start_);
    return {-(farthest.value >> (3 + shift_)), -(farthest.rate >> (29 + shift_))};
  }

  const Convex& convex_;
  const HullView hull_;
  const Turning& turning_;
  int64_t core_;
  int shift_, sign_;
  bool present_, still_;
  /// u = w - angular_velocity, Q29; w: the body's own angular velocity.
  Vec32 relative_;
  int64_t speed_ = 0, twist_ = 0, across_ = 0;    ///< |u|, |w x angular_velocity|, |n x u|, Q29
  Vec32 normal_ = {0, 0, 0}, slope_ = {0, 0, 0};  ///< n and n x u, Q29, in the body's axes
  int64_t value_ = 0;
  mutable uint8_t start_ = 0;
};

/// A lower bound of the separation along a rotating axis, as a function of the time since the start of a pass.
class Separation {
 public:
  Separation(const MovingPair& pair, const Horizon& horizon, const Vec32& normal, const Vec32& angular_velocity,
             int32_t floor)
      : pair_(pair),
        horizon_(horizon),
        angular_velocity_(angular_velocity),
        floor_(floor),
        a_(*pair.a, pair.turning_a, horizon.angular_velocity_a, angular_velocity, pair.core_a, pair.exponent, -1),
        b_(*pair.b, pair.turning_b, horizon.angular_velocity_b, angular_velocity, pair.core_b, pair.exponent, 1) {
    if (is_zero(angular_velocity)) return;
    tilt_ = length_bound_32(cross_29(normal, angular_velocity));
    // The contribution of the centres to the curvature bound K is |n x angular_velocity| (2 |V| + |angular_velocity|
    // max |C|), where V is the displacement over the horizon and C the offset of the centres.
    const int64_t speed = 2 * length_bound_32(horizon.displacement) +
                          product_above(length_bound_32(angular_velocity), pair.distance_max, 30);
    centre_curvature_ = product_above(tilt_, speed, 32);
  }

  void start(const Frames& frames, const Vec32& normal) {
    if (a_.present()) a_.look(frames.a, normal);
    if (b_.present()) b_.look(frames.b, normal);
    set_centre(frames.offset, normal, 0);
  }
  void go_on(int64_t part, const Vec32& normal) {
    const int64_t time = horizon_.time_at(part);
    if (a_.moves()) a_.look(a_.rotation_at(time), normal);
    if (b_.moves()) b_.look(b_.rotation_at(time), normal);
    set_centre(pair_.offset_at(time), normal, part);
  }

  /// The curvature bound K: the magnitude of the second derivative of the separation is at most K. Q26.
  int64_t curvature() const { return curvature_; }

  struct Value {
    int64_t separation;  ///< separation of the cores minus the required distance `floor_`, Q56
    int64_t slope;       ///< slope of the lower bound for the support points at this time, Q30
  };
  /// `x`: time since the pass's start, Q30 of the horizon.
  Value at(int64_t x) const {
    const Side::Share a = a_.at(x), b = b_.at(x);
    return {centre_ + ((centre_slope_ * x) >> 4) + a.value + b.value - ((curvature_ * (((x * x) >> 30) + 1)) >> 1),
            centre_slope_ + a.slope + b.slope - ((curvature_ * x) >> 26)};
  }

 private:
  void set_centre(const Vec32& offset, const Vec32& normal, int64_t part) {
    centre_ = (dot(normal, offset) >> 4) - (int64_t{floor_} << 26);
    centre_slope_ = dot(normal, horizon_.displacement) >> 29;
    if (!is_zero(angular_velocity_)) centre_slope_ += dot(cross_29(angular_velocity_, normal), offset) >> 29;
    curvature_ = centre_curvature_ + a_.curvature(tilt_, k_one_64 - part) + b_.curvature(tilt_, k_one_64 - part);
  }

  const MovingPair& pair_;
  const Horizon& horizon_;
  Vec32 angular_velocity_;
  int32_t floor_;
  Side a_, b_;
  int64_t tilt_ = 0, centre_curvature_ = 0, curvature_ = 0;
  int64_t centre_ = 0, centre_slope_ = 0;  ///< axis . offset of the centres, minus `floor_`, Q56; its slope, Q30
};

/// Returns the root x > 0 of separation + slope x - K x^2 / 2, where K is `curvature`; Q30, at most `limit`. The root
/// is only a first guess.
int64_t parabola_root(int64_t separation, int64_t slope, int64_t curvature, int64_t limit) {
  const int64_t s = separation >> 28;                                         // Q28
  const int64_t b = slope >> 4;                                               // Q26
  const int64_t k = curvature;                                                // Q26
  const uint64_t square = static_cast<uint64_t>(b * b + ((2 * k * s) >> 2));  // Q52
  const int64_t denominator = int64_t{square_root_floor(square)} - b;         // Q26
  if (denominator <= 0) return limit;
  const int64_t numerator = 2 * (separation >> 27);  // Q29
  if (numerator >= denominator << 3) return limit;
  const int64_t x = (numerator << 27) / denominator;
  return x < limit ? x : limit;
}

}  // namespace

Horizon horizon_from(const MovingPair& pair, int64_t start, int64_t length, int angle_quarters) {
  const int64_t half_limit = int64_t{angle_quarters} << 43;  // 2^-46 rad
  const int64_t half_angle = pair.turning_a.angle / 2 + pair.turning_b.angle / 2 + 1;
  if (over_time(half_angle, length) > half_limit) length = time_quotient(half_limit, half_angle);
  return horizon_over(pair, start, length);
}

Horizon horizon_over(const MovingPair& pair, int64_t start, int64_t length) {
  Horizon horizon;
  horizon.start = start;
  horizon.length = length;
  horizon.displacement = round_shift(over_time(pair.displacement, length), pair.exponent + 17);
  horizon.angular_velocity_a = round_shift(over_time(pair.turning_a.rotation_vector, length), 17);
  horizon.angular_velocity_b = round_shift(over_time(pair.turning_b.rotation_vector, length), 17);
  return horizon;
}

RotatingAxis::RotatingAxis(const Vec32& normal, const Vec32& angular_velocity)
    : normal_(normal), turns_(!is_zero(angular_velocity)) {
  if (!turns_) return;
  axis_ = unit_vector_raw(scaled_to_30_bits(angular_velocity));
  rate_ = dot(axis_, angular_velocity) >>
          30;  // the relative error of |axis|, 2^-28, is also that of the angle (at most 3 rad)
  along_ = static_cast<int32_t>(dot(axis_, normal) >> 30);
  across_ = round_shift(cross(axis_, normal), 30);
}

Vec32 RotatingAxis::at(int64_t part) const {
  if (!turns_ || part == 0) return normal_;
  constexpr int64_t k_radian = 2734261103;  // 2^34 / 2 pi
  const SineCosineRaw full = sine_cosine_raw((((rate_ * part) >> 30) * k_radian) >> 29);
  const int64_t kept = (along_ * (k_one_64 - full.cosine)) >> 30;
  const auto component = [&](int64_t n, int64_t c, int64_t k) {
    return round_30(n * full.cosine + c * full.sine + kept * k);
  };
  return {component(normal_.x, across_.x, axis_.x), component(normal_.y, across_.y, axis_.y),
          component(normal_.z, across_.z, axis_.z)};
}

int32_t advance(const MovingPair& pair, const Frames& frames, const Horizon& horizon, const Vec32& normal,
                const Vec32& angular_velocity, int32_t floor, uint32_t& passes) {
  Separation separation(pair, horizon, normal, angular_velocity, floor);
  const RotatingAxis axis(normal, angular_velocity);
  const int64_t enough = int64_t{pair.tolerance} << 24;  // a quarter of the tolerance, Q56
  int64_t part = 0;
  for (int count = 0; count < k_passes_max; ++count) {
    ++passes;
    if (count == 0)
      separation.start(frames, normal);
    else
      separation.go_on(part, axis.at(part));
    const Separation::Value first = separation.at(0);
    if (first.separation <= (count == 0 ? 0 : enough)) break;
    const int64_t curvature = separation.curvature();
    int64_t x = parabola_root(first.separation, first.slope, curvature, k_one_64 - part);
    for (int step = 0;; ++step) {
      const Separation::Value value = separation.at(x);
      if (value.separation >= 0) break;
      // The lower bound of the separation is a concave function of time and positive at the start, so it is positive
      // before the root of its chord from the start to x. This root is used if the overlap at x is below 1/32 of the
      // separation at the start, if the slope at x is not negative, and in the last step.
      if (step == 4 || value.slope >= 0 || -value.separation < first.separation >> 5) {
        x = x * (first.separation >> 26) / ((first.separation - value.separation + (int64_t{1} << 26)) >> 26);
        break;
      }
      // |separation| < 32 (tests/guards/proofs). If it is 2 or more, 4 bits are dropped, so that the product below fits
      // 64 bits.
      const int coarse = -value.separation >> 57 != 0 ? 4 : 0;
      const int64_t fall = -value.slope >> coarse;
      const int64_t back = (-value.separation >> (26 + coarse)) * k_one_64 / (fall > 0 ? fall : 1) + 1;
      x = back < x ? x - back : 0;
    }
    part += x;
    if (part >= k_one_64) return static_cast<int32_t>(k_one_64);
    if ((curvature * ((x * x) >> 30)) >> 1 <= enough) break;
  }
  return static_cast<int32_t>(part);
}

int64_t advance_on(const MovingPair& pair, const Frames& frames, const Horizon& horizon, const Vec32& normal,
                   const Vec32& angular_velocity, int32_t floor, uint32_t& passes) {
  Frames at = frames;
  Horizon ahead = horizon;
  Vec32 axis = normal, rotation_vector = angular_velocity;
  for (int count = 0; count < k_horizons_max; ++count) {
    const int32_t part = advance(pair, at, ahead, axis, rotation_vector, floor, passes);
    const int64_t reached = ahead.time_at(part);
    if (part < k_one_64 || reached >= pair.to) return reached;
    axis = RotatingAxis(axis, rotation_vector).at(k_one_64);
    at = pair.at(reached);
    const int64_t rest = pair.to - reached, length = rest < horizon.length ? rest : horizon.length;
    ahead = horizon_over(pair, reached, length);
    if (length < horizon.length) {
      const int64_t share = time_quotient(length, horizon.length);
      rotation_vector =
          round_shift(over_time(Vec64{angular_velocity.x, angular_velocity.y, angular_velocity.z}, share), 0);
    }
  }
  return at.time;
}

int32_t advance_once(const MovingPair& pair, const Frames& frames, const Horizon& horizon, const Vec32& normal,
                     bool tight, int32_t floor, uint32_t& passes) {
  ++passes;
  Separation at_rest(pair, horizon, normal, {0, 0, 0}, floor);
  at_rest.start(frames, normal);
  const int64_t room = at_rest.at(0).separation >> 26;  // Q30
  if (room <= 0) return 0;
  const auto turning = [&](const Vec32& angular_velocity, int32_t core) {
    if (is_zero(angular_velocity) || core == 0) return int64_t{0};
    return product_above(length_bound_32(tight ? cross_29(normal, angular_velocity) : angular_velocity), core, 29);
  };
  const int64_t approach = -(dot(normal, horizon.displacement) >> 29) + 1 +
                           turning(horizon.angular_velocity_a, pair.core_a) +
                           turning(horizon.angular_velocity_b, pair.core_b);
  if (approach <= 0 || room >= approach) return static_cast<int32_t>(k_one_64);
  return static_cast<int32_t>((room << 30) / approach);
}

int64_t separation_along(const MovingPair& pair, const Frames& frames, const Vec32& normal, int32_t floor) {
  const Horizon moment = {frames.time, 0, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  Separation separation(pair, moment, normal, {0, 0, 0}, floor);
  separation.start(frames, normal);
  return separation.at(0).separation;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
