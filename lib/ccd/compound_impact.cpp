#include "ccd/compound_impact.h"

#include "ccd/surface_impact.h"
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
  const Ladder& ladder;
  Meeting& meeting;
  const ConvexParts parts_a, parts_b;
  const Motion motion_a, motion_b;
  /// Upper bound of how much the distance of any two points can shrink, m.
  Real closing = 0.0;
  bool bounded = false;  ///< `closing` is valid

  bool inset_part(const SweptBody& body, const ConvexParts& parts, uint32_t i, Real inset, Convex& convex) const {
    if (!is_compound(body.traits)) return inset_convex(assets, body.traits, inset, convex);
    return parts.convex(i, inset_halvings(inset, shape_extent(body.traits)) != 0, convex) &&
           inset_convex(inset, 0, convex);
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

  bool may_meet(uint32_t i, uint32_t j) const {
    if (!bounded) return true;
    const Vec3<Real> way = middle_of(parts_b, j, motion_b.start) - middle_of(parts_a, i, motion_a.start);
    const Real far = max(abs(way.x), max(abs(way.y), abs(way.z)));
    const Real reach = parts_a.reach(i) + parts_b.reach(j) + closing;
    return far <= reach + scale_by_power(reach + far, -10);
  }

  bool ask_surface() {
    const bool ground_is_a = is_surface(a.traits);
    const SweptBody& body = ground_is_a ? b : a;
    const ConvexParts& parts = ground_is_a ? parts_b : parts_a;
    for (uint32_t i = 0; i < parts.count(); ++i) {
      const auto on_rung = [&](Real inset, TimeOfImpact& found) {
        Convex convex;
        return inset_part(body, parts, i, inset, convex) &&
               features.surface_impact->impact(assets, *features.surface, a, b, convex, time, found);
      };
      if (!climb(a, b, time, ladder, on_rung, meeting)) return false;
    }
    return parts.count() != 0;
  }

  bool ask_parts() {
    for (uint32_t i = 0; i < parts_a.count(); ++i) {
      for (uint32_t j = 0; j < parts_b.count(); ++j) {
        if (!may_meet(i, j)) continue;
        const auto on_rung = [&](Real inset, TimeOfImpact& found) {
          Convex convex_a, convex_b;
          return inset_part(a, parts_a, i, inset, convex_a) && inset_part(b, parts_b, j, inset, convex_b) &&
                 time_of_impact(convex_a, motion_a, convex_b, motion_b, found) == Status::ok;
        };
        if (!climb(a, b, time, ladder, on_rung, meeting)) return false;
      }
    }
    return parts_a.count() != 0 && parts_b.count() != 0;
  }
};

}  // namespace

bool compound_impact(const AssetTable& assets, const FeatureTable& features, const SweptBody& a, const SweptBody& b,
                     Fraction time, const Ladder& ladder, Meeting& meeting) {
  PartSearch search = {assets,
                       features,
                       a,
                       b,
                       time,
                       ladder,
                       meeting,
                       ConvexParts(a.traits, assets),
                       ConvexParts(b.traits, assets),
                       motion_from(a, time),
                       motion_from(b, time)};
  const bool is_plane = is_half_space(a.traits) || is_half_space(b.traits);
  search.bounded = !is_plane && closing_bound(a, b, time, search.closing);
  return is_surface(a.traits) || is_surface(b.traits) ? search.ask_surface() : search.ask_parts();
}

const CompoundImpactOps k_compound_impact_ops = {compound_impact};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
