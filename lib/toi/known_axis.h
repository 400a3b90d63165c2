#pragma once
#include "toi/moving_pair.h"

/// What is clear by an axis that is known beforehand, or at a glance: conservative_advancement() would say so too,
/// after more work.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Ulps by which more than the touching distance is asked for, so that no witness points of gjk() can show that pairs
/// touch which are certified to be so far apart: 31 that a certificate may be too large by, and at most 30 that a
/// distance which gjk() finds may be too small by. Derived in DESIGN.md.
inline constexpr int32_t k_certain = 64;

/// Whether an axis, which is `normal` when the window begins and turns with one of the bodies, certifies that they do
/// not touch in all of the window. False also of half-spaces, of two rims, and if both together turn by more than 2
/// rad.
bool stays_clear(const MovingPair& pair, const Vec32& normal);

/// For conservative_advancement(): from so far apart, ulps, the cores cannot come to touch in the window. INT32_MAX
/// where stays_clear() is false of every axis.
int32_t enough_apart(const MovingPair& pair);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
