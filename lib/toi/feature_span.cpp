#include "toi/feature_span.h"

#include "distance/simplex.h"
#include "toi/feature_cubic.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// A span rounded to short integers.
struct ShortSpan {
  Vec32 corner[8];  ///< the `count` corners at the start of the interval, then the same corners at its end
  int count;
  Shortening is;

  explicit ShortSpan(const FeatureSpan& span) : count(span.count), is(magnitudes_of(span), span.ball) {
    for (int i = 0; i < count; ++i) {
      corner[i] = round_shift(span.from[i], is.shift);
      corner[count + i] = round_shift(span.to[i], is.shift);
    }
  }
  const Vec32& from(int i) const { return corner[i]; }
  const Vec32& to(int i) const { return corner[count + i]; }

 private:
  static uint64_t magnitudes_of(const FeatureSpan& span) {
    uint64_t all = 0;
    for (int i = 0; i < span.count; ++i) all |= magnitude_bits(span.from[i]) | magnitude_bits(span.to[i]);
    return all;
  }
};

/// Whether the axis that GJK finds separates the points from the cube around the origin with half edge `ball`. If this
/// axis does not separate them, hardly any other axis does. A fixed axis that separates the ends of chords also
/// separates the chords.
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
    // The loop ends, because the points are finitely many and each new vertex brings the simplex nearer to the origin.
    if (!simplex.insert(nearest) || simplex.holds_origin()) return false;
    direction = simplex.direction();
  }
}

/// Whether a coordinate axis separates all corners from the cube around the origin with half edge `ball`.
bool parted_by_bounds(const ShortSpan& span) {
  Vec32 low = span.corner[0], high = low;
  for (int i = 1; i < 2 * span.count; ++i) {
    const Vec32& p = span.corner[i];
    low = {p.x < low.x ? p.x : low.x, p.y < low.y ? p.y : low.y, p.z < low.z ? p.z : low.z};
    high = {p.x > high.x ? p.x : high.x, p.y > high.y ? p.y : high.y, p.z > high.z ? p.z : high.z};
  }
  const int64_t ball = span.is.ball;
  return low.x > ball || low.y > ball || low.z > ball || high.x < -ball || high.y < -ball || high.z < -ball;
}

/// The cross product of two corners over the interval, quadratic in time, in Bernstein form.
struct Moment {
  Vec64 from, middle, to;  ///< `middle` is twice the middle coefficient

  Moment(const ShortSpan& span, int i, int j)
      : from(cross(span.from(i), span.from(j))),
        middle(add(cross(span.from(i), span.to(j)), cross(span.to(i), span.from(j)))),
        to(cross(span.to(i), span.to(j))) {}

  /// Bound on the sum of the magnitudes of the cross product's components over the interval.
  int64_t bound() const {
    const int64_t begins = magnitude_sum(from), ends = magnitude_sum(to), between = magnitude_sum(middle) / 2 + 1;
    const int64_t end = begins > ends ? begins : ends;
    return end > between ? end : between;
  }
};

/// Whether a projection along a coordinate axis shows that the polygon never contains the origin. Let q(i) be the
/// projected corners. The polygon contains the origin only if the cross product q(i) x q(i + 1) has the same sign for
/// all i.
bool passes_by(const ShortSpan& span) {
  const int64_t error = span.is.moment_error();
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

/// Three times the volume p . (q x r) of three corners p, q, r, as a cubic in time. It is 0 where the plane of the
/// polygon contains the origin.
Cubic coplanarity(const ShortSpan& span) {
  const int last = span.count - 1;
  const Moment far(span, 1, last), first(span, 0, 1), second(span, last, 0);
  const Vec32 &from = span.from(0), &to = span.to(0);
  const auto times_3 = [](Int128 value) { return value + value + value; };
  return {{times_3(dot(far.from, from)), dot(far.from, to) + dot(far.middle, from),
           dot(far.to, from) + dot(far.middle, to), times_3(dot(far.to, to))},
          times_3(span.is.volume_error(far.bound() + first.bound() + second.bound()))};
}

}  // namespace

OpenPart open_part(const FeatureSpan& span) {
  const ShortSpan short_span(span);
  if (parted_by_bounds(short_span)) return k_closed;
  if (short_span.is.is_blind()) return k_open;
  const OpenPart part = roots_of(coplanarity(short_span));
  if (part.from > part.to || passes_by(short_span)) return k_closed;
  return parted(short_span.corner, 2 * short_span.count, short_span.is.ball) ? k_closed : part;
}

bool begins_near(const FeatureSpan& span, int64_t gap) {
  // Only the corners at the beginning decide how many bits are dropped. Corners at the end may be so far away that the
  // rounding would hide the gap.
  uint64_t magnitudes = 0;
  for (int i = 0; i < span.count; ++i) magnitudes |= magnitude_bits(span.from[i]);
  const Shortening is(magnitudes, 0);
  Vec32 corner[4];
  for (int i = 0; i < span.count; ++i) corner[i] = round_shift(span.from[i], is.shift);
  return gap >> is.shift >= is.distance_max || !parted(corner, span.count, gap >> is.shift);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
