#include "dynamics/solve.h"

#include "dynamics/contact_motion.h"
#include "dynamics/gyration.h"
#include "dynamics/spin.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr Real k_zero = 0.0;
constexpr Vec3<Real> k_still = {0.0, 0.0, 0.0};
constexpr int k_arrival_power = -9;  ///< of push_max: a point that closes its gap within it meets in this substep
constexpr int k_relax_sweeps = 1;    ///< there and back over a contact's points: in a block they cost little

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

/// What acts without contacts. From the second substep of a tick on, contacts first push as they did in the last one:
/// that is the warm start of all of a body's contacts at once.
uint32_t integrate_velocities(const SolverBodies& bodies, Span<const uint32_t> island, bool first) {
  const Scaled one = 1.0;
  uint32_t clamped = 0;
  for (const uint32_t slot : island) {
    BodyMotion& motion = bodies.motions[slot];
    BodyWork& now = bodies.work[slot];
    const Vec3<Real> pushed = first ? k_still : added_by_contacts(motion.velocity, now.contact_velocity);
    const Vec3<Real> turned = first ? k_still : added_by_contacts(motion.momentum, now.contact_momentum);
    motion.velocity += now.push;
    motion.momentum += now.twist;
    if (!(now.linear_kept == one)) motion.velocity = scaled(motion.velocity, now.linear_kept);
    if (!(now.angular_kept == one)) motion.momentum = scaled(motion.momentum, now.angular_kept);
    now.contact_velocity = kept_at_start(motion.velocity);
    now.contact_momentum = kept_at_start(motion.momentum);
    motion.velocity += pushed;
    motion.momentum += turned;
    if constexpr (!DETENT_FIXED) {
      now.contact_velocity = pushed;
      now.contact_momentum = turned;
    }
    clamped += clamp_vector(motion.velocity, k_speed_work_max) + clamp_vector(motion.momentum, k_spin_work_max);
    now.spin = world_spin(bodies.traits[slot], now.gyration, motion.momentum, -k_spin_power);
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
    const bool flies = added_by_contacts(motion.velocity, now.contact_velocity) == k_still;
    now.displacement += (flies ? motion.velocity - halved(now.push) : motion.velocity) * time;
    clamped += turn(bodies.traits[slot], motion, time, halvings, now);
  }
  return clamped;
}

/// One contact with the state of its bodies.
struct Solving {
  const StepSettings& settings;
  ContactWork& contact;
  BodyMotion& a;
  BodyMotion& b;
  BodyWork& now_a;
  BodyWork& now_b;

  void warm_start() {
    Block block;
    include_impulses(block);
    const uint32_t count = contact.state.point_count;
    Ulps impulse[k_manifold_points_max];
    for (uint32_t i = 0; i < count; ++i) impulse[i] = block.number(contact.state.normal_impulse[i]);
    Ulps wrench[k_parts];
    put_normals(impulse, wrench[k_along_normal], wrench[k_about_first], wrench[k_about_second]);
    wrench[k_along_first] = block.number(contact.friction_impulse[0]);
    wrench[k_along_second] = block.number(contact.friction_impulse[1]);
    wrench[k_about_normal] = block.number(contact.angular_impulse[0]);
    wrench[k_about_first] += block.number(contact.angular_impulse[1]);
    wrench[k_about_second] += block.number(contact.angular_impulse[2]);
    apply_wrench(contact, block, wrench, {a, now_a}, {b, now_b});
  }

  /// Pulls overlapping points apart as damped springs, and lets others close their gap and no more.
  void solve_normals_softly() {
    const Softness& soft = contact.static_pair != 0 ? settings.static_softness : settings.dynamic_softness;
    const PairMotion moved(Block(), now_b.displacement - now_a.displacement, now_a.turn, now_b.turn, 0);
    const NormalMotion way(moved, contact);
    Block room;
    include_normals(room);
    const PairMotion motion = relative_motion(room);
    const Block& block = motion.block;
    Normals normals(contact, block, NormalMotion(motion, contact));
    const Real arrival_speed = scale_by_power(contact.push_max, k_arrival_power);
    DETENT_UNROLL
    for (uint32_t i = 0; i < k_manifold_points_max; ++i) {
      if (i >= normals.count) break;
      ContactPoint& point = contact.point[i];
      // That of the start and what the bodies have moved since, to first order.
      const Real separation = point.separation + moved.block.real(way.at(point));
      const bool apart = separation > k_zero;
      const Real push = apart ? speed_over(settings, separation)
                              : max(speed_over(settings, separation * soft.rate), -contact.push_max);
      const Factor wanted = held(times(held(normals.speed(i) + block.held(push)), point.inverse_mass));
      normals.change(
          i, relaxed(apart ? wanted
                           : times(wanted, soft.mass_scale) + times(held(normals.impulse[i]), soft.impulse_scale)));
      // What arrives by a hair is there.
      point.apart = apart && normals.speed(i) + block.held(push - arrival_speed) > k_no_ulps ? 1 : 0;
    }
    normals.store(contact);
    Ulps along, about_first, about_second;
    put_normals(normals.added, along, about_first, about_second);
    apply_normal(contact, block, along, about_first, about_second, {a, now_a}, {b, now_b});
  }

  void relax() {
    Block room;
    include_impulses(room);
    const PairMotion motion = relative_motion(room);
    Sliding sliding(contact, motion);
    const Factor normal = normal_impulse(motion.block);
    if (contact.angular_rows == 3) roll(normal, sliding);
    if (contact.angular_rows != 0) twist(normal, sliding);
    rub(normal, sliding);

    Normals normals(contact, motion.block, sliding.normal());
    // Points that do not meet in this substep go on closing their gap.
    const auto stop = [&](uint32_t i) {
      const ContactPoint& point = contact.point[i];
      const bool meets = point.apart == 0 || normals.impulse[i] > k_no_ulps;
      if (meets) normals.change(i, relaxed(times(held(normals.speed(i)), point.inverse_mass)));
    };
    for (int sweep = 0; sweep < k_relax_sweeps; ++sweep) {
      DETENT_UNROLL
      for (uint32_t i = 0; i < k_manifold_points_max; ++i) {
        if (i < normals.count) stop(i);
      }
      DETENT_UNROLL
      for (uint32_t i = k_manifold_points_max; i-- > 0;) {
        if (i < normals.count) stop(i);
      }
    }
    normals.store(contact);
    Ulps about_first, about_second;
    put_normals(normals.added, sliding.wrench[k_along_normal], about_first, about_second);
    sliding.wrench[k_about_first] += about_first;
    sliding.wrench[k_about_second] += about_second;
    apply_wrench(contact, motion.block, sliding.wrench, {a, now_a}, {b, now_b});
  }

  /// Newton's law of impact, for points that closed faster than the threshold and were pushed.
  void rebound() {
    if (!is_positive(contact.restitution)) return;
    Block room;
    include_normals(room);
    const uint32_t count = contact.state.point_count;
    for (uint32_t i = 0; i < count; ++i) room.include(contact.point[i].approach);
    const PairMotion motion = relative_motion(room);
    Normals normals(contact, motion.block, NormalMotion(motion, contact));
    bool rebounds[k_manifold_points_max] = {};
    for (uint32_t i = 0; i < count; ++i) {
      const ContactPoint& point = contact.point[i];
      if (point.approach > -contact.rebound_min || point.impulse_max == k_zero) continue;
      const Ulps missing = normals.speed(i) + motion.block.held(multiply(point.approach, contact.restitution));
      normals.change(i, times(held(missing), point.inverse_mass));
      rebounds[i] = true;
    }
    Ulps along, about_first, about_second;
    put_normals(normals.added, along, about_first, about_second);
    apply_normal(contact, motion.block, along, about_first, about_second, {a, now_a}, {b, now_b});
    for (uint32_t i = 0; i < count; ++i) {
      if (rebounds[i]) contact.state.normal_impulse[i] = k_zero;  // it leaves: nothing is carried over to the next tick
    }
  }

 private:
  /// The points of a contact in one pass: the bodies are needed only when it begins and when it ends.
  struct Normals {
    const Unit (&coupling)[k_manifold_points_max][k_manifold_points_max];
    const int exponent;
    const Block& block;
    const uint32_t count;
    UlpSum velocity[k_manifold_points_max];  ///< along the normal, at each point, as the sweep has it by now
    Ulps impulse[k_manifold_points_max];     ///< likewise
    Ulps added[k_manifold_points_max] = {k_no_ulps, k_no_ulps, k_no_ulps, k_no_ulps};

    Normals(const ContactWork& contact, const Block& in, const NormalMotion& motion)
        : coupling(contact.coupling), exponent(contact.coupling_exponent), block(in), count(contact.state.point_count) {
      DETENT_UNROLL
      for (uint32_t i = 0; i < k_manifold_points_max; ++i) {
        velocity[i] = sum_from(motion.at(contact.point[i]), exponent);
        impulse[i] = block.number(contact.state.normal_impulse[i]);
      }
    }
    Ulps speed(uint32_t i) const { return rounded(velocity[i], exponent); }
    /// Takes so much from the impulse at a point, or all of it.
    void change(uint32_t i, Ulps less) {
      const Factor more = held(max(impulse[i] - less, k_no_ulps) - impulse[i]);
      impulse[i] += more;
      added[i] += more;
      DETENT_UNROLL
      for (uint32_t k = 0; k < k_manifold_points_max; ++k) velocity[k] += product(more, coupling[i][k]);
    }
    void store(ContactWork& contact) const {
      for (uint32_t i = 0; i < count; ++i) {
        Real& total = contact.state.normal_impulse[i];
        ContactPoint& point = contact.point[i];
        total = max(total + block.real(added[i]), k_zero);
        point.impulse_max = max(point.impulse_max, total);
      }
    }
  };

  /// The whole motion of the pair while friction is solved, and what has acted on it.
  struct Sliding {
    const ContactWork& contact;
    const Block& block;
    Ulps part[k_parts];
    Ulps wrench[k_parts] = {k_no_ulps, k_no_ulps, k_no_ulps, k_no_ulps, k_no_ulps, k_no_ulps};

    Sliding(const ContactWork& of_pair, const PairMotion& motion) : contact(of_pair), block(motion.block) {
      const Mantissas velocity = motion.at_middle(contact), turning = motion.turning(contact);
      part[k_along_normal] = rounded(dot(velocity, contact.normal));
      part[k_along_first] = rounded(dot(velocity, contact.tangent[0]));
      part[k_along_second] = rounded(dot(velocity, contact.tangent[1]));
      part[k_about_normal] = rounded(dot(turning, contact.normal));
      part[k_about_first] = rounded(dot(turning, contact.tangent[0]));
      part[k_about_second] = rounded(dot(turning, contact.tangent[1]));
    }
    NormalMotion normal() const {
      return {part[k_along_normal], held(part[k_about_first]), held(part[k_about_second])};
    }
    /// Brings an impulse to `after` wherever it is kept.
    template <Part by>
    void bring(Factor after, Real& impulse) {
      const Factor more = held(after - block.number(impulse));
      impulse += block.real(more);
      wrench[by] += more;
      DETENT_UNROLL
      for (int i = 0; i < k_parts; ++i)
        part[i] += times_scaled(more, contact.response[response_index(i, by)], contact.response_exponent);
    }
  };

  PairMotion relative_motion(const Block& room) const {
    return {room, b.velocity - a.velocity, now_a.spin, now_b.spin, k_spin_power};
  }

  void include_normals(Block& block) const {
    for (uint32_t i = 0; i < contact.state.point_count; ++i) block.include(contact.state.normal_impulse[i]);
  }
  void include_impulses(Block& block) const {
    include_normals(block);
    for (const Real impulse : contact.friction_impulse) block.include(impulse);
    for (uint32_t i = 0; i < contact.angular_rows; ++i) block.include(contact.angular_impulse[i]);
  }
  Factor normal_impulse(const Block& block) const {
    Ulps sum = k_no_ulps;
    for (uint32_t i = 0; i < contact.state.point_count; ++i) sum += block.number(contact.state.normal_impulse[i]);
    return held(sum);
  }

  /// Impulses along the normal at the points, as one at their middle and one about each tangent.
  void put_normals(const Ulps (&impulse)[k_manifold_points_max], Ulps& along, Ulps& about_first,
                   Ulps& about_second) const {
    along = about_first = about_second = k_no_ulps;
    for (uint32_t i = 0; i < contact.state.point_count; ++i) {
      const ContactPoint& point = contact.point[i];
      along += impulse[i];
      about_first += times(held(impulse[i]), point.y);
      about_second -= times(held(impulse[i]), point.x);
    }
  }

  /// What stops a part of the motion, with an impulse that has acted along it.
  template <class Mass>
  Factor stopped(const Sliding& sliding, Part by, Real impulse, Mass mass) const {
    return held(sliding.block.number(impulse) - relaxed(times(held(sliding.part[by]), mass)));
  }

  /// Spin about the tangents, within a circle.
  void roll(Factor normal, Sliding& sliding) {
    Factor after[2] = {stopped(sliding, k_about_first, contact.angular_impulse[1], contact.angular_mass[1]),
                       stopped(sliding, k_about_second, contact.angular_impulse[2], contact.angular_mass[2])};
    hold_to_circle(after, times(normal, contact.rolling_arm));
    sliding.bring<k_about_first>(after[0], contact.angular_impulse[1]);
    sliding.bring<k_about_second>(after[1], contact.angular_impulse[2]);
  }

  /// Spin about the normal, within its limit.
  void twist(Factor normal, Sliding& sliding) {
    const Factor limit = times(normal, contact.twist_arm);
    const Factor wanted = stopped(sliding, k_about_normal, contact.angular_impulse[0], contact.angular_mass[0]);
    sliding.bring<k_about_normal>(clamp(wanted, -limit, limit), contact.angular_impulse[0]);
  }

  /// Sliding, within the friction cone.
  void rub(Factor normal, Sliding& sliding) {
    Factor after[2] = {stopped(sliding, k_along_first, contact.friction_impulse[0], contact.friction_mass[0]),
                       stopped(sliding, k_along_second, contact.friction_impulse[1], contact.friction_mass[1])};
    hold_to_circle(after, times(normal, contact.friction));
    sliding.bring<k_along_first>(after[0], contact.friction_impulse[0]);
    sliding.bring<k_along_second>(after[1], contact.friction_impulse[1]);
  }

  Ulps relaxed(Ulps change) const {
    return settings.relaxation == Unit(1.0) ? change : times(held(change), settings.relaxation);
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
    clamped += integrate_velocities(bodies, island, substep == 0);
    if (substep == 0) every([](Solving& contact) { contact.warm_start(); });
    for (const ContactOrder& entry : order) {
      const ContactWork& contact = contacts[entry.contact];
      if (contact.static_pair == 0) continue;
      const uint32_t a = contact.state.body_a, b = contact.state.body_b;
      place_kinematic(bodies.traits[a], bodies.motions[a], elapsed, bodies.work[a]);
      place_kinematic(bodies.traits[b], bodies.motions[b], elapsed, bodies.work[b]);
    }
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
    clamped += integrate_velocities(bodies, island, true);
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
