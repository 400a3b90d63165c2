#pragma once
#include <detent/world.h>

#include "ccd/impact.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Data that a step records in addition to its report, and inputs of a step in a rollback.
struct StepProbe : ImpactProbe {
#if DETENT_SPARSE
  Span<const JointState> joints = {};               ///< input: JointStage::others
  BitSet anchoring = {};                            ///< input: JointStage::anchoring
  Span<const JointBody> joint_bodies = {};          ///< output: JointStage::bodies of the step; they lie in the block
  uint32_t joint_couplings = 0, joint_numbers = 0;  ///< output: entries used of the pools with these names
#endif
};

/// As step(), for tests and rollback. `probe` records the sweeps of the bodies, and can switch off the filters by which
/// continuous collision skips pairs. StepObserver::step is not called.
StepReport step_probed(World& world, StepProbe& probe);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
