#include "proximity/contact_pair.h"

#include "proximity/penetration.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr int32_t k_push = 256;  ///< ulps; deep enough for a direction

/// v length, for a unit vector v.
Vec32 scaled(const Vec32& v, int64_t length) {
  return round_shift(Vec64{v.x * length, v.y * length, v.z * length}, 30);
}

Vec32 weighted(const Placed& placed, const Simplex& simplex, const int32_t (&weight)[4], CorePoint SimplexVertex::*of) {
  Vec64 sum = {0, 0, 0};
  for (int i = 0; i < simplex.count(); ++i) {
    const Vec32 p = placed.point((simplex.vertex(i).*of).local);
    sum = add(sum, Vec64{int64_t{p.x} * weight[i], int64_t{p.y} * weight[i], int64_t{p.z} * weight[i]});
  }
  return round_shift(sum, 30);
}

ContactAxis axis_of(const Penetration& found) {
  return {found.normal, -int64_t{found.depth}, found.point_a, found.point_b, found.capped};
}

/// The axis of round cores, at most `distance` ulps apart, where gjk() met its cap: B is pushed into A, and the least
/// way out found. False if they don't meet even then.
bool axis_by_pushing(const ContactPair& pair, const Vec32& normal, int32_t distance, ContactAxis& axis) {
  const int64_t push = int64_t{distance} + k_push;
  const Vec32 offset = subtract(pair.offset, scaled(normal, push));
  Simplex simplex;
  if (gjk(pair.a, pair.b, offset, simplex, {}).outcome != GjkOutcome::overlap) return false;
  axis = axis_of(penetration(pair.a, pair.b, offset, simplex));
  axis.separation += (push * (dot(normal, axis.normal) >> 30)) >> 30;
  return true;
}

}  // namespace

int32_t ContactPair::block_above(int64_t raw) const {
  const int64_t block = raw >> (k_metre_bits - 30 + exponent);
  return block >= INT32_MAX - 1 ? INT32_MAX : static_cast<int32_t>(block) + 1;
}

Status make_contact_pair(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b, ContactPair& pair) {
  const bool plane_is_a = a.type == ShapeType::half_space, plane_is_b = b.type == ShapeType::half_space;
  if (plane_is_a && plane_is_b) return Status::bad_argument;
  Quat32 rotation_a, rotation_b;
  if (!raw_from_quat(pose_a.rotation, rotation_a) || !raw_from_quat(pose_b.rotation, rotation_b)) {
    return Status::not_normalised;
  }
  const Matrix32 matrix_a = matrix_from(rotation_a), matrix_b = matrix_from(rotation_b);
  if (!raw_difference(pose_b.position, pose_a.position, pair.offset_metres)) return Status::out_of_range;
  Vec64 offset = pair.offset_metres;
  if (plane_is_a || plane_is_b) offset = component_along(offset, (plane_is_a ? matrix_a : matrix_b).column[1]);
  const int64_t cores = raw_core_radius(a) + raw_core_radius(b) + 64, apart = length_bound(offset);
  pair.exponent = raw_exponent_above(saturated_sum(apart, cores));
  pair.offset = round_shift(offset, k_metre_bits - 30 + pair.exponent);
  pair.a = place(a, matrix_a, pair.exponent);
  pair.b = place(b, matrix_b, pair.exponent);
  pair.radius_a = raw_radius(a);
  pair.radius_b = raw_radius(b);
  return Status::ok;
}

void load_cache(const DistanceCache& cache, const ContactPair& pair, Simplex& simplex) {
  for (int i = 0; i < cache.count && i < 4; ++i) {
    SimplexVertex vertex = {{0, 0, 0}, {}, {}};
    if (core_vertex(*pair.a.convex, cache.vertex_a[i], vertex.a) &&
        core_vertex(*pair.b.convex, cache.vertex_b[i], vertex.b)) {
      simplex.start(vertex);
    }
  }
}

void save_cache(const Simplex& simplex, DistanceCache& cache) {
  cache = {};
  for (int i = 0; i < simplex.count(); ++i) {
    const SimplexVertex& vertex = simplex.vertex(i);
    if (vertex.a.feature == k_no_feature || vertex.b.feature == k_no_feature) continue;
    cache.vertex_a[cache.count] = vertex.a.feature;
    cache.vertex_b[cache.count] = vertex.b.feature;
    ++cache.count;
  }
}

bool find_contact_axis(const ContactPair& pair, int32_t above, DistanceCache* cache, ContactAxis& axis) {
  Simplex simplex;
  if (cache != nullptr) load_cache(*cache, pair, simplex);
  const GjkResult found = gjk(pair.a, pair.b, pair.offset, simplex, {-1, above, 62});
  if (cache != nullptr) save_cache(simplex, *cache);
  if (found.outcome == GjkOutcome::overlap) {
    axis = axis_of(penetration(pair.a, pair.b, pair.offset, simplex));
    return true;
  }
  if (found.lower > above) return false;
  const bool capped = found.outcome == GjkOutcome::capped;
  if (capped && axis_by_pushing(pair, found.normal, found.upper, axis)) return true;
  int32_t weight[4];
  simplex.weights(weight);
  axis = {found.normal, found.upper, weighted(pair.a, simplex, weight, &SimplexVertex::a),
          weighted(pair.b, simplex, weight, &SimplexVertex::b), capped};
  if (pair.planar()) {  // the point of the plane is the foot of the other's
    const Vec32 way = subtract(add(pair.offset, axis.point_b), axis.point_a);
    const int64_t height = dot(axis.normal, way) >> 30;
    if (pair.a.convex->type == ShapeType::half_space) {
      axis.point_a = subtract(add(pair.offset, axis.point_b), scaled(axis.normal, height));
    } else {
      axis.point_b = subtract(add(axis.point_a, scaled(axis.normal, height)), pair.offset);
    }
  }
  return true;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
