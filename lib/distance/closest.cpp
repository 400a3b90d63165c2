#include <detent/distance.h>

#include "distance/resting_pair.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// Sets `result` to whether the distance certainly exceeds `distance_max` (2^-46 m). `slack` (ulps of the pair's block,
/// support.h) is added to the distance at which gjk() stops. It is k_gjk_slack for farther_than(). It is 0 for
/// overlap(), because gjk() decides exactly whether two cores without balls touch.
Status farther_by(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b, int64_t distance_max,
                  int32_t slack, bool& result, DistanceCache* cache) {
  RestingPair pair;
  if (const Status status = rest(a, pose_a, b, pose_b, pair); status != Status::ok) return status;
  // The threshold in ulps (2^-30 of the pair's unit), rounded up. No distance between the cores exceeds INT32_MAX ulps.
  const int64_t needed = saturated_sum(saturated_sum(distance_max, pair.radius_a), pair.radius_b);
  const int64_t ulps = (needed >> (k_metre_bits - 30 + pair.exponent)) + (needed > 0 ? 1 : 0) + slack;
  result = false;
  if (ulps >= INT32_MAX) return Status::ok;
  const int32_t above = static_cast<int32_t>(ulps);
  Simplex simplex;
  if (cache != nullptr) load_cache(*cache, pair, simplex);
  const GjkResult found = gjk_on(pair.a, pair.b, pair.offset, simplex, {above, above});
  if (cache != nullptr) save_cache(simplex, *cache);
  if (found.outcome == GjkOutcome::apart && above == 0)
    result = true;
  else
    result = found.outcome != GjkOutcome::overlap && found.lower > above + (slack == 0 ? k_gjk_slack : 0);
  return Status::ok;
}

}  // namespace

Status closest_points(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b, Closest& result,
                      DistanceCache* cache) {
  RestingPair pair;
  if (const Status status = rest(a, pose_a, b, pose_b, pair); status != Status::ok) return status;
  Simplex simplex;
  if (cache != nullptr) load_cache(*cache, pair, simplex);
  const GjkResult found = gjk_on(pair.a, pair.b, pair.offset, simplex, {});
  if (cache != nullptr) save_cache(simplex, *cache);
  Closest made;
  made.iterations = static_cast<uint32_t>(found.iterations);
  made.capped = found.outcome == GjkOutcome::capped;
  if (found.outcome == GjkOutcome::overlap) {
    made.overlap = true;
  } else {
    const int64_t gap = raw_from_block(made.capped ? found.lower - k_gjk_slack : found.upper, pair.exponent) -
                        pair.radius_a - pair.radius_b;
    made.overlap = gap <= 0 && !made.capped;
    made.distance = real_from_raw(gap > 0 ? gap : 0);
    made.normal = units_from_raw(found.normal);
    const NearestPoints nearest = nearest_points(pair.a, pair.b, simplex);
    const Vec32 back = negate(found.normal);
    made.point_a = a.type == ShapeType::half_space
                       ? half_space_point(pair.offset_metres, nearest.on_b, pair.exponent, found.normal, found.upper)
                       : surface_point(nearest.on_a, pair.exponent, found.normal, pair.radius_a);
    made.point_b = b.type == ShapeType::half_space
                       ? half_space_point(negate(pair.offset_metres), nearest.on_a, pair.exponent, back, found.upper)
                       : surface_point(nearest.on_b, pair.exponent, back, pair.radius_b);
  }
  result = made;
  return Status::ok;
}

Status overlap(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b, bool& result,
               DistanceCache* cache) {
  bool farther = false;
  if (const Status status = farther_by(a, pose_a, b, pose_b, 0, 0, farther, cache); status != Status::ok) return status;
  result = !farther;
  return Status::ok;
}

Status farther_than(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b, Real distance_max,
                    bool& result, DistanceCache* cache) {
  Vec64 raw;
  if (!raw_from_real({distance_max, Real(0.0), Real(0.0)}, raw) || raw.x < 0) return Status::out_of_range;
  return farther_by(a, pose_a, b, pose_b, raw.x, k_gjk_slack, result, cache);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
