#include <detent/body.h>
#include <detent/world.h>

#include "base/float_environment.h"
#include "broad_phase/pair_filter.h"
#include "shape/shape_properties.h"
#include "state/ranges.h"
#include "world/body_change.h"
#include "world/body_parts.h"
#include "world/sensors.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr Scaled k_default_density = 1000.0;

/// The data of a body, as a getter reads it. `properties` is null if the id is not valid.
struct Read {
  StateView<const uint8_t> state;
  const BodyProperties* properties = nullptr;
  uint32_t slot = 0;

  Read(const World& world, BodyId id) : state(view_of(world)) {
    if (find_body(state, id, slot)) properties = &state.properties[slot];
  }
};

Real real_from(Scaled value) {
  bool saturated = false;
  return to_real(value, saturated);
}

Shape shape_from(const BodyProperties& properties) {
  const auto size = [&](Unit value) { return real_from_unit(value, properties.size_exponent); };
  Shape shape;
  shape.type = shape_of(properties);
  if (shape.type != ShapeType::compound) shape.rounding = size(properties.rounding);
  switch (shape.type) {
    case ShapeType::sphere:
      shape.radius = size(properties.size.x);
      break;
    case ShapeType::capsule:
    case ShapeType::cylinder:
    case ShapeType::cone:
      shape.radius = size(properties.size.x);
      shape.half_length = size(properties.size.y);
      break;
    case ShapeType::box:
      shape.half_extents = {size(properties.size.x), size(properties.size.y), size(properties.size.z)};
      break;
    case ShapeType::hull:
    case ShapeType::terrain:
    case ShapeType::compound:
      shape.asset = properties.asset;
      break;
    default:
      break;
  }
  return shape;
}

Material material_from(const BodyProperties& properties) {
  return {real_from(properties.friction), real_from(properties.restitution), real_from(properties.rolling_resistance),
          static_cast<RestitutionRule>(properties.restitution_rule)};
}

/// A pending change of a body. It holds the new properties, so that they can be checked before the body is changed.
struct Change {
  StateView<uint8_t> state;
  bool found = false;
  uint32_t slot = 0;
  BodyProperties properties = {};
  BodyMotion motion = {};

  Change(World& world, BodyId id) : state(view_of(world)) {
    found = find_body(state, id, slot);
    if (!found) return;
    properties = state.properties[slot];
    motion = state.motions[slot];
  }
  const Quat& rotation() const { return state.poses[slot].rotation; }
  /// Sets the body's angular momentum from `angular_velocity` and the inertia of the changed properties.
  /// `angular_velocity` is in rad/s times the unit of length of the changed properties, thus in m/s
  /// (angular_velocity.h). Errors: bad_argument, out_of_range.
  Status turn_with(const Vec3<Real>& angular_velocity) {
    const Real zero = 0.0;
    const bool turns = !(angular_velocity == Vec3<Real>{zero, zero, zero});
    if (turns && is_half_space(properties)) return Status::bad_argument;
    if (!within(angular_velocity, k_angular_velocity_max)) return Status::out_of_range;
    if (!is_dynamic(properties) && !within(angular_velocity * properties.bounding_radius, k_speed_max))
      return Status::out_of_range;
    motion.angular_momentum = angular_momentum_of(properties, rotation(), angular_velocity);
    return Status::ok;
  }
  void make() {
    wake_slot(state, slot);
    wake_neighbours(state, slot);
    state.properties[slot] = properties;
    state.motions[slot] = motion;
  }
  /// As make(), but also removes the body's contacts, because the change makes them invalid.
  void make_anew() {
    end_contacts(state, slot);
    make();
  }
  Status make_if(Status status) {
    if (status == Status::ok) make();
    return status;
  }
};

/// Multiplies v by 2^power. Returns false if the result leaves Real's range.
bool scale(int power, Vec3<Real>& v) {
  bool saturated = false;
  const auto scaled = [&](Real value) { return to_real(scaled_by_power(scaled_from(value), power), saturated); };
  v = {scaled(v.x), scaled(v.y), scaled(v.z)};
  return !saturated;
}

}  // namespace

Status get_body_def(const World& world, BodyId id, BodyDef& def) {
  const FloatEnvironment environment;
  const Read body(world, id);
  if (body.properties == nullptr) return Status::bad_id;
  const BodyProperties& properties = *body.properties;
  BodyDef made;
  if (const Status status = get_velocity(world, id, made.linear_velocity, made.angular_velocity); status != Status::ok)
    return status;
  made.type = type_of(properties);
  made.position = body.state.poses[body.slot].position;
  made.rotation = body.state.poses[body.slot].rotation;
  made.shape = shape_from(properties);
  made.material = material_from(properties);
  made.mass = properties.mass;
  made.linear_damping = real_from(properties.linear_damping);
  made.angular_damping = real_from(properties.angular_damping);
  made.gravity_scale = real_from(properties.gravity_scale);
  made.user_data = properties.user_data;
  made.rotation_locks = properties.rotation_locks;
  made.filter = filter_of(properties);
  made.sensor = properties.sensor != 0;
  def = made;
  return Status::ok;
}

Status get_type(const World& world, BodyId id, BodyType& type) {
  const Read body(world, id);
  if (body.properties == nullptr) return Status::bad_id;
  type = type_of(*body.properties);
  return Status::ok;
}

Status get_shape(const World& world, BodyId id, Shape& shape) {
  const FloatEnvironment environment;
  const Read body(world, id);
  if (body.properties == nullptr) return Status::bad_id;
  shape = shape_from(*body.properties);
  return Status::ok;
}

Status get_material(const World& world, BodyId id, Material& material) {
  const Read body(world, id);
  if (body.properties == nullptr) return Status::bad_id;
  material = material_from(*body.properties);
  return Status::ok;
}

Status get_damping(const World& world, BodyId id, Real& linear, Real& angular) {
  const Read body(world, id);
  if (body.properties == nullptr) return Status::bad_id;
  linear = real_from(body.properties->linear_damping);
  angular = real_from(body.properties->angular_damping);
  return Status::ok;
}

Status get_gravity_scale(const World& world, BodyId id, Real& gravity_scale) {
  const Read body(world, id);
  if (body.properties == nullptr) return Status::bad_id;
  gravity_scale = real_from(body.properties->gravity_scale);
  return Status::ok;
}

Status get_rotation_locks(const World& world, BodyId id, uint32_t& locks) {
  const Read body(world, id);
  if (body.properties == nullptr) return Status::bad_id;
  locks = body.properties->rotation_locks;
  return Status::ok;
}

Status get_sensor(const World& world, BodyId id, bool& sensor) {
  const Read body(world, id);
  if (body.properties == nullptr) return Status::bad_id;
  sensor = body.properties->sensor != 0;
  return Status::ok;
}

Status get_inertia(const World& world, BodyId id, Vec3<Scaled>& inertia) {
  const FloatEnvironment environment;
  const Read body(world, id);
  if (body.properties == nullptr) return Status::bad_id;
  const Scaled scaled_mass = scaled_by_power(body.properties->mass, 2 * body.properties->size_exponent);
  const auto about = [&](int axis) { return multiply(scaled_mass, inertia_about(*body.properties, axis)); };
  inertia = {about(0), about(1), about(2)};
  return Status::ok;
}

Status get_velocity_at(const World& world, BodyId id, const Vec3<Real>& arm, Vec3<Real>& velocity) {
  const FloatEnvironment environment;
  const Read body(world, id);
  if (body.properties == nullptr) return Status::bad_id;
  // The arm is halved and stored in the body's unit of length, so that an arm of twice the bounding radius fits a Unit.
  const int exponent = body.properties->size_exponent + 1;
  if (!within(arm, real_from_unit(body.properties->bounding_radius, exponent))) return Status::out_of_range;
  const BodyMotion& motion = body.state.motions[body.slot];
  const Vec3<Unit> halved = unit_from_real(arm, exponent);
  const Vec3<Real> half = cross(
      angular_velocity_of(*body.properties, body.state.poses[body.slot].rotation, motion.angular_momentum), halved);
  if (!within(half, Real(56000.0))) return Status::out_of_range;  // within this limit, 2 `half` + velocity fits a Real
  velocity = motion.linear_velocity + scale_by_power(half, 1);
  return Status::ok;
}

Status set_type(World& world, BodyId id, BodyType type) {
  const FloatEnvironment environment;
  Change change(world, id);
  if (!change.found) return Status::bad_id;
  BodyProperties& properties = change.properties;
  if (const Status status = suits(world, shape_of(properties), properties.asset, type); status != Status::ok)
    return status;
  if (type == type_of(properties)) return Status::ok;
  const Vec3<Real> none = {0.0, 0.0, 0.0};
  const Vec3<Real> angular_velocity =
      type == BodyType::fixed ? none
                              : angular_velocity_of(properties, change.rotation(), change.motion.angular_momentum);
  properties.type = static_cast<uint32_t>(type);
  if (is_dynamic(properties) && properties.mass == Scaled(0.0)) {
    if (const Status status = set_body_density(world, k_default_density, properties); status != Status::ok)
      return status;
  }
  if (const Status status = set_body_inverse_inertia(world, properties); status != Status::ok) return status;
  if (const Status status = change.turn_with(angular_velocity); status != Status::ok) return status;
  if (type == BodyType::fixed) change.motion.linear_velocity = none;
  change.motion.pending_velocity = change.motion.pending_angular_momentum = none;
  change.make_anew();
  change.state.activities[change.slot] = BodyActivity{};
  return Status::ok;
}

Status set_shape(World& world, BodyId id, const Shape& shape) {
  const FloatEnvironment environment;
  Change change(world, id);
  if (!change.found) return Status::bad_id;
  BodyProperties& properties = change.properties;
  const int before = properties.size_exponent;
  Vec3<Real> angular_velocity = angular_velocity_of(properties, change.rotation(), change.motion.angular_momentum);
  if (const Status status = set_body_shape(world, shape, type_of(properties), properties); status != Status::ok)
    return status;
  if (const Status status = set_body_inverse_inertia(world, properties); status != Status::ok) return status;
  Vec3<Real>& torque = change.motion.pending_angular_momentum;
  if (!scale(properties.size_exponent - before, angular_velocity) ||
      !scale(before - properties.size_exponent, torque) || !within(torque, k_angular_velocity_work_max) ||
      !within(angular_velocity_of(properties, change.rotation(), torque), k_angular_velocity_max)) {
    return Status::out_of_range;
  }
  if (const Status status = change.turn_with(angular_velocity); status != Status::ok) return status;
  change.make_anew();
  return Status::ok;
}

Status set_mass(World& world, BodyId id, Scaled mass) {
  Change change(world, id);
  if (!change.found) return Status::bad_id;
  if (!is_mass(mass)) return Status::out_of_range;
  change.properties.mass = mass;
  change.make();
  return Status::ok;
}

Status set_inertia(World& world, BodyId id, const Vec3<Scaled>& inertia) {
  const FloatEnvironment environment;
  Change change(world, id);
  if (!change.found) return Status::bad_id;
  BodyProperties& properties = change.properties;
  if (!is_dynamic(properties)) return Status::bad_argument;
  const Vec3<Real> angular_velocity =
      angular_velocity_of(properties, change.rotation(), change.motion.angular_momentum);
  if (const Status status = set_body_inertia(inertia, properties); status != Status::ok) return status;
  if (!within(angular_velocity_of(properties, change.rotation(), change.motion.pending_angular_momentum),
              k_angular_velocity_max))
    return Status::out_of_range;
  return change.make_if(change.turn_with(angular_velocity));
}

Status set_density(World& world, BodyId id, Scaled density) {
  const FloatEnvironment environment;
  Change change(world, id);
  if (!change.found) return Status::bad_id;
  if (is_ground(change.properties)) return Status::bad_argument;
  return change.make_if(set_body_density(world, density, change.properties));
}

Status set_material(World& world, BodyId id, const Material& material) {
  Change change(world, id);
  if (!change.found) return Status::bad_id;
  return change.make_if(set_body_material(material, change.properties));
}

Status set_damping(World& world, BodyId id, Real linear, Real angular) {
  Change change(world, id);
  if (!change.found) return Status::bad_id;
  return change.make_if(set_body_damping(linear, angular, change.properties));
}

Status set_gravity_scale(World& world, BodyId id, Real gravity_scale) {
  Change change(world, id);
  if (!change.found) return Status::bad_id;
  return change.make_if(set_body_gravity_scale(gravity_scale, change.properties));
}

Status set_sensor(World& world, BodyId id, bool sensor) {
  const FloatEnvironment environment;
  Change change(world, id);
  if (!change.found) return Status::bad_id;
  if (sensor == (change.properties.sensor != 0)) return Status::ok;
  if (sensor) {
    if (const Status status = check_sensors(world); status != Status::ok) return status;
  }
  change.properties.sensor = sensor ? 1 : 0;
  change.state.world.sensor_count += sensor ? 1u : UINT32_MAX;
  change.make_anew();
  forget_sensed(change.state, change.slot);
  return Status::ok;
}

Status set_rotation_locks(World& world, BodyId id, uint32_t locks) {
  const FloatEnvironment environment;
  Change change(world, id);
  if (!change.found) return Status::bad_id;
  BodyProperties& properties = change.properties;
  if (const Status status = set_body_rotation_locks(locks, properties); status != Status::ok) return status;
  if (const Status status = set_body_inverse_inertia(world, properties); status != Status::ok) return status;
  BodyMotion& motion = change.motion;
  motion.angular_momentum = without_locked(properties, change.rotation(), motion.angular_momentum);
  motion.pending_angular_momentum = without_locked(properties, change.rotation(), motion.pending_angular_momentum);
  change.make();
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
