#include <detent/distance.h>

#include "math/root.h"
#include "proximity/gjk.h"
#include "proximity/pair.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// A pair at rest in its block.
struct RestingPair {
  int exponent;  ///< 2^exponent m is the pair's unit of length
  Vec64 offset_whole;  ///< from A's position to B's, 2^-46 m
  Vec32 offset;        ///< the same in the block; of a half-space only the part along its normal
  Placed a, b;
  int64_t radius_a, radius_b;  ///< of the balls, 2^-46 m
};

Status rest(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b, RestingPair& pair) {
  if (a.type == ShapeType::half_space && b.type == ShapeType::half_space) return Status::bad_argument;
  Quat32 rotation_a, rotation_b;
  if (!raw_from_quat(pose_a.rotation, rotation_a) || !raw_from_quat(pose_b.rotation, rotation_b)) {
    return Status::not_normalised;
  }
  const Matrix32 matrix_a = matrix_from(rotation_a), matrix_b = matrix_from(rotation_b);
  Vec64 offset;
  if (!raw_difference(pose_b.position, pose_a.position, offset)) return Status::out_of_range;
  pair.offset_whole = offset;
  const ShapeType half_space = ShapeType::half_space;
  if (a.type == half_space || b.type == half_space) {
    offset = component_along(offset, (a.type == half_space ? matrix_a : matrix_b).column[1]);
  }
  const int64_t reach = saturated_sum(length_bound(offset), raw_core_radius(a) + raw_core_radius(b) + 64);
  pair.exponent = raw_exponent_above(reach);
  pair.offset = round_shift(offset, k_metre_bits - 30 + pair.exponent);
  pair.a = place(a, matrix_a, pair.exponent);
  pair.b = place(b, matrix_b, pair.exponent);
  pair.radius_a = raw_radius(a);
  pair.radius_b = raw_radius(b);
  return Status::ok;
}

void load(const DistanceCache& cache, const Convex& a, const Convex& b, Simplex& simplex) {
  // Only the core points matter: gjk() places them anew.
  for (int i = 0; i < cache.count && i < 4; ++i) {
    SimplexVertex vertex = {{0, 0, 0}, {}, {}};
    if (core_vertex(a, cache.vertex_a[i], vertex.a) && core_vertex(b, cache.vertex_b[i], vertex.b))
      simplex.start(vertex);
  }
}

void save(const Simplex& simplex, DistanceCache& cache) {
  cache = {};
  for (int i = 0; i < simplex.count(); ++i) {
    const SimplexVertex& vertex = simplex.vertex(i);
    if (vertex.a.feature == k_no_feature || vertex.b.feature == k_no_feature) continue;
    cache.vertex_a[cache.count] = vertex.a.feature;
    cache.vertex_b[cache.count] = vertex.b.feature;
    ++cache.count;
  }
}

/// Whether the distance is certainly more than `reach`, 2^-46 m, and `slack` ulps of the block.
Status farther_by(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b, int64_t reach,
                  int32_t slack, bool& result, DistanceCache* cache) {
  RestingPair pair;
  if (const Status status = rest(a, pose_a, b, pose_b, pair); status != Status::ok) return status;
  // In the block, rounded up; beyond it nothing is that far.
  const int64_t needed = saturated_sum(saturated_sum(reach, pair.radius_a), pair.radius_b);
  const int64_t ulps = (needed >> (k_metre_bits - 30 + pair.exponent)) + (needed > 0 ? 1 : 0) + slack;
  result = false;
  if (ulps >= INT32_MAX) return Status::ok;
  const int32_t above = static_cast<int32_t>(ulps);
  Simplex simplex;
  if (cache != nullptr) load(*cache, a, b, simplex);
  const GjkResult found = gjk(pair.a, pair.b, pair.offset, simplex, {above, above, 62});
  if (cache != nullptr) save(simplex, *cache);
  result = found.outcome != GjkOutcome::overlap && (above == 0 || found.lower > above);
  return Status::ok;
}

}  // namespace

Status closest_points(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b, Closest& result,
                      DistanceCache* cache) {
  RestingPair pair;
  if (const Status status = rest(a, pose_a, b, pose_b, pair); status != Status::ok) return status;
  Simplex simplex;
  if (cache != nullptr) load(*cache, a, b, simplex);
  const GjkResult found = gjk(pair.a, pair.b, pair.offset, simplex, {});
  if (cache != nullptr) save(simplex, *cache);
  Closest made;
  made.iterations = static_cast<uint32_t>(found.iterations);
  made.capped = found.outcome == GjkOutcome::capped;
  if (found.outcome == GjkOutcome::overlap) {
    made.overlap = true;
  } else {
    const int64_t gap = raw_from_block(made.capped ? found.lower - k_gjk_slack : found.upper, pair.exponent) -
                        pair.radius_a - pair.radius_b;
    made.overlap = gap <= 0;
    made.distance = real_from_raw(gap > 0 ? gap : 0);
    made.normal = units_from_raw(found.normal);
    const NearestPoints nearest = nearest_points(pair.a, pair.b, simplex);
    const Vec32 back = negate(found.normal);
    made.point_a = a.type == ShapeType::half_space
                       ? half_space_point(pair.offset_whole, nearest.on_b, pair.exponent, found.normal, found.upper)
                       : surface_point(nearest.on_a, pair.exponent, found.normal, pair.radius_a);
    made.point_b = b.type == ShapeType::half_space
                       ? half_space_point(negate(pair.offset_whole), nearest.on_a, pair.exponent, back, found.upper)
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

Status farther_than(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b, Real reach, bool& result,
                    DistanceCache* cache) {
  Vec64 raw;
  if (!raw_from_real({reach, Real(0.0), Real(0.0)}, raw) || raw.x < 0) return Status::out_of_range;
  return farther_by(a, pose_a, b, pose_b, raw.x, k_gjk_slack, result, cache);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
