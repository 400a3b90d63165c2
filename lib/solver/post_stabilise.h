#pragma once
#include "solver/solve.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Moves the bodies of an island apart by half of what their contacts overlap after the substeps, along the normals and
/// without a change of speed, and no faster than push_max. Returns the number of angles that were clamped.
/// Source: Cline, Pai, "Post-stabilization for rigid body simulation with contact and constraints", ICRA 2003.
uint32_t post_stabilise(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> island,
                        Span<const ContactOrder> order, Span<ContactWork> contacts);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
