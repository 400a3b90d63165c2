#include "math/root.h"
#include "proximity/feature_search.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr int k_range_bits = 10;
constexpr int k_tangent_bits = 28;
constexpr int64_t k_one = int64_t{1} << (2 * k_tangent_bits);
constexpr int64_t k_tangent_max = int64_t{4} << k_tangent_bits;

/// g x v, with g in Q28. Rounding: to nearest.
Vec64 cross_tangent(const Vec32& g, const Vec64& v) {
  const auto minor = [](int32_t a, int64_t p, int32_t b, int64_t q) {
    return (Int128::product_narrow(p, a) - Int128::product_narrow(q, b)).round_shift(k_tangent_bits);
  };
  return {minor(g.y, v.z, g.z, v.y), minor(g.z, v.x, g.x, v.z), minor(g.x, v.y, g.y, v.x)};
}

/// A's corners at rest and B's in a screw, in A's frame. With g along its axis and as long as the tangent of half its
/// angle, and d the way of B's position, the corner that is x from B's position c at the start is at time t at
///   c + x + t d + t (g x y + t g x (g x y)) / (1 + t^2 g^2),  y = 2 x - (1 - t) d:
/// neither the axis nor the angle is needed, and without a turn it is a straight line. With |g| <= 4 and |y| < 2^59 the
/// two products, at right angles to each other, have a sum below 2^63.
struct ScrewPath {
  FeatureKind kind;
  Vec64 corner[4];   ///< of B from its position at the start, in A's axes, 2^-46 m
  Vec64 first, way;  ///< of B's position from A's: at the start, and d
  Vec32 tangent;     ///< g, Q28
  int64_t square;    ///< of g, Q56
  int64_t bend;      ///< the most that a corner is off its chord over the whole step
  int64_t ball;      ///< of a difference at either end of an interval

  FeatureSpan span(int64_t from, int64_t to) const {
    FeatureSpan span;
    span.count = difference_count(kind);
    set_differences_at(from, span.from);
    set_differences_at(to, span.to);
    span.ball = ball + over_time(over_time(bend, to - from) + 1, to - from) + 1;
    return span;
  }
  /// Whether a line at rest meets a moving line, or a point a plane, is linear in the moving one's coordinates. Those
  /// are entries of its rotation, which are quadratic after multiplication by 1 + t^2 g^2, and such times the way along
  /// the axis, which is linear: in all a cubic.
  OpenPart roots(int64_t from, int64_t to) const {
    Vec64 corners[4][3];
    int64_t weight[4];
    for (int i = 0; i < 4; ++i) {
      const int64_t time = i == 3 ? to : from + i * ((to - from) / 3);
      Vec64 difference[4];
      set_differences_at(time, difference);
      corners[i][0] = difference[0];
      corners[i][1] = difference[1];
      corners[i][2] = difference[difference_count(kind) - 1];
      weight[i] = weight_at(time) >> k_tangent_bits;
    }
    return reduced_roots(corners, weight, ball + 1);  // a third of the interval is rounded down
  }

 private:
  /// 1 + t^2 g^2, Q56.
  int64_t weight_at(int64_t time) const { return k_one + over_time(over_time(square, time), time); }
  void set_differences_at(int64_t time, Vec64 (&difference)[4]) const {
    const int64_t inverse = time_quotient(k_one, weight_at(time));
    const Vec64 moved = over_time(way, time);
    Vec64 placed[4];
    for (int i = 0; i < 4; ++i) {
      placed[i] = corner[i];
      if (i < first_of_b(kind)) continue;
      const Vec64 y = add(add(corner[i], corner[i]), add(moved, negate(way)));
      const Vec64 once = cross_tangent(tangent, y), twice = cross_tangent(tangent, once);
      const Vec64 turned = over_time(over_time(add(once, over_time(twice, time)), time), inverse);
      placed[i] = add(add(first, corner[i]), add(moved, turned));
    }
    set_differences(kind, placed, difference);
  }
};

constexpr Quat32 conjugate(const Quat32& q) { return {-q.x, -q.y, -q.z, q.w}; }

/// B in A's frame.
struct RelativePose {
  Quat32 rotation;
  Vec64 position;  ///< 2^-46 m
};
Status relative_pose(const Pose& a, const Pose& b, RelativePose& relative) {
  Quat32 of_a, of_b;
  if (!raw_from_quat(a.rotation, of_a) || !raw_from_quat(b.rotation, of_b)) return Status::not_normalised;
  Vec64 offset;
  if (!raw_difference(b.position, a.position, offset) || !in_range(offset, k_range_bits)) return Status::out_of_range;
  const Quat32 back = conjugate(of_a);
  relative = {multiply(back, of_b), rotated(matrix_from(back), offset)};
  return Status::ok;
}

/// The tangent of half the angle of the rotation from one pose to another, along its axis. False if it is beyond 4.
bool tangent_between(const Quat32& from, const Quat32& to, Vec32& tangent) {
  const Quat32 turn = multiply(to, conjugate(from));
  const int64_t w = turn.w;
  if (magnitude_64(w) < uint64_t{1} << 27) return false;
  const auto part = [w](int32_t v) { return (int64_t{v} << k_tangent_bits) / w; };
  const Vec64 g = {part(turn.x), part(turn.y), part(turn.z)};
  if (largest_component(g) > k_tangent_max) return false;
  tangent = {static_cast<int32_t>(g.x), static_cast<int32_t>(g.y), static_cast<int32_t>(g.z)};
  return dot(tangent, tangent) <= k_tangent_max * k_tangent_max;
}

}  // namespace

Status feature_toi_screw(FeatureKind kind, const Vec3<Real> (&corner)[4], const PosePair& a, const PosePair& b,
                         FeatureToi& result) {
  if (!is_kind(kind)) return Status::bad_argument;
  RelativePose start, end;
  if (const Status status = relative_pose(a.start, b.start, start); status != Status::ok) return status;
  if (const Status status = relative_pose(a.end, b.end, end); status != Status::ok) return status;
  ScrewPath path;
  path.kind = kind;
  if (!raw_corners(corner, k_range_bits, path.corner) || !tangent_between(start.rotation, end.rotation, path.tangent)) {
    return Status::out_of_range;
  }
  const int64_t size = size_of(kind, path.corner);
  const int split = first_of_b(kind);
  const Matrix32 rotation = matrix_from(start.rotation);
  for (int i = split; i < 4; ++i) path.corner[i] = rotated(rotation, path.corner[i]);
  path.first = start.position;
  path.way = add(end.position, negate(start.position));
  path.square = dot(path.tangent, path.tangent);
  // With r the distance from the axis |x''| <= 4 g^2 r, and g r <= |d| sqrt(1 + g^2) / 2 + g |x|.
  const int64_t reach = reach_of(path.corner + split, 4 - split), far = length_above(path.way);
  const int64_t g = static_cast<int64_t>(square_root_nearest(Words128{0, static_cast<uint64_t>(path.square)})) + 1;
  const auto times_g = [g](int64_t value) { return Int128::product(value, g).round_shift(k_tangent_bits) + 1; };
  const int64_t swing = times_g(times_g(reach)), drift = times_g(far + times_g(far));
  path.bend = (swing >> 1) + (drift >> 2) + 2;
  // Rotations composed from rounded ones, a tangent rounded after a division by 1/4 or more; sums rounded.
  path.ball = (reach >> 24) + ((length_above(start.position) + length_above(end.position)) >> 26) + 64;
  search(path, near_gap(size, path.ball), result);
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
