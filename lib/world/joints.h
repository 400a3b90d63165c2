#pragma once
#include "joint/joint.h"
#include "state/step_cache.h"

/// Operations on the joints of a world that are not part of the solver.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Frees the slot of a joint and wakes its bodies.
void remove_joint(StateView<uint8_t>& state, uint32_t slot);
/// Removes all joints of a body.
void remove_joints_of(StateView<uint8_t>& state, uint32_t body);

/// Wakes each sleeping body that is joined to a moving body, then each sleeping body that is joined to one of the woken
/// bodies, and so on. Returns the number of bodies that woke.
uint32_t wake_jointed(Span<const JointState> joints, Span<const BodyProperties> properties,
                      Span<const BodyMotion> motions, Span<BodyActivity> activities, const StepCacheView& cache);

/// Lists the keys of the pairs whose collision is disabled by joints, ascending. `keys` must have room for one key per
/// joint of the capacity.
Span<const uint64_t> list_disabled_pairs(Span<const JointState> joints, Span<uint64_t> keys);

/// Removes the joints that broke in this step, and adds them to the report and to the joint events.
void break_joints(World& world, StepReport& report);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
