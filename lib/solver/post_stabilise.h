#pragma once
#include "solver/solve.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Corrects the overlaps of an island after the substeps. In each of four sweeps over the contacts, each contact
/// corrects half of its remaining overlap along its normal, but at most push_max x tick. Velocities do not change.
/// Returns 1 if an angle was clamped, else 0.
/// Source: Cline, Pai, "Post-stabilization for rigid body simulation with contact and constraints", ICRA 2003.
uint32_t post_stabilise(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> island,
                        Span<const ContactOrder> order, Span<ContactWork> contacts);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
