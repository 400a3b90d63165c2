#pragma once
#include <detent/convex.h>
#include <detent/query.h>

#include "broad_phase/pair_filter.h"
#include "broad_phase/swept_box.h"
#include "state/step_cache.h"

/// The bodies that a query asks.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The shape of a query, as that of a body.
struct QueryShape {
  BodyTraits traits;
  Convex convex;
};

/// Errors: as create_body(); bad_argument for a half-space.
Status make_query_shape(const World& world, const Shape& shape, QueryShape& made);
/// A ray's.
QueryShape query_point();

/// Half of the shape's bounds at rest, 2^-46 m.
Vec64 query_half(const QueryShape& shape, const Quat& rotation);

/// A half-space's position moved along its surface to where a query is made: the narrow phase takes positions less than
/// 2^16 m apart.
Pose pose_near(const BodyTraits& traits, const BodyPose& pose, const Position& place);

/// The bodies that a query's filter lets through; no sensors.
struct QueryBodies {
  const World& world;
  StateView<const uint8_t> state;
  StepCacheView cache;
  QueryFilter filter;

  QueryBodies(const World& asked, const QueryFilter& query_filter)
      : world(asked),
        state(view_of(asked)),
        cache(cache_of(asked.block, state.layout, capacity_of(state.header))),
        filter(query_filter) {}

  BodyId id_of(uint32_t slot) const { return {slot + 1, state.traits[slot].generation}; }
  /// Of the body as it is now.
  Bounds bounds_of(uint32_t slot) const;
  /// Larger, and cheap.
  Bounds ball_bounds_of(uint32_t slot) const;

  /// Visits the bodies that may be at bounds of which `meets` is true; it may become stricter on the way. Only reads
  /// the world: what lies in the tree is found there, if it is up to date, but for what has changed since.
  template <class Meets, class Swaps, class Visit>
  void for_each(const Meets& meets, const Swaps& swaps, const Visit& visit) const {
    const auto look_at = [&](uint32_t slot) {
      if (asks(slot) && meets(ball_bounds_of(slot))) visit(slot);
    };
    if (cache.cache.fresh == 0) {
      for (uint32_t slot = 0; slot < state.world.slots_used; ++slot) look_at(slot);
      return;
    }
    cache.tree.walk(meets, swaps, [&](uint32_t slot) {
      if (!cache.visits.has(slot) && asks(slot)) visit(slot);
    });
    cache.visits.for_each(look_at);
  }

 private:
  bool asks(uint32_t slot) const {
    const BodyTraits& traits = state.traits[slot];
    return traits.type != 0 && traits.sensor == 0 &&
           masks_meet(traits.category, traits.mask, filter.category, filter.mask) && !(id_of(slot) == filter.ignore);
  }
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
