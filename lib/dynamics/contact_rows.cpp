#include "dynamics/contact_rows.h"

#include "dynamics/contact_velocity.h"
#include "dynamics/spin.h"
#include "geometry/shape_traits.h"
#include "math/root.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr Vec3<Unit> k_no_vector = {0.0, 0.0, 0.0};

/// The exponent of mantissas up to `value` that leaves room for a dot product; float needs none.
int32_t exponent_for(Real value) { return DETENT_FIXED ? exponent_above(value) + 1 : 0; }

/// A vector of speeds per unit of momentum as a mantissa and an exponent.
void store_response(const Vec3<Real>& response, Vec3<Unit>& mantissa, int32_t& exponent) {
  exponent = exponent_for(max(abs(response.x), max(abs(response.y), abs(response.z))));
  mantissa = {unit_from_real(response.x, exponent), unit_from_real(response.y, exponent),
              unit_from_real(response.z, exponent)};
}

Vec3<Real> real_vector(const Vec3<Unit>& v, int exponent) {
  return {real_from_unit(v.x, exponent), real_from_unit(v.y, exponent), real_from_unit(v.z, exponent)};
}

/// What a unit of `arm` shows of the body's spin, and how much of the pair's inverse effective mass it adds.
/// A kinematic body's momentum is its spin, and a fixed body has none.
Real respond(const RowBody& body, const Vec3<Unit>& arm, int arm_exponent, Vec3<Unit>& response, int32_t& exponent) {
  if (type_of(body.traits) == BodyType::fixed) {
    response = k_no_vector;
    exponent = 0;
    return Real(0.0);
  }
  store_response(spin_of(body.traits, body.pose.rotation, real_vector(arm, arm_exponent)), response, exponent);
  return real_from_unit(dot(arm, response), exponent + arm_exponent);
}

/// `direction` with both arms of the point gives the row.
void make_row(const RowBody& a, const RowBody& b, const ContactWork& work, const Vec3<Unit>& direction,
              const Vec3<Unit>& point_a, const Vec3<Unit>& point_b, ContactRow& row) {
  row.arm_a = cross(point_a, direction);
  row.arm_b = cross(point_b, direction);
  const Real one = 1.0;
  const Real turn_a = respond(a, row.arm_a, 0, row.response_a, row.exponent_a);
  const Real turn_b = respond(b, row.arm_b, 0, row.response_b, row.exponent_b);
  // The lighter body's share is 1, so the sum is at least 1 but for rounding.
  const Real inverse = multiply(one + turn_a, work.share_a) + multiply(one + turn_b, work.share_b);
  row.inverse_mass = unit_from_real(reciprocal(max(inverse, one)), 0);
}

void raise_exponent(int32_t to, Vec3<Unit>& mantissa, int32_t& exponent) {
  const int power = exponent - to;
  if (power == 0) return;
  mantissa = {scale_by_power(mantissa.x, power), scale_by_power(mantissa.y, power), scale_by_power(mantissa.z, power)};
  exponent = to;
}

/// Gives rows of one direction the largest of their exponents; `row(i)` is one of `count`.
template <class RowAt>
void share_exponents(uint32_t count, const RowAt& row) {
  int32_t most_a = row(0).exponent_a, most_b = row(0).exponent_b;
  for (uint32_t i = 1; i < count; ++i) {
    most_a = row(i).exponent_a > most_a ? row(i).exponent_a : most_a;
    most_b = row(i).exponent_b > most_b ? row(i).exponent_b : most_b;
  }
  for (uint32_t i = 0; i < count; ++i) {
    raise_exponent(most_a, row(i).response_a, row(i).exponent_a);
    raise_exponent(most_b, row(i).response_b, row(i).exponent_b);
  }
}

/// What an impulse along the normal at each point does to the normal speed at each.
void couple(ContactWork& work) {
  const uint32_t count = work.state.point_count;
  const Real one = 1.0;
  Real coupling[k_manifold_points_max][k_manifold_points_max];
  Real most = 1.0;
  for (uint32_t i = 0; i < count; ++i) {
    for (uint32_t k = 0; k <= i; ++k) {
      const ContactRow &row = work.point[i].row, &other = work.point[k].row;
      Real sum = 0.0;
      if (is_positive(work.share_a))
        sum += multiply(one + real_from_unit(dot(other.arm_a, row.response_a), row.exponent_a), work.share_a);
      if (is_positive(work.share_b))
        sum += multiply(one + real_from_unit(dot(other.arm_b, row.response_b), row.exponent_b), work.share_b);
      coupling[i][k] = coupling[k][i] = sum;
      most = max(most, abs(sum));
    }
  }
  constexpr int32_t k_most = 29;  // a thin body hit far from its centre; beyond it the sweep converges more slowly
  const int32_t exponent = exponent_for(most);
  work.coupling_exponent = exponent < k_most ? exponent : k_most;
  for (uint32_t i = 0; i < count; ++i) {
    for (uint32_t k = 0; k < count; ++k) work.coupling[i][k] = unit_from_real(coupling[i][k], work.coupling_exponent);
  }
}

void make_angular_row(const RowBody& a, const RowBody& b, const ContactWork& work, const Vec3<Unit>& axis,
                      AngularRow& row) {
  const Real turn_a = respond(a, axis, work.shift_a, row.response_a, row.exponent_a);
  const Real turn_b = respond(b, axis, work.shift_b, row.response_b, row.exponent_b);
  const Scaled inverse = add(multiply(scaled_from(turn_a), work.share_a), multiply(scaled_from(turn_b), work.share_b));
  row.inverse_mass = is_positive(inverse) ? divide(Scaled(1.0), inverse) : Scaled(0.0);
}

void make_tangents(const Vec3<Unit>& normal, Vec3<Unit> tangent[2]) {
  const Vec3<Unit> x = {1.0, 0.0, 0.0}, y = {0.0, 1.0, 0.0};
  Unit size = 0.0;
  tangent[0] = x;
  normalise(cross(normal, abs(normal.x) < Unit(0.5) ? x : y), tangent[0], size);
  tangent[1] = cross(normal, tangent[0]);
}

Scaled pair_restitution(const BodyTraits& a, const BodyTraits& b) {
  constexpr uint32_t k_smaller = static_cast<uint32_t>(RestitutionRule::smaller);
  const bool smaller = a.restitution_rule == k_smaller || b.restitution_rule == k_smaller;
  return less(a.restitution, b.restitution) == smaller ? a.restitution : b.restitution;
}

/// Reference mass over each mass.
void share_mass(const BodyTraits& a, const BodyTraits& b, ContactWork& work) {
  const Scaled none = 0.0, one = 1.0;
  const bool dynamic_a = is_dynamic(a), dynamic_b = is_dynamic(b);
  work.share_a = dynamic_a ? one : none;
  work.share_b = dynamic_b ? one : none;
  work.static_pair = dynamic_a && dynamic_b ? 0 : 1;
  work.moves_a = type_of(a) != BodyType::fixed ? 1 : 0;
  work.moves_b = type_of(b) != BodyType::fixed ? 1 : 0;
  if (!dynamic_a || !dynamic_b) return;
  if (less(a.mass, b.mass))
    work.share_b = divide(a.mass, b.mass);
  else
    work.share_a = divide(b.mass, a.mass);
}

/// The pair's unit of length is that of its smaller moving body.
void share_length(const BodyTraits& a, const BodyTraits& b, ContactWork& work) {
  const bool moves_a = type_of(a) != BodyType::fixed, moves_b = type_of(b) != BodyType::fixed;
  int32_t unit = moves_a ? a.size_exponent : b.size_exponent;
  if (moves_b && b.size_exponent < unit) unit = b.size_exponent;
  work.shift_a = moves_a ? unit - a.size_exponent : 0;
  work.shift_b = moves_b ? unit - b.size_exponent : 0;
}

Real gravity_along(const StepSettings& settings, const BodyTraits& body, const Vec3<Unit>& normal) {
  bool saturated = false;
  return is_dynamic(body) ? multiply(dot(settings.gravity, normal), body.gravity_scale, saturated) : Real(0.0);
}

/// The normal velocity with which a point that approaches at `velocity` closes its gap under the relative acceleration
/// `pull`: sqrt(v^2 + 2 a s). So a bounce neither gains nor loses height.
Real approach_at_touch(Real velocity, Real separation, Real pull) {
  const Real zero = 0.0, fast = 256.0;  // where the fall through a gap is nothing any more, and squares leave the range
  if (!(velocity < zero && velocity > -fast && separation > zero && pull < zero && pull > -fast)) return velocity;
  const Real gain = scale_by_power(pull * min(separation, Real(64.0)), 1);
  return -square_root(velocity * velocity - gain);
}

Vec3<Unit> mean(const ContactGeometry& geometry, Vec3<Unit> ContactGeometryPoint::*arm) {
  static constexpr Unit k_share[k_manifold_points_max] = {1.0, 0.5, 1.0 / 3.0, 0.25};
  const Unit share = k_share[geometry.count - 1];
  Vec3<Unit> sum = k_no_vector;
  for (uint32_t i = 0; i < geometry.count; ++i) sum += geometry.point[i].*arm * share;
  return sum;
}

/// Mean distance of the contact points from their middle, in the body's unit of length.
Unit patch_radius(const ContactGeometry& geometry, Vec3<Unit> ContactGeometryPoint::*arm, const Vec3<Unit>& middle) {
  Unit sum = 0.0;
  for (uint32_t i = 0; i < geometry.count; ++i) sum += scale_by_power(length(geometry.point[i].*arm - middle), -2);
  return sum;
}

}  // namespace

void make_rows(const StepSettings& settings, const RowBody& a, const RowBody& b, const ContactGeometry& geometry,
               ContactWork& work) {
  work.normal = geometry.normal;
  make_tangents(work.normal, work.tangent);
  share_mass(a.traits, b.traits, work);
  share_length(a.traits, b.traits, work);
  const Real pull = gravity_along(settings, b.traits, work.normal) - gravity_along(settings, a.traits, work.normal);
  for (uint32_t i = 0; i < geometry.count; ++i) {
    const ContactGeometryPoint& from = geometry.point[i];
    ContactPoint& point = work.point[i];
    make_row(a, b, work, work.normal, from.arm_a, from.arm_b, point.row);
    point.separation = from.separation;
    point.approach =
        approach_at_touch(row_velocity(point.row, work.normal, a.motion, b.motion), point.separation, pull);
    point.impulse_max = Real(0.0);
  }
  share_exponents(geometry.count, [&](uint32_t i) -> ContactRow& { return work.point[i].row; });
  couple(work);
  const Vec3<Unit> middle_a = work.middle_a = mean(geometry, &ContactGeometryPoint::arm_a);
  const Vec3<Unit> middle_b = work.middle_b = mean(geometry, &ContactGeometryPoint::arm_b);
  for (int i = 0; i < 2; ++i) {
    make_row(a, b, work, work.tangent[i], middle_a, middle_b, work.friction_row[i]);
    work.friction_impulse[i] = dot(work.state.friction_impulse, work.tangent[i]);
  }

  share_exponents(2, [&](uint32_t i) -> ContactRow& { return work.friction_row[i]; });

  work.friction = square_root(multiply(a.traits.friction, b.traits.friction));
  work.restitution = pair_restitution(a.traits, b.traits);
  const Scaled rolling = square_root(multiply(a.traits.rolling_resistance, b.traits.rolling_resistance));
  const Real extent = min(shape_extent(a.traits), shape_extent(b.traits));
  const bool dynamic_a = is_dynamic(a.traits);
  const BodyTraits& some = dynamic_a ? a.traits : b.traits;
  const int32_t unit = some.size_exponent + (dynamic_a ? work.shift_a : work.shift_b);
  const Unit patch = dynamic_a ? patch_radius(geometry, &ContactGeometryPoint::arm_a, middle_a)
                               : patch_radius(geometry, &ContactGeometryPoint::arm_b, middle_b);
  work.rolling_arm = multiply(rolling, scaled_by_power(scaled_from(extent), -1 - unit));
  const Scaled patch_arm = scaled_by_power(scaled_from(patch), dynamic_a ? -work.shift_a : -work.shift_b);
  work.twist_arm = add(multiply(work.friction, patch_arm), work.rolling_arm);
  work.angular_rows = is_positive(work.rolling_arm) ? 3 : is_positive(work.twist_arm) ? 1 : 0;
  const Vec3<Unit>* axes[3] = {&work.normal, &work.tangent[0], &work.tangent[1]};
  for (uint32_t i = 0; i < 3; ++i) {
    work.angular_impulse[i] = Real(0.0);
    if (i >= work.angular_rows) continue;
    make_angular_row(a, b, work, *axes[i], work.angular_row[i]);
    work.angular_impulse[i] = dot(work.state.angular_impulse, *axes[i]);
  }
  // Speeds are measured against that of a fall by the smaller body's diameter.
  const Real fall = fall_speed(settings, extent);
  work.push_max = scale_by_power(fall, -1);
  work.rebound_min = settings.restitution_threshold * fall;
}

void store_impulses(ContactWork& work) {
  work.state.friction_impulse = work.tangent[0] * work.friction_impulse[0] + work.tangent[1] * work.friction_impulse[1];
  work.state.angular_impulse = work.normal * work.angular_impulse[0] + work.tangent[0] * work.angular_impulse[1] +
                               work.tangent[1] * work.angular_impulse[2];
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
