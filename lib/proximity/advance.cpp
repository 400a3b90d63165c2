#include "proximity/advance.h"

#include "math/root.h"
#include "math/trig_integer.h"

// Formats: parts of the horizon and lengths of the block Q30; spins, ways and directions Q29; separations Q56.

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr int64_t k_one = int64_t{1} << 30;

int32_t length_above(const Vec32& v) {
  return static_cast<int32_t>(square_root_floor(static_cast<uint64_t>(dot(v, v)))) + 1;
}

/// n x u, Q29, of n in Q30 and u in Q29.
Vec32 cross_29(const Vec32& n, const Vec32& u) { return round_shift(cross(n, u), 30); }

/// a b 2^-n, rounded up, of numbers >= 0.
int64_t product_above(int64_t a, int64_t b, int n) { return ((a * b) >> n) + 1; }

/// What does not change along one axis: bounds of the second derivatives.
struct Curvature {
  bool turning;
  int32_t relative_a, relative_b;  ///< |u|, Q29
  int64_t twist_a, twist_b;        ///< |w x spin|, Q29
  int32_t tilt;                    ///< |n x spin|, Q29
  int64_t centre;                  ///< bound of |(n.C)''|, Q26

  /// K, Q26, over `rest`, Q30, of the horizon.
  int64_t bound(const MovingPair& pair, const Vec32& slope_a, const Vec32& slope_b, int64_t rest) const {
    if (!turning) return 0;
    return centre + of_body(pair.core_a, slope_a, relative_a, twist_a, rest) +
           of_body(pair.core_b, slope_b, relative_b, twist_b, rest);
  }

 private:
  /// rho (|n x u| |u| + |w x spin|); |n x u| now is |slope|, and grows by at most |n x spin| |u| in the unit of time.
  int64_t of_body(int64_t core, const Vec32& slope, int32_t relative, int64_t twist, int64_t rest) const {
    if (core == 0) return 0;
    int64_t across = relative;
    if (tilt != 0 || relative != 0) {
      const int64_t grown = length_above(slope) + product_above(product_above(tilt, relative, 29), rest, 30);
      across = grown < across ? grown : across;
    }
    return product_above(product_above(across, relative, 29) + twist, core, 33);
  }
};

Curvature curvature_of(const MovingPair& pair, const Horizon& horizon, const Vec32& normal, const Vec32& spin) {
  Curvature result = {};
  result.turning = !is_zero(spin) || !is_zero(horizon.spin_a) || !is_zero(horizon.spin_b);
  if (!result.turning) return result;
  const Vec32 u_a = subtract(horizon.spin_a, spin), u_b = subtract(horizon.spin_b, spin);
  result.relative_a = is_zero(u_a) ? 0 : length_above(u_a);
  result.relative_b = is_zero(u_b) ? 0 : length_above(u_b);
  if (is_zero(spin)) return result;
  const auto twist = [&](const Vec32& w) {
    return is_zero(w) || w == spin ? int64_t{0} : int64_t{length_above(round_shift(cross(w, spin), 29))};
  };
  result.twist_a = twist(horizon.spin_a);
  result.twist_b = twist(horizon.spin_b);
  result.tilt = length_above(cross_29(normal, spin));
  const Vec32 from = pair.offset_at(horizon.start), to = pair.offset_at(horizon.start + horizon.length);
  const int64_t near = length_above(from), far = length_above(to);
  // |n x spin| (2 |V| + |spin| max |C|)
  const int64_t speed = 2 * int64_t{length_above(horizon.way)} + product_above(length_above(spin), near > far ? near : far, 30);
  result.centre = product_above(result.tilt, speed, 32);
  return result;
}

/// The separation along the axis as a concave function of the time from a pass's start.
struct Pass {
  const MovingPair& pair;
  Vec32 normal_a, slope_a, normal_b, slope_b;  ///< n and n x u, Q29, in the bodies' axes
  int64_t centre;                              ///< n.C less the floor, Q56
  int64_t centre_slope;                        ///< Q30
  int64_t curvature;                           ///< K, Q26

  struct Value {
    int64_t separation;  ///< Q56
    int64_t slope;       ///< at this time and with the points that are farthest here, less K x; Q30
  };
  Value at(int64_t x) const {
    const Vec32 support_a = along(normal_a, slope_a, x), support_b = along(normal_b, slope_b, x);
    Value value = {centre + ((centre_slope * x) >> 4), centre_slope};
    if (pair.core_a != 0) {
      const Vec32 p = local_support(*pair.a, support_a).local;
      value.separation -= dot(support_a, p) >> (3 + shift_of(*pair.a));
      value.slope -= dot(slope_a, p) >> (29 + shift_of(*pair.a));
    }
    if (pair.core_b != 0) {
      const Vec32 p = local_support(*pair.b, negate(support_b)).local;
      value.separation += dot(support_b, p) >> (3 + shift_of(*pair.b));
      value.slope += dot(slope_b, p) >> (29 + shift_of(*pair.b));
    }
    if (curvature != 0) {
      value.separation -= (curvature * (((x * x) >> 30) + 1)) >> 1;
      value.slope -= (curvature * x) >> 26;
    }
    return value;
  }

 private:
  int shift_of(const Convex& convex) const { return pair.exponent - convex.exponent; }
  static Vec32 along(const Vec32& n, const Vec32& m, int64_t x) {
    const auto component = [x](int32_t p, int32_t q) { return p + static_cast<int32_t>((q * x) >> 30); };
    return {component(n.x, m.x), component(n.y, m.y), component(n.z, m.z)};
  }
};

Vec32 to_local_29(const Matrix32& rotation, const Vec32& v) {
  const auto component = [&](const Vec32& column) {
    return static_cast<int32_t>((dot(v, column) + (int64_t{1} << 30)) >> 31);
  };
  return {component(rotation.column[0]), component(rotation.column[1]), component(rotation.column[2])};
}

Pass pass_at(const MovingPair& pair, const Horizon& horizon, const Vec32& normal, const Vec32& spin, int64_t part,
             int32_t floor, const Curvature& curvature) {
  const int64_t time = horizon.time_at(part);
  const Vec32 offset = pair.offset_at(time);
  Pass pass = {pair, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, 0, 0, 0};
  pass.centre = (dot(normal, offset) >> 4) - (int64_t{floor} << 26);
  pass.centre_slope = dot(normal, horizon.way) >> 29;
  Vec32 slope_a = {0, 0, 0}, slope_b = {0, 0, 0};
  if (curvature.turning) {
    slope_a = cross_29(normal, subtract(horizon.spin_a, spin));
    slope_b = cross_29(normal, subtract(horizon.spin_b, spin));
    pass.centre_slope += dot(cross_29(spin, normal), offset) >> 29;
    pass.curvature = curvature.bound(pair, slope_a, slope_b, k_one - part);
  }
  if (pair.core_a != 0) {
    const Matrix32 rotation = pair.turning_a.at(time);
    pass.normal_a = to_local_29(rotation, normal);
    pass.slope_a = rotate_inverse(rotation, slope_a);
  }
  if (pair.core_b != 0) {
    const Matrix32 rotation = pair.turning_b.at(time);
    pass.normal_b = to_local_29(rotation, normal);
    pass.slope_b = rotate_inverse(rotation, slope_b);
  }
  return pass;
}

/// Where separation + slope x - K x^2/2 ends, Q30, or `limit` if that comes first. Only a proposal.
int64_t parabola_root(int64_t separation, int64_t slope, int64_t curvature, int64_t limit) {
  const int64_t s = separation >> 28;                          // Q28
  const int64_t b = slope >> 4;                                // Q26
  const int64_t k = curvature;                                 // Q26
  const uint64_t square = static_cast<uint64_t>(b * b + ((2 * k * s) >> 2));  // Q52
  const int64_t denominator = int64_t{square_root_floor(square)} - b;         // Q26
  if (denominator <= 0) return limit;
  const int64_t numerator = 2 * (separation >> 27);  // Q29
  if (numerator >= denominator << 3) return limit;
  const int64_t x = (numerator << 27) / denominator;
  return x < limit ? x : limit;
}

}  // namespace

Horizon horizon_from(const MovingPair& pair, int64_t start, int64_t length, int turn_quarters) {
  const int64_t limit = int64_t{turn_quarters} << 44;  // 2^-46 rad
  while (over_time(pair.turning_a.angle + pair.turning_b.angle, length) > limit) length >>= 1;
  Horizon horizon;
  horizon.start = start;
  horizon.length = length;
  horizon.way = round_shift(over_time(pair.displacement, length), pair.exponent + 17);
  horizon.spin_a = round_shift(over_time(pair.turning_a.turn, length), 17);
  horizon.spin_b = round_shift(over_time(pair.turning_b.turn, length), 17);
  return horizon;
}

Vec32 turned(const Vec32& normal, const Vec32& spin, int32_t part) {
  if (part == 0 || is_zero(spin)) return normal;
  const Vec32 axis = unit_vector_raw(scaled_to_30_bits(spin));
  const int64_t angle = (int64_t{length_above(spin)} * part) >> 30;  // Q29 rad
  const SineCosineRaw full = sine_cosine_raw((angle * 2734261103) >> 29);  // 2^34 / 2 pi
  const int64_t along = ((dot(axis, normal) >> 30) * (k_one - full.cosine)) >> 30;
  const Vec64 across = cross(axis, normal);
  const auto component = [&](int32_t n, int64_t c, int32_t k) {
    return static_cast<int32_t>((int64_t{n} * full.cosine + ((c + (k_one >> 1)) >> 30) * full.sine + along * k +
                                 (k_one >> 1)) >> 30);
  };
  return unit_vector_raw(scaled_to_30_bits(Vec32{component(normal.x, across.x, axis.x),
                                                 component(normal.y, across.y, axis.y),
                                                 component(normal.z, across.z, axis.z)}));
}

int32_t advance(const MovingPair& pair, const Horizon& horizon, const Vec32& normal, const Vec32& spin, int32_t floor,
                uint32_t& passes) {
  const Curvature curvature = curvature_of(pair, horizon, normal, spin);
  const int64_t enough = int64_t{pair.tolerance} << 24;  // a quarter of the tolerance, Q56
  int64_t part = 0;
  for (int count = 0; count < k_passes_max; ++count) {
    ++passes;
    const Pass pass =
        pass_at(pair, horizon, turned(normal, spin, static_cast<int32_t>(part)), spin, part, floor, curvature);
    const Pass::Value first = pass.at(0);
    if (first.separation <= (count == 0 ? 0 : enough)) break;
    int64_t x = parabola_root(first.separation, first.slope, pass.curvature, k_one - part);
    for (int step = 0;; ++step) {
      const Pass::Value value = pass.at(x);
      if (value.separation >= 0) break;
      if (step == 4 || value.slope >= 0) {  // the chord from the start lies below the concave function
        x = x * (first.separation >> 26) / ((first.separation - value.separation + (int64_t{1} << 26)) >> 26);
        break;
      }
      const int64_t back = (-value.separation >> 26) * k_one / -value.slope + 1;
      x = back < x ? x - back : 0;
    }
    part += x;
    if (part >= k_one) return static_cast<int32_t>(k_one);
    if ((pass.curvature * ((x * x) >> 30)) >> 1 <= enough) break;
  }
  return static_cast<int32_t>(part);
}

int32_t advance_once(const MovingPair& pair, const Horizon& horizon, const Vec32& normal, bool tight, int32_t floor,
                     uint32_t& passes) {
  ++passes;
  const Vec32 still = {0, 0, 0};
  const Pass pass = pass_at(pair, horizon, normal, still, 0, floor, curvature_of(pair, horizon, normal, still));
  const int64_t separation = pass.at(0).separation;
  if (separation <= 0) return 0;
  const auto turning = [&](const Vec32& spin, int32_t core) {
    if (is_zero(spin) || core == 0) return int64_t{0};
    return product_above(length_above(tight ? cross_29(normal, spin) : spin), core, 29);
  };
  const int64_t approach =
      -(dot(normal, horizon.way) >> 29) + 1 + turning(horizon.spin_a, pair.core_a) + turning(horizon.spin_b, pair.core_b);
  const int64_t room = separation >> 26;  // Q30
  if (approach <= 0 || room >= approach) return static_cast<int32_t>(k_one);
  return static_cast<int32_t>((room << 30) / approach);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
