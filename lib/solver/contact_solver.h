#pragma once
#include "motion/contact_motion.h"
#include "motion/step_settings.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// A point with a gap counts as in contact if its approach speed is at least the speed that closes the gap in this
/// substep, minus 2^k_arrival_power push_max.
inline constexpr int k_arrival_power = -9;
/// Largest number of rounds of block pivoting in solve_rows().
inline constexpr int k_pivot_rounds = 6;
/// Number of solves of a rebound. Each solve leaves 1/33 of the error, because of k_rigid_softness (1/32).
inline constexpr uint32_t k_rebound_rounds = 5;
/// Softness of a row that is not a spring, as a fraction of the row's diagonal element of K. Without it, the impulses
/// of redundant points would be indefinite.
inline constexpr Unit k_rigid_softness = 1.0 / 32;

/// The change of an impulse, multiplied by the relaxation factor of SOR.
template <class Kind>
inline typename Kind::Number relaxed(typename Kind::Number change, Unit relaxation) {
  return relaxation == Unit(1.0) ? change : typename Kind::Number(times(held(change), Kind::unit(relaxation)));
}

/// The normal rows of a contact while the solver visits the contact. The motions of the bodies are read when the visit
/// begins, and written when it ends.
template <class Kind>
struct Normals {
  using Number = typename Kind::Number;
  using Factor = typename Kind::Factor;
  using Mask = typename Kind::Mask;

  const typename Kind::Contact& contact;
  const uint32_t count;
  /// Normal velocity of each point, updated with each impulse.
  typename Kind::Sum velocity[k_manifold_points_max];
  Number impulse[k_manifold_points_max];  ///< accumulated normal impulses, updated with each change; they are factors
  Number added[k_manifold_points_max];
  // Input of solve_rows().
  Factor wanted[k_manifold_points_max];    ///< speed of each row minus its target; the caller sets it
  Factor softness[k_manifold_points_max];  ///< softness of each row, as a mantissa like those of the coupling
  Mask may[k_manifold_points_max];         ///< whether the impulse of each row may change

  Normals(const typename Kind::Contact& of_pair, const typename Kind::Block& block, const NormalMotion<Kind>& motion)
      : contact(of_pair), count(of_pair.state.point_count) {
    DETENT_UNROLL
    for (uint32_t i = 0; i < k_manifold_points_max; ++i) {
      velocity[i] = sum_from(motion.at(contact, i), contact.coupling_exponent);
      impulse[i] = block.number(contact.state.normal_impulse[i]);
      added[i] = Kind::zero();
      wanted[i] = Kind::zero();
      // A single row needs no softness.
      softness[i] =
          count == 1 ? Kind::zero() : Kind::factor(times(Kind::mantissa(contact, i, i), Kind::unit(k_rigid_softness)));
      may[i] = Kind::is_positive(contact.normal_mass[i]);
    }
  }
  Number speed(uint32_t i) const { return rounded(velocity[i], contact.coupling_exponent); }
  /// Solves the rows of all points at once. With the coupling K and the diagonal matrix S of `softness`, let
  /// w = wanted + (K + S) change. In the solution each point that `may` change is active, with w = 0 and an impulse of
  /// at least 0, or at rest, with an impulse of 0 and w >= 0. In each round, an active point with a negative impulse
  /// becomes a point at rest, and a point at rest with w < 0 becomes active (block pivoting).
  /// Source: Judice, Pires, "A block principal pivoting algorithm ...", Computers and Operations Research, 1994.
  void solve_rows(Unit relaxation) {
    const Factor none = Kind::zero();
    Mask active[k_manifold_points_max];
    Factor change[k_manifold_points_max] = {none, none, none, none};
    DETENT_UNROLL
    for (uint32_t i = 0; i < k_manifold_points_max; ++i) {
      if (i < count) active[i] = may[i] & ((impulse[i] > none) | (none > wanted[i]));
    }
    Mask goes_on = Kind::all();
    for (int round = 0; round < k_pivot_rounds; ++round) {
      Factor next[k_manifold_points_max] = {none, none, none, none};
      solve_active(active, next);
      Mask changes = none > none;
      DETENT_UNROLL
      for (uint32_t i = 0; i < k_manifold_points_max; ++i) {
        if (i >= count) break;
        change[i] = select(goes_on, next[i], change[i]);
        Mask flips = goes_on & active[i] & (none > impulse[i] + next[i]);
        const Mask rests = goes_on & may[i] & !active[i];
        if (Kind::any(rests)) flips = flips | (rests & (none > residual(i, next)));
        active[i] = (flips & !active[i]) | (active[i] & !flips);
        changes = changes | flips;
      }
      goes_on = goes_on & changes;
      if (!Kind::any(goes_on)) break;
    }
    DETENT_UNROLL
    for (uint32_t i = 0; i < k_manifold_points_max; ++i) {
      if (i >= count) break;
      add(i,
          select(may[i], Factor(Kind::impulse(impulse[i] + relaxed<Kind>(change[i], relaxation)) - impulse[i]), none));
    }
  }
  void store(const typename Kind::Block& block, typename Kind::Contact& to) const {
    const auto zero = block.real(Number(Kind::zero()));
    DETENT_UNROLL
    for (uint32_t i = 0; i < k_manifold_points_max; ++i) {
      if (i >= count) break;
      auto& total = to.state.normal_impulse[i];
      total = max(total + block.real(added[i]), zero);
      to.impulse_max[i] = max(to.impulse_max[i], total);
    }
  }
  /// Adds up the changes of all points: the impulse along the normal at the middle, and the angular impulse about each
  /// tangent.
  void put(Number& along, Number& about_first, Number& about_second) const {
    along = about_first = about_second = Number(Kind::zero());
    DETENT_UNROLL
    for (uint32_t i = 0; i < k_manifold_points_max; ++i) {
      if (i >= count) break;
      along += added[i];
      about_first += times(held(added[i]), contact.y[i]);
      about_second -= times(held(added[i]), contact.x[i]);
    }
  }

 private:
  void add(uint32_t i, Factor more) {
    impulse[i] += more;
    added[i] += more;
    DETENT_UNROLL
    for (uint32_t k = 0; k < k_manifold_points_max; ++k) velocity[k] += product(more, contact.coupling[i][k]);
  }
  /// Element i of wanted + K change.
  Number residual(uint32_t i, const Factor (&change)[k_manifold_points_max]) const {
    typename Kind::Sum sum = sum_from(Number(wanted[i]), contact.coupling_exponent);
    DETENT_UNROLL
    for (uint32_t k = 0; k < k_manifold_points_max; ++k) sum += product(change[k], contact.coupling[i][k]);
    return rounded(sum, contact.coupling_exponent);
  }
  /// Solves (K + S) change = -wanted for the active points by a factor L D L^T. The changes of the other points that
  /// `may` change set their impulses to 0.
  void solve_active(const Mask (&active)[k_manifold_points_max], Factor (&change)[k_manifold_points_max]) const {
    const Factor none = Kind::zero();
    DETENT_UNROLL
    for (uint32_t i = 0; i < k_manifold_points_max; ++i) {
      if (i < count) change[i] = select(may[i] & !active[i], Factor(-Kind::factor(impulse[i])), none);
    }
    Factor side[k_manifold_points_max];
    Factor lower[k_manifold_points_max][k_manifold_points_max];  // L
    Factor inverse[k_manifold_points_max];                       // 1 / D
    DETENT_UNROLL
    for (uint32_t i = 0; i < k_manifold_points_max; ++i) {
      if (i >= count) break;
      side[i] = select(active[i], Factor(-held(residual(i, change))), none);
      Factor scaled[k_manifold_points_max];  // L D
      Number pivot = Number(Kind::mantissa(contact, i, i)) + softness[i];
      DETENT_UNROLL
      for (uint32_t k = 0; k < i; ++k) {
        typename Kind::Wide sum = Kind::widened(select(active[i] & active[k], Kind::mantissa(contact, i, k), none));
        DETENT_UNROLL
        for (uint32_t m = 0; m < k; ++m) sum -= Kind::wide(scaled[m], lower[k][m]);
        scaled[k] = Kind::held_row(Kind::narrowed(sum));
        lower[i][k] = held(Kind::scaled_product(scaled[k], inverse[k]));
        pivot -= Kind::scaled_product(scaled[k], lower[i][k]);
        side[i] = held(side[i] - Kind::scaled_product(side[k], lower[i][k]));
      }
      inverse[i] = Kind::inverse(pivot);
    }
    for (uint32_t i = count; i-- > 0;) {
      Number solved = held(Kind::quotient(contact, side[i], inverse[i]));
      for (uint32_t k = i + 1; k < count; ++k)
        solved -= Kind::scaled_product(change[k], select(active[k], lower[k][i], none));
      change[i] = select(active[i], held(solved), change[i]);
    }
  }
};

/// The relative motion of a pair while relax() visits the contact, and the wrench that this visit has applied so far.
template <class Kind>
struct Sliding {
  using Number = typename Kind::Number;
  using Factor = typename Kind::Factor;

  const typename Kind::Contact& contact;
  const typename Kind::Block& block;
  Number part[k_parts];
  Number wrench[k_parts];

  Sliding(const typename Kind::Contact& of_pair, const PairMotion<Kind>& motion)
      : contact(of_pair), block(motion.block) {
    const auto velocity = motion.at_middle(contact), turning = motion.turning(contact);
    part[k_along_normal] = rounded(dot(velocity, contact.normal));
    part[k_along_first] = rounded(dot(velocity, contact.tangent[0]));
    part[k_along_second] = rounded(dot(velocity, contact.tangent[1]));
    part[k_about_normal] = rounded(dot(turning, contact.normal));
    part[k_about_first] = rounded(dot(turning, contact.tangent[0]));
    part[k_about_second] = rounded(dot(turning, contact.tangent[1]));
    DETENT_UNROLL
    for (int i = 0; i < k_parts; ++i) wrench[i] = Number(Kind::zero());
  }
  NormalMotion<Kind> normal() const {
    return {held(part[k_along_normal]), held(part[k_about_first]), held(part[k_about_second])};
  }
  /// Applies an impulse along or about the axis `by`, and updates the motion with the column `by` of the response
  /// matrix.
  DETENT_SPECIALISED void act(Part by, Factor more) {
    wrench[by] += more;
    DETENT_UNROLL
    for (int i = 0; i < k_parts; ++i)
      part[i] += times_scaled(more, contact.response[response_index(i, by)], contact.response_exponent);
  }
  /// Sets an accumulated impulse to `after`, and applies the difference.
  DETENT_SPECIALISED void bring(Part by, Factor after, typename Kind::Real& impulse) {
    const Factor more = held(after - block.number(impulse));
    impulse += block.real(Number(more));
    act(by, more);
  }
};

/// A contact and its bodies, in a pass over the contacts of an island.
template <class Kind>
struct ContactSolver {
  using Number = typename Kind::Number;
  using Factor = typename Kind::Factor;

  const StepSettings& settings;
  typename Kind::Contact& contact;
  typename Kind::Body& a;
  typename Kind::Body& b;

  void warm_start() {
    typename Kind::Block block;
    include_impulses(block);
    block.settle();
    const uint32_t count = contact.state.point_count;
    Number wrench[k_parts];
    wrench[k_along_normal] = Number(Kind::zero());
    wrench[k_along_first] = block.number(contact.friction_impulse[0]);
    wrench[k_along_second] = block.number(contact.friction_impulse[1]);
    wrench[k_about_normal] = block.number(contact.angular_impulse[0]);
    wrench[k_about_first] = block.number(contact.angular_impulse[1]);
    wrench[k_about_second] = block.number(contact.angular_impulse[2]);
    for (uint32_t i = 0; i < count; ++i) {
      const Number impulse = block.number(contact.state.normal_impulse[i]);
      wrench[k_along_normal] += impulse;
      wrench[k_about_first] += times(held(impulse), contact.y[i]);
      wrench[k_about_second] -= times(held(impulse), contact.x[i]);
    }
    apply_wrench<Kind>(contact, block, wrench, a, b);
  }

  /// Solves the normal rows. With C the separation now, h the substep, v the velocities and m the effective mass, the
  /// target of a row is:
  ///
  ///     C > 0, speculative: J v >= -C / h: the gap may close, but not become negative
  ///     C <= 0, soft:       J v = -max(rate (C + min(C + deep, 0)) / h, -push_max)
  ///
  /// A soft row is a damped spring (Softness). Each sweep over the contacts changes the impulse of a single soft row by
  ///
  ///     -(m (J v - target) + s impulse) / (1 + s)
  ///
  /// where s is the softness over the row's response: 8 spring_eighth.
  void solve_normals() {
    typename Kind::Block near;
    near.include(contact.separation, contact.state.point_count);
    const PairMotion<Kind> moved(near, b.displacement - a.displacement, a.rotation_vector, b.rotation_vector, 0);
    const NormalMotion<Kind> displacement(moved, contact);
    const uint32_t count = contact.state.point_count;
    const Factor none = Kind::zero();
    const auto soft = Kind::softness(settings, contact);
    Factor push[k_manifold_points_max] = {}, least = none;
    typename Kind::Mask apart[k_manifold_points_max] = {};
    const Factor deep = moved.block.held(contact.deep);
    DETENT_UNROLL
    for (uint32_t i = 0; i < k_manifold_points_max; ++i) {
      if (i >= count) break;
      // The current separation: that at the start of the tick, plus the change by the motion since then, to first
      // order.
      const Factor separation = held(moved.block.number(contact.separation[i]) + displacement.at(contact, i));
      apart[i] = separation > none;
      const Factor overlap = held(separation + min(Factor(held(separation + deep)), none));
      const Factor length = select(apart[i], separation, Factor(held(times(overlap, soft.rate))));
      // A speed divided by 2^rate_exponent, as a number of the block of `moved`.
      push[i] = select(Kind::has_point(contact, i), held(times(length, Kind::unit(settings.rate_mantissa))), none);
      least = min(least, push[i]);
    }
    typename Kind::Block room;
    room.include(contact.state.normal_impulse, count);
    room.include_speed(Factor(-least), moved.block, settings.rate_exponent, contact.push_max);
    const PairMotion<Kind> motion = relative_motion(room);
    const typename Kind::Block& block = motion.block;
    Normals<Kind> normals(contact, block, NormalMotion<Kind>(motion, contact));
    const Factor push_max = block.held(contact.push_max), arrival = block.held(contact.push_max, k_arrival_power);
    DETENT_UNROLL
    for (uint32_t i = 0; i < k_manifold_points_max; ++i) {
      if (i >= count) break;
      push[i] = max(block.converted(push[i], moved.block, settings.rate_exponent), Factor(-push_max));
      const Factor spring = Kind::factor(times(Kind::eightfold(Kind::mantissa(contact, i, i)), soft.spring_eighth));
      const Number pull = Kind::soft_speed(contact, Kind::factor(normals.impulse[i]), spring);
      normals.softness[i] = select(apart[i], normals.softness[i], spring);
      normals.wanted[i] = held(normals.speed(i) + push[i] + select(apart[i], Number(none), pull));
    }
    normals.solve_rows(settings.relaxation);
    DETENT_UNROLL
    for (uint32_t i = 0; i < k_manifold_points_max; ++i) {
      if (i >= normals.count) break;
      // A point whose gap is almost closed counts as in contact.
      contact.apart[i] = Kind::flag(apart[i] & (normals.speed(i) + push[i] - arrival > Number(none)));
    }
    normals.store(block, contact);
    Number along, about_first, about_second;
    normals.put(along, about_first, about_second);
    apply_normal<Kind>(contact, block, along, about_first, about_second, a, b);
  }

  /// Relaxation: solves the normal rows of points in contact with the target J v = 0, which removes the speed that the
  /// springs have added. Then solves friction.
  void relax() {
    typename Kind::Block room;
    include_impulses(room);
    const PairMotion<Kind> motion = relative_motion(room);
    Sliding<Kind> sliding(contact, motion);
    Normals<Kind> normals(contact, motion.block, sliding.normal());
    DETENT_UNROLL
    for (uint32_t i = 0; i < k_manifold_points_max; ++i) {
      if (i >= normals.count) break;
      normals.wanted[i] = held(normals.speed(i));
      // Points that do not come into contact in this substep keep their approach speed.
      const auto touches = Kind::is_unset(contact.apart[i]);
      normals.may[i] = normals.may[i] & (touches | (normals.impulse[i] > Number(Kind::zero())));
    }
    normals.solve_rows(settings.relaxation);
    normals.store(motion.block, contact);
    act_along_normal(normals, sliding);

    // Friction is solved after the normal rows. In the other order, the normal impulses would make a body creep down a
    // slope.
    const Factor normal = normal_impulse(motion.block);
    if (contact.angular_rows == 3) solve_rolling(normal, sliding);
    if (contact.angular_rows != 0) twist(normal, sliding);
    solve_friction(normal, sliding);
    apply_wrench<Kind>(contact, motion.block, sliding.wrench, a, b);
  }

  /// Applies Newton's law of impact (restitution) to the points that approached faster than ContactWork::rebound_min
  /// and had a normal impulse in this tick. Points that rebound together share the impulse: an impulse at a single
  /// point would rotate the body into the other points. Then applies the friction of these impulses, in addition to the
  /// friction of the load.
  void rebound() {
    if (!is_positive(contact.restitution)) return;
    const uint32_t count = contact.state.point_count;
    uint32_t rebounds = 0;  // a bit for each point
    for (uint32_t i = 0; i < count; ++i) {
      if (contact.approach[i] <= -contact.rebound_min && contact.impulse_max[i] != Real(0.0)) rebounds |= 1U << i;
    }
    if (rebounds == 0) return;
    typename Kind::Block room;
    room.include(contact.state.normal_impulse, count);
    room.include(contact.approach, count);
    const PairMotion<Kind> motion = relative_motion(room);
    Sliding<Kind> sliding(contact, motion);
    Normals<Kind> normals(contact, motion.block, sliding.normal());
    for (uint32_t round = 0; round < k_rebound_rounds; ++round) {
      for (uint32_t i = 0; i < count; ++i) {
        normals.may[i] = (rebounds >> i & 1U) != 0;
        normals.wanted[i] =
            held(normals.speed(i) + motion.block.held(multiply(contact.approach[i], contact.restitution)));
      }
      normals.solve_rows(Unit(1.0));
    }
    act_along_normal(normals, sliding);
    // Points that part faster than their target lose impulse. If the contact loses impulse as a whole, it gets no
    // friction.
    const Factor gained = max(held(sliding.wrench[k_along_normal]), Kind::zero());
    typename Kind::Real friction[2] = {Real(0.0), Real(0.0)};
    stop_in_circle(k_along_first, friction, contact.friction_mass, times(gained, contact.friction), sliding);
    apply_wrench<Kind>(contact, motion.block, sliding.wrench, a, b);
    for (uint32_t i = 0; i < count; ++i) {
      // The point separates: no impulse is carried over to the next tick.
      if ((rebounds >> i & 1U) != 0) contact.state.normal_impulse[i] = Real(0.0);
    }
  }

  PairMotion<Kind> relative_motion(const typename Kind::Block& room) const {
    return {room, b.linear_velocity - a.linear_velocity, a.angular_velocity, b.angular_velocity,
            k_angular_velocity_power};
  }

 private:
  void include_impulses(typename Kind::Block& block) const {
    block.include(contact.state.normal_impulse, contact.state.point_count);
    block.include(contact.friction_impulse, 2);
    block.include(contact.angular_impulse, contact.angular_rows);
  }
  Factor normal_impulse(const typename Kind::Block& block) const {
    Number sum = Number(Kind::zero());
    for (uint32_t i = 0; i < contact.state.point_count; ++i) sum += block.number(contact.state.normal_impulse[i]);
    return held(sum);
  }

  /// Applies the changes of the normal impulses to the motion.
  void act_along_normal(const Normals<Kind>& normals, Sliding<Kind>& sliding) const {
    Number along, about_first, about_second;
    normals.put(along, about_first, about_second);
    sliding.act(k_along_normal, held(along));
    sliding.act(k_about_first, held(about_first));
    sliding.act(k_about_second, held(about_second));
  }

  /// Returns the accumulated impulse that stops one part of the motion.
  template <class Mass>
  DETENT_SHARED Factor stopped(const Sliding<Kind>& sliding, Part by, const typename Kind::Real& impulse,
                               const Mass& mass) const {
    return held(sliding.block.number(impulse) -
                relaxed<Kind>(times(held(sliding.part[by]), mass), settings.relaxation));
  }
  /// Stops two parts of the motion. The vector of their accumulated impulses is limited to the circle of radius
  /// `radius`. Because both parts have the same effective mass, the impulse of a sliding contact opposes its velocity.
  template <class Mass>
  DETENT_SPECIALISED void stop_in_circle(Part first, typename Kind::Real* impulse, const Mass& mass, Factor radius,
                                         Sliding<Kind>& sliding) {
    const Part second = static_cast<Part>(first + 1);
    Factor after[2] = {stopped(sliding, first, impulse[0], mass), stopped(sliding, second, impulse[1], mass)};
    clamp_to_circle(after, radius);
    sliding.bring(first, after[0], impulse[0]);
    sliding.bring(second, after[1], impulse[1]);
  }
  /// Solves rolling friction: stops the angular velocity about the tangents, within the limit of the impulse.
  void solve_rolling(Factor normal, Sliding<Kind>& sliding) {
    stop_in_circle(k_about_first, contact.angular_impulse + 1, contact.rolling_mass, times(normal, contact.rolling_arm),
                   sliding);
  }
  /// Solves twist friction: stops the angular velocity about the normal, within the limit of the impulse.
  void twist(Factor normal, Sliding<Kind>& sliding) {
    const Factor limit = times(normal, contact.twist_arm);
    const Factor step = stopped(sliding, k_about_normal, contact.angular_impulse[0], contact.twist_mass);
    sliding.bring(k_about_normal, clamp(step, Factor(-limit), limit), contact.angular_impulse[0]);
  }
  /// Solves sliding friction: stops the velocity along the tangents, within the friction cone.
  void solve_friction(Factor normal, Sliding<Kind>& sliding) {
    stop_in_circle(k_along_first, contact.friction_impulse, contact.friction_mass, times(normal, contact.friction),
                   sliding);
  }
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
