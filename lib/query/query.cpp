#include "base/float_environment.h"
#include "broad_phase/pair_filter.h"
#include "motion/activity.h"
#include "state/view.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

bool is_valid(const World& world, BodyId id) {
  uint32_t slot = 0;
  return find_body(view_of(world), id, slot);
}

Status get_pose(const World& world, BodyId id, Pose& pose) {
  const StateView<const uint8_t> state = view_of(world);
  uint32_t slot = 0;
  if (!find_body(state, id, slot)) return Status::bad_id;
  pose = {state.poses[slot].position, state.poses[slot].rotation};
  return Status::ok;
}

Status get_velocity(const World& world, BodyId id, Vec3<Real>& velocity, Vec3<Real>& angular_velocity) {
  const FloatEnvironment environment;
  const StateView<const uint8_t> state = view_of(world);
  uint32_t slot = 0;
  if (!find_body(state, id, slot)) return Status::bad_id;
  const BodyProperties& properties = state.properties[slot];
  const BodyMotion& motion = state.motions[slot];
  const Vec3<Real> speed = angular_velocity_of(properties, state.poses[slot].rotation, motion.angular_momentum);
  // An angular velocity beyond the range of Real is clamped to this range, less a margin for rounding. Only bodies with
  // a bounding radius below about 12 cm can have one.
  const int exponent = properties.size_exponent;
  const Real limit = exponent < 0 ? scale_by_power(Real(131071.0), exponent) : k_real_max;
  const auto per_radius = [&](Real value) { return scale_by_power(clamp(value, -limit, limit), -exponent); };
  velocity = motion.linear_velocity;
  angular_velocity = {per_radius(speed.x), per_radius(speed.y), per_radius(speed.z)};
  return Status::ok;
}

Status get_mass(const World& world, BodyId id, Scaled& mass) {
  const StateView<const uint8_t> state = view_of(world);
  uint32_t slot = 0;
  if (!find_body(state, id, slot)) return Status::bad_id;
  mass = is_dynamic(state.properties[slot]) ? state.properties[slot].mass : Scaled(0.0);
  return Status::ok;
}

Status get_user_data(const World& world, BodyId id, uint32_t& user_data) {
  const StateView<const uint8_t> state = view_of(world);
  uint32_t slot = 0;
  if (!find_body(state, id, slot)) return Status::bad_id;
  user_data = state.properties[slot].user_data;
  return Status::ok;
}

Status get_filter(const World& world, BodyId id, Filter& filter) {
  const StateView<const uint8_t> state = view_of(world);
  uint32_t slot = 0;
  if (!find_body(state, id, slot)) return Status::bad_id;
  filter = filter_of(state.properties[slot]);
  return Status::ok;
}

Status is_awake(const World& world, BodyId id, bool& awake) {
  const StateView<const uint8_t> state = view_of(world);
  uint32_t slot = 0;
  if (!find_body(state, id, slot)) return Status::bad_id;
  awake = is_moving(state.properties[slot], state.motions[slot], state.activities[slot]);
  return Status::ok;
}

WorldInfo get_info(const World& world) {
  const StateView<const uint8_t> state = view_of(world);
  return {capacity_of(state.header), state.world.tick,         state.world.body_count,   state.world.contact_count,
          state.world.joint_count,   state.world.sensed_count, state.world.slots_retired};
}

BodyId next_body(const World& world, BodyId previous) {
  const StateView<const uint8_t> state = view_of(world);
  for (uint32_t slot = previous.slot; slot < state.world.slots_used; ++slot) {
    if (state.properties[slot].type != 0) return {slot + 1, state.properties[slot].generation};
  }
  return {};
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
