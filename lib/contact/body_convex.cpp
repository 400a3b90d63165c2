#include "contact/body_convex.h"

#include "math/arithmetic.h"
#include "shape/hull.h"
#include "shape/shape_properties.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// Converts `value` to an integer in 2^-30, rounded to nearest.
#if DETENT_FIXED
int32_t raw_from_unit(Unit value) { return value.raw; }
#else
int32_t raw_from_unit(Unit value) {
  bool saturated = false;  // never set: |value| < 2
  return static_cast<int32_t>(integer_from_float(value, 30, saturated));
}
#endif

/// The most by which the stored bounding radius can be too small for the stored sizes, in 2^-30 of the body's unit of
/// length. The error comes from rounding the radius and each size.
constexpr int32_t k_bound_slack = sizeof(Unit) == 4 && !DETENT_FIXED ? 1 << 8 : 4;

/// Sets the sizes, the core radius and the unit of length of `convex`. `size` and the core radius `bound` are in 2^-30
/// of 2^exponent m. The unit becomes the smallest power of two, in m, that exceeds the core radius, but at least
/// 2^k_size_exponent_min m.
void set_core(const int32_t (&size)[3], int32_t bound, int32_t exponent, Convex& convex) {
  int lift = 30 - bit_length_32(static_cast<uint32_t>(bound));
  if (lift > exponent - k_size_exponent_min) lift = exponent - k_size_exponent_min;
  convex.exponent = exponent - lift;
  for (int i = 0; i < 3; ++i) convex.size[i] = static_cast<int32_t>(shift_64(size[i], lift));
  convex.core_radius = static_cast<int32_t>(lift < 0 ? (bound >> 1) + 2 : shift_64(bound, lift));
}

}  // namespace

bool body_convex(const BodyProperties& properties, const AssetTable& assets, Convex& convex) {
  Convex made;
  made.type = static_cast<ShapeType>(properties.shape);
  made.radius = raw_from_unit(properties.rounding);
  made.radius_exponent = properties.size_exponent;
  int32_t size[3] = {raw_from_unit(properties.size.x), raw_from_unit(properties.size.y),
                     raw_from_unit(properties.size.z)};
  switch (made.type) {
    case ShapeType::capsule:
      made.radius = size[0];
      size[0] = 0;
      if (size[1] != 0) set_core(size, size[1], properties.size_exponent, made);
      break;
    case ShapeType::box:
    case ShapeType::cylinder:
    case ShapeType::cone:
      set_core(size, raw_from_unit(properties.bounding_radius) - made.radius + k_bound_slack, properties.size_exponent,
               made);
      break;
    case ShapeType::hull: {
      if (!is_in(assets, properties.asset)) return false;
      made.hull = assets.assets[properties.asset].bytes;
      made.exponent = cooked_i32(made.hull + k_hull_exponent_at);
      made.core_radius = cooked_i32(made.hull + k_hull_core_radius_at);
      made.vertex_count = cooked_u32(made.hull + k_hull_vertex_count_at);
      break;
    }
    case ShapeType::sphere:
      made.radius = size[0];
      break;
    case ShapeType::compound:
      return false;
    default:
      made.radius_exponent = 0;
      break;
  }
  convex = made;
  return true;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
