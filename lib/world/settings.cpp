#include "world/settings.h"

#include <detent/world.h>

#include "base/float_environment.h"
#include "state/ranges.h"
#include "world/body_change.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

Status check_settings(const WorldDef& def, const FeatureTable& features) {
  if (!are_settings(def.gravity, def.tick, def.substeps, def.substeps_max, def.iterations, def.convergence,
                    def.relaxation, def.contact_frequency, def.damping_ratio, def.restitution_threshold,
                    def.contact_margin, def.contact_recycle_distance, def.resting_penetration)) {
    return Status::out_of_range;
  }
  if (!is_reduction(def.reduction) || !is_stabilisation(def.stabilisation)) return Status::bad_argument;
  if (!contains(features.features, features_of(def.continuous, def.sleeping))) return Status::feature_missing;
  return Status::ok;
}

void store_settings(const WorldDef& def, WorldState& world, bool has_manifolds) {
  world.substeps = def.substeps;
  world.substeps_max = def.substeps_max;
  world.resting_penetration = def.resting_penetration;
  world.sleeping = def.sleeping ? 1 : 0;
  world.continuous = def.continuous ? 1 : 0;
  world.iterations = def.iterations;
  world.convergence = def.convergence;
  world.stabilisation = static_cast<uint32_t>(def.stabilisation);
  world.gravity = def.gravity;
  world.tick_time = def.tick;
  world.relaxation = def.relaxation;
  world.contact_frequency = def.contact_frequency;
  world.damping_ratio = def.damping_ratio;
  world.restitution_threshold = def.restitution_threshold;
  world.reduction = static_cast<uint32_t>(def.reduction);
  world.contact_margin = def.contact_margin;
  world.contact_recycle_distance = has_manifolds ? def.contact_recycle_distance : Real(0.0);
}

Status set_gravity(World& world, const Vec3<Real>& gravity) {
  if (!within(gravity, k_gravity_max)) return Status::out_of_range;
  StateView<uint8_t> state = view_of(world);
  state.world.gravity = gravity;
  wake_world(state);
  return Status::ok;
}

WorldDef get_settings(const World& world) {
  const StateView<const uint8_t> state = view_of(world);
  const WorldState& from = state.world;
  WorldDef def;
  def.capacity = capacity_of(state.header);
  def.gravity = from.gravity;
  def.tick = from.tick_time;
  def.substeps = from.substeps;
  def.substeps_max = from.substeps_max;
  def.resting_penetration = from.resting_penetration;
  def.iterations = from.iterations;
  def.convergence = from.convergence;
  def.stabilisation = static_cast<Stabilisation>(from.stabilisation);
  def.relaxation = from.relaxation;
  def.contact_frequency = from.contact_frequency;
  def.damping_ratio = from.damping_ratio;
  def.restitution_threshold = from.restitution_threshold;
  def.continuous = from.continuous != 0;
  def.sleeping = from.sleeping != 0;
  def.contact_margin = from.contact_margin;
  def.contact_recycle_distance = from.contact_recycle_distance;
  def.reduction = static_cast<ManifoldReduction>(from.reduction);
  return def;
}

Status set_settings(World& world, const WorldDef& def) {
  const FloatEnvironment environment;
  if (const Status status = check_settings(def, *world.features); status != Status::ok) return status;
  StateView<uint8_t> state = view_of(world);
  store_settings(def, state.world, state.header.manifolds != 0);
  // Clears the stored manifolds, because they were computed with the old settings.
  for (ManifoldState& manifold : state.manifolds.first(state.manifolds.count == 0 ? 0 : state.world.contact_count))
    manifold = ManifoldState{};
  wake_world(state);
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
