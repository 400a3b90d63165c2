#pragma once
#include "ccd/impact_pair.h"
#include "contact/compound_ops.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// As PairSearch::find(), of two bodies of which one is a compound; the time is a part of what is left of the tick. The
/// first of all pairs of parts that meet: each climbs the ladder by itself, for while one parts another may go through.
/// A hull's deep rungs are the hull within it that was cooked for them.
bool compound_impact(const AssetTable& assets, const FeatureTable& features, const SweptBody& a, const SweptBody& b,
                     Fraction time, const Ladder& ladder, Meeting& meeting);

/// For a feature table.
struct CompoundImpactOps {
  decltype(&compound_impact) find;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
