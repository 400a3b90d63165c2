#pragma once
#include "motion/contact_motion.h"
#include "motion/step_settings.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// A point counts as in contact if its approach speed is at most k_arrival push_max below the speed that closes its
/// gap.
inline constexpr Unit k_arrival = 1.0 / 512;
/// Largest numbers of sweeps over the points of a contact. The sweeps end earlier if no impulse changes by more than
/// k_settled times the greatest impulse.
inline constexpr int k_normal_sweeps = 8, k_relax_sweeps = 8;
inline constexpr Unit k_settled = 0x1p-14;

/// The normal rows of a contact in one pass over its points. The motions of the bodies are read when the pass begins,
/// and written when it ends.
template <class Kind>
struct Normals {
  using Number = typename Kind::Number;
  using Factor = typename Kind::Factor;

  const typename Kind::Contact& contact;
  const uint32_t count;
  /// Normal velocity of each point, updated with each impulse.
  typename Kind::Sum velocity[k_manifold_points_max];
  Number impulse[k_manifold_points_max];  ///< accumulated normal impulses, updated with each change
  Number added[k_manifold_points_max];

  Normals(const typename Kind::Contact& of_pair, const typename Kind::Block& block, const NormalMotion<Kind>& motion)
      : contact(of_pair), count(of_pair.state.point_count) {
    DETENT_UNROLL
    for (uint32_t i = 0; i < k_manifold_points_max; ++i) {
      velocity[i] = sum_from(motion.at(contact, i), contact.coupling_exponent);
      impulse[i] = block.number(contact.state.normal_impulse[i]);
      added[i] = Kind::zero();
    }
  }
  Number speed(uint32_t i) const { return rounded(velocity[i], contact.coupling_exponent); }
  /// Subtracts `less` from the impulse at point i, which stays at least 0. Returns the change of the impulse.
  Factor change(uint32_t i, Number less) {
    const Factor more = held(max(impulse[i] - less, Number(Kind::zero())) - impulse[i]);
    impulse[i] += more;
    added[i] += more;
    DETENT_UNROLL
    for (uint32_t k = 0; k < k_manifold_points_max; ++k) velocity[k] += product(more, contact.coupling[i][k]);
    return more;
  }
  /// Sweeps over the points, and subtracts less(i) from the impulse of each point i, until the changes are small.
  template <class Less>
  void solve(int sweeps, const Less& less) {
    const Number none = Number(Kind::zero());
    auto goes_on = Kind::all();
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      Number most = none, total = none;
      DETENT_UNROLL
      for (uint32_t i = 0; i < k_manifold_points_max; ++i) {
        if (i >= count) break;
        const Number more = change(i, select(goes_on, less(i), none));
        most = max(most, max(more, Number(-more)));
        total = max(total, impulse[i]);
      }
      goes_on = goes_on & (most > times(held(total), Kind::unit(k_settled)));
      if (count == 1 || !Kind::any(goes_on)) break;
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
};

/// The relative motion of a pair in the pass with friction, and the wrench that this pass has applied to the pair.
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
  /// Applies an impulse along or about one axis, and updates the motion with that column of the response matrix.
  template <Part by>
  void act(Factor more) {
    wrench[by] += more;
    DETENT_UNROLL
    for (int i = 0; i < k_parts; ++i)
      part[i] += times_scaled(more, contact.response[response_index(i, by)], contact.response_exponent);
  }
  /// Sets an accumulated impulse to `after`, and applies the difference.
  template <Part by>
  void bring(Factor after, typename Kind::Real& impulse) {
    const Factor more = held(after - block.number(impulse));
    impulse += block.real(Number(more));
    act<by>(more);
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
  ///     C <= 0, soft:       J v = -max(rate C / h, -push_max)
  ///
  /// A soft row is a damped spring (Softness). Each sweep changes its impulse by
  ///
  ///     -(mass_scale m (J v - target) + impulse_scale impulse)
  void solve_normals() {
    typename Kind::Block near;
    near.include(contact.separation, contact.state.point_count);
    const PairMotion<Kind> moved(near, b.displacement - a.displacement, a.rotation_vector, b.rotation_vector, 0);
    const NormalMotion<Kind> displacement(moved, contact);
    typename Kind::Block room;
    room.include(contact.state.normal_impulse, contact.state.point_count);
    const PairMotion<Kind> motion = relative_motion(room);
    const typename Kind::Block& block = motion.block;
    Normals<Kind> normals(contact, block, NormalMotion<Kind>(motion, contact));
    const Factor none = Kind::zero(), push_max = block.held(contact.push_max);
    const Factor arrival = held(times(push_max, Kind::unit(k_arrival)));
    const auto soft = Kind::softness(settings, contact);
    Factor push[k_manifold_points_max];
    typename Kind::Mask apart[k_manifold_points_max];
    DETENT_UNROLL
    for (uint32_t i = 0; i < k_manifold_points_max; ++i) {
      push[i] = none;
      apart[i] = Kind::all();
      if (i >= normals.count) continue;
      // The current separation: that at the start of the tick, plus the change by the motion since then, to first
      // order.
      const Factor separation = held(moved.block.number(contact.separation[i]) + displacement.at(contact, i));
      apart[i] = separation > none;
      const Factor length = select(apart[i], separation, Factor(held(times(separation, soft.rate))));
      const Factor speed =
          block.converted(held(times(length, Kind::unit(settings.rate_mantissa))), moved.block, settings.rate_exponent);
      push[i] = select(apart[i], speed, max(speed, Factor(-push_max)));
    }
    normals.solve(k_normal_sweeps, [&](uint32_t i) {
      const Factor step = held(times(held(normals.speed(i) + push[i]), contact.inverse_mass[i]));
      const Number softly = times(step, soft.mass_scale) + times(held(normals.impulse[i]), soft.impulse_scale);
      return relaxed(select(apart[i], Number(step), softly));
    });
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

  /// Relaxation: removes the speed that the springs have added, with the target J v = 0 for points in contact, then
  /// solves friction.
  void relax() {
    typename Kind::Block room;
    include_impulses(room);
    const PairMotion<Kind> motion = relative_motion(room);
    Sliding<Kind> sliding(contact, motion);
    Normals<Kind> normals(contact, motion.block, sliding.normal());
    // Points that do not come into contact in this substep keep their approach speed.
    normals.solve(k_relax_sweeps, [&](uint32_t i) {
      const Number none = Number(Kind::zero());
      const auto meets = Kind::is_unset(contact.apart[i]) | (normals.impulse[i] > none);
      return select(meets, relaxed(times(held(normals.speed(i)), contact.inverse_mass[i])), none);
    });
    normals.store(motion.block, contact);
    Number along, about_first, about_second;
    normals.put(along, about_first, about_second);
    sliding.template act<k_along_normal>(held(along));
    sliding.template act<k_about_first>(held(about_first));
    sliding.template act<k_about_second>(held(about_second));

    // Friction is solved after the normal rows. In the other order, the normal impulses would make a body creep down a
    // slope.
    const Factor normal = normal_impulse(motion.block);
    if (contact.angular_rows == 3) solve_rolling(normal, sliding);
    if (contact.angular_rows != 0) twist(normal, sliding);
    solve_friction(normal, sliding);
    apply_wrench<Kind>(contact, motion.block, sliding.wrench, a, b);
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

  /// Returns the accumulated impulse that stops one part of the motion.
  template <class Mass>
  Factor stopped(const Sliding<Kind>& sliding, Part by, const typename Kind::Real& impulse, const Mass& mass) const {
    return held(sliding.block.number(impulse) - relaxed(times(held(sliding.part[by]), mass)));
  }
  /// Stops two parts of the motion, with accumulated impulses limited to a circle.
  template <Part first, Part second, class Mass>
  void stop_in_circle(typename Kind::Real* impulse, const Mass* mass, Factor radius, Sliding<Kind>& sliding) {
    Factor after[2] = {stopped(sliding, first, impulse[0], mass[0]), stopped(sliding, second, impulse[1], mass[1])};
    clamp_to_circle(after, radius);
    sliding.template bring<first>(after[0], impulse[0]);
    sliding.template bring<second>(after[1], impulse[1]);
  }
  /// Solves rolling friction: it stops the angular velocity about the tangents, within its limit.
  void solve_rolling(Factor normal, Sliding<Kind>& sliding) {
    stop_in_circle<k_about_first, k_about_second>(contact.angular_impulse + 1, contact.angular_mass + 1,
                                                  times(normal, contact.rolling_arm), sliding);
  }
  /// Solves twist friction: it stops the angular velocity about the normal, within its limit.
  void twist(Factor normal, Sliding<Kind>& sliding) {
    const Factor limit = times(normal, contact.twist_arm);
    const Factor step = stopped(sliding, k_about_normal, contact.angular_impulse[0], contact.angular_mass[0]);
    sliding.template bring<k_about_normal>(clamp(step, Factor(-limit), limit), contact.angular_impulse[0]);
  }
  /// Solves sliding friction: it stops the velocity along the tangents, within the friction cone.
  void solve_friction(Factor normal, Sliding<Kind>& sliding) {
    stop_in_circle<k_along_first, k_along_second>(contact.friction_impulse, contact.friction_mass,
                                                  times(normal, contact.friction), sliding);
  }

  Number relaxed(Number change) const {
    return settings.relaxation == Unit(1.0) ? change : Number(times(held(change), Kind::unit(settings.relaxation)));
  }
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
