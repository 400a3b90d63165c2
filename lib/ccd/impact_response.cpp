#include "ccd/impact_response.h"

#include "math/root.h"
#include "motion/contact_motion.h"
#include "motion/gyration.h"
#include "motion/spin.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr int k_sweeps_max = 64;
constexpr int k_last_sweeps = 8;  ///< over the normal rows only, without friction
constexpr int k_rounds = 2;

Vec3<Real> scaled(const Vec3<Real>& v, Scaled factor) {
  bool saturated = false;
  return {multiply(v.x, factor, saturated), multiply(v.y, factor, saturated), multiply(v.z, factor, saturated)};
}

/// Twice the kinetic energy of rotation per unit mass: L . (I^-1 L) over the mass, from the angular momentum L in the
/// body's axes.
Scaled energy_of(const BodyTraits& traits, const Vec3<Real>& local) {
  const auto term = [&](Real value, int i) {
    const Scaled factor = scaled_from(value);
    return multiply(multiply(factor, factor), traits.gyration[i]);
  };
  return add(term(local.x, 0), add(term(local.y, 1), term(local.z, 2)));
}

/// True if one principal moment of inertia is more than 16 times another.
bool is_slender(const BodyTraits& traits) {
  Scaled least = traits.gyration[0], most = least;
  for (const Scaled& gyration : traits.gyration) {
    if (less(gyration, least)) least = gyration;
    if (less(most, gyration)) most = gyration;
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
  Real wanted[k_manifold_points_max];  ///< target of the normal velocity after the impact
  Real normal_impulse[k_manifold_points_max];
  Real friction_impulse[2] = {k_zero, k_zero};
  Real largest = k_zero;  ///< largest change of an impulse in a sweep

  Impact(const ContactWork& of_pair, uint32_t points, const ImpactBody& a, const ImpactBody& b)
      : contact(of_pair),
        count(points),
        response(respond_exactly(a.traits, a.rotation, b.traits, b.rotation, of_pair)) {
    look(a, b);
  }

  /// Reads the relative motion of the bodies.
  void look(const ImpactBody& a, const ImpactBody& b) {
    const Vec3<Real> spin_a = spin_of(a.traits, a.rotation, a.motion.momentum);
    const Vec3<Real> spin_b = spin_of(b.traits, b.rotation, b.motion.momentum);
    const Vec3<Real> velocity =
        (b.motion.velocity - a.motion.velocity) + (cross(spin_b, contact.middle_b) - cross(spin_a, contact.middle_a));
    const Vec3<Real> turning = spin_b * contact.unit_b - spin_a * contact.unit_a;
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
    const Real after = max(normal_impulse[i] + (wanted[i] - velocity(i)) * contact.inverse_mass[i], k_zero);
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
    for (int i = 0; i < 2; ++i) after[i] = friction_impulse[i] - motion[k_along_first + i] * contact.friction_mass[i];
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
    const Vec3<Real> force = in_world(k_along_normal), turn = in_world(k_about_normal);
    if (is_positive(contact.share_a)) {
      a.motion.velocity -= scaled(force, contact.share_a);
      a.motion.momentum -= scaled(cross(contact.middle_a, force) + turn * contact.unit_a, contact.share_a);
    }
    if (is_positive(contact.share_b)) {
      b.motion.velocity += scaled(force, contact.share_b);
      b.motion.momentum += scaled(cross(contact.middle_b, force) + turn * contact.unit_b, contact.share_b);
    }
    for (Real& part : wrench) part = k_zero;
  }
};

}  // namespace

uint32_t hold_turn(const BodyTraits& traits, Real tick_time, BodySweep& sweep) {
  bool clamped = false;
  const Real limit = angle_of(k_spin_max * tick_time, traits.size_exponent, clamped);
  const Real fastest = max(abs(sweep.turn.x), max(abs(sweep.turn.y), abs(sweep.turn.z)));
  if (fastest <= limit) return 0;
  const Real factor = divide(limit, fastest);
  sweep.turn = {sweep.turn.x * factor, sweep.turn.y * factor, sweep.turn.z * factor};
  return 1;
}

BodyMotion motion_of_sweep(const BodyTraits& traits, const Quat& rotation, const BodySweep& sweep, Scaled tick_rate) {
  // In the order that keeps each result in its range.
  const int power = traits.size_exponent;
  const Vec3<Real> spin = power < 0 ? scaled(scale_by_power(sweep.turn, power), tick_rate)
                                    : scale_by_power(scaled(sweep.turn, tick_rate), power);
  return {scaled(sweep.displacement, tick_rate), momentum_of(traits, rotation, spin), k_zero_vector, k_zero_vector};
}

Vec3<Real> carried_momentum(const BodyTraits& traits, const Quat& from, const Quat& to, const Vec3<Real>& momentum) {
  if (is_isotropic(traits) || from == to) return momentum;
  const Vec3<Real> before = rotate_inverse(from, momentum), after = rotate_inverse(to, momentum);
  const Scaled energy_before = energy_of(traits, before), energy_after = energy_of(traits, after);
  if (!less(add(energy_before, scaled_by_power(energy_before, -16)), energy_after)) return momentum;
  if (is_slender(traits) || less(add(energy_before, scaled_by_power(energy_before, -2)), energy_after))
    return rotate(to, before);
  return scaled(momentum, square_root(divide(energy_before, energy_after)));
}

uint32_t hold_spin(const BodyTraits& traits, const Quat& rotation, BodyMotion& motion) {
  if (!is_dynamic(traits)) return 0;
  const Vec3<Real> local = rotate_inverse(rotation, motion.momentum);
  bool saturated = false;
  const auto spin = [&](Real value, int i) { return abs(multiply(value, traits.gyration[i], saturated)); };
  const Real fastest = max(spin(local.x, 0), max(spin(local.y, 1), spin(local.z, 2)));
  if (fastest <= k_spin_max) return 0;
  const auto held = [&](Real value, int i) {
    const Real limit = multiply(k_spin_max, inertia_about(traits, i));
    return clamp(value, -limit, limit);
  };
  motion.momentum = rotate(rotation, Vec3<Real>{held(local.x, 0), held(local.y, 1), held(local.z, 2)});
  return 1;
}

uint32_t add_to_sweep(const BodyTraits& traits, const Quat& rotation, const BodyMotion& before, const BodyMotion& after,
                      Real tick_time, BodySweep& sweep) {
  const Vec3<Real> spin = spin_of(traits, rotation, after.momentum - before.momentum);
  bool turns_clamped = false;
  const auto angle = [&](Real value) { return angle_of(value * tick_time, traits.size_exponent, turns_clamped); };
  sweep.displacement += (after.velocity - before.velocity) * tick_time;
  sweep.turn += {angle(spin.x), angle(spin.y), angle(spin.z)};
  // The limits of the state; time_of_impact() accepts twice as much.
  constexpr Real k_sweep_turn_max = 32768.0, k_sweep_way_max = 8192.0;
  return clamp_vector(sweep.displacement, k_sweep_way_max) + clamp_vector(sweep.turn, k_sweep_turn_max) +
         (turns_clamped ? 1 : 0);
}

bool resolve_impact(const ContactWork& contact, uint32_t count, Real least, Real parting, const ImpactBody& a,
                    const ImpactBody& b, Real& approach) {
  Impact impact(contact, count, a, b);
  approach = k_zero;
  for (uint32_t i = 0; i < count; ++i) {
    const Real velocity = impact.velocity(i);
    const bool rebounds = is_positive(contact.restitution) && velocity <= -contact.rebound_min;
    impact.wanted[i] = rebounds ? max(-multiply(velocity, contact.restitution), parting) : parting;
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
  // The friction row was solved last, so a slow approach may remain: sweep over the normals again. Then apply the
  // impulses to the bodies. A second round corrects the residual that the rounding of the bodies' state leaves.
  for (int round = 0; round < k_rounds; ++round) {
    for (int sweep = 0; sweep < k_last_sweeps; ++sweep) {
      for (uint32_t i = 0; i < count; ++i) impact.push(i);
    }
    impact.act(a, b);
    impact.look(a, b);
  }
  return true;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
