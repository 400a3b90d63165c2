#pragma once
#include <detent/asset.h>
#include <detent/detail/state.h>
#include <detent/distance.h>
#include <detent/features.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// As farther_than(), for a body `ground` with terrain (a mesh or height field) and a convex shape at `pose`: sets
/// `farther` to whether their distance exceeds `margin`, m. `convex` is the shape of `body` or a part of it. Returns
/// false if the test cannot be made, for example because the bytes of the terrain are missing.
bool farther_than_terrain(const AssetTable& assets, const BodyProperties& ground, const Pose& ground_pose,
                          const BodyProperties& body, const Convex& convex, const Pose& pose, Real margin,
                          bool& farther);

/// Entry of FeatureTable (detent/features.h): the distance test for terrain.
struct TerrainDistanceOps {
  decltype(&farther_than_terrain) farther;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
