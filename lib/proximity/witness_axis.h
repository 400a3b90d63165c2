#pragma once
#include "proximity/moving_pair.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// More witnesses than this are not looked for.
inline constexpr int k_witnesses_max = 32;
/// Halvings and interpolations between two times along one witness.
inline constexpr int k_root_steps_max = 48;

/// The time of impact of a prepared pair by the roots of the separation along witnesses. A witness is a plane between
/// the nearest features whose normal moves with them: that of a face, or the one of an edge towards a vertex, turns
/// with the body; of two edges it is their cross product; between two vertices, and on rims, it is that of now. What
/// parts the cores along it at the end of the step is taken to be clear; else a change of sign between now and then is
/// found by regula falsi (Illinois) and bisection, where GJK says whether that is a hit, and gives the next witness.
/// A hit is a time at which the shapes are apart, and within the tolerance. *Nothing else is certified*: between the
/// times looked at the shapes may meet and part, so that a hit may be a later one than the first, and a pair reported
/// clear may meet. Errors: undecided after k_witnesses_max, or where neither the witness nor the normal of the nearest
/// points, as it is now, leads on.
/// Source: after the separating planes of D. Baraff, Curved Surfaces and Coherence for Non-penetrating Rigid Body
/// Simulation, SIGGRAPH 1990; the search for a root by interpolating and halving is as in Box2D's b2TimeOfImpact.
void witness_axes(const MovingPair& pair, TimeOfImpact& result);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
