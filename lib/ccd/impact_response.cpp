#include "ccd/impact_response.h"

#include "math/root.h"
#include "motion/angular_velocity.h"
#include "motion/contact_motion.h"
#include "motion/inverse_inertia.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr int k_sweeps_max = 64;
constexpr int k_last_sweeps = 8;  ///< number of sweeps in a round, over the normal rows only
constexpr int k_rounds = 2;

Vec3<Real> scaled(const Vec3<Real>& v, Scaled factor) {
  bool saturated = false;
  return multiply(v, factor, saturated);
}

/// True if one principal moment of inertia is more than 16 times another.
bool is_slender(const BodyProperties& properties) {
  Scaled least = properties.inverse_inertia[0], most = least;
  for (const Scaled& inverse_inertia : properties.inverse_inertia) {
    if (less(inverse_inertia, least)) least = inverse_inertia;
    if (less(most, inverse_inertia)) most = inverse_inertia;
  }
  return less(scaled_by_power(least, 4), most);
}

/// The solver of one impact: the pair's motion and its wrench in the contact's frame, as in contact_motion.h, but in
/// Real.
struct Impact {
  const ContactWork& contact;
  uint32_t count;
  PairResponse response;
  Real motion[k_parts];
  Real wrench[k_parts] = {k_zero, k_zero, k_zero, k_zero, k_zero, k_zero};
  Real target[k_manifold_points_max];  ///< target of the normal velocity after the impact
  Real normal_impulse[k_manifold_points_max];
  Real friction_impulse[2] = {k_zero, k_zero};
  Real largest = k_zero;  ///< largest change of an impulse in a sweep

  Impact(const ContactWork& of_pair, uint32_t points, const ImpactBody& a, const ImpactBody& b)
      : contact(of_pair),
        count(points),
        response(respond_exactly(a.properties, a.rotation, b.properties, b.rotation, of_pair)) {
    update(a, b);
  }

  /// Reads the relative motion of the bodies.
  void update(const ImpactBody& a, const ImpactBody& b) {
    const Vec3<Real> angular_velocity_a = angular_velocity_of(a.properties, a.rotation, a.motion.angular_momentum);
    const Vec3<Real> angular_velocity_b = angular_velocity_of(b.properties, b.rotation, b.motion.angular_momentum);
    const Vec3<Real> velocity =
        (b.motion.linear_velocity - a.motion.linear_velocity) +
        (cross(angular_velocity_b, contact.middle_b) - cross(angular_velocity_a, contact.middle_a));
    const Vec3<Real> turning = angular_velocity_b * contact.unit_b - angular_velocity_a * contact.unit_a;
    for (int i = 0; i < 3; ++i) {
      motion[i] = dot(velocity, axis(i));
      motion[i + 3] = dot(turning, axis(i));
    }
  }

  const Vec3<Unit>& axis(int i) const { return i == 0 ? contact.normal : contact.tangent[i - 1]; }
  Real velocity(uint32_t i) const {
    return motion[k_along_normal] + (motion[k_about_first] * contact.y[i] - motion[k_about_second] * contact.x[i]);
  }
  Real shown(int i, Part k) const { return response.part[response_index(i, k)]; }

  void push(uint32_t i) {
    const Real after = max(normal_impulse[i] + (target[i] - velocity(i)) * contact.normal_mass[i], k_zero);
    const Real change = after - normal_impulse[i];
    if (change == k_zero) return;
    normal_impulse[i] = after;
    largest = max(largest, abs(change));
    wrench[k_along_normal] += change;
    wrench[k_about_first] += change * contact.y[i];
    wrench[k_about_second] -= change * contact.x[i];
    for (int k = 0; k < k_parts; ++k) {
      motion[k] += change * (shown(k, k_along_normal) +
                             (shown(k, k_about_first) * contact.y[i] - shown(k, k_about_second) * contact.x[i]));
    }
  }

  void solve_friction() {
    Real normal = k_zero;
    for (uint32_t i = 0; i < count; ++i) normal += normal_impulse[i];
    bool saturated = false;
    const Real limit = multiply(normal, contact.friction, saturated);
    Real after[2];
    for (int i = 0; i < 2; ++i) after[i] = friction_impulse[i] - motion[k_along_first + i] * contact.friction_mass;
    const Real size = length(Vec3<Real>{after[0], after[1], k_zero});
    const bool slides = size > limit;
    const Real factor = slides ? divide(limit, size) : k_zero;
    for (int i = 0; i < 2; ++i) {
      const Part part = i == 0 ? k_along_first : k_along_second;
      const Real held = slides ? after[i] * factor : after[i];
      const Real change = held - friction_impulse[i];
      friction_impulse[i] = held;
      largest = max(largest, abs(change));
      wrench[part] += change;
      for (int k = 0; k < k_parts; ++k) motion[k] += change * shown(k, part);
    }
  }

  /// Applies the wrench that has accumulated since the last call to the bodies, and clears it.
  void act(const ImpactBody& a, const ImpactBody& b) {
    const auto in_world = [&](int first) {
      return axis(0) * wrench[first] + (axis(1) * wrench[first + 1] + axis(2) * wrench[first + 2]);
    };
    const Vec3<Real> force = in_world(k_along_normal), rotation_vector = in_world(k_about_normal);
    if (is_positive(contact.inverse_mass_a)) {
      a.motion.linear_velocity -= scaled(force, contact.inverse_mass_a);
      a.motion.angular_momentum -=
          scaled(cross(contact.middle_a, force) + rotation_vector * contact.unit_a, contact.inverse_mass_a);
    }
    if (is_positive(contact.inverse_mass_b)) {
      b.motion.linear_velocity += scaled(force, contact.inverse_mass_b);
      b.motion.angular_momentum +=
          scaled(cross(contact.middle_b, force) + rotation_vector * contact.unit_b, contact.inverse_mass_b);
    }
    for (Real& part : wrench) part = k_zero;
  }
};

}  // namespace

uint32_t clamp_rotation(const BodyProperties& properties, Real tick_time, BodySweep& sweep) {
  bool clamped = false;
  const Real limit = angle_of(k_angular_velocity_max * tick_time, properties.size_exponent, clamped);
  const Real fastest = greatest(sweep.rotation_vector);
  if (fastest <= limit) return 0;
  const Real factor = divide(limit, fastest);
  sweep.rotation_vector = {sweep.rotation_vector.x * factor, sweep.rotation_vector.y * factor,
                           sweep.rotation_vector.z * factor};
  return 1;
}

BodyMotion motion_of_sweep(const BodyProperties& properties, const Quat& rotation, const BodySweep& sweep,
                           Scaled tick_rate) {
  // The order of the operations keeps each result in its range.
  const int power = properties.size_exponent;
  const Vec3<Real> angular_velocity = power < 0 ? scaled(scale_by_power(sweep.rotation_vector, power), tick_rate)
                                                : scale_by_power(scaled(sweep.rotation_vector, tick_rate), power);
  return {scaled(sweep.displacement, tick_rate), angular_momentum_of(properties, rotation, angular_velocity),
          k_zero_vector, k_zero_vector};
}

Vec3<Real> carried_angular_momentum(const BodyProperties& properties, const Quat& from, const Quat& to,
                                    const Vec3<Real>& angular_momentum) {
  if (is_isotropic(properties) || from == to) return angular_momentum;
  const Vec3<Real> before = rotate_inverse(from, angular_momentum), after = rotate_inverse(to, angular_momentum);
  const Scaled energy_before = rotational_energy(properties, before),
               energy_after = rotational_energy(properties, after);
  if (!less(add(energy_before, scaled_by_power(energy_before, -16)), energy_after)) return angular_momentum;
  if (is_slender(properties) || less(add(energy_before, scaled_by_power(energy_before, -2)), energy_after))
    return rotate(to, before);
  return scaled(angular_momentum, square_root(divide(energy_before, energy_after)));
}

uint32_t clamp_angular_velocity(const BodyProperties& properties, const Quat& rotation, BodyMotion& motion) {
  if (!is_dynamic(properties)) return 0;
  const Vec3<Real> local = rotate_inverse(rotation, motion.angular_momentum);
  bool saturated = false;
  const auto angular_velocity = [&](Real value, int i) {
    return abs(multiply(value, properties.inverse_inertia[i], saturated));
  };
  const Real fastest =
      max(angular_velocity(local.x, 0), max(angular_velocity(local.y, 1), angular_velocity(local.z, 2)));
  if (fastest <= k_angular_velocity_max) return 0;
  const auto held = [&](Real value, int i) {
    const Real limit = multiply(k_angular_velocity_max, inertia_about(properties, i));
    return clamp(value, -limit, limit);
  };
  motion.angular_momentum = rotate(rotation, Vec3<Real>{held(local.x, 0), held(local.y, 1), held(local.z, 2)});
  return 1;
}

uint32_t add_to_sweep(const BodyProperties& properties, const Quat& rotation, const BodyMotion& before,
                      const BodyMotion& after, Real tick_time, BodySweep& sweep) {
  const Vec3<Real> angular_velocity =
      angular_velocity_of(properties, rotation, after.angular_momentum - before.angular_momentum);
  bool turns_clamped = false;
  const auto angle = [&](Real value) { return angle_of(value * tick_time, properties.size_exponent, turns_clamped); };
  sweep.displacement += (after.linear_velocity - before.linear_velocity) * tick_time;
  sweep.rotation_vector += {angle(angular_velocity.x), angle(angular_velocity.y), angle(angular_velocity.z)};
  // The largest rotation, rad, and displacement, m, of a sweep. time_of_impact() accepts values twice as large.
  constexpr Real k_sweep_rotation_max = 32768.0, k_sweep_displacement_max = 8192.0;
  return clamp_vector(sweep.displacement, k_sweep_displacement_max) +
         clamp_vector(sweep.rotation_vector, k_sweep_rotation_max) + (turns_clamped ? 1 : 0);
}

bool resolve_impact(const ContactWork& contact, uint32_t count, Real least, Real parting, const ImpactBody& a,
                    const ImpactBody& b, Real& approach) {
  Impact impact(contact, count, a, b);
  approach = k_zero;
  for (uint32_t i = 0; i < count; ++i) {
    const Real velocity = impact.velocity(i);
    const bool rebounds = is_positive(contact.restitution) && velocity <= -contact.rebound_min;
    impact.target[i] = rebounds ? max(-multiply(velocity, contact.restitution), parting) : parting;
    impact.normal_impulse[i] = k_zero;
    approach = max(approach, -velocity);
  }
  if (approach <= least) return false;
  const Real enough = scale_by_power(approach, -28);
  for (int sweep = 0; sweep < k_sweeps_max; ++sweep) {
    impact.largest = k_zero;
    for (uint32_t i = 0; i < count; ++i) impact.push(i);
    impact.solve_friction();
    if (impact.largest <= enough) break;
  }
  // The friction row was solved last, so a slow approach may remain along the normals: sweep over the normal rows
  // again. Then apply the impulses to the bodies. A second round corrects the residual that the rounding of the bodies'
  // state leaves.
  for (int round = 0; round < k_rounds; ++round) {
    for (int sweep = 0; sweep < k_last_sweeps; ++sweep) {
      for (uint32_t i = 0; i < count; ++i) impact.push(i);
    }
    impact.act(a, b);
    impact.update(a, b);
  }
  return true;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
