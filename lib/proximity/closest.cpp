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
  Vec32 offset;  ///< from A's centre to B's, in the block
  Placed a, b;
  int64_t radius_a, radius_b;  ///< of the balls, 2^-46 m

  int64_t metres(int64_t block) const {
    const int n = exponent + k_metre_bits - 30;
    const int64_t limit = INT64_MAX >> n;
    return block > limit ? INT64_MAX : block < -limit ? -INT64_MAX : block * (int64_t{1} << n);
  }
};

int64_t saturated_sum(int64_t a, int64_t b) { return a > INT64_MAX - b ? INT64_MAX : a + b; }

Status rest(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b, RestingPair& pair) {
  if (a.type == ShapeType::half_space && b.type == ShapeType::half_space) return Status::bad_argument;
  Quat32 rotation_a, rotation_b;
  if (!raw_from_quat(pose_a.rotation, rotation_a) || !raw_from_quat(pose_b.rotation, rotation_b)) {
    return Status::not_normalised;
  }
  const Matrix32 matrix_a = matrix_from(rotation_a), matrix_b = matrix_from(rotation_b);
  Vec64 offset = raw_difference(pose_b.position, pose_a.position);
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
    if (core_vertex(a, cache.vertex_a[i], vertex.a) && core_vertex(b, cache.vertex_b[i], vertex.b)) simplex.start(vertex);
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

/// The points that the simplex' nearest point is the difference of, in the block, each from its shape's centre.
void witnesses(const RestingPair& pair, const Simplex& simplex, Vec32& on_a, Vec32& on_b) {
  int32_t weight[4];
  simplex.weights(weight);
  const auto weighted = [&](const Placed& placed, CorePoint SimplexVertex::* of) {
    if (simplex.count() == 1) return placed.point((simplex.vertex(0).*of).local);
    Vec64 sum = {0, 0, 0};
    for (int i = 0; i < simplex.count(); ++i) {
      const Vec32 p = placed.point((simplex.vertex(i).*of).local);
      sum = add(sum, Vec64{int64_t{p.x} * weight[i], int64_t{p.y} * weight[i], int64_t{p.z} * weight[i]});
    }
    return round_shift(sum, 30);
  };
  on_a = weighted(pair.a, &SimplexVertex::a);
  on_b = weighted(pair.b, &SimplexVertex::b);
}

Vec3<Real> surface_point(const RestingPair& pair, const Vec32& core, const Vec32& normal, int64_t radius) {
  const auto component = [&](int64_t at, int32_t n) {
    return real_from_raw(saturated_sum(pair.metres(at), Int128::product_narrow(radius, n).round_shift(30)));
  };
  return {component(core.x, normal.x), component(core.y, normal.y), component(core.z, normal.z)};
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
    const int64_t gap = pair.metres(made.capped ? found.lower - k_gjk_slack : found.upper) - pair.radius_a - pair.radius_b;
    made.overlap = gap <= 0;
    made.distance = real_from_raw(gap > 0 ? gap : 0);
    made.normal = units_from_raw(found.normal);
    Vec32 on_a, on_b;
    witnesses(pair, simplex, on_a, on_b);
    made.point_a = surface_point(pair, on_a, found.normal, pair.radius_a);
    made.point_b = surface_point(pair, on_b, negate(found.normal), pair.radius_b);
  }
  result = made;
  return Status::ok;
}

Status farther_than(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b, Real reach, bool& result,
                    DistanceCache* cache) {
  RestingPair pair;
  if (const Status status = rest(a, pose_a, b, pose_b, pair); status != Status::ok) return status;
  Vec64 raw;
  if (!raw_from_real({reach, Real(0.0), Real(0.0)}, raw) || raw.x < 0) return Status::out_of_range;
  // In the block, rounded up; beyond it nothing is that far.
  const int n = k_metre_bits - 30 + pair.exponent;
  const int64_t needed = saturated_sum(saturated_sum(raw.x, pair.radius_a), pair.radius_b) >> n;
  if (needed >= INT32_MAX - 2 * k_gjk_slack) {
    result = false;
    return Status::ok;
  }
  const int32_t above = static_cast<int32_t>(needed) + 1 + k_gjk_slack;
  Simplex simplex;
  if (cache != nullptr) load(*cache, a, b, simplex);
  const GjkResult found = gjk(pair.a, pair.b, pair.offset, simplex, {above, above, 62});
  if (cache != nullptr) save(simplex, *cache);
  result = found.outcome != GjkOutcome::overlap && found.lower > above;
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
