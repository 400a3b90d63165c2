#pragma once
#include <detent/detail/state.h>
#include <detent/distance.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Converts the shape of a body to a Convex, for lib/distance, lib/contact and lib/toi. The conversion is cheap: it
/// scales the body's sizes by a power of two and computes no roots. The core radius is rounded up by at most 2^-7 of
/// its value. Returns false, and leaves `convex` unchanged, for a compound and for a hull whose asset is not in
/// `assets`. Returns true for all other bodies.
bool body_convex(const BodyProperties& properties, const AssetTable& assets, Convex& convex);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
