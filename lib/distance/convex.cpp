#include <detent/distance.h>

#include "distance/pair.h"
#include "math/root.h"
#include "shape/hull.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr int64_t k_raw_size_min = int64_t{1} << (k_metre_bits - 14);
constexpr int64_t k_raw_size_max = int64_t{1} << (k_metre_bits + 14);

bool is_raw_size(int64_t raw) { return raw >= k_raw_size_min && raw <= k_raw_size_max; }
bool is_rounding(int64_t raw) { return raw == 0 || is_raw_size(raw); }

/// Converts 2^-46 m to 2^-30 of the unit of length 2^exponent m.
int32_t in_units(int64_t raw, int exponent) {
  return static_cast<int32_t>(round_shift_64(raw, k_metre_bits - 30 + exponent));
}

void set_ball(int64_t rounding, Convex& convex) {
  convex.radius_exponent = raw_exponent_above(rounding);
  convex.radius = in_units(rounding, convex.radius_exponent);
}

/// Sets the unit of length and the core radius for a core whose points are at most `bound` (2^-46 m) from the origin.
void set_core(int64_t bound, Convex& convex) {
  convex.exponent = raw_exponent_above(bound + 1);
  convex.core_radius = in_units(bound, convex.exponent) + 1;
}

}  // namespace

Status make_convex(const Shape& shape, Convex& convex) {
  Vec64 raw, half;
  if (!raw_from_real({shape.radius, shape.half_length, shape.rounding}, raw)) return Status::out_of_range;
  if (!raw_from_real(shape.half_extents, half)) return Status::out_of_range;
  const int64_t radius = raw.x, half_length = raw.y, rounding = raw.z;
  Convex made;
  made.type = shape.type;
  int64_t bound = 0, smallest = INT64_MAX, largest = 0, ball = rounding;
  Vec64 size = {0, 0, 0};
  if (!is_rounding(rounding)) return Status::out_of_range;
  switch (shape.type) {
    case ShapeType::sphere:
    case ShapeType::capsule:
      if (!is_raw_size(radius)) return Status::out_of_range;
      if (rounding != 0) return Status::bad_argument;
      ball = radius;
      if (shape.type == ShapeType::sphere) break;
      if (half_length < 0 || half_length > k_raw_size_max) return Status::out_of_range;
      size.y = bound = half_length;
      break;
    case ShapeType::box:
      if (!is_raw_size(half.x) || !is_raw_size(half.y) || !is_raw_size(half.z)) return Status::out_of_range;
      size = half;
      bound = length_above(half);
      smallest = half.x < half.y ? half.x : half.y;
      smallest = half.z < smallest ? half.z : smallest;
      largest = half.x > half.y ? half.x : half.y;
      largest = half.z > largest ? half.z : largest;
      break;
    case ShapeType::cylinder:
    case ShapeType::cone: {
      if (!is_raw_size(radius) || !is_raw_size(half_length)) return Status::out_of_range;
      size = {radius, half_length, 0};
      smallest = radius < half_length ? radius : half_length;
      largest = radius > half_length ? radius : half_length;
      const bool is_cone = shape.type == ShapeType::cone;
      bound = length_above({radius, is_cone ? half_length / 2 : half_length, 0});
      const int64_t apex = half_length + half_length / 2 + 1;
      if (is_cone && apex > bound) bound = apex;
      break;
    }
    case ShapeType::half_space:
      if (rounding != 0) return Status::bad_argument;
      break;
    default:
      return Status::bad_argument;
  }
  if ((largest + (1 << 14) - 1) >> 14 > smallest) return Status::out_of_range;
  if (bound > 0) set_core(bound, made);
  for (int i = 0; i < 3; ++i) made.size[i] = in_units(i == 0 ? size.x : i == 1 ? size.y : size.z, made.exponent);
  set_ball(ball, made);
  convex = made;
  return Status::ok;
}

Status make_hull(const Asset& asset, Real rounding, Convex& convex) {
  Vec64 raw;
  if (!raw_from_real({rounding, Real(0.0), Real(0.0)}, raw) || !is_rounding(raw.x)) return Status::out_of_range;
  HullView hull;
  if (const Status status = read_hull(asset, hull); status != Status::ok) return status;
  Convex made;
  made.type = ShapeType::hull;
  made.exponent = hull.exponent();
  made.core_radius = hull.core_radius();
  made.vertex_count = hull.vertex_count;
  made.hull = asset.bytes;
  set_ball(raw.x, made);
  convex = made;
  return Status::ok;
}

Status make_triangle(const Vec3<Real> (&corners)[3], Real rounding, Convex& convex) {
  Vec64 raw;
  if (!raw_from_real({rounding, Real(0.0), Real(0.0)}, raw) || !is_rounding(raw.x)) return Status::out_of_range;
  Convex made;
  made.type = ShapeType::triangle;
  set_ball(raw.x, made);
  Vec64 corner[3];
  int64_t bound = 0;
  for (int i = 0; i < 3; ++i) {
    if (!raw_from_real(corners[i], corner[i])) return Status::out_of_range;
    const int64_t distance = length_above(corner[i]);
    bound = distance > bound ? distance : bound;
  }
  if (bound < k_raw_size_min || bound > 2 * k_raw_size_max) return Status::out_of_range;
  set_core(bound, made);
  for (int i = 0; i < 3; ++i) {
    made.corner[i][0] = in_units(corner[i].x, made.exponent);
    made.corner[i][1] = in_units(corner[i].y, made.exponent);
    made.corner[i][2] = in_units(corner[i].z, made.exponent);
  }
  convex = made;
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
