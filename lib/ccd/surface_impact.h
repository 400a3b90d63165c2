#pragma once
#include "ccd/impact_pair.h"
#include "contact/surface_ops.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// As pair_impact(), of two bodies of which one has a surface; the time is a part of what is left of the tick. Of the
/// other one only `convex` counts, at its pose: its shape or a part of it, made smaller. The first of its triangles
/// that it meets; those whose bounds the sweep misses, whose plane it stays off, or which are one-sided and met from
/// behind are not asked.
bool surface_impact(const AssetTable& assets, const SurfaceOps& code, const SweptBody& a, const SweptBody& b,
                    const Convex& convex, Fraction time, TimeOfImpact& impact);

/// For a feature table.
struct SurfaceImpactOps {
  decltype(&surface_impact) impact;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
