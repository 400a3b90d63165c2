#include "proximity/feature_span.h"

#include "proximity/simplex.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr int64_t k_whole = int64_t{1} << 30;
constexpr OpenPart k_closed = {1, 0};
constexpr int k_corner_bits = 29;

/// A span in 29 bits and a sign, so that products of two fit 64 bits and of three 128.
struct ShortSpan {
  Vec32 corner[8];  ///< `count` at the beginning, then as many at the end
  int count;
  int64_t ball;   ///< with what rounding took; at most the reach and 1
  int64_t reach;  ///< no component is larger
  int shift;      ///< as many bits were lost

  const Vec32& from(int i) const { return corner[i]; }
  const Vec32& to(int i) const { return corner[count + i]; }
};

ShortSpan shortened(const FeatureSpan& span) {
  const auto magnitudes = [](const Vec64& v) { return magnitude_64(v.x) | magnitude_64(v.y) | magnitude_64(v.z); };
  uint64_t all = static_cast<uint64_t>(span.ball);
  for (int i = 0; i < span.count; ++i) all |= magnitudes(span.from[i]) | magnitudes(span.to[i]);
  const int length = bit_length_64(all);
  ShortSpan result;
  result.shift = length > k_corner_bits ? length - k_corner_bits : 0;
  result.reach = int64_t{1} << (length - result.shift);
  result.count = span.count;
  for (int i = 0; i < span.count; ++i) {
    result.corner[i] = round_shift(span.from[i], result.shift);
    result.corner[span.count + i] = round_shift(span.to[i], result.shift);
  }
  // Rounding takes a half: the whole is rounded up once.
  const int64_t unit = int64_t{1} << result.shift;
  result.ball = (span.ball + (unit >> 1) + unit - 1) >> result.shift;
  return result;
}

/// Some axis parts the points from the cube about the origin whose half edge is the ball: GJK's, so that hardly any
/// other does if that does not. A fixed axis that parts the ends of chords parts the chords.
bool parted(const Vec32* point, int count, int64_t ball) {
  Vec64 sum = {0, 0, 0};
  for (int i = 0; i < count; ++i) sum = add(sum, Vec64{point[i].x, point[i].y, point[i].z});
  Vec32 direction = is_zero(sum) ? Vec32{1 << 30, 0, 0} : scaled_to_30_bits(sum);
  Simplex simplex;
  for (;;) {
    SimplexVertex nearest = {};
    int64_t least = INT64_MAX;
    for (int i = 0; i < count; ++i) {
      const int64_t along = dot(direction, point[i]);
      if (along >= least) continue;
      least = along;
      nearest.difference = point[i];
    }
    const int64_t length = int64_t{magnitude_32(direction.x)} + magnitude_32(direction.y) + magnitude_32(direction.z);
    if (least > ball * length) return true;
    // Finitely many points, each nearer than those before it: the loop ends.
    if (!simplex.insert(nearest) || simplex.holds_origin()) return false;
    direction = simplex.direction();
  }
}

/// A coordinate axis parts all corners.
bool parted_by_bounds(const ShortSpan& span) {
  Vec32 low = span.corner[0], high = low;
  for (int i = 1; i < 2 * span.count; ++i) {
    const Vec32& p = span.corner[i];
    low = {p.x < low.x ? p.x : low.x, p.y < low.y ? p.y : low.y, p.z < low.z ? p.z : low.z};
    high = {p.x > high.x ? p.x : high.x, p.y > high.y ? p.y : high.y, p.z > high.z ? p.z : high.z};
  }
  const int64_t ball = span.ball;
  return low.x > ball || low.y > ball || low.z > ball || high.x < -ball || high.y < -ball || high.z < -ball;
}

/// The cross product of two corners over the interval, quadratic in time, in Bernstein form.
struct Moment {
  Vec64 from, middle, to;  ///< the middle one twice

  Moment(const ShortSpan& span, int i, int j)
      : from(cross(span.from(i), span.from(j))),
        middle(add(cross(span.from(i), span.to(j)), cross(span.to(i), span.from(j)))),
        to(cross(span.to(i), span.to(j))) {}

  /// The magnitudes of its components never add up to more than this.
  int64_t bound() const {
    const int64_t begins = sum(from), ends = sum(to), between = sum(middle) / 2 + 1;
    const int64_t end = begins > ends ? begins : ends;
    return end > between ? end : between;
  }

 private:
  static int64_t sum(const Vec64& v) {
    return static_cast<int64_t>(magnitude_64(v.x) + magnitude_64(v.y) + magnitude_64(v.z));
  }
};

/// In the projection along a coordinate axis the polygon holds the origin only if it goes round it one way at each of
/// its edges: q(i) x q(i + 1) has one sign at all of them.
bool passes_by(const ShortSpan& span) {
  // |(a + d) x (b + e) - a x b| in a component, d and e within the ball.
  const int64_t error = 2 * span.ball * (2 * span.reach + span.ball);
  bool left[3] = {false, false, false}, right[3] = {false, false, false};
  for (int i = 0; i < span.count; ++i) {
    const Moment moment(span, i, i + 1 < span.count ? i + 1 : 0);
    const int64_t coefficients[3][3] = {{moment.from.x, moment.middle.x, moment.to.x},
                                        {moment.from.y, moment.middle.y, moment.to.y},
                                        {moment.from.z, moment.middle.z, moment.to.z}};
    for (int axis = 0; axis < 3; ++axis) {
      const int64_t(&c)[3] = coefficients[axis];
      left[axis] = left[axis] || (c[0] > error && c[1] > 2 * error && c[2] > error);
      right[axis] = right[axis] || (c[0] < -error && c[1] < -2 * error && c[2] < -error);
    }
  }
  return (left[0] && right[0]) || (left[1] && right[1]) || (left[2] && right[2]);
}

/// A cubic in Bernstein form.
struct Cubic {
  Int128 coefficient[4];
  Int128 error;
};

/// Three times the determinant of three corners: 0 where the polygon's plane holds the origin.
Cubic coplanarity(const ShortSpan& span) {
  const int last = span.count - 1;
  const Moment far(span, 1, last), first(span, 0, 1), second(span, last, 0);
  // Corners p, q, r off by d, e, f within the ball b: |d.(q x r)| and its like, |(d x e).r| and its like, |(d x e).f|.
  // A flat triangle has small moments: what counts is its area, not its length.
  const int64_t b = span.ball;
  const int64_t slope = far.bound() + first.bound() + second.bound() + 18 * b * span.reach + 6 * b * b;
  const Vec32 &from = span.from(0), &to = span.to(0);
  const auto times_3 = [](Int128 value) { return value + value + value; };
  return {{times_3(dot(far.from, from)), dot(far.from, to) + dot(far.middle, from),
           dot(far.to, from) + dot(far.middle, to), times_3(dot(far.to, to))},
          times_3(Int128::product_narrow(slope, static_cast<int32_t>(b)))};
}

/// The value 2^-n, rounded down. Range: it fits.
int64_t floor_shift(Int128 value, int n) {
  if (n == 0) return value.low_signed();
  return (value - Int128::from(1).shift_left(n - 1)).round_shift(n);
}

/// The least x, Q30, rounded down, at which the lower hull of Bernstein coefficients is not above 0; above 1 if it is
/// above 0 everywhere. Range: below 2^31.
int64_t first_descent(const int64_t (&c)[4]) {
  if (c[0] <= 0) return 0;
  int64_t first = 3 * (k_whole + 1);
  for (int i = 0; i < 3; ++i) {
    if (c[i] <= 0) continue;
    for (int j = i + 1; j < 4; ++j) {
      if (c[j] > 0) continue;
      const int64_t crossing = i * k_whole + (j - i) * ((c[i] << 30) / (c[i] - c[j]));
      if (crossing < first) first = crossing;
    }
  }
  return first / 3;
}

/// Where the hull of the coefficients, give or take the error, holds 0.
OpenPart roots_of(const Cubic& cubic) {
  int length = bit_length_128(magnitude_128(cubic.error));
  for (const Int128& c : cubic.coefficient) {
    const int bits = bit_length_128(magnitude_128(c));
    if (bits > length) length = bits;
  }
  const int n = length > 29 ? length - 29 : 0;
  OpenPart part = {0, k_whole};
  for (int sign = 0; sign < 2; ++sign) {
    int64_t ahead[4], back[4];
    for (int i = 0; i < 4; ++i) {
      const Int128 c = sign == 0 ? cubic.coefficient[i] : -cubic.coefficient[i];
      ahead[i] = back[3 - i] = floor_shift(c - cubic.error, n);
    }
    const int64_t from = first_descent(ahead), to = k_whole - first_descent(back);
    if (from > part.from) part.from = from;
    if (to < part.to) part.to = to;
  }
  return part;
}

}  // namespace

OpenPart open_part(const FeatureSpan& span) {
  const ShortSpan short_span = shortened(span);
  if (parted_by_bounds(short_span)) return k_closed;
  if (8 * short_span.ball > short_span.reach) return {0, k_whole};  // such a ball hides all else, and overflows
  const OpenPart part = roots_of(coplanarity(short_span));
  if (part.from > part.to || passes_by(short_span)) return k_closed;
  return parted(short_span.corner, 2 * short_span.count, short_span.ball) ? k_closed : part;
}

bool begins_near(const FeatureSpan& span, int64_t gap) {
  const ShortSpan short_span = shortened(span);
  return !parted(short_span.corner, short_span.count, gap >> short_span.shift);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
