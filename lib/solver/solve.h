#pragma once
#include <detent/detail/scratch.h>

#include "base/span.h"
#include "motion/solver_bodies.h"
#include "motion/step_settings.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

struct SolveCount {
  uint32_t clamped = 0;  ///< values that were clamped
  /// Iterations over the island's contacts that were skipped because earlier iterations had converged
  /// (WorldDef::convergence).
  uint32_t sweeps_saved = 0;
  uint32_t undecided = 0;  ///< joint solves that ended before the modes of all limits and drives were decided
};

struct JointStage;
struct JointOps;

/// The joints of an island. `code` is null if the island has none.
struct IslandJoints {
  const JointOps* code = nullptr;
  const Island* island = nullptr;
  JointStage* stage = nullptr;
};

/// The contacts of an island in the order of the solve, and the work space for groups of contacts that are solved at
/// once. The work space of a group begins at lanes[key], where `key` is ContactOrder::key of the group's first contact.
struct IslandContacts {
  Span<ContactOrder> order;
  Span<ContactWork> contacts;
  Span<LaneSpace> lanes;
};

/// Whether a body of any of the contacts is kinematic.
bool has_kinematic_contact(Span<const BodyProperties> properties, Span<const ContactOrder> order,
                           Span<const ContactWork> contacts);

/// Runs an island's substeps. Each substep integrates velocities, warm starts, solves soft normals and joints,
/// integrates positions, and relaxes with friction. Restitution is applied once after all substeps. The solver is SOR
/// over the contacts in the given order, in velocity units. `settings` has the island's substeps.
/// Source: Macklin and others, "Small Steps in Physics Simulation", 2019; Catto, "Solver2D", 2024 (soft step).
SolveCount solve(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> island,
                 const IslandContacts& all, const IslandJoints& joints);

/// Moves an island without contacts. The displacement is exact for constant acceleration. The rotation of each body is
/// computed in four steps per substep (rotate_freely() in angular_velocity.h). Returns the number of values that were
/// clamped.
uint32_t integrate_free(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> island);

/// Moves the kinematic bodies through the tick. Returns the number of values that were clamped.
uint32_t integrate_kinematic(const StepSettings& settings, const SolverBodies& bodies);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
