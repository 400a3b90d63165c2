#pragma once
#include "distance/gjk.h"
#include "distance/pair.h"
#include "toi/moving_pair.h"

/// What the methods of impact share that go from axis to axis: where GJK is asked, what is a hit, and how it is told.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Where the shapes are nearest at `time`, on A's surface, m, from A's position.
inline Vec3<Real> point_on_a(const MovingPair& pair, const Placed& a, const Placed& b, const Simplex& simplex,
                             const GjkResult& nearest, int64_t time) {
  const NearestPoints points = nearest_points(a, b, simplex);
  if (pair.a->type != ShapeType::half_space) {
    return surface_point(points.on_a, pair.exponent, nearest.normal, pair.radius_a);
  }
  const Vec64 offset = add(pair.offset_whole, over_time(pair.displacement_whole, time));
  return half_space_point(offset, points.on_b, pair.exponent, nearest.normal, nearest.upper);
}

/// GJK at a time, then as far as `next_time` leads from there, and so on: until the shapes are within the tolerance,
/// the window ends, `next_time` leads no farther, or more than `iterations_max` axes were needed, which is undecided.
/// `next_time(frames, simplex, nearest, iteration, floor)` gives a time from frames.time on, until which its method
/// holds the cores for `floor` ulps apart. `enough`, ulps: clear at once where no core points are nearer than this when
/// the window begins; INT32_MAX not to look. Inlined always: time_of_impact() then costs no more than with a loop of
/// its own.
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
    result.gjk_calls += nearest.iterations > (hit && iteration > 0 ? 1 : 0) ? 1 : 0;  // one may but confirm the hit
    result.normal = units_from_raw(meet ? Vec32{0, 0, 0} : nearest.normal);
    if (hit) {
      result.outcome = ToiOutcome::hit;
      result.point = point_on_a(pair, a, b, simplex, nearest, time);
      return;
    }
    const int64_t next = next_time(frames, simplex, nearest, iteration, floor);
    if (next >= pair.to) return set_clear(result);
    // On a rim the supports have no end: where the cap left too coarse an axis, the next round goes on from its
    // simplex.
    if (next == time && nearest.outcome != GjkOutcome::capped) break;
    time = next;
    result.time = Fraction::from_raw(time);
  }
  result.outcome = ToiOutcome::undecided;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
