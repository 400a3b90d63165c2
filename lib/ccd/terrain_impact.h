#pragma once
#include "ccd/impact_pair.h"
#include "contact/terrain_ops.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Finds the time of impact of two bodies of which one is a terrain (a mesh or height field). The time is a fraction of
/// the rest of the tick. The other body is represented by `convex` at the body's pose: the body's shape, or a part of
/// that shape, made smaller. Reports the first impact with a triangle. Skips triangles whose bounds the sweep does not
/// overlap, triangles whose plane the sweep does not reach, and one-sided triangles that would be hit from behind.
/// Returns false if the bytes of the terrain are missing or a value is out of range.
bool terrain_impact(const AssetTable& assets, const TerrainOps& code, const SweptBody& a, const SweptBody& b,
                    const Convex& convex, Fraction time, TimeOfImpact& impact);

/// FeatureTable points to these functions if the feature is linked.
struct TerrainImpactOps {
  decltype(&terrain_impact) impact;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
