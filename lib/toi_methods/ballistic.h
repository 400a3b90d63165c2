#pragma once
#include "toi/moving_pair.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The time of impact of a prepared pair by conservative advancement with a ballistic bound. n is the normal at the
/// nearest points. The gap is the separation of the cores along n, minus the distance that the cores must keep. The gap
/// cannot close before the time at which D1(t) + D2(t) equals the gap. D1 and D2 bound how far the two bodies approach
/// each other along n: D of a body is the displacement of its centre along n towards the other body, plus a bound for
/// its rotation. The displacement is linear in t, because the velocities of a step are constant and already contain
/// gravity. The rotation adds at most rho |n x axis| 2 sin(min(angle t, pi) / 2), because a point moves by a chord
/// across the axis. Here rho is the core radius, and axis and angle are those of the rotation. This bound is never more
/// than the usual rho |w| t, with w the angular velocity. The remaining gap is a convex function of time. Newton's
/// method approaches its first root from the safe side, with values and slopes that are rounded outwards. The result is
/// never late, for every shape. The bound does not exist for a rotating half-space, because its points have no greatest
/// distance from its position. Therefore conservative_advancement() finds the time of impact of a rotating half-space,
/// as in all methods: its axis is the normal of the plane, which rotates. The result is undecided after
/// k_toi_iterations_compared_max normals.
/// Source: the conservative advancement of B. Mirtich, Impulse-based Dynamic Simulation of Rigid Body Systems, PhD
/// thesis, Berkeley 1996. The chord bound and the search are Detent's own.
void ballistic_advancement(const MovingPair& pair, TimeOfImpact& result);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
