#include "toi_methods/canny.h"

#include "math/root.h"
#include "toi_methods/feature_pairs.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr int64_t k_raw_pi = 221069929750888;  // pi, 2^-46 rad, rounded down

/// A rotation whose quaternion moves in a straight line from one quaternion to another, with the sign that makes the
/// line shorter.
struct QuaternionLine {
  Quat32 start;
  int64_t displacement[4];

  /// The quaternion at a time, Q30; not of length 1.
  Quat32 at(int64_t time) const {
    const auto component = [&](int32_t from, int64_t displacement_along) {
      return static_cast<int32_t>(from + over_time(displacement_along, time));
    };
    return {component(start.x, displacement[0]), component(start.y, displacement[1]),
            component(start.z, displacement[2]), component(start.w, displacement[3])};
  }
  /// The square of the quaternion's length, Q60: from 1/2 to 1.
  static uint64_t square(const Quat32& q) {
    const auto squared = [](int64_t v) { return static_cast<uint64_t>(v * v); };
    return squared(q.x) + squared(q.y) + squared(q.z) + squared(q.w);
  }
};

int64_t clipped_32(uint64_t square) {
  const uint64_t value = square >> 28;
  return value > UINT32_MAX ? UINT32_MAX : static_cast<int64_t>(value);
}

Matrix32 rotation_of(const Quat32& q) {
  const int64_t inverse = reciprocal_root(static_cast<uint32_t>(clipped_32(QuaternionLine::square(q))));  // Q31
  const auto scaled = [inverse](int32_t v) { return static_cast<int32_t>((v * inverse + (int64_t{1} << 30)) >> 31); };
  return matrix_from(Quat32{scaled(q.x), scaled(q.y), scaled(q.z), scaled(q.w)});
}

/// The motion of both bodies, in world axes.
struct LerpMotion : SweptPair {
  QuaternionLine line_a, line_b;
  Vec64 offset, displacement;

  PlacedPair at(int64_t time) const {
    return {rotation_of(line_a.at(time)), rotation_of(line_b.at(time)), add(offset, over_time(displacement, time))};
  }
  /// The factor that makes the volume of a feature pair's corners a polynomial: the product of the quaternions'
  /// squares, Q30.
  int64_t weight_at(int64_t time) const {
    const int64_t a = clipped_32(QuaternionLine::square(line_a.at(time))) >> 2;
    const int64_t b = clipped_32(QuaternionLine::square(line_b.at(time))) >> 2;
    return (a * b) >> 30;
  }
};

constexpr int k_degree = 5;

/// A polynomial of degree five in Bernstein form over an interval.
struct Quintic {
  int64_t coefficient[k_degree + 1];
  int64_t noise;  ///< coefficients that are all within +-noise carry no information

  bool changes_sign() const {
    bool above = false, below = false;
    for (const int64_t c : coefficient) {
      above = above || c >= 0;
      below = below || c <= 0;
    }
    return above && below;
  }
  bool is_noise() const {
    for (const int64_t c : coefficient) {
      if (c > noise || c < -noise) return false;
    }
    return true;
  }
  /// Replaces the polynomial by its left half and returns its right half (de Casteljau).
  Quintic halve() {
    Quintic right;
    right.noise = noise;
    for (int i = k_degree; i >= 0; --i) {
      right.coefficient[i] = coefficient[k_degree];
      for (int j = k_degree; j > k_degree - i; --j) {
        coefficient[j] = (coefficient[j - 1] + coefficient[j]) >> 1;
      }
    }
    return right;
  }
};

/// 240 times the polynomial of degree five that has the values `value`, below 2^49 in magnitude, at six evenly spaced
/// times.
Quintic through(const int64_t (&value)[k_degree + 1], int64_t noise) {
  constexpr int64_t k_first[] = {-308, 1200, -1200, 800, -300, 48};
  constexpr int64_t k_second[] = {269, -1450, 2950, -2300, 925, -154};
  Quintic quintic = {{240 * value[0], 0, 0, 0, 0, 240 * value[k_degree]}, 240 * noise};
  for (int i = 0; i <= k_degree; ++i) {
    quintic.coefficient[1] += k_first[i] * value[i];
    quintic.coefficient[2] += k_second[i] * value[i];
    quintic.coefficient[3] += k_second[k_degree - i] * value[i];
    quintic.coefficient[4] += k_first[k_degree - i] * value[i];
  }
  return quintic;
}

/// The volume of a feature pair's corners times weight_at(), up to a constant factor.
template <class Path>
Quintic coplanarity(const Path& path, const Interval& interval) {
  Vec64 corner[k_degree + 1][3];
  int64_t weight[k_degree + 1];
  uint64_t magnitudes = 0;
  for (int i = 0; i <= k_degree; ++i) {
    const int64_t time = interval.from + (interval.to - interval.from) / k_degree * i;
    Vec64 difference[4];
    path.set_differences_at(time, difference);
    weight[i] = path.motion.weight_at(time);
    for (int j = 0; j < 3; ++j) {
      corner[i][j] = difference[j < 2 ? j : difference_count(path.kind) - 1];
      magnitudes |= magnitude_bits(corner[i][j]);
    }
  }
  const Shortening shortening(magnitudes, 0);
  Int128 volume[k_degree + 1];
  int64_t moments_most = 0;
  int length = 0;
  for (int i = 0; i <= k_degree; ++i) {
    Vec32 c[3];
    for (int j = 0; j < 3; ++j) c[j] = round_shift(corner[i][j], shortening.shift);
    const Vec64 far = cross(c[1], c[2]);
    volume[i] = dot(far, c[0]);
    moments_most =
        larger(moments_most, magnitude_sum(far) + magnitude_sum(cross(c[0], c[1])) + magnitude_sum(cross(c[2], c[0])));
    const int bits = bit_length_128(magnitude_128(volume[i]));
    length = bits > length ? bits : length;
  }
  const int n = length > 48 ? length - 48 : 0;
  const auto brought = [n](Int128 v) { return n == 0 ? v.low_signed() : v.round_shift(n); };
  int64_t value[k_degree + 1];
  for (int i = 0; i <= k_degree; ++i) value[i] = Int128::product(brought(volume[i]), weight[i]).round_shift(30);
  const Int128 error = shortening.volume_error(moments_most);
  const bool is_all_noise = bit_length_128(magnitude_128(error)) > length;
  return through(value, is_all_noise ? int64_t{1} << 49 : brought(error) + 2);
}

/// Search strategy for FeaturePairs: finds the first numerical root of the volume at which the features are near.
struct NumericalRoots {
  template <class Path>
  static void find(const Path& path, int64_t gap, const Interval& interval, FeatureToi& result) {
    result = {ToiOutcome::clear, Fraction(1.0), 0};
    find(path, gap, interval, 0, result);
  }

 private:
  template <class Path>
  static void find(const Path& path, int64_t gap, const Interval& interval, int depth, FeatureToi& result) {
    struct Piece {
      int64_t from, length;
      Quintic quintic;
    };
    constexpr int k_halvings = 32, k_pieces_max = 512;
    Piece waiting[k_halvings + 3];
    int count = 1;
    waiting[0] = {interval.from, interval.to - interval.from, coplanarity(path, interval)};
    const int64_t fine = larger((interval.to - interval.from) >> k_halvings, 1);
    while (count > 0) {
      Piece piece = waiting[--count];
      if (!piece.quintic.changes_sign()) continue;
      if (++result.intervals >= k_pieces_max) {
        result.outcome = ToiOutcome::undecided;
        result.time = Fraction::from_raw(piece.from);
        return;
      }
      if (piece.length <= fine || piece.quintic.is_noise()) {
        FeatureSpan span;
        span.count = difference_count(path.kind);
        path.set_differences_at(piece.from, span.from);
        if (begins_near(span, gap)) {
          result.outcome = ToiOutcome::hit;
          result.time = Fraction::from_raw(piece.from);
          return;
        }
        if (depth != 0) continue;
        // The error of the volume may have moved the root. Therefore a small interval around the piece is searched once
        // more.
        const int64_t margin = (interval.to - interval.from) >> 8, end = piece.from + piece.length;
        find(path, gap,
             {larger(piece.from - margin, interval.from), interval.to - end < margin ? interval.to : end + margin}, 1,
             result);
        if (result.outcome != ToiOutcome::clear) return;
        continue;
      }
      const int64_t half = piece.length / 2;
      const Quintic right = piece.quintic.halve();
      waiting[count++] = {piece.from + half, piece.length - half, right};
      waiting[count++] = {piece.from, half, piece.quintic};
    }
  }
};

/// Sets the rotation of one body and a bound on the paths of its points. Errors: out_of_range for a rotation of more
/// than pi; other errors as time_of_impact().
Status set_line(const Motion& motion, int64_t distance_max, QuaternionLine& line, RotationBound& bound) {
  Turning turning;
  if (const Status status = turning_of(motion, turning); status != Status::ok) return status;
  if (turning.angle > k_raw_pi) return Status::out_of_range;
  line.start = turning.start;
  const Quat32 end = turning.rotation_at(k_time_end);
  const int32_t from[4] = {line.start.x, line.start.y, line.start.z, line.start.w},
                to[4] = {end.x, end.y, end.z, end.w};
  uint64_t squares[2] = {0, 0};  // squared lengths of half the difference and of half the sum
  int64_t along = 0;
  for (int i = 0; i < 4; ++i) along += int64_t{from[i]} * to[i] >> 2;
  for (int i = 0; i < 4; ++i) {
    const int64_t last = along < 0 ? -int64_t{to[i]} : to[i], sum = (from[i] + last) / 2;
    line.displacement[i] = last - from[i];
    squares[0] += static_cast<uint64_t>(line.displacement[i] / 2 * (line.displacement[i] / 2));
    squares[1] += static_cast<uint64_t>(sum * sum);
  }
  // With k the tangent of a quarter of the angle, the angular speed is at most 4 k. Including the part of the angular
  // acceleration, the acceleration of a point is at most 16.9 k^2 times its distance from the body's position. The
  // bound is a rate whose square exceeds 16.9 k^2: 33/8 k.
  const int64_t k = ((int64_t{square_root_floor(squares[0])} + 2) << 30) / square_root_floor(squares[1]);  // Q30
  bound = {distance_max, turning.turns ? (33 * k) << 13 : 0};
  return Status::ok;
}

}  // namespace

Status time_of_impact_by_canny(const Convex& a, const Motion& motion_a, const Convex& b, const Motion& motion_b,
                               TimeOfImpact& result) {
  if (!Polytope::is_one(a) || !Polytope::is_one(b)) return Status::bad_argument;
  MovingPair pair;
  if (const Status status = prepare(a, motion_a, b, motion_b, pair); status != Status::ok) return status;
  LerpMotion motion;
  if (const Status status = set_line(motion_a, raw_core_radius(a), motion.line_a, motion.bound_a); status != Status::ok)
    return status;
  if (const Status status = set_line(motion_b, raw_core_radius(b), motion.line_b, motion.bound_b); status != Status::ok)
    return status;
  motion.offset = pair.offset;
  motion.displacement = pair.displacement;
  FeaturePairs<LerpMotion, NumericalRoots>(a, b, motion).first_contact({pair.from, pair.to}, result);
  result.normal = {};
  result.point = {};
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
