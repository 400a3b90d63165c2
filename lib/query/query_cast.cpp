#include <detent/toi.h>

#include "base/float_environment.h"
#include "contact/compound_ops.h"
#include "distance/pair.h"
#include "math/root.h"
#include "query/query_hits.h"
#include "query/query_terrain.h"
#include "shape/shape_properties.h"
#include "shape/sweep.h"
#include "state/ranges.h"
#include "world/query_bodies.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// Whether time_of_impact() accepts the motion.
bool is_motion(const Motion& motion) {
  const auto below = [](Real value) { return value > Real(-16384.0) && value < Real(16384.0); };
  const Vec3<Real>& displacement = motion.displacement;
  return is_position(motion.start.position) && below(displacement.x) && below(displacement.y) &&
         below(displacement.z) && within(motion.rotation_vector, Real(65536.0)) &&
         length(motion.rotation_vector) <= Real(65536.0);
}

/// Half extents of the shape's bounds during the motion, in units of 2^-46 m: those of its bounding sphere if it
/// rotates.
Vec64 half_of(const QueryShape& shape, const Motion& motion, const Quat& rotation) {
  if (motion.rotation_vector == k_zero_vector) return query_half(shape, rotation);
  const Real ball = real_from_unit(shape.properties.bounding_radius, shape.properties.size_exponent);
  Vec64 raw;
  if (!raw_from_real({ball, ball, ball}, raw)) return {0, 0, 0};  // does not occur: the value is finite
  return raw;
}

/// As cast_at(), for a terrain.
bool cast_at_terrain(const QueryBodies& bodies, uint32_t slot, const QueryShape& shape, const Motion& motion,
                     Fraction entry, QueryHit& hit) {
  const BodyProperties& properties = bodies.state.properties[slot];
  bool touched = false;
  const bool asked = has_terrain_bytes(bodies.world, properties) &&
                     cast_on_terrain(asked_terrain(bodies.world, properties, bodies.state.poses[slot]), shape, motion,
                                     hit, touched) == Status::ok;
  hit.body = bodies.id_of(slot);
  hit.undecided = hit.undecided || !asked;
  if (hit.undecided && hit.fraction < entry) hit.fraction = entry;
  return !asked || touched;
}

/// Sets `first` to the earliest hit on a part of the body, or to an undecided result if that is earlier. If there is
/// neither, sets first.outcome to `clear`. Returns false if a part could not be tested.
bool first_impact(const QueryBodies& bodies, const BodyProperties& properties, const Motion& still,
                  const QueryShape& shape, const Motion& motion, TimeOfImpact& first) {
  first.outcome = ToiOutcome::clear;
  const ConvexParts parts(properties, bodies.world.hooks.assets);
  for (uint32_t i = 0; i < parts.count(); ++i) {
    Convex convex;
    TimeOfImpact impact;
    if (!parts.convex(i, false, convex) || time_of_impact(convex, still, shape.convex, motion, impact) != Status::ok)
      return false;
    if (impact.outcome == ToiOutcome::clear) continue;
    const bool sooner = first.outcome == ToiOutcome::clear || impact.time < first.time;
    if (sooner || (impact.time == first.time && first.outcome == ToiOutcome::undecided)) first = impact;
  }
  return parts.count() != 0;
}

/// Finds the hit on a body. `hit` must be newly made. `entry`: a fraction of the motion before which the shape
/// certainly does not hit the body; it is the least fraction of an undecided hit. Returns false if there is no hit.
bool cast_at(const QueryBodies& bodies, uint32_t slot, const QueryShape& shape, const Motion& motion, Fraction entry,
             QueryHit& hit) {
  const BodyProperties& properties = bodies.state.properties[slot];
  if (is_terrain(properties)) return cast_at_terrain(bodies, slot, shape, motion, entry, hit);
  const Pose pose = pose_near(properties, bodies.state.poses[slot], motion.start.position);
  TimeOfImpact impact;
  hit.body = bodies.id_of(slot);
  const bool asked = first_impact(bodies, properties, {pose, k_zero_vector, k_zero_vector}, shape, motion, impact);
  if (!asked || impact.outcome == ToiOutcome::undecided) {
    hit.undecided = true;
    hit.fraction = asked && impact.time > entry ? impact.time : entry;
    return true;
  }
  if (impact.outcome == ToiOutcome::clear) return false;
  hit.fraction = impact.time;
  hit.point = moved(pose.position, impact.point);
  hit.normal = impact.normal;
  return true;
}

Status cast(const World& world, const QueryShape& shape, const Motion& motion, const QueryFilter& filter, bool all,
            QueryHits out, QueryReport& report) {
  Quat unit;
  if (!is_motion(motion)) return Status::out_of_range;
  if (!normalise_input(motion.start.rotation, unit)) return Status::not_normalised;
  Vec64 displacement;
  if (!raw_from_real(motion.displacement, displacement)) return Status::out_of_range;
  SweptBox box(motion.start.position, half_of(shape, motion, unit), displacement, 0);
  const QueryBodies bodies(world, filter);
  HitCollector hits(all, out, k_whole_step, Real(0.0));
  bodies.for_each([&](const Bounds& bounds) { return box.meets(box.place_of(bounds)); },
                  [&](const Bounds& a, const Bounds& b) { return box.is_ahead(a, b); },
                  [&](uint32_t slot) {
                    if (hits.rules_out(slot)) return;
                    const SweptBox::Place place = box.place_of(bodies.bounds_of(slot));
                    QueryHit hit;
                    if (!box.meets(place) || !cast_at(bodies, slot, shape, motion, box.entry(place), hit)) return;
                    hits.add(hit);
                    box.shorten(hits.end());
                  });
  hits.finish(report);
  return Status::ok;
}

}  // namespace

Status query_ray(const World& world, const RayQuery& query, QueryHits hits, QueryReport& report) {
  const FloatEnvironment environment;
  const Motion motion = {{query.origin, k_identity}, query.displacement, k_zero_vector};
  return cast(world, query_point(), motion, query.filter, query.all, hits, report);
}

Status query_cast(const World& world, const CastQuery& query, QueryHits hits, QueryReport& report) {
  const FloatEnvironment environment;
  QueryShape shape;
  if (const Status status = make_query_shape(world, query.shape, shape); status != Status::ok) return status;
  const Motion motion = {{query.position, query.rotation}, query.displacement, query.rotation_vector};
  return cast(world, shape, motion, query.filter, query.all, hits, report);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
