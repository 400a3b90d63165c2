#include "ccd/impact_pair.h"

#include "ccd/compound_impact.h"
#include "ccd/surface_impact.h"
#include "contact/body_convex.h"
#include "distance/pair.h"
#include "math/root.h"
#include "motion/spin.h"
#include "shape/shape_traits.h"
#include "toi/conservative_advancement.h"
#include "toi/known_axis.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

ShapeType shape_type(const BodyTraits& traits) { return static_cast<ShapeType>(traits.shape); }

/// Converts `depth`, 2^-46 m, to units of 2^(exponent - 30) m, rounded up. Returns INT32_MAX if the result is larger.
int32_t depth_in_units(int64_t depth, int exponent) {
  if (depth >> (k_metre_bits + exponent) != 0) return INT32_MAX;
  return static_cast<int32_t>(shift_64(depth, 30 - k_metre_bits - exponent)) + 1;
}

int32_t less_depth(int32_t size, int32_t depth, int32_t least) { return size - least > depth ? size - depth : least; }

/// Makes the shape smaller by `depth`, 2^-46 m, on all sides. A hull or cone has no such core of its own kind; it is
/// halved in size `halvings` times instead.
void shrink(int64_t depth, int halvings, Convex& convex) {
  switch (convex.type) {
    case ShapeType::sphere:
    case ShapeType::capsule:
    case ShapeType::triangle:
      convex.radius = less_depth(convex.radius, depth_in_units(depth, convex.radius_exponent), 0);
      break;
    case ShapeType::box:
      for (int32_t& size : convex.size) size = less_depth(size, depth_in_units(depth, convex.exponent), 1);
      break;
    case ShapeType::cylinder:
      for (int i = 0; i < 2; ++i) {
        convex.size[i] = less_depth(convex.size[i], depth_in_units(depth, convex.exponent), 1);
      }
      break;
    case ShapeType::cone:
    case ShapeType::hull:
      convex.exponent -= halvings;
      break;
    default:
      break;
  }
}

/// The largest distance, m, from the centre to a part of the surface that a rotation moves. It is 0 for a sphere, which
/// looks the same after a rotation.
Real swing_radius(const BodyTraits& traits) {
  switch (shape_type(traits)) {
    case ShapeType::sphere:
      return Real(0.0);
    case ShapeType::capsule:
      return real_from_unit(traits.size.y, traits.size_exponent);
    default:
      return real_from_unit(traits.bounding_radius, traits.size_exponent);
  }
}

Real swing(const BodyTraits& traits, const Vec3<Real>& turn, bool& bounded) {
  const Real zero = 0.0, angle = length(turn);
  if (angle == zero) return zero;
  if (is_half_space(traits)) bounded = false;
  // Half a revolution moves a point by at most the diameter. The limit also keeps the product in range.
  return swing_radius(traits) * min(angle, Real(4.0));
}

}  // namespace

Real next_inset(Real extent, Real inset) {
  if (inset == Real(0.0)) return scale_by_power(extent, -10);
  if (inset < scale_by_power(extent, -4)) return scale_by_power(inset, 2);
  return inset + scale_by_power(extent, -5);
}

Real contact_inset(Real extent, Real depth) {
  return max(scale_by_power(extent, -3), scale_by_power(depth + scale_by_power(extent, -5), -1));
}

Real last_inset(Real extent) { return scale_by_power(extent, -1); }

Sweep rest_of(const BodySweep& sweep, Fraction time) {
  const Sweep whole = {sweep.displacement, sweep.turn};
  return time.raw == 0 ? whole : sweep_part(whole, k_whole_step - time);
}

BodyPose pose_at(const SweptBody& body, Fraction time) {
  BodyPose pose = body.pose;
  if (time > body.sweep.from) {
    advance_along({body.sweep.displacement, body.sweep.turn}, time - body.sweep.from, pose);
  }
  return pose;
}

bool is_parting(const SweptBody& a, const SweptBody& b, Fraction time, const TimeOfImpact& impact) {
  const Vec3<Real> offset = offset_of(pose_at(a, time), pose_at(b, time));
  const Vec3<Real> way = b.sweep.displacement - a.sweep.displacement;
  const Vec3<Real> arm_b = impact.point - offset;
  const Real swing_a = dot(cross(impact.point, impact.normal), a.sweep.turn);
  const Real swing_b = dot(cross(arm_b, impact.normal), b.sweep.turn);
  // A slower approach does not pass through the next shrink depth in this tick.
  const Real slow = scale_by_power(min(shape_extent(a.traits), shape_extent(b.traits)), -12);
  return dot(way, impact.normal) + (swing_b - swing_a) >= -slow;
}

Motion motion_from(const SweptBody& body, Fraction time) {
  const BodyPose from = pose_at(body, time);
  const Sweep rest = rest_of(body.sweep, time);
  return {{from.position, from.rotation}, rest.displacement, rest.turn};
}

bool motion_bound(const SweptBody& body, Fraction time, Real& bound) {
  const Sweep rest = rest_of(body.sweep, time);
  bool bounded = true;
  bound = length(rest.displacement) + swing(body.traits, rest.turn, bounded);
  return bounded;
}

bool closing_bound(const SweptBody& a, const SweptBody& b, Fraction time, Real& bound) {
  const Sweep rest_a = rest_of(a.sweep, time), rest_b = rest_of(b.sweep, time);
  bool bounded = true;
  bound = length(rest_b.displacement - rest_a.displacement) + swing(a.traits, rest_a.turn, bounded) +
          swing(b.traits, rest_b.turn, bounded);
  return bounded;
}

bool inset_convex(const AssetTable& assets, const BodyTraits& traits, Real inset, Convex& convex) {
  Convex made;
  if (!body_convex(traits, assets, made) || !inset_convex(inset, inset_halvings(inset, shape_extent(traits)), made))
    return false;
  convex = made;
  return true;
}

bool inset_convex(Real inset, int halvings, Convex& convex) {
  const Real zero = 0.0;
  Vec64 raw;
  if (!(inset > zero)) return true;
  if (!raw_from_real({inset, zero, zero}, raw)) return false;
  shrink(raw.x, halvings, convex);
  return true;
}

int inset_halvings(Real inset, Real extent) {
  // One halving at the depths of contacts, two at the deepest ones.
  return (inset > scale_by_power(extent, -4) ? 1 : 0) + (inset > scale_by_power(extent, -2) ? 1 : 0);
}

bool PairSearch::prepare_pair() {
  const Motion motion_a = motion_from(a_, time_), motion_b = motion_from(b_, time_);
  if (is_half_space(a_.traits) || is_half_space(b_.traits)) {
    prepared_ = prepare(convex_a_, motion_a, convex_b_, motion_b, pair_) == Status::ok;
    return prepared_;
  }
  pair_.a = &convex_a_;
  pair_.b = &convex_b_;
  if (set_ways(motion_a, motion_b, pair_) != Status::ok) return false;
  if (pair_.from > pair_.to) return true;  // the bounding spheres never touch: skip the rotation setup
  pair_.absolute = moves_both(k_toi_method, pair_);
  prepared_ = set_turnings(motion_a, motion_b, pair_) == Status::ok;
  return prepared_;
}

bool PairSearch::find_convex(Real inset, const Vec3<Unit>& axis, TimeOfImpact& impact) {
  if (!inset_convex(assets_, a_.traits, inset, convex_a_) || !inset_convex(assets_, b_.traits, inset, convex_b_))
    return false;
  if (!(prepared_ ? set_block(pair_.offset_whole, pair_.displacement_whole, pair_) == Status::ok : prepare_pair()))
    return false;
  Vec32 normal;
  const bool known = raw_from_direction(axis, normal);
  if (known && stays_clear(pair_, normal)) {
    impact.outcome = ToiOutcome::clear;
    impact.time = k_whole_step;
  } else {
    conservative_advancement(pair_, k_toi_method, impact, known ? INT32_MAX : enough_apart(pair_));
  }
  return true;
}

bool PairSearch::find(const Ladder& ladder, Vec3<Unit> axis, Meeting& meeting) {
  bool known;
  if (is_compound(a_.traits) || is_compound(b_.traits)) {
    known = features_.compound_impact->find(assets_, features_, a_, b_, time_, ladder, meeting);
  } else if (is_surface(a_.traits) || is_surface(b_.traits)) {
    const BodyTraits& body = (is_surface(a_.traits) ? b_ : a_).traits;
    const auto on_rung = [&](Real inset, TimeOfImpact& impact) {
      Convex convex;
      return inset_convex(assets_, body, inset, convex) &&
             features_.surface_impact->impact(assets_, *features_.surface, a_, b_, convex, time_, impact);
    };
    known = climb(a_, b_, time_, ladder, on_rung, meeting);
  } else {
    const auto on_rung = [&](Real inset, TimeOfImpact& impact) {
      if (is_direction(impact.normal)) axis = impact.normal;
      return find_convex(inset, axis, impact);
    };
    known = climb(a_, b_, time_, ladder, on_rung, meeting);
  }
  meeting.impact.time = time_ + fraction_product(k_whole_step - time_, meeting.impact.time);
  return known;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
