#include "contact/surface_distance.h"

#include <detent/distance.h>

#include "contact/surface_ops.h"
#include "distance/pair.h"
#include "math/arithmetic.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// Tests the triangles one by one until one is near.
struct DistanceSearch {
  const Surface surface;
  const Pose &ground, &pose;
  const Convex& convex;
  const Real reach;
  bool asked = true, farther = true;

  void ask(uint32_t triangle) {
    Pose placed;
    Convex made;
    if (!asked || !farther) return;
    asked = surface_convex(surface, ground, triangle, placed, made) == Status::ok &&
            farther_than(made, placed, convex, pose, reach, farther) == Status::ok;
  }
};

}  // namespace

bool farther_than_surface(const AssetTable& assets, const BodyTraits& ground, const Pose& ground_pose,
                          const BodyTraits& body, const Convex& convex, const Pose& pose, Real reach, bool& farther) {
  const Real zero = 0.0, ball = real_from_unit(body.bounding_radius, body.size_exponent);
  SurfacePlace place;
  Vec64 raw;
  if (!is_in(assets, ground.asset) || place_on_surface(ground_pose, pose, place) != Status::ok ||
      !raw_from_real({ball + scale_by_power(ball, -8) + reach, zero, zero}, raw))
    return false;
  DistanceSearch search = {surface_of(ground, assets), ground_pose, pose, convex, reach};
  const Vec64 half = {raw.x, raw.x, raw.x};
  visit_surface(
      search.surface, place.centre - half, place.centre + half,
      [](void* context, uint32_t triangle) { static_cast<DistanceSearch*>(context)->ask(triangle); }, &search);
  farther = search.farther;
  return search.asked;
}

const SurfaceDistanceOps k_surface_distance_ops = {farther_than_surface};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
