#pragma once
#include "toi/moving_pair.h"

/// Cheap tests that show a pair to be clear, by an axis that is known beforehand or by the distance alone.
/// conservative_advancement() would give the same result after more work.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The margin, in ulps of the pair's block, by which a certified separation must exceed the touching distance. With it,
/// gjk() never finds a pair touching that was certified to be apart: a certified separation may be too large by 31
/// ulps, and a distance of gjk() too small by at most 30.
/// Derived in docs/design/time_of_impact.md, "A known axis replaces the search".
inline constexpr int32_t k_certain = 64;

/// Whether an axis certifies that the bodies do not touch in the whole window (the part of the step in which their
/// bounding spheres touch). The axis is `normal` when the window begins and rotates with one of the bodies. False for
/// pairs that are not tested: pairs with a half-space, pairs of two shapes that are cylinders or cones, pairs with an
/// empty window, and pairs whose rotation angles add up to more than 2 rad.
bool stays_clear(const MovingPair& pair, const Vec32& normal);

/// The distance of the cores at the start of the window, in ulps of the pair's block, beyond which the shapes cannot
/// come to touch in the window: the argument `enough` of conservative_advancement(). INT32_MAX for a pair that
/// stays_clear() does not test.
int32_t enough_apart(const MovingPair& pair);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
