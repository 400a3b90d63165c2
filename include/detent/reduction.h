#pragma once
#include <detent/config.h>

/// @file
/// Which contact points are kept.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Which of more than four contact points are kept. Stored: a value is never reused.
enum class ManifoldReduction : uint32_t {
  /// Those that reach farthest along four diagonals of the contact plane, whatever their depth, so that what trembles
  /// keeps them; and the deepest, where it is deeper than all of them by 2^-10 of the smaller body. Where several are
  /// one point, those that add most to the area follow.
  /// Source: the extremes of Moravanszky, Terdiman, "Fast Contact Reduction for Dynamics Simulation", 2004.
  projected_extremes = 1,
  /// The deepest, the one farthest from it, the one that makes the largest triangle with both, and the one that adds
  /// most to its area.
  deepest_area = 2,
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
