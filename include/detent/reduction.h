#pragma once
#include <detent/config.h>

/// @file
/// Reduction of contact points to four.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Which of more than four contact points are kept. Stored: a value is never reused.
enum class ManifoldReduction : uint32_t {
  /// The extreme points along four diagonals of the contact plane. Their depth is not used, so that small changes of
  /// depth select the same points. The deepest point is added, or replaces the nearest of four, if it is deeper than
  /// all of them by 2^-10 of the smaller body. If one point is extreme along several diagonals, points that add most to
  /// the area fill the free places.
  /// Source: the extremes of Moravanszky, Terdiman, "Fast Contact Reduction for Dynamics Simulation", 2004.
  projected_extremes = 1,
  /// The deepest point, the point farthest from it, the point that makes the largest triangle with both, and the point
  /// that adds most to the area of this triangle.
  deepest_area = 2,
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
