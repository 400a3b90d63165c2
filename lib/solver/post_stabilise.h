#pragma once
#include "solver/solve.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Separates the bodies of an island after the substeps: corrects half of the remaining overlap of each contact along
/// its normal, no faster than push_max, without changing velocities. Returns the number of angles that were clamped.
/// Source: Cline, Pai, "Post-stabilization for rigid body simulation with contact and constraints", ICRA 2003.
uint32_t post_stabilise(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> island,
                        Span<const ContactOrder> order, Span<ContactWork> contacts);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
