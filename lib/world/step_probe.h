#pragma once
#include <detent/world.h>

#include "ccd/impact.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Data that a step records in addition to its report, and inputs of a step in a rollback.
struct StepProbe : ImpactProbe {
#if DETENT_SPARSE
  /// Input: the joints from which `anchoring` selects (JointStage::others).
  Span<const JointState> joints = {};
  /// Input: indices in `joints` of joints that this step does not solve, but whose fixed and kinematic bodies it
  /// collects (JointStage::anchoring).
  BitSet anchoring = {};
  /// Output: the jointed bodies of the step (JointStage::bodies). The entries are stored in the world's block.
  Span<const JointBody> joint_bodies = {};
  /// Output: number of elements that the step used of JointStage::couplings and of JointStage::numbers.
  uint32_t joint_couplings = 0, joint_numbers = 0;
#endif
};

/// As step(), for tests and rollback. `probe` records the sweeps of the bodies, and can switch off the filters by which
/// continuous collision skips pairs. StepObserver::step is not called.
StepReport step_probed(World& world, StepProbe& probe);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
