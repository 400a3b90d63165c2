#pragma once
#include "base/span.h"
#include "motion/solver_bodies.h"

/// Limits the warm start: the impulses of the last substep, which the next substep applies again before it solves.
///
/// The impulses that stop a heavy body on light ones are too great as soon as it has stopped. The rows reduce them only
/// slowly, because each row sees the small effective mass of its own light body. Applied again in each substep, they
/// throw the heavy body back. But the contacts of an island do not move by themselves, so their impulses together
/// cannot add kinetic energy. A warm start that adds kinetic energy is therefore too great.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The warm start is limited in islands of more than one contact whose heaviest body has at least
/// 2^k_limited_mass_power times the mass of the lightest body. In other islands, the rows reduce impulses fast enough:
/// masses differ less, or the row of the single contact sees the masses of all bodies.
inline constexpr int k_limited_mass_power = 3;

/// Limits the warm start of an island, which integrate_velocities() has applied in full. Does nothing if
/// BodyWork::supports of its bodies is 0. choose_substeps() sets it to 0 in an island whose masses differ less, in an
/// island with one contact, and in an island that a kinematic body touches, because this body can do work. Sets
/// BodyWork::carried of the bodies to the share of the warm start that the island keeps, and removes the rest from
/// their motions. The caller scales the contacts' impulses. Returns whether the share is below 1. Range: no body has a
/// joint.
///
/// Let v be the motion before the warm start, M the masses and inertias, and p the change of v by the warm start. The
/// warm start has added the energy E = p M v + p M p / 2. The share is 1 if E <= 0, then falls with E, and is 0 from E
/// = p M p on. (For a body at rest on another, gravity has added the motion v = -p, so that E = -p M p / 2.)
bool limit_warm_start(const SolverBodies& bodies, Span<const uint32_t> island);

/// Multiplies all accumulated impulses of a contact by `share`. Overflow: clamps to Real's range.
void scale_impulses(Scaled share, ContactWork& contact);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
