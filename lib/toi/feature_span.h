#pragma once
#include "toi/feature_cubic.h"

/// Two features over an interval of time, as the polygon of the differences of their corners: a triangle for a vertex
/// and a face, a parallelogram for two edges. The features touch when the polygon contains the origin.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// All lengths are in one unit that the caller chooses. Range: components and ball below 2^63.
struct FeatureSpan {
  int count;      ///< number of corners, 3 or 4, in order around the polygon
  Vec64 from[4];  ///< the corners at the beginning of the interval
  Vec64 to[4];    ///< the corners at its end
  int64_t ball;   ///< bound on the distance of a corner from its chord, in each component
};

/// The part of the interval that may hold a contact; there is certainly no contact outside of it. The result is empty
/// if the hull of all corners at both ends is farther from the origin than 1.8 `ball` plus 2^-26 of the largest corner;
/// it may be empty for nearer corners too.
OpenPart open_part(const FeatureSpan& span);

/// Whether the features are nearer than `gap` at the beginning of the interval. True for every distance below `gap`;
/// false for every distance above 1.8 gap plus 2^-26 of the largest corner at that time.
bool begins_near(const FeatureSpan& span, int64_t gap);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
