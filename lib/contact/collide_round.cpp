#include "contact/collide_shapes.h"
#include "contact/segments.h"
#include "math/root.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

// Limit of sin^2 of the angle between the axes of two capsules: at less than 3.6 degrees they touch along a line.
constexpr Unit k_parallel = 0x1p-8;

Segment core(const PairShape& shape) {
  const Unit half = shape.type == ShapeType::capsule ? shape.size.y : Unit(0.0);
  return {shape.centre, shape.rotation.column[1], half};
}

/// Returns the normal for two cores that intersect: a unit vector perpendicular to both. Any such vector would do; this
/// choice is deterministic.
Vec3<Unit> normal_of_meeting(const Segment& a, const Segment& b) {
  Vec3<Unit> normal = {0.0, 1.0, 0.0};
  Unit size = 0.0;
  if (a.half_length > Unit(0.0) && b.half_length > Unit(0.0)) normalise(cross(a.direction, b.direction), normal, size);
  return normal;
}

}  // namespace

void collide_round(const PairFrame& frame, PairManifold& manifold) {
  const Unit zero = 0.0;
  const Segment a = core(frame.a);
  const Segment b = core(frame.b);
  const Unit radius_a = frame.a.size.x;
  const Unit radius_b = frame.b.size.x;
  Unit along_a = zero, along_b = zero;
  closest_points(a, b, along_a, along_b);
  Vec3<Unit> gap = point_at(b, along_b) - point_at(a, along_a);
  Unit distance = zero;
  if (!normalise(gap, manifold.normal, distance)) manifold.normal = normal_of_meeting(a, b);
  if (distance - radius_a - radius_b > frame.margin) return;

  const auto add = [&](Unit at_a, Unit at_b, uint32_t feature) {
    const Vec3<Unit> core_a = point_at(a, at_a);
    const Vec3<Unit> core_b = point_at(b, at_b);
    const Unit separation = dot(core_b - core_a, manifold.normal) - radius_a - radius_b;
    if (separation > frame.margin) return;
    const Vec3<Unit> surface_a = core_a + manifold.normal * radius_a;
    manifold.add({surface_a + manifold.normal * scale_by_power(separation, -1), separation, feature});
  };
  const Unit cosine = dot(a.direction, b.direction);
  if (a.half_length > zero && b.half_length > zero && Unit(1.0) - cosine * cosine < k_parallel) {
    const Unit middle = dot(a.direction, b.centre - a.centre);
    Unit low = max(-a.half_length, middle - b.half_length);
    Unit high = min(a.half_length, middle + b.half_length);
    stay_beside(dot(b.direction, cross(manifold.normal, a.direction)), scale_by_power(min(radius_a, radius_b), -5),
                along_a, low, high);
    if (low < high) {
      manifold.turns = true;
      const auto opposite = [&](Unit at_a) {
        const Unit from_middle = at_a - middle;
        return clamp(cosine < zero ? -from_middle : from_middle, -b.half_length, b.half_length);
      };
      add(low, opposite(low), 1);
      add(high, opposite(high), 2);
      return;
    }
  }
  // If both closest points lie between the ends of their segments, the segments cross and the normal does not rotate.
  const auto is_end = [](Unit along, const Segment& of) { return along >= of.half_length || along <= -of.half_length; };
  manifold.turns = is_end(along_a, a) || is_end(along_b, b);
  add(along_a, along_b, 3);
}

const PairOps k_round_pair_ops = {collide_round};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
