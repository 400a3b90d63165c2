#pragma once
#include "toi/moving_pair.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The time of impact of a prepared pair by conservative advancement with a ballistic bound. Along the normal n of the
/// nearest points, what lies between the cores and the floor is not used up before the time at which D1(t) + D2(t) is
/// as much: of each body its centre's way along n, linear in t since a step's velocities are constant (gravity has gone
/// into them), and what its rotation may add, rho |n x axis| 2 sin(min(angle t, pi) / 2): a point moves by a chord
/// across the axis. Never more than the usual rho |w| t. The rest is a convex function of time: Newton's method comes
/// to its first root from the safe side, by values and slopes that are rounded outwards. Never late, of every shape.
/// A plane that turns has no such bound, as its points have no greatest distance: there it is the plane's normal that
/// turns (conservative_advancement()), as in all methods.
/// Errors: undecided after k_toi_iterations_compared_max normals.
/// Source: conservative advancement as named after B. Mirtich, Impulse-based Dynamic Simulation of Rigid Body Systems,
/// PhD thesis, Berkeley 1996; the chords and the search are ours.
void ballistic_advancement(const MovingPair& pair, TimeOfImpact& result);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
