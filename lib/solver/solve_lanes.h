#pragma once
#include "solver/solve.h"

/// The passes of the solver for four contacts at once, for processors with registers of 256 bits. Each lane executes
/// the operations for one contact, so the results have the same bits (tests/unit/solver/lanes_test.cpp).
namespace detent {
inline namespace DETENT_NAMESPACE {

#if DETENT_QUADS
inline constexpr bool k_built_with_lanes = true;
/// Whether this machine has these registers. On a virtual machine this call can take longer than the step of a small
/// world.
bool has_lanes();

/// The same passes as those of ContactSolver<One>, for four contacts. Range: no dynamic body belongs to two of the
/// contacts; all have equal numbers of points and of angular rows.
void warm_start_lanes(const StepSettings& settings, const SolverBodies& bodies, ContactWork* const (&contacts)[4]);
void solve_normals_lanes(const StepSettings& settings, const SolverBodies& bodies, ContactWork* const (&contacts)[4]);
void relax_lanes(const StepSettings& settings, const SolverBodies& bodies, ContactWork* const (&contacts)[4]);
#else
inline constexpr bool k_built_with_lanes = false;
constexpr bool has_lanes() { return false; }
inline void warm_start_lanes(const StepSettings&, const SolverBodies&, ContactWork* const (&)[4]) {}
inline void solve_normals_lanes(const StepSettings&, const SolverBodies&, ContactWork* const (&)[4]) {}
inline void relax_lanes(const StepSettings&, const SolverBodies&, ContactWork* const (&)[4]) {}
#endif

}  // namespace DETENT_NAMESPACE
}  // namespace detent
