#include "ccd/compound_impact.h"

#include "ccd/terrain_impact.h"
#include "contact/part_culling.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// Tests the parts of two moving bodies.
struct PartSearch {
  const AssetTable& assets;
  const FeatureTable& features;
  const SweptBody &a, &b;
  const Fraction time;
  const ShrunkenCores& cores;
  Meeting& meeting;
  const ConvexParts parts_a, parts_b;
  const Motion motion_a, motion_b;

  bool shrink_part(const SweptBody& body, const ConvexParts& parts, uint32_t i, Real shrink_depth,
                   Convex& convex) const {
    if (!is_compound(body.properties)) return shrink_convex(assets, body.properties, shrink_depth, convex);
    return parts.convex(i, shrink_halvings(shrink_depth, shape_extent(body.properties)) != 0, convex) &&
           shrink_convex(shrink_depth, 0, convex);
  }

  bool ask_terrain() {
    const bool ground_is_a = is_terrain(a.properties);
    const SweptBody& body = ground_is_a ? b : a;
    const ConvexParts& parts = ground_is_a ? parts_b : parts_a;
    for (uint32_t i = 0; i < parts.count(); ++i) {
      const auto at_depth = [&](Real shrink_depth, TimeOfImpact& found) {
        Convex convex;
        return shrink_part(body, parts, i, shrink_depth, convex) &&
               features.terrain_impact->impact(assets, *features.terrain, a, b, convex, time, found);
      };
      if (!climb(a, b, time, cores, at_depth, meeting)) return false;
    }
    return parts.count() != 0;
  }

  bool ask_parts() {
    const PartCulling culling(
        b.properties, motion_b.start, a.properties, motion_a.start,
        swing_bound(a.properties, motion_a.rotation_vector) + swing_bound(b.properties, motion_b.rotation_vector),
        motion_a.displacement - motion_b.displacement);
    MovingShapes shapes(motion_a, motion_b);
    for (uint32_t i = 0; i < parts_a.count(); ++i) {
      Vec64 middle_a, half_a;
      parts_a.place(i, middle_a, half_a);
      culling.bring(middle_a, half_a);
      for (uint32_t j = 0; j < parts_b.count(); ++j) {
        Vec64 middle_b, half_b;
        parts_b.place(j, middle_b, half_b);
        if (!culling.meet(middle_b, half_b, middle_a, half_a)) continue;
        const auto at_depth = [&](Real shrink_depth, TimeOfImpact& found) {
          Convex convex_a, convex_b;
          return shrink_part(a, parts_a, i, shrink_depth, convex_a) &&
                 shrink_part(b, parts_b, j, shrink_depth, convex_b) &&
                 shapes.find(convex_a, convex_b, {}, meeting.impact.time, found);
        };
        if (!climb(a, b, time, cores, at_depth, meeting)) return false;
      }
    }
    return parts_a.count() != 0 && parts_b.count() != 0;
  }
};

}  // namespace

bool compound_impact(const AssetTable& assets, const FeatureTable& features, const SweptBody& a, const SweptBody& b,
                     Fraction time, const ShrunkenCores& cores, Meeting& meeting) {
  PartSearch search = {assets,
                       features,
                       a,
                       b,
                       time,
                       cores,
                       meeting,
                       ConvexParts(a.properties, assets),
                       ConvexParts(b.properties, assets),
                       motion_from(a, time),
                       motion_from(b, time)};
  return is_terrain(a.properties) || is_terrain(b.properties) ? search.ask_terrain() : search.ask_parts();
}

const CompoundImpactOps k_compound_impact_ops = {compound_impact};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
