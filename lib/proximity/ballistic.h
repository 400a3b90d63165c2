#pragma once
#include "proximity/moving_pair.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The time of impact of a prepared pair by conservative advancement with a ballistic bound. Along the normal n of the
/// nearest points, less than the floor apart is certainly not before D1(t) + D2(t) takes up the rest: of each body its
/// centre's way along n, linear in t since a step's velocities are constant (gravity is in them), and what rotation may
/// add, rho |n x axis| 2 sin(min(angle t, pi) / 2): a point turns along a chord across the axis. Mirtich's own bound is
/// rho |w| t, never less. With chords the rest is a convex function of time: Newton's method comes from the safe side
/// to its first root, by values and slopes that are rounded outwards. Never late, of every shape. Of a plane that turns
/// no such bound holds, for its points have no greatest distance: there it is advance_on() with the plane's normal, as
/// of all methods. Errors: undecided after k_toi_iterations_compared_max normals.
/// Source: B. Mirtich, Impulse-based Dynamic Simulation of Rigid Body Systems, PhD thesis, Berkeley 1996.
void ballistic_advancement(const MovingPair& pair, TimeOfImpact& result);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
