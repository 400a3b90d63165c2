#include "contact/contact_arm.h"

#include "math/root.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// Clamps the length of an arm to k_arm_max. Range: each component is already clamped to +-k_arm_max.
Vec3<Unit> clamped_arm(const Vec3<Unit>& arm) {
  constexpr Unit k_surely_short = 0.7216;  // k_arm_max / sqrt(3): an arm with smaller components is within the limit
  if (max(abs(arm.x), max(abs(arm.y), abs(arm.z))) < k_surely_short) return arm;
  const auto half = [](Unit value) { return scale_by_power(value, -1); };
  const Vec3<Unit> halved = {half(arm.x), half(arm.y), half(arm.z)};
  const Unit limit = half(k_arm_max);
  if (!(dot(halved, halved) > limit * limit)) return arm;
  Vec3<Unit> direction;
  Unit ignored;
  normalise(halved, direction, ignored);
  return direction * k_arm_max;
}

}  // namespace

Vec3<Unit> arm_of_point(const Vec3<Unit>& point, int power) {
  const Unit limit = scale_by_power(k_arm_max, power > 0 ? -power : 0);
  const auto component = [&](Unit value) { return scale_by_power(clamp(value, -limit, limit), power); };
  return clamped_arm({component(point.x), component(point.y), component(point.z)});
}

Vec3<Unit> arm_of_offset(const Vec3<Real>& offset, int32_t exponent) {
  const Real limit = real_from_unit(k_arm_max, exponent);
  const auto component = [&](Real value) { return unit_from_real(clamp(value, -limit, limit), exponent); };
  return clamped_arm({component(offset.x), component(offset.y), component(offset.z)});
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
