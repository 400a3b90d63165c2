#include "dynamics/solve.h"

#include "dynamics/block.h"
#include "dynamics/contact_rows.h"
#include "dynamics/contact_velocity.h"
#include "dynamics/spin.h"
#include "math/root.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr Real k_zero = 0.0;
constexpr int k_arrival_power = -9;  ///< of push_max: a point that closes its gap within it meets in this substep
constexpr int k_relax_sweeps = 2;    ///< there and back over a contact's points: in a block they cost little

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

Vec3<Real> halved(const Vec3<Real>& v) {
  return {scale_by_power(v.x, -1), scale_by_power(v.y, -1), scale_by_power(v.z, -1)};
}

uint32_t integrate_velocities(const SolverBodies& bodies, Span<const uint32_t> island) {
  const Scaled one = 1.0;
  uint32_t clamped = 0;
  for (const uint32_t slot : island) {
    BodyMotion& motion = bodies.motions[slot];
    BodyWork& now = bodies.work[slot];
    motion.velocity += now.push;
    motion.momentum += now.twist;
    if (!(now.linear_kept == one)) motion.velocity = scaled(motion.velocity, now.linear_kept);
    if (!(now.angular_kept == one)) motion.momentum = scaled(motion.momentum, now.angular_kept);
    clamped += clamp_vector(motion.velocity, k_speed_work_max) + clamp_vector(motion.momentum, k_spin_work_max);
    now.free_velocity = motion.velocity;
  }
  return clamped;
}

uint32_t turn(const BodyTraits& traits, const BodyMotion& motion, Real time, int halvings, BodyWork& now) {
  if (motion.momentum == Vec3<Real>{k_zero, k_zero, k_zero}) return 0;
  const Vec3<Real> spin = spin_of(traits, now.rotation, motion.momentum);
  now.turn += spin * time;
  return turn_freely(traits, motion.momentum, spin, time, halvings, now.rotation) ? 0 : 1;
}

uint32_t integrate_positions(const SolverBodies& bodies, Span<const uint32_t> island, Real time, int halvings = 0) {
  uint32_t clamped = 0;
  for (const uint32_t slot : island) {
    const BodyMotion& motion = bodies.motions[slot];
    BodyWork& now = bodies.work[slot];
    // What no contact acts on is in free flight: at the mean of its velocities before and after the push.
    const bool flies = motion.velocity == now.free_velocity;
    now.displacement += (flies ? motion.velocity - halved(now.push) : motion.velocity) * time;
    clamped += turn(bodies.traits[slot], motion, time, halvings, now);
  }
  return clamped;
}

/// How two bodies move against each other, in a block: B's centre against A's, and each one's turning.
struct PairMotion {
  Block block;
  Mantissas linear, a, b;

  /// The turning of each is scaled by the exponents of the rows that it is asked for along.
  PairMotion(const Block& room, const Vec3<Real>& way, const Vec3<Real>& turn_a, int exponent_a,
             const Vec3<Real>& turn_b, int exponent_b)
      : block(room) {
    block.include(way, 0);
    block.include(turn_a, exponent_a);
    block.include(turn_b, exponent_b);
    linear = block.mantissas(way, 0);
    a = block.mantissas(turn_a, exponent_a);
    b = block.mantissas(turn_b, exponent_b);
  }
  /// Along a direction, at a point whose rows are `row_a` and `row_b`.
  Ulps along(UlpSum direction, const Vec3<Unit>& row_a, const Vec3<Unit>& row_b) const {
    return rounded(direction + (dot(b, row_b) - dot(a, row_a)));
  }
};

/// One contact with the state of its bodies.
struct Solving {
  const StepSettings& settings;
  ContactWork& contact;
  BodyMotion& a;
  BodyMotion& b;
  const BodyWork& now_a;
  const BodyWork& now_b;

  void warm_start() {
    Block block;
    Ulps impulse[k_manifold_points_max] = {k_no_ulps, k_no_ulps, k_no_ulps, k_no_ulps};
    const uint32_t count = contact.state.point_count;
    for (uint32_t i = 0; i < count; ++i) block.include(contact.state.normal_impulse[i]);
    for (uint32_t i = 0; i < count; ++i) impulse[i] = block.number(contact.state.normal_impulse[i]);
    add_normals(block, impulse);
    push_along_tangents(contact.friction_impulse);
    for (uint32_t i = 0; i < contact.angular_rows; ++i) {
      apply_angular_impulse(contact, axis(i), contact.angular_impulse[i], a, b);
    }
  }

  /// Pulls overlapping points apart as damped springs, and lets others close their gap and no more.
  void solve_normals_softly() {
    const Softness& soft = contact.static_pair != 0 ? settings.static_softness : settings.dynamic_softness;
    const uint32_t count = contact.state.point_count;
    const PairMotion moved(Block(), now_b.displacement - now_a.displacement, now_a.turn, 0, now_b.turn, 0);
    const UlpSum way = dot(moved.linear, contact.normal);
    Normals normals(*this);
    for (uint32_t i = 0; i < count; ++i) {
      ContactPoint& point = contact.point[i];
      // That of the start and what the bodies have moved since, to first order.
      const Real separation = point.separation + moved.block.real(moved.along(way, point.row.arm_a, point.row.arm_b));
      const bool apart = separation > k_zero;
      const Real push = apart ? speed_over(settings, separation)
                              : max(speed_over(settings, separation * soft.rate), -contact.push_max);
      const Ulps wanted = times(held(normals.velocity[i]) + normals.block.held(push), point.row.inverse_mass);
      normals.change(i,
                     apart ? wanted : times(wanted, soft.mass_scale) + times(normals.impulse[i], soft.impulse_scale));
      // What arrives by a hair is there.
      const Real arrival = push - scale_by_power(contact.push_max, k_arrival_power);
      point.apart = apart && normals.velocity[i] + normals.block.held(arrival) > k_no_ulps ? 1 : 0;
    }
    normals.finish();
  }

  void relax() {
    Real normal = k_zero;
    for (uint32_t i = 0; i < contact.state.point_count; ++i) normal += contact.state.normal_impulse[i];
    solve_rolling(normal);
    solve_twist(normal);
    solve_friction(normal);
    Normals normals(*this);
    // Points that do not meet in this substep go on closing their gap.
    const auto meets = [&](uint32_t i) { return contact.point[i].apart == 0 || normals.impulse[i] > k_no_ulps; };
    for (int sweep = 0; sweep < k_relax_sweeps; ++sweep) {
      for (uint32_t i = 0; i < contact.state.point_count; ++i) {
        if (meets(i)) normals.stop(i);
      }
      for (uint32_t i = contact.state.point_count; i-- > 0;) {
        if (meets(i)) normals.stop(i);
      }
    }
    normals.finish();
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
      impulse = k_zero;  // it leaves: nothing is carried over to the next tick
    }
  }

 private:
  /// The points of a contact in one pass: a sweep needs the bodies only when it begins and when it ends.
  struct Normals {
    Solving& solving;
    Block block;
    Ulps velocity[k_manifold_points_max];  ///< along the normal, at each point, as the sweep has it by now
    Ulps impulse[k_manifold_points_max];   ///< likewise
    Ulps added[k_manifold_points_max] = {k_no_ulps, k_no_ulps, k_no_ulps, k_no_ulps};

    explicit Normals(Solving& of) : solving(of) {
      const ContactWork& of_pair = solving.contact;
      const ContactRow& first = of_pair.point[0].row;
      Block room;
      const uint32_t count = of_pair.state.point_count;
      for (uint32_t i = 0; i < count; ++i) room.include(of_pair.state.normal_impulse[i]);
      const PairMotion motion(room, solving.b.velocity - solving.a.velocity, solving.a.momentum, first.exponent_a,
                              solving.b.momentum, first.exponent_b);
      block = motion.block;
      const UlpSum way = dot(motion.linear, of_pair.normal);
      for (uint32_t i = 0; i < count; ++i) {
        const ContactRow& row = of_pair.point[i].row;
        velocity[i] = motion.along(way, row.response_a, row.response_b);
        impulse[i] = block.number(of_pair.state.normal_impulse[i]);
      }
    }
    /// Takes so much from the impulse at a point, or all of it.
    void change(uint32_t i, Ulps less) {
      const ContactWork& of_pair = solving.contact;
      const Ulps before = impulse[i];
      impulse[i] = max(before - solving.relaxed(less), k_no_ulps);
      const Ulps more = impulse[i] - before;
      if (more == k_no_ulps) return;
      added[i] += more;
      for (uint32_t k = 0; k < of_pair.state.point_count; ++k)
        velocity[k] += times_scaled(more, of_pair.coupling[i][k], of_pair.coupling_exponent);
    }
    void stop(uint32_t i) { change(i, times(held(velocity[i]), solving.contact.point[i].row.inverse_mass)); }
    void finish() {
      solving.add_normals(block, added);
      for (uint32_t i = 0; i < solving.contact.state.point_count; ++i) {
        Real& total = solving.contact.state.normal_impulse[i];
        ContactPoint& point = solving.contact.point[i];
        total = max(total + block.real(added[i]), k_zero);
        point.impulse_max = max(point.impulse_max, total);
      }
    }
  };

  /// Applies impulses along the normal at the points; what is too fine for a product is rounded away in `impulse` too.
  void add_normals(Block& block, Ulps (&impulse)[k_manifold_points_max]) {
    const uint32_t count = contact.state.point_count;
    block.coarsen(impulse);
    Ulps sum = impulse[0];
    for (uint32_t i = 1; i < count; ++i) sum += impulse[i];
    const auto turned = [&](Vec3<Unit> ContactRow::*arm) {
      UlpSum x = product(impulse[0], (contact.point[0].row.*arm).x),
             y = product(impulse[0], (contact.point[0].row.*arm).y),
             z = product(impulse[0], (contact.point[0].row.*arm).z);
      for (uint32_t i = 1; i < count; ++i) {
        const Vec3<Unit>& by = contact.point[i].row.*arm;
        x += product(impulse[i], by.x);
        y += product(impulse[i], by.y);
        z += product(impulse[i], by.z);
      }
      return Vec3<Real>{block.real_from_sum(x), block.real_from_sum(y), block.real_from_sum(z)};
    };
    const Vec3<Real> push = {block.real_from_sum(product(sum, contact.normal.x)),
                             block.real_from_sum(product(sum, contact.normal.y)),
                             block.real_from_sum(product(sum, contact.normal.z))};
    if (takes_impulses(contact.share_a)) {
      a.velocity -= shared(push, contact.share_a);
      a.momentum -= shared(turned(&ContactRow::arm_a), contact.share_a);
    }
    if (takes_impulses(contact.share_b)) {
      b.velocity += shared(push, contact.share_b);
      b.momentum += shared(turned(&ContactRow::arm_b), contact.share_b);
    }
  }

  void push_along_tangents(const Real (&impulse)[2]) {
    for (int i = 0; i < 2; ++i) apply_impulse(contact, contact.friction_row[i], contact.tangent[i], impulse[i], a, b);
  }

  /// Spin about the normal, within its limit.
  void solve_twist(Real normal) {
    if (contact.angular_rows == 0) return;
    const Real limit = limit_of(normal, contact.twist_arm);
    const Real before = contact.angular_impulse[0];
    const Real after = clamp(before - wanted(contact.angular_row[0]), -limit, limit);
    if (after == before) return;
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
    const ContactRow& first = contact.friction_row[0];
    const PairMotion motion(Block(), b.velocity - a.velocity, a.momentum, first.exponent_a, b.momentum,
                            first.exponent_b);
    Real after[2], change[2];
    for (int i = 0; i < 2; ++i) {
      const ContactRow& row = contact.friction_row[i];
      const Ulps velocity = motion.along(dot(motion.linear, contact.tangent[i]), row.response_a, row.response_b);
      after[i] = contact.friction_impulse[i] - motion.block.real(relaxed(times(velocity, row.inverse_mass)));
    }
    clamp_to_circle(after, limit);
    for (int i = 0; i < 2; ++i) {
      change[i] = after[i] - contact.friction_impulse[i];
      contact.friction_impulse[i] = after[i];
    }
    push_along_tangents(change);
  }

  const Vec3<Unit>& axis(uint32_t i) const { return i == 0 ? contact.normal : contact.tangent[i - 1]; }
  template <class Number>
  Number relaxed(Number change) const {
    return settings.relaxation == Unit(1.0) ? change : times(change, settings.relaxation);
  }
  static Real times(Real a, Unit b) { return a * b; }
#if DETENT_FIXED
  static Ulps times(Ulps a, Unit b) { return detent::times(a, b); }
#endif
  Real wanted(const AngularRow& row) const {
    bool saturated = false;
    return relaxed(multiply(row_spin(row, a, b), row.inverse_mass, saturated));
  }
  static Real limit_of(Real normal, Scaled arm) {
    bool saturated = false;
    return multiply(normal, arm, saturated);
  }
  static void clamp_to_circle(Real v[2], Real limit) {
    if (abs(v[0]) + abs(v[1]) <= limit) return;
    const Real size = length(Vec3<Real>{v[0], v[1], k_zero});
    if (size <= limit) return;
    const Real factor = divide(limit, size);
    v[0] = v[0] * factor;
    v[1] = v[1] * factor;
  }
  static Vec3<Real> shared(const Vec3<Real>& impulse, Scaled share) {
    return share == Scaled(1.0) ? impulse : scaled(impulse, share);
  }
};

/// Where a kinematic body is once `time` of the tick has gone; its momentum is its spin.
void place_kinematic(const BodyTraits& traits, const BodyMotion& motion, Real time, BodyWork& now) {
  if (type_of(traits) != BodyType::kinematic) return;
  now.displacement = motion.velocity * time;
  now.turn = motion.momentum * time;
}

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

uint32_t solve(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> island,
               Span<const ContactOrder> order, Span<ContactWork> contacts) {
  uint32_t clamped = 0;
  Real elapsed = 0.0;
  const auto every = [&](const auto& visit) { for_each_contact(settings, bodies, order, contacts, visit); };
  for (uint32_t substep = 0; substep < settings.substeps; ++substep) {
    clamped += integrate_velocities(bodies, island);
    every([&](Solving& contact) {
      contact.warm_start();
      if (contact.contact.static_pair == 0) return;
      const uint32_t a = contact.contact.state.body_a, b = contact.contact.state.body_b;
      place_kinematic(bodies.traits[a], bodies.motions[a], elapsed, bodies.work[a]);
      place_kinematic(bodies.traits[b], bodies.motions[b], elapsed, bodies.work[b]);
    });
    for (uint32_t iteration = 0; iteration < settings.iterations; ++iteration) {
      every([](Solving& contact) { contact.solve_normals_softly(); });
    }
    clamped += integrate_positions(bodies, island, settings.time);
    for (uint32_t iteration = 0; iteration < settings.iterations; ++iteration) {
      every([](Solving& contact) { contact.relax(); });
    }
    elapsed += settings.time;
  }
  every([](Solving& contact) { contact.rebound(); });
  return clamped;
}

uint32_t fly(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> island) {
  constexpr int k_halvings = 2;
  uint32_t clamped = 0;
  for (uint32_t substep = 0; substep < settings.substeps; ++substep) {
    clamped += integrate_velocities(bodies, island);
    clamped += integrate_positions(bodies, island, settings.time, k_halvings);
  }
  return clamped;
}

uint32_t carry(const StepSettings& settings, const SolverBodies& bodies) {
  uint32_t clamped = 0;
  for (uint32_t slot = 0; slot < bodies.traits.count; ++slot) {
    const BodyTraits& traits = bodies.traits[slot];
    if (type_of(traits) != BodyType::kinematic) continue;
    BodyWork& now = bodies.work[slot];
    place_kinematic(traits, bodies.motions[slot], settings.tick_time, now);
    if (!turn_freely(traits, bodies.motions[slot].momentum, bodies.motions[slot].momentum, settings.tick_time, 0,
                     now.rotation))
      ++clamped;
  }
  return clamped;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
