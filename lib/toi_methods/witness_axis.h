#pragma once
#include "toi/moving_pair.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// More witnesses than this are not looked for.
inline constexpr int k_witnesses_max = 32;
/// Halvings and interpolations between two times along one witness.
inline constexpr int k_root_steps_max = 48;

/// The time of impact of a prepared pair by the roots of the separation along witnesses. A witness is a plane between
/// the nearest features whose normal moves with them: that of a face, or of an edge towards a vertex, turns with the
/// body, a half-space's with it; of two edges it is their cross product; between two vertices, and on rims, it stays as
/// it is (a line that followed two vertices would part them always). If the cores are the floor apart along it at the
/// window's end, they are taken to be clear; else a change of sign between now and then is found by regula falsi
/// (Illinois) and bisection, and there GJK says whether that is a hit, and gives the next witness.
/// At a hit the shapes are apart, and within the tolerance. *Nothing else is certified*: between the times that are
/// looked at they may meet and part again, so that a hit may be later than the first, and what is said to be clear may
/// have met (tests/unit/toi/witness_axis_test.cpp counts both).
/// Errors: undecided after k_witnesses_max, or where neither the witness nor the normal of now leads on.
/// Source: the local separating axis of E. Catto's Box2D (b2TimeOfImpact), with planes of a face or of two edges as in
/// the lecture notes of D. Baraff, Rigid Body Simulation II: Nonpenetration Constraints, 1997, and before them in his
/// Curved Surfaces and Coherence for Non-penetrating Rigid Body Simulation, SIGGRAPH 1990.
void witness_axes(const MovingPair& pair, TimeOfImpact& result);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
