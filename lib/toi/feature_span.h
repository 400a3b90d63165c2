#pragma once
#include "toi/feature_cubic.h"

/// Two features over an interval of time, as the polygon of the differences of their corners: a triangle for a vertex
/// and a face, a parallelogram for two edges. They meet where the polygon holds the origin.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Lengths in one unit of the caller's choice. Range: components and ball below 2^63.
struct FeatureSpan {
  int count;      ///< of corners, 3 or 4, in their order round the polygon
  Vec64 from[4];  ///< the corners at the interval's beginning
  Vec64 to[4];    ///< and at its end
  int64_t ball;   ///< in each component a corner is never farther than this from its chord
};

/// Certain outside of the part that it leaves, whatever the corners are. An interval is closed altogether at the latest
/// where the hull of all corners, at both ends, stays off the origin by more than 1.8 balls and 2^-26 of the largest
/// corner.
OpenPart open_part(const FeatureSpan& span);

/// Whether the features are nearer than `gap` at the interval's beginning: at least where they are, and at most where
/// they are nearer than 1.8 of it and 2^-26 of the largest corner then.
bool begins_near(const FeatureSpan& span, int64_t gap);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
