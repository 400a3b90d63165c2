#include "contact/manifold_recycling.h"

#include "contact/contact_arm.h"
#include "math/arithmetic.h"
#include "math/root.h"
#include "shape/shape_properties.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// A contact with at least this many points is recycled until the motion of the pair exceeds the tolerance. A pair can
/// rotate or roll about a contact with fewer points. For such a contact the limit is 2^-k_roll_power of the tolerance.
constexpr uint32_t k_plane_points = 3;
constexpr int k_roll_power = 6;
constexpr int k_anchor_frac = 15;                          ///< fractional bits of ManifoldState::anchor
constexpr Unit k_kept_arm_max = k_arm_max + Unit(0x1p-7);  ///< a clamped arm may exceed k_arm_max by rounding

Unit unit_from_anchor(int16_t raw) {
#if DETENT_FIXED
  return Unit::from_raw(int32_t{raw} * (1 << (k_unit_frac - k_anchor_frac)));
#else
  return scale_by_power(static_cast<Unit>(raw), -k_anchor_frac);  // exact
#endif
}
/// Rounds a coordinate of a contact point, in the body's unit, to the format of ManifoldState::anchor. Range: |value| <
/// 1 - 2^-k_anchor_frac.
int16_t anchor_from_unit(Unit value) {
#if DETENT_FIXED
  return static_cast<int16_t>(round_shift_64(value.raw, k_unit_frac - k_anchor_frac));
#else
  bool saturated = false;
  return static_cast<int16_t>(integer_from_float(value, k_anchor_frac, saturated));
#endif
}

/// Whether |value| < limit. Does not compute |value|, because it overflows for the most negative number.
bool is_within(Unit value, Unit limit) { return -limit < value && value < limit; }
bool is_within(const Vec3<Unit>& v, Unit limit) {
  return is_within(v.x, limit) && is_within(v.y, limit) && is_within(v.z, limit);
}
Real absolute_sum(const Vec3<Unit>& v, int exponent) {
  return real_from_unit(abs(v.x), exponent) + real_from_unit(abs(v.y), exponent) + real_from_unit(abs(v.z), exponent);
}

/// A pair in the frame of ManifoldState. Its unit of length is 4 times that of the base (the larger body). If the other
/// body touches the base, its centre is within 0.6 of the pair's unit from the base's centre.
struct RecyclePair {
  const CollisionBody& base;
  const CollisionBody& other;
  bool base_is_a;
  int exponent;
  Vec3<Real> between = {};  ///< from the base's centre to the other body's, world axes, m
  Vec3<Unit> offset = {};   ///< as `between`, but in the pair's unit of length

  RecyclePair(const CollisionBody& a, const CollisionBody& b, bool a_is_base)
      : base(a_is_base ? a : b),
        other(a_is_base ? b : a),
        base_is_a(a_is_base),
        exponent(base.properties.size_exponent + 2) {}

  /// Sets `between` and `offset`. Returns false if the bodies are too far apart to touch.
  bool place() {
    const Position &from = base.pose.position, &to = other.pose.position;
    between = real_difference(to, from);
    const Real limit = real_from_unit(Unit(0.625), exponent);
    if (greatest(between) > limit) return false;
    offset = unit_from_real(between, exponent);
    return true;
  }
  Vec3<Unit> offset_in_base() const { return multiply_transposed(base.rotation, offset); }
  Quat rotation_in_base() const { return multiply(conjugate(base.pose.rotation), other.pose.rotation); }
  /// Returns the vector from the other body's centre to an anchor (a stored contact point), in the other body's unit,
  /// in world axes.
  Vec3<Unit> arm_at(const int16_t (&anchor)[3]) const {
    return multiply(other.rotation,
                    Vec3<Unit>{unit_from_anchor(anchor[0]), unit_from_anchor(anchor[1]), unit_from_anchor(anchor[2])});
  }
  /// Returns the coordinate along `normal`, from the base's centre, of the other body's point at `arm`, m. It is
  /// computed from the difference of the exact positions (`between`), because rounded positions cause jitter.
  Real place_along(const Vec3<Unit>& normal, const Vec3<Unit>& arm) const {
    return dot(between, normal) + real_from_unit(dot(normal, arm), other.properties.size_exponent);
  }
  /// Returns the vector from the base's centre to the other body's point at `arm`, in the pair's unit, in world axes.
  Vec3<Unit> point_at(const Vec3<Unit>& arm) const {
    return offset + scale_by_power(arm, other.properties.size_exponent - exponent);
  }
};

bool a_is_base(const BodyProperties& a, const BodyProperties& b) {
  return !(bounding_radius_of(a) < bounding_radius_of(b));
}

/// Returns an upper bound, m, of how far any point of the other body has moved relative to the base since `before` was
/// stored.
Real motion_since(const RecyclePair& pair, const ManifoldState& before) {
  const Vec3<Unit> shift = pair.offset_in_base() - before.offset;
  const Quat &p = before.rotation, q = pair.rotation_in_base();
  const bool flipped = dot(Vec3<Unit>{p.x, p.y, p.z}, Vec3<Unit>{q.x, q.y, q.z}) + p.w * q.w < Unit(0.0);
  const auto change = [flipped](Unit from, Unit to) { return real_from_unit(abs(flipped ? to + from : to - from), 0); };
  // Let d = |q - p|. The angle of the rotation from p to q is 4 asin(d / 2). At the small angles that matter, it
  // exceeds 2 d by less than 2^-10 of its value. The sum of the magnitudes of the components of q - p is at least d.
  const Real change_of_rotation = change(p.x, q.x) + change(p.y, q.y) + change(p.z, q.z) + change(p.w, q.w);
  const Real swing = scale_by_power(change_of_rotation * pair.other.properties.bounding_radius,
                                    pair.other.properties.size_exponent + 1);
  return absolute_sum(shift, pair.exponent) + swing + scale_by_power(swing, -10);
}

}  // namespace

bool is_kept(const ManifoldState& manifold) {
  return !(manifold.rotation == Quat{Unit(0.0), Unit(0.0), Unit(0.0), Unit(0.0)});
}

ManifoldState kept_manifold(const CollisionBody& a, const CollisionBody& b, const ContactGeometry& contact) {
  const ManifoldState none = {};
  if (contact.count == 0 || contact.capped || is_half_space(a.properties) || is_half_space(b.properties)) return none;
  RecyclePair pair(a, b, a_is_base(a.properties, b.properties));
  if (!pair.place()) return none;
  const Vec3<Unit> normal = pair.base_is_a ? contact.normal : -contact.normal;
  ManifoldState kept = none;
  for (uint32_t i = 0; i < contact.count; ++i) {
    const ContactGeometryPoint& point = contact.point[i];
    const Vec3<Unit>& arm_base = pair.base_is_a ? point.arm_a : point.arm_b;
    const Vec3<Unit> local = multiply_transposed(pair.other.rotation, pair.base_is_a ? point.arm_b : point.arm_a);
    const Real deepest = real_from_unit(Unit(0.5), pair.exponent);
    if (!is_within(local, Unit(0.99)) || !is_within(arm_base, Unit(1.1)) || abs(point.separation) > deepest)
      return none;
    int16_t(&anchor)[3] = kept.anchor[i];
    anchor[0] = anchor_from_unit(local.x);
    anchor[1] = anchor_from_unit(local.y);
    anchor[2] = anchor_from_unit(local.z);
    // The height is computed from the rounded anchor, so that the rounding does not change the separation.
    const Real place = pair.place_along(normal, pair.arm_at(anchor));
    kept.height[i] = unit_from_real(point.separation - place, pair.exponent);
  }
  kept.normal = multiply_transposed(pair.base.rotation, normal);
  kept.offset = pair.offset_in_base();
  kept.rotation = pair.rotation_in_base();
  return kept;
}

bool recycle_manifold(const CollisionBody& a, const CollisionBody& b, const ManifoldState& before,
                      const uint32_t (&feature)[k_manifold_points_max], uint32_t count, Real tolerance, Real margin,
                      ContactGeometry& contact, ManifoldState& after) {
  contact.count = 0;
  if (!is_kept(before)) return false;
  RecyclePair pair(a, b, a_is_base(a.properties, b.properties));
  const bool plane = count >= k_plane_points;
  if (!pair.place() || motion_since(pair, before) > (plane ? tolerance : scale_by_power(tolerance, -k_roll_power)))
    return false;
  const Vec3<Unit> normal = multiply(pair.base.rotation, before.normal);
  contact.capped = false;
  contact.normal = pair.base_is_a ? normal : -normal;
  after = {before.normal, before.offset, before.rotation, {}, {}};
  for (uint32_t i = 0; i < count; ++i) {
    const Vec3<Unit> arm_other = pair.arm_at(before.anchor[i]);
    const Vec3<Unit> place = pair.point_at(arm_other);
    const Real separation = real_from_unit(before.height[i], pair.exponent) + pair.place_along(normal, arm_other);
    if (separation > margin) continue;
    const Vec3<Unit> arm_base = scale_by_power(place, pair.exponent - pair.base.properties.size_exponent);
    after.height[contact.count] = before.height[i];
    for (int k = 0; k < 3; ++k) after.anchor[contact.count][k] = before.anchor[i][k];
    contact.point[contact.count++] = {pair.base_is_a ? arm_base : arm_other, pair.base_is_a ? arm_other : arm_base,
                                      separation, feature[i]};
  }
  return plane ? contact.count >= k_plane_points : contact.count == count;
}

bool is_manifold(const BodyProperties& a, const BodyProperties& b, uint32_t count, const ManifoldState& manifold) {
  const auto is_zero = [](const Vec3<Unit>& v) { return v == Vec3<Unit>{Unit(0.0), Unit(0.0), Unit(0.0)}; };
  const bool none = !is_kept(manifold);
  for (uint32_t i = none ? 0 : count; i < k_manifold_points_max; ++i) {
    const int16_t(&anchor)[3] = manifold.anchor[i];
    if (!(manifold.height[i] == Unit(0.0)) || anchor[0] != 0 || anchor[1] != 0 || anchor[2] != 0) return false;
  }
  if (none) return is_zero(manifold.normal) && is_zero(manifold.offset);
  Quat ignored;
  if (is_half_space(a) || is_half_space(b) || !normalise_input(manifold.rotation, ignored)) return false;
  if (!is_within(manifold.normal, Unit(1.01)) || !(abs(length(manifold.normal) - Unit(1.0)) < Unit(0x1p-10)) ||
      !is_within(manifold.offset, Unit(0.625)) || !(length(manifold.offset) < Unit(0.66)))
    return false;
  const BodyProperties &base = a_is_base(a, b) ? a : b, &other = a_is_base(a, b) ? b : a;
  const int power = other.size_exponent - base.size_exponent - 2;
  for (uint32_t i = 0; i < count; ++i) {
    const int16_t(&anchor)[3] = manifold.anchor[i];
    const Vec3<Unit> arm = {unit_from_anchor(anchor[0]), unit_from_anchor(anchor[1]), unit_from_anchor(anchor[2])};
    if (!is_within(arm, Unit(0.991)) || !(length(arm) < k_kept_arm_max)) return false;
    if (!is_within(manifold.height[i], Unit(1.0))) return false;
    const Vec3<Unit> place = manifold.offset + scale_by_power(rotate(manifold.rotation, arm), power);
    if (!(length(place) < scale_by_power(k_kept_arm_max, -2))) return false;
    if (!is_within(manifold.height[i] + dot(manifold.normal, place), Unit(0.52))) return false;
  }
  return true;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
