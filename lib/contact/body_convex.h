#pragma once
#include <detent/convex.h>
#include <detent/detail/state.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The shape of a live body, ready for the questions of lib/distance, lib/contact and lib/toi. Cheap: shifts of the
/// body's sizes, no roots. The core radius is rounded up by no more than 2^-7 of it. False, and nothing changed, for a
/// hull whose asset the table does not have, and for a compound; any other body's shape is known.
bool body_convex(const BodyTraits& traits, const AssetTable& assets, Convex& convex);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
