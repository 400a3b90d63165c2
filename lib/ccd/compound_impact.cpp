#include "ccd/compound_impact.h"

#include "ccd/terrain_impact.h"
#include "math/root.h"

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
  /// Upper bound, m, on how much the distance between a point of A and a point of B can shrink.
  Real closing = 0.0;
  bool bounded = false;  ///< `closing` is valid

  bool shrink_part(const SweptBody& body, const ConvexParts& parts, uint32_t i, Real shrink_depth,
                   Convex& convex) const {
    if (!is_compound(body.properties)) return shrink_convex(assets, body.properties, shrink_depth, convex);
    return parts.convex(i, shrink_halvings(shrink_depth, shape_extent(body.properties)) != 0, convex) &&
           shrink_convex(shrink_depth, 0, convex);
  }

  /// The centre of a part's bounds, m, relative to A's position, world axes.
  Vec3<Real> middle_of(const ConvexParts& parts, uint32_t i, const Pose& pose) const {
    Vec64 middle, half;
    parts.place(i, middle, half);
    const Position &at = pose.position, &from = motion_a.start.position;
    const Vec3<Real> local = {real_from_raw(middle.x), real_from_raw(middle.y), real_from_raw(middle.z)};
    return rotate(pose.rotation, local) +
           Vec3<Real>{real_difference(at.x, from.x), real_difference(at.y, from.y), real_difference(at.z, from.z)};
  }

  bool may_collide(uint32_t i, uint32_t j) const {
    if (!bounded) return true;
    const Vec3<Real> offset = middle_of(parts_b, j, motion_b.start) - middle_of(parts_a, i, motion_a.start);
    const Real far = max(abs(offset.x), max(abs(offset.y), abs(offset.z)));
    const Real radius = parts_a.radius(i) + parts_b.radius(j) + closing;
    return far <= radius + scale_by_power(radius + far, -10);
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
    for (uint32_t i = 0; i < parts_a.count(); ++i) {
      for (uint32_t j = 0; j < parts_b.count(); ++j) {
        if (!may_collide(i, j)) continue;
        const auto at_depth = [&](Real shrink_depth, TimeOfImpact& found) {
          Convex convex_a, convex_b;
          return shrink_part(a, parts_a, i, shrink_depth, convex_a) &&
                 shrink_part(b, parts_b, j, shrink_depth, convex_b) &&
                 time_of_impact(convex_a, motion_a, convex_b, motion_b, found) == Status::ok;
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
  const bool is_plane = is_half_space(a.properties) || is_half_space(b.properties);
  search.bounded = !is_plane;
  search.closing = closing_bound(a, b, time);
  return is_terrain(a.properties) || is_terrain(b.properties) ? search.ask_terrain() : search.ask_parts();
}

const CompoundImpactOps k_compound_impact_ops = {compound_impact};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
