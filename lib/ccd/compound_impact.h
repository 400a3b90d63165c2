#pragma once
#include "ccd/impact_pair.h"
#include "contact/compound_ops.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Finds the earliest impact of two bodies, at least one of which is a compound, over all pairs of parts. Stores it in
/// `meeting`; its time is a fraction of the part of the tick after `time`. Each pair of parts is tested at increasing
/// shrink depths (amounts by which the shapes are made smaller, impact_pair.h) independently: one pair may separate
/// while another one would pass through. At shrink depths of more than 1/16 of the body's smallest diameter, a hull
/// child is replaced by the smaller hull that was cooked for it. Returns false if a part could not be tested.
bool compound_impact(const AssetTable& assets, const FeatureTable& features, const SweptBody& a, const SweptBody& b,
                     Fraction time, const ShrunkenCores& cores, Meeting& meeting);

/// FeatureTable points to these functions if the feature is linked.
struct CompoundImpactOps {
  decltype(&compound_impact) find;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
