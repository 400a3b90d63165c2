#include "solver/contact_arms.h"

#include "contact/contact_arm.h"
#include "math/rotation.h"
#include "motion/angular_velocity.h"
#include "shape/shape_properties.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr Unit k_arm_rotation_max = 0.25;  ///< limit of the rotation of the points, rad
/// The squared sine of the angle between an axis and the normal below which a cylinder or cone stands on its base.
constexpr Unit k_least_lean = 0x1p-12;

bool is_solid_of_revolution(ShapeType shape) { return shape == ShapeType::cylinder || shape == ShapeType::cone; }

/// The angle, rad, by which the contact points of a body rotate about the normal in `time`.
Unit rotation_of_points(const RowBody& body, const Vec3<Unit>& normal, Real time) {
  const BodyProperties& properties = body.properties;
  const ShapeType shape = shape_of(properties);
  if (shape == ShapeType::sphere || shape == ShapeType::capsule) return 0.0;
  bool clamped = false;
  const auto angle_of_part = [&](Real part) {
    return angle_of(scale_by_power(part * time, k_angular_velocity_power), properties.size_exponent, clamped);
  };
  const Vec3<Real>& rate = body.angular_velocity;
  const Vec3<Real> angle = {angle_of_part(rate.x), angle_of_part(rate.y), angle_of_part(rate.z)};
  const Real most = real_from_unit(k_arm_rotation_max, 0);
  Real about_normal = dot(angle, normal);
  if (is_solid_of_revolution(shape)) {
    const Vec3<Unit> axis = rotate(body.pose.rotation, Vec3<Unit>{0.0, 1.0, 0.0});
    const Unit upright = dot(axis, normal), lean = Unit(1.0) - upright * upright;
    if (lean < k_least_lean) return 0.0;
    about_normal = divide(about_normal - dot(angle, axis) * upright, real_from_unit(lean, 0));
  } else if (greatest(angle - normal * about_normal) > abs(about_normal)) {
    return 0.0;
  }
  return unit_from_real(clamp(about_normal, -most, most), 0);
}

/// Does the work of advance_arms() for a dynamic body and a body that is not dynamic.
Unit advance(const RowBody& dynamic, const RowBody& other, const Vec3<Unit>& normal, Real time, Vec3<Unit>& arm,
             Vec3<Unit>& other_arm) {
  const Unit angle = rotation_of_points(dynamic, normal, time);
  const Vec3<Unit> rotated = cross(normal, arm) * angle;
  arm += rotated;
  if (!is_kinematic(other.properties)) return angle;
  const Vec3<Real> relative = (dynamic.motion.linear_velocity - other.motion.linear_velocity) * time +
                              real_from_unit(rotated, dynamic.properties.size_exponent);
  const Vec3<Real> slide = relative - normal * dot(relative, normal);
  const int unit = other.properties.size_exponent;
  other_arm = arm_of_offset(real_from_unit(other_arm, unit) + slide, unit);
  return angle;
}

}  // namespace

Unit advance_arms(const RowBody& a, const RowBody& b, const Vec3<Unit>& normal, Real time, Vec3<Unit>& arm_a,
                  Vec3<Unit>& arm_b) {
  const bool dynamic_a = is_dynamic(a.properties), dynamic_b = is_dynamic(b.properties);
  if (dynamic_a == dynamic_b) return 0.0;
  return dynamic_a ? advance(a, b, normal, time, arm_a, arm_b) : advance(b, a, normal, time, arm_b, arm_a);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
