#pragma once
#include "distance/gjk.h"
#include "distance/pair.h"
#include "toi/moving_pair.h"

/// The search loop that all time-of-impact methods with a sequence of axes share. It decides where GJK is called, when
/// a hit is reported, and what is reported.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The point on A's surface that is nearest to B at `time`, m, relative to A's position.
inline Vec3<Real> point_on_a(const MovingPair& pair, const Placed& a, const Placed& b, const Simplex& simplex,
                             const GjkResult& nearest, int64_t time) {
  const NearestPoints points = nearest_points(a, b, simplex);
  if (pair.a->type != ShapeType::half_space) {
    return surface_point(points.on_a, pair.exponent, nearest.normal, pair.radius_a);
  }
  const Vec64 offset = add(pair.offset_whole, over_time(pair.displacement_whole, time));
  return half_space_point(offset, points.on_b, pair.exponent, nearest.normal, nearest.upper);
}

/// Repeats two steps: calls GJK at the current time, and advances the time to the result of `next_time`. Stops when the
/// shapes are within the tolerance of touching, or when the window ends in which their bounding spheres touch. The
/// result is undecided if `next_time` makes no progress along an axis that GJK found within its iteration cap, or if
/// `iterations_max` axes did not suffice. `next_time(frames, simplex, nearest, iteration, floor)` returns a time >=
/// frames.time up to which its method finds the cores at least `floor` apart. `floor` and `enough` are in ulps of the
/// pair's block. `enough`: the result is clear at once if the distance of the cores is greater than this when the
/// window begins; INT32_MAX disables this test. The result is also clear once the time has passed `pair.last`. The
/// function is always inlined, so that time_of_impact() costs no more than with a loop of its own.
template <class NextTime>
[[gnu::always_inline]] inline void advance_by_axes(const MovingPair& pair, int iterations_max, int32_t enough,
                                                   TimeOfImpact& result, NextTime next_time) {
  result = {};
  if (pair.from > pair.to) return set_clear(result);
  const int32_t touching = pair.radius + pair.tolerance;
  const int32_t floor = pair.radius + pair.tolerance / 4;
  int64_t time = pair.from;
  Simplex simplex;
  for (int iteration = 0; iteration < iterations_max; ++iteration) {
    const Frames frames = pair.at(time);
    const Placed a = place(*pair.a, frames.a, pair.exponent), b = place(*pair.b, frames.b, pair.exponent);
    const GjkResult nearest = gjk(a, b, frames.offset, simplex, {-1, iteration == 0 ? enough : INT32_MAX});
    if (iteration == 0 && nearest.lower > enough) return set_clear(result);
    result.time = Fraction::from_raw(time);
    const bool meet = nearest.outcome == GjkOutcome::overlap, hit = meet || nearest.upper <= touching;
    // A call whose single iteration only confirms the hit is not counted.
    result.gjk_calls += nearest.iterations > (hit && iteration > 0 ? 1 : 0) ? 1 : 0;
    result.normal = units_from_raw(meet ? Vec32{0, 0, 0} : nearest.normal);
    if (hit) {
      result.outcome = ToiOutcome::hit;
      result.point = point_on_a(pair, a, b, simplex, nearest, time);
      return;
    }
    const int64_t next = next_time(frames, simplex, nearest, iteration, floor);
    if (next >= pair.to || next > pair.last) return set_clear(result);
    // A rim has infinitely many support points, so GJK may stop at its iteration cap with too coarse an axis. GJK then
    // continues from its last simplex in the next iteration of this loop.
    if (next == time && nearest.outcome != GjkOutcome::capped) break;
    time = next;
    result.time = Fraction::from_raw(time);
  }
  result.outcome = ToiOutcome::undecided;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
