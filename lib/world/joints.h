#pragma once
#include "joint/joint.h"
#include "state/step_cache.h"

/// The joints of a world around its step.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Frees the slot of a joint; its bodies wake.
void remove_joint(StateView<uint8_t>& state, uint32_t slot);
/// And those of all joints of a body.
void remove_joints_of(StateView<uint8_t>& state, uint32_t body);

/// Wakes whoever is joined to a body that moves, and whoever they are joined to. Returns how many woke.
uint32_t wake_jointed(Span<const JointState> joints, Span<const BodyTraits> traits, Span<const BodyMotion> motions,
                      Span<BodyActivity> activities, const StepCacheView& cache);

/// The pairs that their joints keep from colliding, ascending. `keys` has room for as many as there may be joints.
Span<const uint64_t> list_apart(Span<const JointState> joints, Span<uint64_t> keys);

/// Takes away the joints that the step that ends now has broken, and says so.
void break_joints(World& world, StepReport& report);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
