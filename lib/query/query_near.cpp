#include <detent/distance.h>

#include "base/float_environment.h"
#include "contact/compound_ops.h"
#include "distance/pair.h"
#include "query/query_hits.h"
#include "query/query_terrain.h"
#include "shape/shape_properties.h"
#include "shape/sweep.h"
#include "state/ranges.h"
#include "world/query_bodies.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// As near_at(), for a terrain.
bool near_at_terrain(const QueryBodies& bodies, uint32_t slot, const QueryShape& shape, const Pose& at, Real gap,
                     Real distance_max, QueryHit& hit) {
  const BodyProperties& properties = bodies.state.properties[slot];
  bool touched = false;
  const bool asked = has_terrain_bytes(bodies.world, properties) &&
                     near_on_terrain(asked_terrain(bodies.world, properties, bodies.state.poses[slot]), shape, at,
                                     distance_max, hit, touched) == Status::ok;
  hit.body = bodies.id_of(slot);
  hit.undecided = hit.undecided || !asked;
  if (hit.undecided) hit.distance = max(hit.distance, gap);
  return hit.distance <= distance_max && (!asked || touched);
}

/// Sets `nearest` to the result for the part that is nearest to the shape; it may be undecided (capped). Returns false
/// if a part could not be tested.
bool nearest_part(const QueryBodies& bodies, const BodyProperties& properties, const Pose& pose,
                  const QueryShape& shape, const Pose& at, Closest& nearest) {
  const ConvexParts parts(properties, bodies.world.hooks.assets);
  for (uint32_t i = 0; i < parts.count(); ++i) {
    Convex convex;
    Closest closest;
    if (!parts.convex(i, false, convex) || closest_points(convex, pose, shape.convex, at, closest) != Status::ok)
      return false;
    if (i == 0 || closest.distance < nearest.distance || (closest.distance == nearest.distance && nearest.capped))
      nearest = closest;
  }
  return parts.count() != 0;
}

/// Computes the distance to a body. `hit` must be newly made. `gap`: a lower bound of the distance, m; it is the least
/// distance of an undecided hit. Returns false if the distance exceeds `distance_max`, m.
bool near_at(const QueryBodies& bodies, uint32_t slot, const QueryShape& shape, const Pose& at, Real gap,
             Real distance_max, QueryHit& hit) {
  const BodyProperties& properties = bodies.state.properties[slot];
  if (is_terrain(properties)) return near_at_terrain(bodies, slot, shape, at, gap, distance_max, hit);
  const Pose pose = pose_near(properties, bodies.state.poses[slot], at.position);
  Closest closest;
  hit.body = bodies.id_of(slot);
  const bool asked = nearest_part(bodies, properties, pose, shape, at, closest);
  if (!asked || closest.capped) {
    hit.undecided = true;
    hit.distance = asked && closest.distance > gap ? closest.distance : gap;
    return hit.distance <= distance_max;
  }
  hit.distance = closest.distance;
  hit.point = moved(pose.position, closest.point_a);
  hit.normal = closest.normal;
  return hit.distance <= distance_max;
}

Status find_bodies_near(const World& world, const Shape& asked, const Pose& at, Real distance_max,
                        const QueryFilter& filter, bool all, QueryHits out, QueryReport& report) {
  const FloatEnvironment environment;
  QueryShape shape;
  if (const Status status = make_query_shape(world, asked, shape); status != Status::ok) return status;
  Quat unit;
  if (!is_position(at.position) || !within(distance_max, Real(0.0), Real(16384.0))) return Status::out_of_range;
  if (!normalise_input(at.rotation, unit)) return Status::not_normalised;
  const SweptBox box(at.position, query_half(shape, unit), {0, 0, 0}, raw_length(distance_max));
  const QueryBodies bodies(world, filter);
  HitCollector hits(all, out, k_whole_step, distance_max);
  const auto is_near = [&](const SweptBox::Place& place) {
    return box.is_near(place, raw_length(hits.distance_max()));
  };
  bodies.for_each([&](const Bounds& bounds) { return is_near(box.place_of(bounds)); },
                  [&](const Bounds& a, const Bounds& b) {
                    return distance_max > Real(0.0) && box.gap(box.place_of(b)) < box.gap(box.place_of(a));
                  },
                  [&](uint32_t slot) {
                    if (hits.rules_out(slot)) return;
                    const SweptBox::Place place = box.place_of(bodies.bounds_of(slot));
                    QueryHit hit;
                    if (!is_near(place)) return;
                    const Real gap = real_from_raw(box.gap(place));
                    if (near_at(bodies, slot, shape, at, gap, distance_max, hit)) hits.add(hit);
                  });
  hits.finish(report);
  return Status::ok;
}

}  // namespace

Status query_closest(const World& world, const ClosestQuery& query, QueryHits hits, QueryReport& report) {
  return find_bodies_near(world, query.shape, {query.position, query.rotation}, query.distance_max, query.filter,
                          query.all, hits, report);
}

Status query_overlap(const World& world, const OverlapQuery& query, QueryHits hits, QueryReport& report) {
  return find_bodies_near(world, query.shape, {query.position, query.rotation}, Real(0.0), query.filter, query.all,
                          hits, report);
}

Status query_bounds(const World& world, const BoundsQuery& query, QueryHits out, QueryReport& report) {
  const FloatEnvironment environment;
  const Position &lower = query.lower, &upper = query.upper;
  if (!is_position(lower) || !is_position(upper) || !(lower.x <= upper.x) || !(lower.y <= upper.y) ||
      !(lower.z <= upper.z))
    return Status::out_of_range;
  const Bounds box = {lower, upper};
  const QueryBodies bodies(world, query.filter);
  HitCollector hits(query.all, out, k_whole_step, Real(0.0));
  const auto meets = [&](const Bounds& bounds) { return overlap(bounds, box); };
  bodies.for_each(
      meets, [](const Bounds&, const Bounds&) { return false; },
      [&](uint32_t slot) {
        if (hits.rules_out(slot) || !meets(bodies.bounds_of(slot))) return;
        QueryHit hit;
        hit.body = bodies.id_of(slot);
        hits.add(hit);
      });
  hits.finish(report);
  return Status::ok;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
