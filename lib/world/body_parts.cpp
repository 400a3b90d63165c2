#include "world/body_parts.h"

#include "motion/spin.h"
#include "shape/shape_traits.h"
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
  const bool is_ground = shape == ShapeType::half_space || shape == ShapeType::surface;
  if (is_ground && type == BodyType::dynamic) return Status::bad_argument;
  return asset_kind_of(shape) == AssetKind::none ? Status::ok : find_shape(world, shape, asset, type);
}

Status set_body_shape(const World& world, const Shape& shape, BodyType type, BodyTraits& traits) {
  if (const Status status = suits(world, shape.type, shape.asset, type); status != Status::ok) return status;
  return set_shape_traits(shape, traits, world.assets, *world.features);
}

Status set_body_gyration(const World& world, BodyTraits& traits) {
  for (Scaled& gyration : traits.gyration) gyration = Scaled(0.0);
  if (!is_dynamic(traits)) return Status::ok;
  set_gyration(traits, world.assets, *world.features);
  return are_gyrations(traits) ? Status::ok : Status::out_of_range;
}

Status set_body_inertia(const Vec3<Scaled>& inertia, BodyTraits& traits) {
  const Scaled most = scaled_by_power(traits.mass, 2 * traits.size_exponent);
  const Scaled about[3] = {inertia.x, inertia.y, inertia.z};
  for (int axis = 0; axis < 3; ++axis) {
    if (!is_positive(about[axis]) || less(most, about[axis])) return Status::out_of_range;
    if ((traits.turn_locks >> axis & 1) == 0) traits.gyration[axis] = divide(most, about[axis]);
  }
  return are_gyrations(traits) ? Status::ok : Status::out_of_range;
}

Status set_body_density(const World& world, Scaled density, BodyTraits& traits) {
  if (!is_mass(density)) return Status::out_of_range;
  traits.mass = multiply(density, shape_volume(traits, world.assets, *world.features));
  return is_mass(traits.mass) ? Status::ok : Status::out_of_range;
}

Status set_body_material(const Material& material, BodyTraits& traits) {
  if (!is_rule(material.restitution_rule)) return Status::bad_argument;
  if (!is_material(material)) return Status::out_of_range;
  traits.friction = scaled_from(material.friction);
  traits.restitution = scaled_from(material.restitution);
  traits.rolling_resistance = scaled_from(material.rolling_resistance);
  traits.restitution_rule = static_cast<uint32_t>(material.restitution_rule);
  return Status::ok;
}

Status set_body_damping(Real linear, Real angular, BodyTraits& traits) {
  const Real zero = 0.0;
  if (!within(linear, zero, k_damping_max) || !within(angular, zero, k_damping_max)) return Status::out_of_range;
  traits.linear_damping = scaled_from(linear);
  traits.angular_damping = scaled_from(angular);
  return Status::ok;
}

Status set_body_gravity_scale(Real scale, BodyTraits& traits) {
  if (!within(scale, -k_gravity_scale_max, k_gravity_scale_max)) return Status::out_of_range;
  traits.gravity_scale = scaled_from(scale);
  return Status::ok;
}

Status set_body_turn_locks(uint32_t locks, BodyTraits& traits) {
  if (locks > k_turn_locks_all) return Status::bad_argument;
  traits.turn_locks = static_cast<uint16_t>(locks);
  return Status::ok;
}

bool speeds_fit(const BodyTraits& traits, const Quat& rotation, const BodyMotion& motion) {
  return within(motion.velocity, k_speed_max) && within(motion.momentum, k_spin_work_max) &&
         within(spin_of(traits, rotation, motion.momentum), k_spin_max);
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

Status make_motion(const BodyTraits& traits, const Quat& rotation, const Vec3<Real>& velocity, const Vec3<Real>& spin,
                   BodyMotion& motion) {
  if (!within(velocity, k_speed_max)) return Status::out_of_range;
  const int32_t exponent = traits.size_exponent;
  // |spin| <= k_spin_max 2^-exponent, or any Real if that limit exceeds the range of Real.
  const Real limit = exponent < -1 ? k_real_max : scale_by_power(k_spin_max, -exponent);
  if (!within(spin, limit)) return Status::out_of_range;
  const bool moves = !(velocity == k_zero_vector), turns = !(spin == k_zero_vector);
  if ((moves || turns) && type_of(traits) == BodyType::fixed) return Status::bad_argument;
  if (turns && is_half_space(traits)) return Status::bad_argument;
  const Vec3<Real> spin_speed = {scale_by_power(spin.x, exponent), scale_by_power(spin.y, exponent),
                                 scale_by_power(spin.z, exponent)};
  if (!within(spin_speed * traits.bounding_radius, k_speed_max)) return Status::out_of_range;
  motion.velocity = velocity;
  motion.momentum = spin_speed;
  if (turns && is_dynamic(traits)) {
    const Vec3<Real> local = rotate_inverse(rotation, spin_speed);
    motion.momentum = rotate(
        rotation, Vec3<Real>{multiply(local.x, inertia_about(traits, 0)), multiply(local.y, inertia_about(traits, 1)),
                             multiply(local.z, inertia_about(traits, 2))});
  }
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
