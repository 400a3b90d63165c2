#include "solver/solve.h"

#include "base/binary_search.h"
#include "base/processor.h"
#include "joint/joint.h"
#include "motion/angular_velocity.h"
#include "motion/inverse_inertia.h"
#include "solver/contact_order.h"
#include "solver/contact_rows.h"
#include "solver/contact_solver.h"
#include "solver/post_stabilise.h"
#include "solver/solve_lanes.h"
#include "solver/warm_start.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// Applies gravity, forces, torques and damping. From the second substep of a tick on, it also applies the contact
/// impulses of the last substep: the warm start of all contacts of a body at once.
uint32_t integrate_velocities(const SolverBodies& bodies, Span<const uint32_t> island, bool first, bool touches) {
  const Scaled one = 1.0;
  uint32_t clamped = 0;
  for (const uint32_t slot : island) {
    BodyMotion& motion = bodies.motions[slot];
    BodyWork& now = bodies.work[slot];
    const Vec3<Real> pushed = first ? k_zero_vector : added_by_contacts(motion.linear_velocity, now.contact_velocity);
    const Vec3<Real> turned =
        first ? k_zero_vector : added_by_contacts(motion.angular_momentum, now.contact_angular_momentum);
    motion.linear_velocity += now.push;
    motion.angular_momentum += now.twist;
    if (!(now.linear_kept == one)) motion.linear_velocity = multiply(motion.linear_velocity, now.linear_kept);
    if (!(now.angular_kept == one)) motion.angular_momentum = multiply(motion.angular_momentum, now.angular_kept);
    now.contact_velocity = kept_at_start(motion.linear_velocity, pushed);
    now.contact_angular_momentum = kept_at_start(motion.angular_momentum, turned);
    motion.linear_velocity += pushed;
    motion.angular_momentum += turned;
    clamped += clamp_vector(motion.linear_velocity, k_speed_work_max) +
               clamp_vector(motion.angular_momentum, k_angular_velocity_work_max);
    // Only contacts read BodyWork::angular_velocity.
    if (touches) renew_angular_velocity(bodies.properties[slot], motion, now);
  }
  return clamped;
}

uint32_t rotate(const BodyProperties& properties, const BodyMotion& motion, Real time, int halvings, BodyWork& now) {
  if (motion.angular_momentum == Vec3<Real>{k_zero, k_zero, k_zero}) return 0;
  Vec3<Real> angular_velocity;
  const bool whole = rotate_freely(properties, now.free_rotation, motion.angular_momentum, time, halvings, now.rotation,
                                   angular_velocity);
  now.rotation_vector += angular_velocity * time;
  return whole ? 0 : 1;
}

uint32_t integrate_positions(const SolverBodies& bodies, Span<const uint32_t> island, Real time, int halvings = 0) {
  uint32_t clamped = 0;
  for (const uint32_t slot : island) {
    const BodyMotion& motion = bodies.motions[slot];
    BodyWork& now = bodies.work[slot];
    // A body in free flight, without contact and joint impulses, moves at the mean of its velocities before and after
    // gravity and forces have acted in the substep.
    const bool flies =
        now.joint_body == k_no_link && added_by_contacts(motion.linear_velocity, now.contact_velocity) == k_zero_vector;
    now.displacement += (flies ? motion.linear_velocity - scale_by_power(now.push, -1) : motion.linear_velocity) * time;
    clamped += rotate(bodies.properties[slot], motion, time, halvings, now);
  }
  return clamped;
}

/// Limits of the number of rounds per substep in which contacts and joints are solved alternately. After k_joint_rounds
/// rounds, further rounds follow, up to k_joint_rounds_max, only while a round changes velocities as much as an impact
/// does.
constexpr uint32_t k_joint_rounds = 4, k_joint_rounds_max = 16;

/// Stores the bodies' current velocities, for has_settled().
void remember(const SolverBodies& bodies, Span<const uint32_t> island) {
  for (const uint32_t slot : island) bodies.work[slot].velocity_before = bodies.motions[slot].linear_velocity;
}

/// Whether no component of a linear velocity has changed by more than `enough`, m/s, since remember().
bool has_settled(const SolverBodies& bodies, Span<const uint32_t> island, Real enough) {
  for (const uint32_t slot : island) {
    const Vec3<Real> change = bodies.motions[slot].linear_velocity - bodies.work[slot].velocity_before;
    if (greatest(change) > enough) return false;
  }
  return true;
}

/// Whether two contacts may be solved at once: they have the same colour and number of angular rows, and both have one
/// point or both have more.
bool may_be_solved_at_once(const ContactOrder& a, const ContactOrder& b) {
  const bool single_a = (a.kind & k_point_mask) == 1, single_b = (b.kind & k_point_mask) == 1;
  return a.colour == b.colour && a.kind >> k_rows_shift == b.kind >> k_rows_shift && single_a == single_b;
}

/// Returns how many contacts at the start of `order` may be solved at once: at least 1.
uint32_t solved_at_once(const StepSettings& settings, Span<const ContactOrder> order) {
  if (order[0].colour == k_colour_overflow) return 1;
  uint32_t count = 1;
  while (count < settings.lanes && count < order.count && may_be_solved_at_once(order[0], order[count])) ++count;
  return count;
}

void put_groups_in_lanes(const StepSettings& settings, const SolverBodies& bodies, const IslandContacts& all) {
  share(settings.team, all.order.count, k_contacts_shared, [&](uint32_t first, uint32_t last) {
    for (uint32_t i = first; i < last; ++i) {
      const uint32_t count = group_size(all.order[i]);
      if (count > 1) put_in_lanes(bodies, all.contacts, {all.order.data + i, count}, &all.lanes[all.order[i].key]);
    }
  });
}

/// Marks the groups of contacts that are solved at once, and puts them into lanes. A group takes whole LaneSpaces, even
/// if it leaves lanes empty. A group is made smaller if fewer LaneSpaces would remain than one for each four later
/// contacts.
void put_all_in_lanes(const StepSettings& settings, const SolverBodies& bodies, const IslandContacts& all) {
  if (!uses_lanes(settings)) return;
  uint32_t used = 0;
  for (uint32_t i = 0, count = 0; i < all.order.count; i += count) {
    ContactOrder* const group = all.order.data + i;
    const uint32_t rest = all.order.count - i;
    count = solved_at_once(settings, {group, rest});
    while (count > 1 && used + lane_spaces(count) + (rest - count) / 4 > all.lanes.count) count = count > 4 ? 4 : 1;
    if (count == 1) continue;
    for (uint32_t k = 0; k < count; ++k)
      group[k].kind |= static_cast<uint16_t>((k == 0 ? count : k_in_group) << k_group_shift);
    group[0].key = used;
    used += lane_spaces(count);
  }
  put_groups_in_lanes(settings, bodies, all);
}

void take_all_from_lanes(const StepSettings& settings, const IslandContacts& all) {
  if (!uses_lanes(settings)) return;
  share(settings.team, all.order.count, k_contacts_shared, [&](uint32_t first, uint32_t last) {
    for (uint32_t i = first; i < last; ++i) {
      const uint32_t count = group_size(all.order[i]);
      if (count > 1) take_from_lanes(&all.lanes[all.order[i].key], count, all.contacts);
    }
  });
}

/// Limits the warm start of each island in `islands`, which lists the bodies of islands that are solved together.
void limit_warm_starts(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> islands,
                       const IslandContacts& all) {
  bool limited = false;
  for (uint32_t i = 0, count = 0; i < islands.count; i += count) {
    const auto island_at = [&](uint32_t at) { return bodies.work[islands[at]].island; };
    for (count = 1; i + count < islands.count && island_at(i + count) == island_at(i);) ++count;
    if (limit_warm_start(bodies, {islands.data + i, count})) limited = true;
  }
  if (!limited) return;
  take_all_from_lanes(settings, all);
  for (const ContactOrder& entry : all.order) {
    ContactWork& contact = all.contacts[entry.contact];
    const uint32_t a = contact.state.body_a, b = contact.state.body_b;
    const BodyWork& body = bodies.work[is_dynamic(bodies.properties[a]) ? a : b];
    if (body.supports != 0) scale_impulses(body.carried, contact);
  }
  if (uses_lanes(settings)) put_groups_in_lanes(settings, bodies, all);
}

/// The functions by which a pass processes a single contact, and a group of contacts in lanes.
struct ContactPass {
  void (*one)(ContactSolver<One>& contact);
  void (*group)(const StepSettings& settings, const SolverBodies& bodies, LaneSpace* lanes, uint32_t count);
};

/// One pass over the contacts from `first` to before `last`, in their order. A group of contacts takes part if its
/// first contact is in this range.
void pass_in_order(const StepSettings& settings, const SolverBodies& bodies, const IslandContacts& all, uint32_t first,
                   uint32_t last, const ContactPass& pass) {
  for (uint32_t i = first; i < last; ++i) {
    const ContactOrder& entry = all.order[i];
    const uint32_t count = uses_lanes(settings) ? group_size(entry) : 0;
    if (count != 0) {
      if (count != k_in_group) pass.group(settings, bodies, &all.lanes[entry.key], count);
      continue;
    }
    ContactWork& contact = all.contacts[entry.contact];
    const uint32_t a = contact.state.body_a, b = contact.state.body_b;
    SolvedBody body_a(bodies.motions[a], bodies.work[a]), body_b(bodies.motions[b], bodies.work[b]);
    ContactSolver<One> solver = {settings, contact, body_a, body_b};
    pass.one(solver);
  }
}

/// The number of contacts at the start of `order` that have the same colour.
uint32_t colour_count(Span<const ContactOrder> order) {
  return partition_point(order.count, [&](uint32_t i) { return order[i].colour == order[0].colour; });
}

/// One pass over all contacts of an island. Threads share the contacts of each colour, because these have no dynamic
/// body in common. One thread solves the contacts of k_colour_overflow.
void pass_over(const StepSettings& settings, const SolverBodies& bodies, const IslandContacts& all,
               const ContactPass& pass) {
  if (settings.team == nullptr) {
    pass_in_order(settings, bodies, all, 0, all.order.count, pass);
    return;
  }
  for (uint32_t i = 0; i < all.order.count;) {
    const uint32_t count = colour_count({all.order.data + i, all.order.count - i});
    Team* const team = all.order[i].colour == k_colour_overflow ? nullptr : settings.team;
    share(team, count, k_contacts_shared,
          [&](uint32_t first, uint32_t last) { pass_in_order(settings, bodies, all, i + first, i + last, pass); });
    i += count;
  }
}

/// Sets the displacement and rotation of a kinematic body at `time`, s, after the start of the tick.
/// BodyMotion::angular_momentum of a kinematic body is its angular velocity.
void place_kinematic(const BodyProperties& properties, const BodyMotion& motion, Real time, BodyWork& now) {
  if (!is_kinematic(properties)) return;
  now.displacement = motion.linear_velocity * time;
  now.rotation_vector = motion.angular_momentum * time;
}

/// Recomputes the responses of contacts whose bodies have joints, so that contacts and joints use the same inertias.
void renew_responses(const StepSettings& settings, const SolverBodies& bodies, const JointStage& stage,
                     const IslandContacts& all) {
  uint32_t start = 0;  // index of the first contact of the current group
  bool renewed = false;
  for (uint32_t i = 0; i < all.order.count; ++i) {
    ContactWork& contact = all.contacts[all.order[i].contact];
    const uint32_t a = contact.state.body_a, b = contact.state.body_b;
    if (group_size(all.order[i]) != k_in_group) {
      start = i;
      renewed = false;
    }
    if (has_renewed_inverse_inertia(bodies.work[a], stage) || has_renewed_inverse_inertia(bodies.work[b], stage)) {
      renew_response(bodies.work[a].inverse_inertia, bodies.work[b].inverse_inertia, contact);
      renewed = true;
    }
    const uint32_t count = uses_lanes(settings) ? group_size(all.order[start]) : 0;
    if (i + 1 == start + count && renewed) renew_lanes(bodies, all.contacts, &all.lanes[all.order[start].key], count);
  }
}

}  // namespace

#if DETENT_QUADS
uint32_t lanes_of_machine() {
#if DETENT_WIDE_LANES
  if (has_avx512()) return 8;
  return has_avx2_and_fma() ? 4 : 1;
#elif defined(__x86_64__)
  return has_avx2_and_fma() ? k_lanes_max : 1;
#else
  return k_lanes_max;
#endif
}
#endif

bool has_kinematic_contact(Span<const BodyProperties> properties, Span<const ContactOrder> order,
                           Span<const ContactWork> contacts) {
  for (const ContactOrder& entry : order) {
    const ContactWork& contact = contacts[entry.contact];
    if (contact.static_pair != 0 &&
        (is_kinematic(properties[contact.state.body_a]) || is_kinematic(properties[contact.state.body_b])))
      return true;
  }
  return false;
}

SolveCount solve(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> island,
                 const IslandContacts& all, const IslandJoints& joints) {
  using Solver = ContactSolver<One>;
  constexpr ContactPass k_warm_start = {[](Solver& contact) { contact.warm_start(); }, warm_start_lanes};
  constexpr ContactPass k_solve_normals = {[](Solver& contact) { contact.solve_normals(); }, solve_normals_lanes};
  constexpr ContactPass k_relax = {[](Solver& contact) { contact.relax(); }, relax_lanes};
  constexpr ContactPass k_rebound = {[](Solver& contact) { contact.rebound(); }, nullptr};
  SolveCount count;
  const Span<const ContactOrder> order = all.order;
  put_all_in_lanes(settings, bodies, all);
  Real elapsed = 0.0;
  const Real enough = scale_by_power(settings.gravity_size * settings.time, -static_cast<int>(settings.convergence));
  const Real enough_for_joints = scale_by_power(settings.gravity_size * settings.time, -2);
  const Real less_than_impact = scale_by_power(settings.gravity_size * settings.time, 2);
  /// Sweeps over the contacts, at most settings.iterations times. Ends when no velocity changes by more than `enough`
  /// in a sweep.
  const auto sweep = [&](const ContactPass& of) {
    for (uint32_t iteration = 1;; ++iteration) {
      const bool last = iteration == settings.iterations;
      if (!last) remember(bodies, island);
      pass_over(settings, bodies, all, of);
      if (last) return;
      if (has_settled(bodies, island, enough)) {
        count.sweeps_saved += settings.iterations - iteration;
        return;
      }
    }
  };
  /// Stores the velocities of the bodies, then sweeps over the contacts `times` times.
  const auto sweep_times = [&](uint32_t times, const ContactPass& of) {
    remember(bodies, island);
    for (uint32_t left = times; left > 0; --left) pass_over(settings, bodies, all, of);
  };
  const bool kinematic = !DETENT_TASKS || has_kinematic_contact(bodies.properties, order, all.contacts);
  for (uint32_t substep = 0; substep < settings.substeps; ++substep) {
    if (joints.code != nullptr) {
      joints.code->begin(settings, bodies, *joints.island, elapsed, *joints.stage);
      renew_responses(settings, bodies, *joints.stage, all);
    }
    count.clamped += share_sum(settings.team, island, k_bodies_shared, [&](Span<const uint32_t> slots) {
      return integrate_velocities(bodies, slots, substep == 0, order.count != 0);
    });
    if (substep == 0)
      pass_over(settings, bodies, all, k_warm_start);
    else if (joints.code == nullptr)
      limit_warm_starts(settings, bodies, island, all);
    for (const ContactOrder& entry : kinematic ? order : order.first(0)) {
      const ContactWork& contact = all.contacts[entry.contact];
      if (contact.static_pair == 0) continue;
      const uint32_t a = contact.state.body_a, b = contact.state.body_b;
      place_kinematic(bodies.properties[a], bodies.motions[a], elapsed, bodies.work[a]);
      place_kinematic(bodies.properties[b], bodies.motions[b], elapsed, bodies.work[b]);
    }
    if (joints.code == nullptr) {
      sweep(k_solve_normals);
    } else {
      const Island& own = *joints.island;
      JointStage& stage = *joints.stage;
      uint32_t& undecided = count.undecided;
      count.clamped += joints.code->solve(settings, bodies, own, elapsed, stage, undecided);
      for (uint32_t round = 1; round <= k_joint_rounds_max && order.count != 0; ++round) {
        sweep_times(round == 1 ? settings.iterations + 1 : 1, k_solve_normals);
        if (has_settled(bodies, island, enough)) break;
        const bool last = has_settled(bodies, island, round < k_joint_rounds ? enough_for_joints : less_than_impact);
        count.clamped += joints.code->solve_again(settings, bodies, own, elapsed, enough, stage, undecided);
        if (last) break;
      }
      count.clamped += joints.code->follow(settings, bodies, own, elapsed, stage);
    }
    count.clamped += share_sum(settings.team, island, k_bodies_shared, [&](Span<const uint32_t> slots) {
      return integrate_positions(bodies, slots, settings.time);
    });
    if (joints.code == nullptr) {
      sweep(k_relax);
    } else {
      count.clamped += joints.code->shift(bodies, *joints.island, *joints.stage);
      sweep_times(settings.iterations, k_relax);
      count.clamped +=
          joints.code->end(settings, bodies, *joints.island, elapsed, enough, *joints.stage, count.undecided);
    }
    elapsed += settings.time;
  }
  take_all_from_lanes(settings, all);
  StepSettings one_by_one = settings;
  one_by_one.lanes = 1;
  if (joints.code != nullptr) renew_responses(one_by_one, bodies, *joints.stage, all);
  pass_over(one_by_one, bodies, all, k_rebound);
  if (settings.post_stabilises) count.clamped += post_stabilise(settings, bodies, island, order, all.contacts);
  return count;
}

uint32_t integrate_free(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> island) {
  constexpr int k_halvings = 2;
  uint32_t clamped = 0;
  for (uint32_t substep = 0; substep < settings.substeps; ++substep) {
    clamped += integrate_velocities(bodies, island, true, false);
    clamped += integrate_positions(bodies, island, settings.time, k_halvings);
  }
  return clamped;
}

uint32_t integrate_kinematic(const StepSettings& settings, const SolverBodies& bodies) {
  uint32_t clamped = 0;
  for (uint32_t slot = 0; slot < bodies.properties.count; ++slot) {
    const BodyProperties& properties = bodies.properties[slot];
    if (!is_kinematic(properties)) continue;
    BodyWork& now = bodies.work[slot];
    place_kinematic(properties, bodies.motions[slot], settings.tick_time, now);
    Vec3<Real> angular_velocity;
    if (!rotate_freely(properties, now.free_rotation, bodies.motions[slot].angular_momentum, settings.tick_time, 0,
                       now.rotation, angular_velocity))
      ++clamped;
  }
  return clamped;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
