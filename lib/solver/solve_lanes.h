#pragma once
#include "solver/solve.h"

/// The passes of the solver for four contacts at once, for processors with registers of 256 bits. Each lane executes
/// the operations for one contact, so the results have the same bits (tests/unit/solver/lanes_test.cpp). The contacts
/// are in lanes while their island is solved.
namespace detent {
inline namespace DETENT_NAMESPACE {

#if DETENT_QUADS
inline constexpr bool k_built_with_lanes = true;
/// Whether this machine has these registers. On a virtual machine this call can take longer than the step of a small
/// world.
bool has_lanes();

/// Puts four contacts, order[0] to order[3], into lanes. Range: no dynamic body belongs to two of the contacts; all
/// have equal numbers of points and of angular rows.
void put_in_lanes(const SolverBodies& bodies, Span<const ContactWork> contacts, const ContactOrder* order,
                  LaneSpace& lanes);
/// Reads the rows of the contacts, and the inverse inertias of their bodies, again. Impulses stay.
void renew_lanes(const SolverBodies& bodies, Span<const ContactWork> contacts, LaneSpace& lanes);
/// Writes the impulses back to the contacts.
void take_from_lanes(const LaneSpace& lanes, Span<ContactWork> contacts);

/// The same passes as those of ContactSolver<One>, for four contacts.
void warm_start_lanes(const StepSettings& settings, const SolverBodies& bodies, LaneSpace& lanes);
void solve_normals_lanes(const StepSettings& settings, const SolverBodies& bodies, LaneSpace& lanes);
void relax_lanes(const StepSettings& settings, const SolverBodies& bodies, LaneSpace& lanes);
#else
inline constexpr bool k_built_with_lanes = false;
constexpr bool has_lanes() { return false; }
inline void put_in_lanes(const SolverBodies&, Span<const ContactWork>, const ContactOrder*, LaneSpace&) {}
inline void renew_lanes(const SolverBodies&, Span<const ContactWork>, LaneSpace&) {}
inline void take_from_lanes(const LaneSpace&, Span<ContactWork>) {}
inline void warm_start_lanes(const StepSettings&, const SolverBodies&, LaneSpace&) {}
inline void solve_normals_lanes(const StepSettings&, const SolverBodies&, LaneSpace&) {}
inline void relax_lanes(const StepSettings&, const SolverBodies&, LaneSpace&) {}
#endif

inline bool uses_lanes(const StepSettings& settings) { return k_built_with_lanes && settings.lanes; }

}  // namespace DETENT_NAMESPACE
}  // namespace detent
