#include "ccd/impact_pair.h"

#include "ccd/compound_impact.h"
#include "ccd/terrain_impact.h"
#include "contact/body_convex.h"
#include "distance/pair.h"
#include "math/root.h"
#include "motion/angular_velocity.h"
#include "shape/shape_properties.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

ShapeType shape_type(const BodyProperties& properties) { return static_cast<ShapeType>(properties.shape); }

/// Converts `depth` from units of 2^-46 m to units of 2^(exponent - 30) m, rounded up. Returns INT32_MAX if the result
/// is larger.
int32_t depth_in_units(int64_t depth, int exponent) {
  if (depth >> (k_metre_bits + exponent) != 0) return INT32_MAX;
  return static_cast<int32_t>(shift_64(depth, 30 - k_metre_bits - exponent)) + 1;
}

int32_t less_depth(int32_t size, int32_t depth, int32_t least) { return size - least > depth ? size - depth : least; }

/// Makes the shape smaller by `depth`, 2^-46 m, on all sides. A cone or hull cannot be made smaller in this way. The
/// smaller one of a cone's radius and half length becomes smaller by `depth`, down to a quarter of its value; the other
/// changes in proportion. A hull is halved in size `halvings` times.
void shrink(int64_t depth, int halvings, Convex& convex) {
  const ShapeType type = convex.type;
  if (type == ShapeType::hull) {
    convex.exponent -= halvings;
    return;
  }
  const bool has_sizes = type == ShapeType::box || type == ShapeType::cylinder || type == ShapeType::cone;
  const int32_t by = depth_in_units(depth, has_sizes ? convex.exponent : convex.radius_exponent);
  if (!has_sizes) {
    convex.radius = less_depth(convex.radius, by, 0);
    return;
  }
  const int32_t thinner = min(convex.size[0], convex.size[1]), left = less_depth(thinner, by, thinner >> 2);
  for (int i = 0; i < (type == ShapeType::box ? 3 : 2); ++i) {
    int32_t& size = convex.size[i];
    size = type == ShapeType::cone ? static_cast<int32_t>(int64_t{size} * left / thinner) : less_depth(size, by, 1);
  }
}

/// The distance, m, from the centre by which a rotation angle is multiplied to bound the motion of the surface. It is 0
/// for a sphere and the half length for a capsule, because a rotation about its own centre does not change a ball.
Real swing_radius(const BodyProperties& properties) {
  switch (shape_type(properties)) {
    case ShapeType::sphere:
      return Real(0.0);
    case ShapeType::capsule:
      return real_from_unit(properties.size.y, properties.size_exponent);
    default:
      return real_from_unit(properties.bounding_radius, properties.size_exponent);
  }
}

}  // namespace

Real swing_bound(const BodyProperties& properties, const Vec3<Real>& rotation_vector) {
  const Real zero = 0.0, angle = length(rotation_vector);
  if (angle == zero) return zero;
  if (is_half_space(properties)) return scale_by_power(k_real_max, -2);
  // A rotation moves a point by at most the diameter, so larger angles count as 4 rad. The limit also keeps the product
  // in range.
  return swing_radius(properties) * min(angle, Real(4.0));
}

Real next_shrink_depth(Real extent, Real shrink_depth) {
  if (shrink_depth == Real(0.0)) return scale_by_power(extent, -10);
  if (shrink_depth < scale_by_power(extent, -5)) return scale_by_power(shrink_depth, 1);
  return shrink_depth + scale_by_power(extent, -5);
}

Real contact_shrink_depth(Real extent, Real depth) {
  return max(scale_by_power(extent, -3), scale_by_power(depth + scale_by_power(extent, -5), -1));
}

Real last_shrink_depth(Real extent) { return scale_by_power(extent, -1); }

Sweep rest_of(const BodySweep& sweep, Fraction time) {
  const Sweep whole = {sweep.displacement, sweep.rotation_vector};
  return time.raw == 0 ? whole : sweep_part(whole, k_whole_step - time);
}

BodyPose pose_at(const SweptBody& body, Fraction time) {
  BodyPose pose = body.pose;
  if (time > body.sweep.from) {
    advance_along({body.sweep.displacement, body.sweep.rotation_vector}, time - body.sweep.from, pose);
  }
  return pose;
}

bool is_parting(const SweptBody& a, const SweptBody& b, Fraction time, const TimeOfImpact& impact) {
  const Vec3<Real> offset = offset_of(pose_at(a, time), pose_at(b, time));
  const Vec3<Real> relative = b.sweep.displacement - a.sweep.displacement;
  const Vec3<Real> arm_b = impact.point - offset;
  const Real swing_a = dot(cross(impact.point, impact.normal), a.sweep.rotation_vector);
  const Real swing_b = dot(cross(arm_b, impact.normal), b.sweep.rotation_vector);
  // In a tick, an approach this slow closes less than the step to the next shrink depth.
  const Real slow = scale_by_power(min(shape_extent(a.properties), shape_extent(b.properties)), -12);
  return dot(relative, impact.normal) + (swing_b - swing_a) >= -slow;
}

Motion motion_from(const SweptBody& body, Fraction time) {
  const BodyPose from = pose_at(body, time);
  const Sweep rest = rest_of(body.sweep, time);
  return {{from.position, from.rotation}, rest.displacement, rest.rotation_vector};
}

Real motion_bound(const SweptBody& body, Fraction time) {
  const Sweep rest = rest_of(body.sweep, time);
  return length(rest.displacement) + swing_bound(body.properties, rest.rotation_vector);
}

bool shrink_convex(const AssetTable& assets, const BodyProperties& properties, Real shrink_depth, Convex& convex) {
  Convex made;
  if (!body_convex(properties, assets, made) ||
      !shrink_convex(shrink_depth, shrink_halvings(shrink_depth, shape_extent(properties)), made))
    return false;
  convex = made;
  return true;
}

bool shrink_convex(Real shrink_depth, int halvings, Convex& convex) {
  const Real zero = 0.0;
  Vec64 raw;
  if (!(shrink_depth > zero)) return true;
  if (!raw_from_real({shrink_depth, zero, zero}, raw)) return false;
  shrink(raw.x, halvings, convex);
  return true;
}

int shrink_halvings(Real shrink_depth, Real extent) {
  // One halving beyond 1/16 of the extent, two beyond 1/4.
  return (shrink_depth > scale_by_power(extent, -4) ? 1 : 0) + (shrink_depth > scale_by_power(extent, -2) ? 1 : 0);
}

bool climb_with(const SweptBody& a, const SweptBody& b, Fraction time, const ShrunkenCores& cores,
                const FindAtDepth& find, Meeting& meeting) {
  TimeOfImpact found;
  bool looked_ahead = false;
  for (Real shrink_depth = cores.first; !(shrink_depth > last_shrink_depth(cores.extent));
       shrink_depth = next_shrink_depth(cores.extent, shrink_depth)) {
    ++meeting.tests;
    if (shrink_depth > cores.first && shrink_depth > meeting.depth) meeting.depth = shrink_depth;
    if (!find.find(find.context, shrink_depth, found)) return false;
    // Cores that overlap have no normal.
    const bool now =
        found.outcome != ToiOutcome::clear && !(time + fraction_product(k_whole_step - time, found.time) > time);
    const auto closes = [&] {
      return !cores.resolved &&
             (found.outcome == ToiOutcome::undecided || (is_direction(found.normal) && !is_parting(a, b, time, found)));
    };
    if (now && cores.climbs && !closes()) {
      // Cores that overlap at the last shrink depth also overlap at all smaller depths. The last depth is therefore
      // tested once, before the depths in between.
      if (looked_ahead || is_direction(found.normal)) continue;
      looked_ahead = true;
      ++meeting.tests;
      if (!find.find(find.context, last_shrink_depth(cores.extent), found)) return false;
      if (found.outcome == ToiOutcome::clear || is_direction(found.normal)) continue;
      break;
    }
    meeting.take(found);
    return true;
  }
  meeting.left = true;
  meeting.depth = last_shrink_depth(cores.extent);
  if (cores.resolved && !(is_direction(found.normal) && is_parting(a, b, time, found))) meeting.stuck = true;
  return true;
}

bool PairSearch::find_convex(Real shrink_depth, const Vec3<Unit>& axis, TimeOfImpact& impact) {
  return shrink_convex(assets_, a_.properties, shrink_depth, convex_a_) &&
         shrink_convex(assets_, b_.properties, shrink_depth, convex_b_) &&
         shapes_.find(convex_a_, convex_b_, axis, k_whole_step, impact);
}

bool PairSearch::find(const ShrunkenCores& cores, Vec3<Unit> axis, Meeting& meeting) {
  bool known;
  if (is_compound(a_.properties) || is_compound(b_.properties)) {
    known = features_.compound_impact->find(assets_, features_, a_, b_, time_, cores, meeting);
  } else if (is_terrain(a_.properties) || is_terrain(b_.properties)) {
    const BodyProperties& body = (is_terrain(a_.properties) ? b_ : a_).properties;
    const auto at_depth = [&](Real shrink_depth, TimeOfImpact& impact) {
      Convex convex;
      return shrink_convex(assets_, body, shrink_depth, convex) &&
             features_.terrain_impact->impact(assets_, *features_.terrain, a_, b_, convex, time_, impact);
    };
    known = climb(a_, b_, time_, cores, at_depth, meeting);
  } else {
    const auto at_depth = [&](Real shrink_depth, TimeOfImpact& impact) {
      if (is_direction(impact.normal)) axis = impact.normal;
      return find_convex(shrink_depth, axis, impact);
    };
    known = climb(a_, b_, time_, cores, at_depth, meeting);
  }
  meeting.impact.time = time_ + fraction_product(k_whole_step - time_, meeting.impact.time);
  return known;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
