#include <detent/contact.h>
#include <detent/world.h>

#include "base/float_environment.h"
#include "contact/compound_ops.h"
#include "contact/contact_cache.h"
#include "motion/angular_velocity.h"
#include "motion/step_settings.h"
#include "shape/shape_properties.h"
#include "shape/sweep.h"
#include "state/view.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// The mass of the lighter dynamic body, by which the stored impulses of a contact are divided.
Scaled reference_mass(const BodyProperties& a, const BodyProperties& b) {
  if (!is_dynamic(a)) return b.mass;
  return is_dynamic(b) && less(b.mass, a.mass) ? b.mass : a.mass;
}

__attribute__((noinline)) ContactGeometry part_geometry(const CollisionBody& a, const CollisionBody& b, Real margin,
                                                        ManifoldReduction reduction, const World& world,
                                                        const ContactState& contact) {
  TerrainContacts contacts;
  collide_parts(a, b, margin, world.hooks.assets, reduction, *world.features, contacts);
  const ContactGeometry* best = nullptr;
  uint32_t most = 0;
  for (uint32_t i = 0; i < contacts.count; ++i) {
    const TerrainContact& found = contacts.contact[i];
    const uint32_t alike = 2 * shared_features(found.geometry, contact) + (found.key == contact.part ? 1 : 0);
    if (alike <= most) continue;
    most = alike;
    best = &found.geometry;
  }
  return best == nullptr ? ContactGeometry{} : *best;
}

/// The contact points at the current poses. Points are included up to a separation of a quarter of the smaller body's
/// extent, because bodies may have separated a little in the last step.
ContactGeometry geometry_of(const World& world, const StateView<const uint8_t>& state, const ContactState& contact) {
  const BodyPose &pose_a = state.poses[contact.body_a], &pose_b = state.poses[contact.body_b];
  const BodyProperties &a = state.properties[contact.body_a], &b = state.properties[contact.body_b];
  const Matrix3 axes_a = matrix_from(pose_a.rotation), axes_b = matrix_from(pose_b.rotation);
  const Real margin = scale_by_power(min(shape_extent(a), shape_extent(b)), -2);
  const CollisionBody body_a = {pose_a, a, axes_a}, body_b = {pose_b, b, axes_b};
  const ManifoldReduction reduction = static_cast<ManifoldReduction>(state.world.reduction);
  if (has_parts(a, b)) return part_geometry(body_a, body_b, margin, reduction, world, contact);
  ContactGeometry geometry;
  collide(body_a, body_b, margin, geometry, world.hooks.assets, reduction, *world.features);
  return geometry;
}

}  // namespace

Status get_contact(const World& world, uint32_t index, Contact& contact) {
  const FloatEnvironment environment;
  const StateView<const uint8_t> state = view_of(world);
  if (index >= state.world.contact_count) return Status::out_of_range;
  const ContactState& from = state.contacts[index];
  const BodyProperties &a = state.properties[from.body_a], &b = state.properties[from.body_b];
  const uint32_t mover = is_dynamic(a) ? from.body_a : from.body_b;
  const uint32_t substeps = state.activities[mover].substeps;
  const Scaled none = 0.0, scale = multiply(reference_mass(a, b), scaled_from_count(substeps));
  const auto impulse = [&](Real speed) { return multiply(scaled_from(speed), scale); };

  Contact made;
  made.a = {from.body_a + 1, a.generation};
  made.b = {from.body_b + 1, b.generation};
  made.part = from.part;
  made.touching = from.touching != 0;
  made.age = from.age;
  made.friction_impulse = {impulse(from.friction_impulse.x), impulse(from.friction_impulse.y),
                           impulse(from.friction_impulse.z)};
  made.normal_impulse = none;
  for (uint32_t i = 0; i < from.point_count; ++i)
    made.normal_impulse = add(made.normal_impulse, impulse(from.normal_impulse[i]));
  made.normal_force = divide(made.normal_impulse, scaled_from(state.world.tick_time));

  const ContactGeometry geometry = geometry_of(world, state, from);
  // Arms are taken from a dynamic body, because the centre of a half-space may be far away.
  const bool by_a = is_dynamic(a);
  const Position& centre = state.poses[mover].position;
  const int exponent = state.properties[mover].size_exponent;
  if (geometry.count != 0) made.normal = geometry.normal;
  made.point_count = geometry.count;
  for (uint32_t i = 0; i < geometry.count; ++i) {
    const Vec3<Unit>& arm = by_a ? geometry.point[i].arm_a : geometry.point[i].arm_b;
    ContactPoint& point = made.point[i];
    point.position = moved(centre, real_from_unit(arm, exponent));
    point.separation = geometry.point[i].separation;
    point.feature = geometry.point[i].feature;
    point.child_a = geometry.point[i].part >> 16;
    point.child_b = geometry.point[i].part & 0xffff;
    point.normal_impulse = none;
    for (uint32_t k = 0; k < from.point_count; ++k) {
      if (from.feature[k] == point.feature) point.normal_impulse = impulse(from.normal_impulse[k]);
    }
  }
  contact = made;
  return Status::ok;
}

uint32_t next_contact(const World& world, BodyId id, uint32_t index) {
  const StateView<const uint8_t> state = view_of(world);
  const uint32_t count = state.world.contact_count;
  uint32_t slot = 0;
  if (!find_body(state, id, slot)) return count;
  for (; index < count; ++index) {
    if (state.contacts[index].body_a == slot || state.contacts[index].body_b == slot) return index;
  }
  return count;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
