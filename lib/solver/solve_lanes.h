#pragma once
#include "solver/solve.h"

/// The passes of the solver over four contacts at once, for processors with such registers. Each lane executes the
/// operations of one contact, so the bits are the same (tests/unit/solver/lanes_test.cpp).
namespace detent {
inline namespace DETENT_NAMESPACE {

#if DETENT_QUADS
inline constexpr bool k_built_with_lanes = true;
/// True if this machine has the registers. On a virtual machine the query can take longer than a small world's step.
bool has_lanes();

/// Do the same as the passes of ContactSolver<One>. Range: no dynamic body twice; equal counts of points and of angular
/// rows.
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
