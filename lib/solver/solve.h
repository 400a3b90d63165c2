#pragma once
#include <detent/detail/scratch.h>

#include "base/span.h"
#include "motion/solver_bodies.h"
#include "motion/step_settings.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

struct SolveCount {
  uint32_t clamped = 0;       ///< values
  uint32_t sweeps_saved = 0;  ///< over the island's contacts, since the ones before changed nothing any more
};

struct JointStage;
struct JointOps;

/// The joints of an island; `code` null if it has none.
struct IslandJoints {
  const JointOps* code = nullptr;
  const Island* island = nullptr;
  JointStage* stage = nullptr;
  uint32_t* undecided = nullptr;
};

/// Runs an island's substeps: velocities, warm start, soft normals, joints, positions, relaxation with
/// friction; then
/// restitution once. SOR over the contacts in the given order, in velocity units. `settings` has the island's substeps.
/// Source: Macklin and others, "Small Steps in Physics Simulation", 2019; Catto, "Solver2D", 2024 (soft step).
SolveCount solve(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> island,
                 Span<const ContactOrder> order, Span<ContactWork> contacts, const IslandJoints& joints);

/// Moves an island without contacts: under constant acceleration its centre's way is exact, and each body's turning is
/// split in four (spin.h).
uint32_t integrate_free(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> island);

/// Moves the kinematic bodies through the tick.
uint32_t integrate_kinematic(const StepSettings& settings, const SolverBodies& bodies);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
