#include "contact/terrain_distance.h"

#include <detent/distance.h>

#include "contact/terrain_ops.h"
#include "distance/pair.h"
#include "math/arithmetic.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// Tests triangles one by one until one of them is not farther from the shape than `margin` (`farther` becomes false),
/// or until a test fails (`asked` becomes false).
struct DistanceSearch {
  const Terrain terrain;
  const Pose &ground, &pose;
  const Convex& convex;
  const Real margin;
  bool asked = true, farther = true;

  void ask(uint32_t triangle) {
    Pose placed;
    Convex made;
    if (!asked || !farther) return;
    asked = terrain_convex(terrain, ground, triangle, placed, made) == Status::ok &&
            farther_than(made, placed, convex, pose, margin, farther) == Status::ok;
  }
};

}  // namespace

bool farther_than_terrain(const AssetTable& assets, const BodyProperties& ground, const Pose& ground_pose,
                          const BodyProperties& body, const Convex& convex, const Pose& pose, Real margin,
                          bool& farther) {
  const Real zero = 0.0, ball = real_from_unit(body.bounding_radius, body.size_exponent);
  TerrainPlace place;
  Vec64 raw;
  if (!is_in(assets, ground.asset) || place_on_terrain(ground_pose, pose, place) != Status::ok ||
      !raw_from_real({ball + scale_by_power(ball, -8) + margin, zero, zero}, raw))
    return false;
  DistanceSearch search = {terrain_of(ground, assets), ground_pose, pose, convex, margin};
  const Vec64 half = {raw.x, raw.x, raw.x};
  visit_terrain(
      search.terrain, place.centre - half, place.centre + half,
      [](void* context, uint32_t triangle) { static_cast<DistanceSearch*>(context)->ask(triangle); }, &search);
  farther = search.farther;
  return search.asked;
}

const TerrainDistanceOps k_terrain_distance_ops = {farther_than_terrain};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
