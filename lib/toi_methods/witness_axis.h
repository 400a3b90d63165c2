#pragma once
#include "toi/moving_pair.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The maximum number of witnesses of a search.
inline constexpr int k_witnesses_max = 32;
/// The maximum number of bisections and interpolations along one witness.
inline constexpr int k_root_steps_max = 48;

/// The time of impact of a prepared pair by the roots of the separation along witnesses. A witness is a plane between
/// the nearest features. Its normal moves with the features. The normal of a face, of an edge towards a vertex, or of a
/// half-space rotates with the body of this feature. The normal between two edges is their cross product. Between two
/// vertices, and on rims, the normal is fixed: the line through two vertices would always separate them. The floor is
/// the distance, a little below that of a hit, which the cores must keep (advance_by_axes()). If the cores are at least
/// the floor apart along the witness at the end of the window, the result is clear. Otherwise regula falsi (Illinois)
/// and bisection find a time at which the separation falls below the floor. GJK at that time decides whether the result
/// is a hit, and gives the next witness.
/// At a hit the shapes are disjoint and within the tolerance. *Nothing else is certified*: between the tested times the
/// shapes may touch and separate again. A reported hit may therefore be later than the first contact, and a pair that
/// is reported clear may have touched (tests/unit/toi/witness_axis_test.cpp counts both).
/// The result is undecided after k_witnesses_max witnesses, or if neither the witness nor the current normal, held
/// fixed, advances the time.
/// Source: the local separating axis of E. Catto's Box2D (b2TimeOfImpact). The planes of a face or of two edges are as
/// in the lecture notes of D. Baraff, Rigid Body Simulation II: Nonpenetration Constraints, 1997, and earlier in his
/// Curved Surfaces and Coherence for Non-penetrating Rigid Body Simulation, SIGGRAPH 1990.
void witness_axes(const MovingPair& pair, TimeOfImpact& result);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
