#include "proximity/feature_span.h"

#include "proximity/simplex.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr int64_t k_whole = int64_t{1} << 30;
constexpr OpenPart k_closed = {1, 0};
constexpr int k_corner_bits = 29;

/// The same in 29 bits and a sign, so that products of two fit 64 bits and of three 128.
struct ShortSpan {
  int count;
  Vec32 from[4], to[4];
  int64_t ball;   ///< with what rounding took
  int64_t reach;  ///< of the largest component
};

uint64_t magnitudes_of(const Vec64& v) { return magnitude_64(v.x) | magnitude_64(v.y) | magnitude_64(v.z); }

ShortSpan shortened(const FeatureSpan& span) {
  uint64_t all = static_cast<uint64_t>(span.ball);
  for (int i = 0; i < span.count; ++i) all |= magnitudes_of(span.from[i]) | magnitudes_of(span.to[i]);
  const int length = bit_length_64(all);
  const int n = length > k_corner_bits ? length - k_corner_bits : 0;
  ShortSpan result;
  result.count = span.count;
  for (int i = 0; i < span.count; ++i) {
    result.from[i] = round_shift(span.from[i], n);
    result.to[i] = round_shift(span.to[i], n);
  }
  // Rounding takes a half: the whole is rounded up once.
  const int64_t unit = int64_t{1} << n;
  result.ball = (span.ball + (n == 0 ? 0 : unit / 2) + unit - 1) >> n;
  result.reach = int64_t{1} << (length < k_corner_bits ? length : k_corner_bits);
  return result;
}

/// An axis fixed over the interval parts the chords from the origin if it parts their ends from it.
class Parting {
 public:
  explicit Parting(const ShortSpan& span) : span_(span) {}

  /// By one of the coordinate axes.
  bool by_bounds() const {
    Vec32 low = span_.from[0], high = low;
    for (int i = 0; i < 2 * span_.count; ++i) {
      const Vec32& p = point(i);
      low = {p.x < low.x ? p.x : low.x, p.y < low.y ? p.y : low.y, p.z < low.z ? p.z : low.z};
      high = {p.x > high.x ? p.x : high.x, p.y > high.y ? p.y : high.y, p.z > high.z ? p.z : high.z};
    }
    const int64_t ball = span_.ball;
    return low.x > ball || low.y > ball || low.z > ball || high.x < -ball || high.y < -ball || high.z < -ball;
  }

  /// By the axis of GJK on all corners at both ends: if any axis does, within rounding.
  bool by_axis() const {
    Vec64 sum = {0, 0, 0};
    for (int i = 0; i < 2 * span_.count; ++i) sum = add(sum, Vec64{point(i).x, point(i).y, point(i).z});
    Vec32 direction = is_zero(sum) ? Vec32{1 << 30, 0, 0} : scaled_to_30_bits(sum);
    Simplex simplex;
    for (;;) {
      SimplexVertex nearest = {};
      int64_t least = INT64_MAX;
      for (int i = 0; i < 2 * span_.count; ++i) {
        const int64_t along = dot(direction, point(i));
        if (along >= least) continue;
        least = along;
        nearest.difference = point(i);
      }
      const int64_t length = int64_t{magnitude_32(direction.x)} + magnitude_32(direction.y) + magnitude_32(direction.z);
      if (least > span_.ball * length) return true;
      // Finitely many corners, each nearer than all before: the loop ends.
      if (!simplex.insert(nearest) || simplex.holds_origin()) return false;
      direction = simplex.direction();
    }
  }

 private:
  const Vec32& point(int i) const { return i < span_.count ? span_.from[i] : span_.to[i - span_.count]; }

  const ShortSpan& span_;
};

Vec64 sum_of(const Vec64& a, const Vec64& b) { return add(a, b); }

/// In the projection along a coordinate axis the polygon holds the origin only if it goes round it one way at each of
/// its edges: q(i) x q(i + 1), quadratic in time, has one sign at all of them.
bool passes_by(const ShortSpan& span) {
  // |(a + d) x (b + e) - a x b| in a component, |d| and |e| up to the ball.
  const int64_t error = 2 * span.ball * (2 * span.reach + span.ball);
  bool left[3] = {false, false, false}, right[3] = {false, false, false};
  for (int i = 0; i < span.count; ++i) {
    const int j = i + 1 < span.count ? i + 1 : 0;
    const Vec64 from = cross(span.from[i], span.from[j]), to = cross(span.to[i], span.to[j]);
    const Vec64 middle = sum_of(cross(span.from[i], span.to[j]), cross(span.to[i], span.from[j]));  // twice
    const int64_t coefficients[3][3] = {{from.x, middle.x, to.x}, {from.y, middle.y, to.y}, {from.z, middle.z, to.z}};
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

/// Three times the determinant of three corners, which is 0 where the polygon's plane holds the origin.
Cubic coplanarity(const ShortSpan& span) {
  const int last = span.count - 1;
  const Vec32 *s = span.from, *e = span.to;
  const Vec64 from = cross(s[1], s[last]), to = cross(e[1], e[last]);
  const Vec64 middle = add(cross(s[1], e[last]), cross(e[1], s[last]));
  const Int128 first = dot(from, s[0]), final = dot(to, e[0]);
  // 6 ((reach + ball)^3 - reach^3) is the error of a determinant.
  const int64_t r = span.reach, b = span.ball;
  const Int128 error = Int128::product_narrow(3 * r * r + 3 * r * b + b * b, static_cast<int32_t>(b));
  const auto times_3 = [](Int128 value) { return value + value + value; };
  return {{times_3(first), dot(from, e[0]) + dot(middle, s[0]), dot(to, s[0]) + dot(middle, e[0]), times_3(final)},
          times_3(times_3(error) + times_3(error))};
}

/// The value 2^-n, rounded down.
int64_t floor_shift(Int128 value, int n) {
  if (n == 0) return value.low_signed();
  return (value - Int128::from(1).shift_left(n - 1)).round_shift(n);
}

/// The least x, Q30, rounded down, at which the lower hull of Bernstein coefficients is not above 0; above 1 if it is
/// above everywhere. Range: below 2^31.
int64_t first_descent(const int64_t (&c)[4]) {
  if (c[0] <= 0) return 0;
  int64_t first = 3 * k_whole + 3;
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

OpenPart roots_of(const Cubic& cubic) {
  int length = 0;
  for (const Int128& c : cubic.coefficient) {
    const int bits = bit_length_128(magnitude_128(c));
    if (bits > length) length = bits;
  }
  const int error_length = bit_length_128(magnitude_128(cubic.error));
  length = (error_length > length ? error_length : length) + 1;
  const int n = length > 30 ? length - 30 : 0;
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
  const Parting parting(short_span);
  if (parting.by_bounds()) return k_closed;
  const OpenPart part = roots_of(coplanarity(short_span));
  if (part.from > part.to || passes_by(short_span) || parting.by_axis()) return k_closed;
  return part;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
