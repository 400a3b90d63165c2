#pragma once
#include "state/view.h"

/// Checks of the joints in a state.
namespace detent {
inline namespace DETENT_NAMESPACE {

inline constexpr Real k_anchor_max = 4096.0;  ///< limit of each component of an anchor, m

bool is_joint_type(JointType type);
/// Whether the settings of a joint are valid. Does not check the bodies, the frames and the values that steps compute.
bool is_joint(const JointState& joint);
/// Whether all joints of the state are valid.
bool are_joints(const StateView<const uint8_t>& state);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
