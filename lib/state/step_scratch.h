#pragma once
#include <detent/detail/layout.h>

#include "base/bit_set.h"
#include "base/span.h"
#include "base/team.h"
#include "state/view.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The arrays of a step's work space in a block. The length of each span is the capacity of its array.
struct Scratch {
  Span<uint32_t> moving_bodies;
  BitSet candidates;
  Span<BodyWork> bodies;
  Span<BoundsKey> bounds_keys, bounds_sort;
  Span<uint64_t> pairs, pair_sort;
  Span<ContactWork> contacts;
  Span<ContactOrder> contact_order, contact_sort;
  Span<LaneSpace> lane_contacts;
  Span<Island> islands;
  Span<uint32_t> island_bodies;
  Span<BodySweep> sweeps;
  Span<ImpactPair> impact_pairs;
  Span<ImpactHit> impact_hits;
  Span<ImpactPath> impact_paths;
  Span<ManifoldState> manifolds;
  Span<JointWork> joints;
  Span<JointLanes> joint_lanes;
  Span<JointBody> joint_bodies;
  Span<uint32_t> joint_order;
  Span<JointCoupling> joint_couplings;
  Span<Real> joint_numbers;
  Span<uint64_t> disabled_pairs;
  Span<uint64_t> sensed, sensed_passed;
  BitSet changed;
};

inline Scratch scratch_of(uint8_t* block, const Layout& layout, Capacity capacity) {
  return {{at_offset<uint32_t>(block, layout.moving_bodies), capacity.bodies},
          {{at_offset<uint32_t>(block, layout.candidates), slot_words(capacity.bodies)}},
          {at_offset<BodyWork>(block, layout.body_work), capacity.bodies},
          {at_offset<BoundsKey>(block, layout.bounds_keys), capacity.bodies},
          {at_offset<BoundsKey>(block, layout.bounds_sort), capacity.bodies},
          {at_offset<uint64_t>(block, layout.pairs), capacity.contacts * k_pairs_per_contact},
          {at_offset<uint64_t>(block, layout.pair_sort), capacity.contacts * k_pairs_per_contact},
          {at_offset<ContactWork>(block, layout.contact_work), capacity.contacts},
          {at_offset<ContactOrder>(block, layout.contact_order), capacity.contacts},
          {at_offset<ContactOrder>(block, layout.contact_sort), capacity.contacts},
          k_may_have_lanes ? Span<LaneSpace>{at_offset<LaneSpace>(block, layout.lane_contacts),
                                             lane_contact_count(capacity.contacts)}
                           : Span<LaneSpace>{},
          {at_offset<Island>(block, layout.islands), capacity.bodies},
          {at_offset<uint32_t>(block, layout.island_bodies), capacity.bodies},
          {at_offset<BodySweep>(block, layout.sweeps), capacity.bodies},
          {at_offset<ImpactPair>(block, layout.impact_pairs), capacity.contacts},
          {at_offset<ImpactHit>(block, layout.impact_hits), capacity.contacts},
          {at_offset<ImpactPath>(block, layout.impact_paths), capacity.bodies},
          {at_offset<ManifoldState>(block, layout.manifold_work), manifold_count(capacity)},
          {at_offset<JointWork>(block, layout.joint_work), capacity.joints},
          k_may_have_joint_lanes ? Span<JointLanes>{at_offset<JointLanes>(block, layout.joint_lanes), capacity.joints}
                                 : Span<JointLanes>{},
          {at_offset<JointBody>(block, layout.joint_bodies), joint_body_count(capacity)},
          {at_offset<uint32_t>(block, layout.joint_order), capacity.joints},
          {at_offset<JointCoupling>(block, layout.joint_couplings), joint_coupling_count(capacity)},
          {at_offset<Real>(block, layout.joint_numbers), joint_number_room<k_may_have_joint_lanes>(capacity)},
          {at_offset<uint64_t>(block, layout.disabled_pairs), capacity.joints},
          {at_offset<uint64_t>(block, layout.sensed_work), capacity.sensed},
          {at_offset<uint64_t>(block, layout.sensed_passed), capacity.sensed},
          {{at_offset<uint32_t>(block, layout.changed), capacity.sensed == 0 ? 0 : slot_words(capacity.bodies)}}};
}

#if DETENT_TASKS
/// The spare memory of the impact stage. The arrays for impacts reuse the memory of the substeps' work space (Layout).
/// The spare memory is the part that they leave unused.
inline Span<uint64_t> impact_spare(uint8_t* block, const Layout& layout, Capacity capacity) {
  const uint64_t start = (layout.impact_paths + uint64_t{sizeof(ImpactPath)} * capacity.bodies + 7) / 8;
  return {at_offset<uint64_t>(block, static_cast<uint32_t>(8 * start)),
          static_cast<uint32_t>(layout.manifold_work / 8 - start)};
}
#endif

}  // namespace DETENT_NAMESPACE
}  // namespace detent
