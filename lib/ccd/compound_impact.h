#pragma once
#include "ccd/impact_pair.h"
#include "contact/compound_ops.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Finds the earliest impact of two bodies, at least one of which is a compound, over all pairs of parts. The time of
/// the result is a fraction of the rest of the tick. Each pair of parts goes through the shrink depths (impact_pair.h)
/// separately: one pair may separate while another one would pass through. At shrink depths of more than 1/16 of the
/// body's extent, a hull child is replaced by the smaller hull that was cooked for it. Returns false if a part could
/// not be tested.
bool compound_impact(const AssetTable& assets, const FeatureTable& features, const SweptBody& a, const SweptBody& b,
                     Fraction time, const ShrunkenCores& cores, Meeting& meeting);

/// Entry of the feature table.
struct CompoundImpactOps {
  decltype(&compound_impact) find;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
