#pragma once
#include <detent/world.h>

#include "ccd/impact.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// What a step records besides its report.
struct StepProbe : ImpactProbe {
#if DETENT_SPARSE
  Span<const JointState> joints = {};               ///< in: JointStage::others
  BitSet anchoring = {};                            ///< in: JointStage::anchoring
  Span<const JointBody> joint_bodies = {};          ///< the bodies of the joints, in the block
  uint32_t joint_couplings = 0, joint_numbers = 0;  ///< used of these pools of the joints
#endif
};

/// As step(), for tests and rollback. `probe` records the sweeps of the bodies, and can switch off the filters of
/// continuous collision. StepObserver::step is not called.
StepReport step_probed(World& world, StepProbe& probe);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
