#include "distance/gjk.h"

#include "math/root.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

Vec32 difference_of(const Placed& a, const Placed& b, const Vec32& offset, const SimplexVertex& vertex) {
  return add(offset, subtract(b.point(vertex.b.local), a.point(vertex.a.local)));
}

/// Rebuilds the simplex of an earlier query from its core points: computes their differences at the current poses.
void restart(const Placed& a, const Placed& b, const Vec32& offset, Simplex& simplex) {
  const Simplex last = simplex;
  simplex.clear();
  for (int i = 0; i < last.count() && !simplex.holds_origin(); ++i) {
    SimplexVertex vertex = last.vertex(i);
    vertex.difference = difference_of(a, b, offset, vertex);
    simplex.insert(vertex);
  }
}

/// The cores certainly have a gap along a direction vector if the dot product of the vector and the difference of the
/// support points (ulps) is above this. The vector is shorter than 2^31, so the gap is then more than four ulps: more
/// than the rounding errors of the direction and of the support points.
constexpr int64_t k_touching = int64_t{4} << 31;

int32_t floor_30(int64_t value) { return static_cast<int32_t>(value >> 30); }
int32_t ceiling_30(int64_t value) { return static_cast<int32_t>((value + (int64_t{1} << 30) - 1) >> 30); }

const SimplexVertex& newest(const Simplex& simplex) { return simplex.vertex(simplex.count() - 1); }

/// Sets `core` to the vertex of the placed core that is exactly the farthest along v, the vector from the origin to the
/// simplex's nearest point (`sign` -1: along -v). Leaves `core` as it is if the core has no vertices.
void exact_support(const Placed& placed, const Simplex& simplex, int sign, CorePoint& core) {
  CorePoint vertex;
  Int128 most = Int128::from(0);
  for (uint32_t i = 0; i < k_no_feature && core_vertex(*placed.convex, static_cast<uint8_t>(i), vertex); ++i) {
    const Int128 along = simplex.support(placed.point(vertex.local));
    const Int128 along_direction = sign < 0 ? -along : along;
    if (i != 0 && !(most < along_direction)) continue;
    most = along_direction;
    core = vertex;
  }
}

/// As gjk(), for a pair with a half-space. Only the normal of its plane can separate it from the other shape.
GjkResult half_space_gjk(const Placed& a, const Placed& b, const Vec32& offset, Simplex& simplex) {
  const bool plane_is_a = a.convex->type == ShapeType::half_space;
  const Vec32 up = (plane_is_a ? a : b).rotation.column[1];
  const Vec32 normal = plane_is_a ? up : negate(up);
  const SupportPoint on_a = support(a, normal), on_b = support(b, negate(normal));
  const SimplexVertex vertex = {add(offset, subtract(on_b.point, on_a.point)), on_a.core, on_b.core};
  simplex.clear();
  simplex.insert(vertex);
  const int64_t gap = dot(normal, vertex.difference);
  const GjkOutcome outcome = gap <= 0 ? GjkOutcome::overlap : GjkOutcome::apart;
  return {outcome, normal, ceiling_30(gap), floor_30(gap), 1};
}

}  // namespace

GjkResult gjk(const Placed& a, const Placed& b, const Vec32& offset, Simplex& simplex, const GjkLimits& limits) {
  if (a.convex->type == ShapeType::half_space || b.convex->type == ShapeType::half_space) {
    return half_space_gjk(a, b, offset, simplex);
  }
  GjkResult result = {GjkOutcome::apart, {0, 0, 0}, INT32_MAX, 0, 0};
  uint8_t start_a = 0, start_b = 0;
  if (simplex.count() != 0) {
    restart(a, b, offset, simplex);
    start_a = newest(simplex).a.feature;
    start_b = newest(simplex).b.feature;
  }
  Vec32 direction = is_zero(offset) ? Vec32{1 << 30, 0, 0} : scaled_to_30_bits(offset);
  for (;;) {
    int64_t along_direction = 0;  // direction . nearest point
    if (simplex.count() != 0) {
      if (simplex.holds_origin()) {
        result.outcome = GjkOutcome::overlap;
        result.upper = 0;
        return result;
      }
      direction = simplex.direction();
      along_direction = dot(direction, newest(simplex).difference);
      // |direction| is at most sqrt(3) 2^30, below 2^31, so this shift gives a lower bound of the distance. If the
      // bound is above limits.below, `upper` need not be computed.
      if (along_direction >> 31 <= limits.below) {
        result.normal = unit_vector_raw(direction);
        result.upper = ceiling_30(dot(result.normal, newest(simplex).difference));
        if (result.upper <= limits.below) return result;
      }
    }
    const SupportPoint on_a = support(a, direction, start_a), on_b = support(b, negate(direction), start_b);
    start_a = on_a.core.feature;
    start_b = on_b.core.feature;
    ++result.iterations;
    SimplexVertex vertex = {add(offset, subtract(on_b.point, on_a.point)), on_a.core, on_b.core};
    const int64_t floor = dot(direction, vertex.difference);
    const int64_t progress = along_direction - floor;
    // If the gap is at most k_touching, only exact tests decide: rounding never decides whether the cores overlap.
    const bool touching = floor <= k_touching;
    const bool precise = simplex.count() != 0 && !touching && progress <= int64_t{1} << 30;
    const bool separate =
        floor >> 29 > limits.above && floor_30(dot(unit_vector_raw(direction), vertex.difference)) > limits.above;
    const bool last = result.iterations == k_gjk_iterations_max;
    if (!precise && !separate && !last) {
      if (simplex.insert(vertex)) continue;
      if (touching) {
        exact_support(a, simplex, 1, vertex.a);
        exact_support(b, simplex, -1, vertex.b);
        vertex.difference = difference_of(a, b, offset, vertex);
        if (simplex.insert(vertex)) continue;
      }
    }

    if (last && !precise && !separate) result.outcome = GjkOutcome::capped;
    if (simplex.count() == 0) simplex.insert(vertex);
    result.normal = unit_vector_raw(direction);
    result.lower = floor_30(dot(result.normal, vertex.difference));
    result.upper = ceiling_30(dot(result.normal, newest(simplex).difference));
    return result;
  }
}

GjkResult gjk_on(const Placed& a, const Placed& b, const Vec32& offset, Simplex& simplex, const GjkLimits& limits) {
  GjkResult result = gjk(a, b, offset, simplex, limits);
  for (int round = 1; round < k_gjk_rounds_max && result.outcome == GjkOutcome::capped; ++round) {
    const int iterations = result.iterations;
    result = gjk(a, b, offset, simplex, limits);
    result.iterations += iterations;
  }
  return result;
}

NearestPoints nearest_points(const Placed& a, const Placed& b, const Simplex& simplex) {
  int32_t weight[4];
  simplex.weights(weight);
  const auto weighted = [&](const Placed& placed, CorePoint SimplexVertex::*of) {
    if (simplex.count() == 1) return placed.point((simplex.vertex(0).*of).local);
    Vec64 sum = {0, 0, 0};
    for (int i = 0; i < simplex.count(); ++i) {
      const Vec32 p = placed.point((simplex.vertex(i).*of).local);
      sum = add(sum, Vec64{int64_t{p.x} * weight[i], int64_t{p.y} * weight[i], int64_t{p.z} * weight[i]});
    }
    return round_shift(sum, 30);
  };
  return {weighted(a, &SimplexVertex::a), weighted(b, &SimplexVertex::b)};
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
