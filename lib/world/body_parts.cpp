#include "world/body_parts.h"

#include "motion/angular_velocity.h"
#include "shape/shape_properties.h"
#include "state/asset_binding.h"
#include "state/ranges.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

bool is_material(const Material& material) {
  return within(material.friction, Real(0.0), k_friction_max) && within(material.restitution, Real(0.0), Real(1.0)) &&
         within(material.rolling_resistance, Real(0.0), k_friction_max);
}

}  // namespace

Status suits(const World& world, ShapeType shape, uint32_t asset, BodyType type) {
  if (!is_type(type)) return Status::bad_argument;
  const bool is_ground = shape == ShapeType::half_space || shape == ShapeType::terrain;
  if (is_ground && type == BodyType::dynamic) return Status::bad_argument;
  return asset_kind_of(shape) == AssetKind::none ? Status::ok : find_shape(world, shape, asset, type);
}

Status set_body_shape(const World& world, const Shape& shape, BodyType type, BodyProperties& properties) {
  if (const Status status = suits(world, shape.type, shape.asset, type); status != Status::ok) return status;
  return set_shape_properties(shape, properties, world.hooks.assets, *world.features);
}

Status set_body_inverse_inertia(const World& world, BodyProperties& properties) {
  for (Scaled& inverse_inertia : properties.inverse_inertia) inverse_inertia = Scaled(0.0);
  if (!is_dynamic(properties)) return Status::ok;
  set_inverse_inertia(properties, world.hooks.assets, *world.features);
  return are_inverse_inertias(properties) ? Status::ok : Status::out_of_range;
}

Status set_body_inertia(const Vec3<Scaled>& inertia, BodyProperties& properties) {
  const Scaled most = scaled_by_power(properties.mass, 2 * properties.size_exponent);
  const Scaled about[3] = {inertia.x, inertia.y, inertia.z};
  for (int axis = 0; axis < 3; ++axis) {
    if (!is_positive(about[axis]) || less(most, about[axis])) return Status::out_of_range;
    if ((properties.rotation_locks >> axis & 1) == 0) properties.inverse_inertia[axis] = divide(most, about[axis]);
  }
  return are_inverse_inertias(properties) ? Status::ok : Status::out_of_range;
}

Status set_body_density(const World& world, Scaled density, BodyProperties& properties) {
  if (!is_mass(density)) return Status::out_of_range;
  properties.mass = multiply(density, shape_volume(properties, world.hooks.assets, *world.features));
  return is_mass(properties.mass) ? Status::ok : Status::out_of_range;
}

Status set_body_material(const Material& material, BodyProperties& properties) {
  if (!is_rule(material.restitution_rule)) return Status::bad_argument;
  if (!is_material(material)) return Status::out_of_range;
  properties.friction = scaled_from(material.friction);
  properties.restitution = scaled_from(material.restitution);
  properties.rolling_resistance = scaled_from(material.rolling_resistance);
  properties.restitution_rule = static_cast<uint32_t>(material.restitution_rule);
  return Status::ok;
}

Status set_body_damping(Real linear, Real angular, BodyProperties& properties) {
  const Real zero = 0.0;
  if (!within(linear, zero, k_damping_max) || !within(angular, zero, k_damping_max)) return Status::out_of_range;
  properties.linear_damping = scaled_from(linear);
  properties.angular_damping = scaled_from(angular);
  return Status::ok;
}

Status set_body_gravity_scale(Real scale, BodyProperties& properties) {
  if (!within(scale, -k_gravity_scale_max, k_gravity_scale_max)) return Status::out_of_range;
  properties.gravity_scale = scaled_from(scale);
  return Status::ok;
}

Status set_body_rotation_locks(uint32_t locks, BodyProperties& properties) {
  if (locks > k_rotation_locks_all) return Status::bad_argument;
  properties.rotation_locks = static_cast<uint16_t>(locks);
  return Status::ok;
}

bool speeds_fit(const BodyProperties& properties, const Quat& rotation, const BodyMotion& motion) {
  return within(motion.linear_velocity, k_speed_max) && within(motion.angular_momentum, k_angular_velocity_work_max) &&
         within(angular_velocity_of(properties, rotation, motion.angular_momentum), k_angular_velocity_max);
}

Status make_pose(const Position& position, const Quat& rotation, BodyPose& pose) {
  if (!is_position(position)) return Status::out_of_range;
  Quat unit;
  if (!normalise_input(rotation, unit)) return Status::not_normalised;
  pose = BodyPose{};
  pose.position = position;
  pose.rotation = unit;
  return Status::ok;
}

Status make_motion(const BodyProperties& properties, const Quat& rotation, const Vec3<Real>& velocity,
                   const Vec3<Real>& angular_velocity, BodyMotion& motion) {
  if (!within(velocity, k_speed_max)) return Status::out_of_range;
  const int32_t exponent = properties.size_exponent;
  // Each component is at most k_angular_velocity_max 2^-exponent. If this exceeds the range of Real, every Real is
  // permitted.
  const Real limit = exponent < -1 ? k_real_max : scale_by_power(k_angular_velocity_max, -exponent);
  if (!within(angular_velocity, limit)) return Status::out_of_range;
  const bool moves = !(velocity == k_zero_vector), turns = !(angular_velocity == k_zero_vector);
  if ((moves || turns) && type_of(properties) == BodyType::fixed) return Status::bad_argument;
  if (turns && is_half_space(properties)) return Status::bad_argument;
  const Vec3<Real> angular_velocity_speed = scale_by_power(angular_velocity, exponent);
  if (!within(angular_velocity_speed * properties.bounding_radius, k_speed_max)) return Status::out_of_range;
  motion.linear_velocity = velocity;
  motion.angular_momentum = angular_velocity_speed;
  if (turns && is_dynamic(properties)) {
    const Vec3<Real> local = rotate_inverse(rotation, angular_velocity_speed);
    motion.angular_momentum = rotate(rotation, Vec3<Real>{multiply(local.x, inertia_about(properties, 0)),
                                                          multiply(local.y, inertia_about(properties, 1)),
                                                          multiply(local.z, inertia_about(properties, 2))});
  }
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
