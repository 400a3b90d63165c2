#pragma once
#include "state/view.h"

/// Which joints a state may hold.
namespace detent {
inline namespace DETENT_NAMESPACE {

inline constexpr Real k_anchor_max = 4096.0;  ///< m, of each component

bool is_joint_type(JointType type);
/// All but the bodies and what steps leave.
bool is_joint(const JointState& joint);
/// All of the state's.
bool are_joints(const StateView<const uint8_t>& state);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
