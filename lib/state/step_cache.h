#pragma once
#include "base/bit_set.h"
#include "broad_phase/resting_tree.h"
#include "motion/step_settings.h"
#include "state/view.h"

/// Data that steps keep between ticks. A call that changes a body adds the body to the active set, so that the next
/// step evaluates it. After create_world(), restore(), load() and copy_world(), the next step recomputes all of this
/// data.
namespace detent {
inline namespace DETENT_NAMESPACE {

struct StepCacheView {
  StepCache& cache;
  BitSet active;  ///< the active set: bodies that moved in the last step or were changed since
  Span<uint32_t> awake_contacts;
  Span<Bounds> bounds;
  RestingTree tree;
};

DETENT_SHARED inline StepCacheView cache_of(uint8_t* block, const Layout& layout, Capacity capacity) {
  StepCache& cache = *at_offset<StepCache>(block, layout.cache);
  const Span<Bounds> bounds = {at_offset<Bounds>(block, layout.bounds), capacity.bodies};
  return {cache,
          {{at_offset<uint32_t>(block, layout.active), slot_words(capacity.bodies)}},
          {at_offset<uint32_t>(block, layout.awake_contacts), capacity.contacts},
          bounds,
          {cache.tree,
           {at_offset<TreeNode>(block, layout.tree_nodes), capacity.bodies},
           {at_offset<uint32_t>(block, layout.tree_parents), capacity.bodies},
           bounds}};
}
inline StepCacheView cache_of(StateView<uint8_t>& state) {
  return cache_of(reinterpret_cast<uint8_t*>(&state.header), state.layout, capacity_of(state.header));
}

/// Invalidates the cache, after the state was replaced from outside.
inline void forget_steps(World& world) { at_offset<StepCache>(world.block, view_of(world).layout.cache)->fresh = 0; }

/// Partitions the active set into moving bodies and resting bodies. Returns the moving bodies, ascending. Removes the
/// resting bodies from the active set and inserts them into the tree of resting bodies. Initialises the BodyWork of all
/// bodies that were in the active set, and computes their bounds (bound()). `slots`: one element for each body of the
/// capacity; holds the result.
Span<const uint32_t> partition_bodies(const StepCacheView& step, const StepSettings& settings,
                                      const StateView<uint8_t>& state, Span<BodyWork> work, Span<BodySweep> sweeps,
                                      Span<uint32_t> slots);

/// The indices of all contacts with an awake body, ascending.
Span<const uint32_t> list_awake_contacts(const StepCacheView& step, const StateView<uint8_t>& state);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
