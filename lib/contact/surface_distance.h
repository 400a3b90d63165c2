#pragma once
#include <detent/asset.h>
#include <detent/convex.h>
#include <detent/detail/state.h>
#include <detent/features.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// As farther_than(), of a body that has a surface and one that has none, of which only `convex` counts, at its pose:
/// its shape or a part of it. False if it could not be asked, as where the
/// surface's bytes are missing.
bool farther_than_surface(const AssetTable& assets, const BodyTraits& ground, const Pose& ground_pose,
                          const BodyTraits& body, const Convex& convex, const Pose& pose, Real reach, bool& farther);

/// For a feature table.
struct SurfaceDistanceOps {
  decltype(&farther_than_surface) farther;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
