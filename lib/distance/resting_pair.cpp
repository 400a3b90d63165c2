#include "distance/resting_pair.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

int32_t RestingPair::block_above(int64_t raw) const {
  const int64_t block = raw >> (k_metre_bits - 30 + exponent);
  return block >= INT32_MAX - 1 ? INT32_MAX : static_cast<int32_t>(block) + 1;
}

Status rest(const Convex& a, const Pose& pose_a, const Convex& b, const Pose& pose_b, RestingPair& pair) {
  const bool plane_is_a = a.type == ShapeType::half_space, plane_is_b = b.type == ShapeType::half_space;
  if (plane_is_a && plane_is_b) return Status::bad_argument;
  Quat32 rotation_a, rotation_b;
  if (!raw_from_quat(pose_a.rotation, rotation_a) || !raw_from_quat(pose_b.rotation, rotation_b)) {
    return Status::not_normalised;
  }
  const Matrix32 matrix_a = matrix_from(rotation_a), matrix_b = matrix_from(rotation_b);
  if (!raw_difference(pose_b.position, pose_a.position, pair.offset_metres)) return Status::out_of_range;
  Vec64 offset = pair.offset_metres;
  if (plane_is_a || plane_is_b) {
    if (magnitudes(offset) >> 62 != 0) return Status::out_of_range;
    offset = component_along(offset, (plane_is_a ? matrix_a : matrix_b).column[1]);
  }
  const int64_t cores = raw_core_radius(a) + raw_core_radius(b) + 64, apart = length_bound(offset);
  const int64_t extent = saturated_sum(apart, cores);
  pair.exponent = extent == INT64_MAX ? k_exponent_max : raw_exponent_above(extent);
  pair.offset = round_shift(offset, k_metre_bits - 30 + pair.exponent);
  pair.a = place(a, matrix_a, pair.exponent);
  pair.b = place(b, matrix_b, pair.exponent);
  pair.radius_a = raw_radius(a);
  pair.radius_b = raw_radius(b);
  return Status::ok;
}

void load_cache(const DistanceCache& cache, const RestingPair& pair, Simplex& simplex) {
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

}  // namespace DETENT_NAMESPACE
}  // namespace detent
