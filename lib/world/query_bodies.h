#pragma once
#include <detent/distance.h>
#include <detent/query.h>

#include "broad_phase/pair_filter.h"
#include "broad_phase/swept_box.h"
#include "state/step_cache.h"

/// The bodies that a query tests.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The shape of a query, in the form in which a body stores its shape.
struct QueryShape {
  BodyProperties properties;
  Convex convex;
};

/// Converts the shape of a query. Errors: as create_body(); bad_argument for a half-space, a terrain or a compound.
Status make_query_shape(const World& world, const Shape& shape, QueryShape& made);
/// The shape of a ray: a sphere of radius 0.
QueryShape query_point();

/// The half extents of the shape's axis-aligned bounds at this rotation, in units of 2^-46 m.
Vec64 query_half(const QueryShape& shape, const Quat& rotation);

/// The pose of a body for a query at `place`. The position of a distant half-space is moved along its plane to the
/// query, because the narrow phase accepts only positions less than 2^16 m apart.
Pose pose_near(const BodyProperties& properties, const BodyPose& pose, const Position& place);

/// The bodies that a query tests: those that its filter allows, except sensors.
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

  BodyId id_of(uint32_t slot) const { return {slot + 1, state.properties[slot].generation}; }
  /// Bounds of the body at its current pose.
  Bounds bounds_of(uint32_t slot) const;
  /// Bounds of the body's bounding sphere: larger, but cheaper to compute.
  Bounds ball_bounds_of(uint32_t slot) const;

  /// Visits the bodies whose bounds may satisfy `meets`. `meets` may become stricter during the search. `swaps`: as for
  /// RestingTree::walk(). The search does not change the world. If the tree of resting bodies (RestingTree) is up to
  /// date, the search finds resting bodies by the tree, and tests the bodies that moved or were changed one by one.
  /// Otherwise it tests all bodies one by one.
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
      if (!cache.active.has(slot) && asks(slot)) visit(slot);
    });
    cache.active.for_each(look_at);
  }

 private:
  bool asks(uint32_t slot) const {
    const BodyProperties& properties = state.properties[slot];
    return properties.type != 0 && properties.sensor == 0 &&
           masks_meet(properties.category, properties.mask, filter.category, filter.mask) &&
           !(id_of(slot) == filter.ignore);
  }
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
