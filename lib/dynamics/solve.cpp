#include "dynamics/solve.h"

#include "dynamics/contact_rows.h"
#include "dynamics/contact_velocity.h"
#include "dynamics/spin.h"
#include "math/root.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr Real k_zero = 0.0;

uint32_t clamp_component(Real& value, Real limit) {
  const Real held = clamp(value, -limit, limit);
  const bool clamped = !(held == value);
  value = held;
  return clamped ? 1 : 0;
}

uint32_t clamp_vector(Vec3<Real>& v, Real limit) {
  return clamp_component(v.x, limit) + clamp_component(v.y, limit) + clamp_component(v.z, limit);
}

Vec3<Real> scaled(const Vec3<Real>& v, Scaled factor) {
  return {multiply(v.x, factor), multiply(v.y, factor), multiply(v.z, factor)};
}

uint32_t integrate_velocities(const SolverBodies& bodies) {
  const Scaled one = 1.0;
  uint32_t clamped = 0;
  for (uint32_t slot = 0; slot < bodies.traits.count; ++slot) {
    if (!is_dynamic(bodies.traits[slot])) continue;
    BodyMotion& motion = bodies.motions[slot];
    const BodyWork& now = bodies.work[slot];
    motion.velocity += now.push;
    motion.momentum += now.twist;
    if (!(now.linear_kept == one)) motion.velocity = scaled(motion.velocity, now.linear_kept);
    if (!(now.angular_kept == one)) motion.momentum = scaled(motion.momentum, now.angular_kept);
    clamped += clamp_vector(motion.velocity, k_speed_work_max) + clamp_vector(motion.momentum, k_spin_work_max);
  }
  return clamped;
}

uint32_t integrate_positions(const SolverBodies& bodies, Real time) {
  uint32_t clamped = 0;
  for (uint32_t slot = 0; slot < bodies.traits.count; ++slot) {
    const BodyTraits& traits = bodies.traits[slot];
    if (traits.type == 0 || type_of(traits) == BodyType::fixed) continue;
    const BodyMotion& motion = bodies.motions[slot];
    BodyWork& now = bodies.work[slot];
    now.displacement += motion.velocity * time;
    if (motion.momentum == Vec3<Real>{k_zero, k_zero, k_zero}) continue;
    const Vec3<Real> spin = spin_of(traits, now.rotation, motion.momentum);
    now.turn += spin * time;
    if (!turn_freely(traits, motion.momentum, spin, time, now.rotation)) ++clamped;
  }
  return clamped;
}

/// One contact with the state of its bodies.
struct Solving {
  const StepSettings& settings;
  ContactWork& contact;
  BodyMotion& a;
  BodyMotion& b;
  const BodyWork& now_a;
  const BodyWork& now_b;

  void warm_start() {
    for (uint32_t i = 0; i < contact.state.point_count; ++i) {
      apply_impulse(contact, contact.point[i].row, contact.normal, contact.state.normal_impulse[i], a, b);
    }
    for (int i = 0; i < 2; ++i) {
      apply_impulse(contact, contact.friction_row[i], contact.tangent[i], contact.friction_impulse[i], a, b);
    }
    for (uint32_t i = 0; i < contact.angular_rows; ++i) {
      apply_angular_impulse(contact, axis(i), contact.angular_impulse[i], a, b);
    }
  }

  /// Separation of a point now: that of the start and what the bodies have moved since, to first order.
  Real separation_now(const ContactPoint& point) const {
    return point.separation + dot(now_b.displacement - now_a.displacement, contact.normal) +
           (dot(now_b.turn, point.row.arm_b) - dot(now_a.turn, point.row.arm_a));
  }

  void solve_normal_softly(uint32_t i) {
    ContactPoint& point = contact.point[i];
    const Softness& soft = contact.static_pair != 0 ? settings.static_softness : settings.dynamic_softness;
    const Real separation = separation_now(point);
    const Real velocity = row_velocity(point.row, contact.normal, a, b);
    Real& impulse = contact.state.normal_impulse[i];
    bool saturated = false;
    if (separation > k_zero) {
      // Not touching yet: they may close the gap and no more.
      const Real gap_speed = min(multiply(separation, settings.rate, saturated), k_speed_work_max);
      add_normal(point, impulse, -((velocity + gap_speed) * point.row.inverse_mass));
      return;
    }
    const Real push = max(multiply(separation * soft.rate, settings.rate, saturated), -contact.push_max);
    add_normal(point, impulse,
               -((velocity + push) * point.row.inverse_mass) * soft.mass_scale - impulse * soft.impulse_scale);
  }

  void solve_normal_rigidly(uint32_t i) {
    ContactPoint& point = contact.point[i];
    const Real velocity = row_velocity(point.row, contact.normal, a, b);
    add_normal(point, contact.state.normal_impulse[i], -(velocity * point.row.inverse_mass));
  }

  Real normal_sum() const {
    Real sum = k_zero;
    for (uint32_t i = 0; i < contact.state.point_count; ++i) sum += contact.state.normal_impulse[i];
    return sum;
  }

  /// Spin about the normal, within its limit.
  void solve_twist(Real normal) {
    if (contact.angular_rows == 0) return;
    const Real limit = limit_of(normal, contact.twist_arm);
    const Real before = contact.angular_impulse[0];
    const Real after = clamp(before - wanted(contact.angular_row[0]), -limit, limit);
    contact.angular_impulse[0] = after;
    apply_angular_impulse(contact, contact.normal, after - before, a, b);
  }

  /// Spin about the tangents, within a circle.
  void solve_rolling(Real normal) {
    if (contact.angular_rows != 3) return;
    const Real before[2] = {contact.angular_impulse[1], contact.angular_impulse[2]};
    Real after[2] = {before[0] - wanted(contact.angular_row[1]), before[1] - wanted(contact.angular_row[2])};
    clamp_to_circle(after, limit_of(normal, contact.rolling_arm));
    for (uint32_t i = 0; i < 2; ++i) {
      contact.angular_impulse[i + 1] = after[i];
      apply_angular_impulse(contact, contact.tangent[i], after[i] - before[i], a, b);
    }
  }

  void solve_friction(Real normal) {
    const Real limit = limit_of(normal, contact.friction);
    Real after[2];
    for (int i = 0; i < 2; ++i) {
      const Real velocity = row_velocity(contact.friction_row[i], contact.tangent[i], a, b);
      after[i] = contact.friction_impulse[i] - relaxed(velocity * contact.friction_row[i].inverse_mass);
    }
    clamp_to_circle(after, limit);
    for (int i = 0; i < 2; ++i) {
      const Real change = after[i] - contact.friction_impulse[i];
      contact.friction_impulse[i] = after[i];
      apply_impulse(contact, contact.friction_row[i], contact.tangent[i], change, a, b);
    }
  }

  void relax() {
    const Real normal = normal_sum();
    solve_rolling(normal);
    solve_twist(normal);
    solve_friction(normal);
    for (uint32_t i = 0; i < contact.state.point_count; ++i) solve_normal_rigidly(i);
    for (uint32_t i = contact.state.point_count; i-- > 0;) solve_normal_rigidly(i);
  }

  /// Newton's law of impact, for points that closed faster than the threshold and were pushed.
  void rebound() {
    if (!is_positive(contact.restitution)) return;
    for (uint32_t i = 0; i < contact.state.point_count; ++i) {
      ContactPoint& point = contact.point[i];
      if (point.approach > -contact.rebound_min || point.impulse_max == k_zero) continue;
      const Real velocity = row_velocity(point.row, contact.normal, a, b);
      const Real missing = velocity + multiply(point.approach, contact.restitution);
      Real& impulse = contact.state.normal_impulse[i];
      const Real after = max(impulse - missing * point.row.inverse_mass, k_zero);
      apply_impulse(contact, point.row, contact.normal, after - impulse, a, b);
      impulse = after;
    }
  }

 private:
  const Vec3<Unit>& axis(uint32_t i) const { return i == 0 ? contact.normal : contact.tangent[i - 1]; }
  Real relaxed(Real change) const { return settings.relaxation == Real(1.0) ? change : change * settings.relaxation; }
  Real wanted(const AngularRow& row) const {
    bool saturated = false;
    return relaxed(multiply(row_spin(row, a, b), row.inverse_mass, saturated));
  }
  static Real limit_of(Real normal, Scaled arm) {
    bool saturated = false;
    return multiply(normal, arm, saturated);
  }
  static void clamp_to_circle(Real v[2], Real limit) {
    const Real size = length(Vec3<Real>{v[0], v[1], k_zero});
    if (size <= limit) return;
    const Real factor = divide(limit, size);
    v[0] = v[0] * factor;
    v[1] = v[1] * factor;
  }
  void add_normal(ContactPoint& point, Real& impulse, Real change) {
    const Real after = max(impulse + relaxed(change), k_zero);
    apply_impulse(contact, point.row, contact.normal, after - impulse, a, b);
    impulse = after;
    point.impulse_max = max(point.impulse_max, after);
  }
};

template <class Visit>
void for_each_contact(const StepSettings& settings, const SolverBodies& bodies, Span<const ContactOrder> order,
                      Span<ContactWork> contacts, const Visit& visit) {
  for (const ContactOrder& entry : order) {
    ContactWork& contact = contacts[entry.contact];
    const uint32_t a = contact.state.body_a, b = contact.state.body_b;
    Solving solving = {settings, contact, bodies.motions[a], bodies.motions[b], bodies.work[a], bodies.work[b]};
    visit(solving);
  }
}

}  // namespace

uint32_t solve(const StepSettings& settings, const SolverBodies& bodies, Span<const ContactOrder> order,
               Span<ContactWork> contacts) {
  uint32_t clamped = 0;
  const auto every = [&](const auto& visit) { for_each_contact(settings, bodies, order, contacts, visit); };
  for (uint32_t substep = 0; substep < settings.substeps; ++substep) {
    clamped += integrate_velocities(bodies);
    every([](Solving& contact) { contact.warm_start(); });
    for (uint32_t iteration = 0; iteration < settings.iterations; ++iteration) {
      every([](Solving& contact) {
        for (uint32_t i = 0; i < contact.contact.state.point_count; ++i) contact.solve_normal_softly(i);
      });
    }
    clamped += integrate_positions(bodies, settings.time);
    for (uint32_t iteration = 0; iteration < settings.iterations; ++iteration) {
      every([](Solving& contact) { contact.relax(); });
    }
  }
  every([](Solving& contact) {
    contact.rebound();
    store_impulses(contact.contact);
  });
  return clamped;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
