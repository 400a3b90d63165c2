#include <detent/rollback.h>

#include "base/digest.h"
#include "base/float_environment.h"
#include "broad_phase/pair_filter.h"
#include "state/asset_binding.h"
#include "state/snapshot.h"
#include "state/used.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using State = StateView<const uint8_t>;

bool has_room(const State& from, const State& to) {
  const WorldState& world = from.world;
  return world.slots_used <= to.properties.count && world.contact_count <= to.contacts.count &&
         world.joints_used <= to.joints.count && world.sensed_count <= to.sensed.count &&
         used_assets(from) <= to.assets.count && (world.sensor_count == 0 || to.sensed.count != 0) &&
         (world.contact_recycle_distance == Real(0.0) || to.header.manifolds != 0);
}

/// Checks that the world `to` has the features, assets and filter rules that the state needs.
Status check_handle(const World& from, const State& state, const World& to) {
  const Features needed = without(Features::all, static_cast<Features>(state.header.left_out));
  if (!contains(to.features->features, needed)) return Status::feature_missing;
  const bool same_table =
      from.hooks.assets.assets == to.hooks.assets.assets && from.hooks.assets.count <= to.hooks.assets.count;
  if (!same_table) {
    const FloatEnvironment environment;
    const Status status = check_assets(to.hooks.assets, *to.features, state.assets);
    if (status != Status::ok) return status;
  }
  for (const BodyProperties& properties : state.properties.first(state.world.slots_used)) {
    if (!has_rule(to.hooks.filter_rules, properties.rule)) return Status::rule_missing;
  }
  return Status::ok;
}

}  // namespace

Status copy_world(const World& from, World& to) {
  if (from.block == to.block) return Status::ok;
  const State state = view_of(from);
  const StateView<uint8_t> target = view_of(to);
  if (!has_room(state, const_view_of(to.block))) return Status::pool_full;
  if (const Status status = check_handle(from, state, to); status != Status::ok) return status;
  copy_used(state, target);
  take_over(to);
  return Status::ok;
}

uint32_t checksum32(const World& world) { return digest_fold(digest(world)); }

}  // namespace DETENT_NAMESPACE
}  // namespace detent
