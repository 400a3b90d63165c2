#include "solver/substeps.h"

#include "base/heap.h"
#include "math/root.h"
#include "math/scaled.h"
#include "solver/island.h"
#include "solver/warm_start.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// The numbers of substeps that an island can have. If the limit of the island lies between two of these numbers, the
/// island can have the limit, too.
constexpr uint32_t k_notches[] = {1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64};
/// The number of substeps decreases only to a number whose square is at least k_in_hand times the squared number that
/// the contacts need.
constexpr Scaled k_in_hand = 1.0 / 0.6;
/// The least number of bodies of a run that can buckle: a shorter run sinks before it buckles.
constexpr uint32_t k_run_min = 3;
constexpr uint32_t k_contact_substeps_min = 2;  ///< least number of substeps for islands with contacts

Scaled square_of(uint32_t n) {
  const Scaled scaled = scaled_from_count(n);
  return multiply(scaled, scaled);
}

/// The squared number of substeps that the contact needs for its sag and against buckling. `extent`: of the smaller
/// body. In an island with joints (`jointed`), the sag requires at most k_jointed_sag_substeps.
Scaled needed(const StepSettings& settings, const ContactWork& contact, Real extent, uint32_t run, bool jointed) {
  Real masses = 0.0;
  for (uint32_t i = 0; i < contact.state.point_count; ++i) masses += real_from_unit(contact.normal_mass[i], 0);
  if (!(masses > k_zero)) return Scaled(0.0);
  // The springs of a contact with only one dynamic body have twice the frequency.
  const Scaled effective_mass = scaled_by_power(scaled_from(masses), contact.static_pair != 0 ? 2 : 0);
  const Scaled load = scaled_from(contact.state.load);
  const Scaled rate = multiply(divide(load, multiply(effective_mass, scaled_from(extent))), settings.substeps_per_rate);
  Scaled sag = divide(rate, settings.resting_penetration);
  if (jointed) {
    const Scaled sag_max = square_of(k_jointed_sag_substeps);
    if (less(sag_max, sag)) sag = sag_max;
  }
  if (run < k_run_min) return sag;
  const Scaled buckling = multiply(rate, square_of(run));
  return less(sag, buckling) ? buckling : sag;
}

/// The smallest entry of k_notches that is at least `least`, below `most`, and whose square is at least `need`. Returns
/// `most` if there is no such entry.
DETENT_SHARED uint32_t notch_for(Scaled need, uint32_t least, uint32_t most) {
  for (const uint32_t notch : k_notches) {
    if (notch < least) continue;
    if (notch >= most) break;
    if (!less(scaled_from_count(notch * notch), need)) return notch;
  }
  return most;
}

uint32_t most_for(const StepSettings& settings, const Island& island, const SubstepLimit& limit) {
  const uint32_t rows = island.contact_count + k_joint_contacts * island.joint_count;
  const uint32_t share = rows == 0 ? limit.contact_substeps : limit.contact_substeps / rows;
  const uint32_t always = island.joint_count != 0 ? k_jointed_sag_substeps : limit.always;
  const uint32_t most = share < always ? always : share;
  return most < settings.substeps_max ? most : settings.substeps_max;
}

uint32_t next_below(uint32_t substeps, uint32_t least) {
  uint32_t below = least;
  for (const uint32_t notch : k_notches) {
    if (notch > least && notch < substeps) below = notch;
  }
  return below;
}

/// Scales a contact's impulses, which were stored in a tick with `before` substeps, for a tick with `now` substeps.
void rescale(uint32_t before, uint32_t now, ContactWork& contact) {
  if (before == now || before == 0) return;
  scale_impulses(divide(scaled_from_count(before), scaled_from_count(now)), contact);
}

/// upper_body() returns this if neither body of a contact lies on the other one.
constexpr uint32_t k_neither = UINT32_MAX;
uint32_t upper_body(const Vec3<Unit>& down, const ContactWork& contact) {
  const Unit slope = dot(down, contact.normal);
  if (abs(slope) < Unit(0.25)) return k_neither;
  return slope > Unit(0.0) ? contact.state.body_a : contact.state.body_b;
}

/// Initialises the members of BodyWork for the estimate of loads: height, carried mass, and 0 supports.
void weigh(Span<const BodyPose> poses, Span<const BodyProperties> properties, Span<const uint32_t> bodies,
           const Vec3<Unit>& down, Span<BodyWork> work) {
  const Position& origin = poses[bodies[0]].position;
  for (const uint32_t slot : bodies) {
    const Position& at = poses[slot].position;
    work[slot].height = dot(real_difference(origin, at), down);
    work[slot].carried = properties[slot].mass;
    work[slot].supports = 0;
  }
}

/// Divides each body's load equally among the bodies that it rests on, from the top down.
void hand_down(Span<const BodyProperties> properties, const Vec3<Unit>& down, Span<const ContactOrder> order,
               Span<ContactOrder> spare, Span<BodyWork> work, Span<ContactWork> contacts) {
  uint32_t count = 0;
  for (const ContactOrder& entry : order) {
    const uint32_t upper = upper_body(down, contacts[entry.contact]);
    if (upper == k_neither || !is_dynamic(properties[upper])) continue;
    ++work[upper].supports;
    spare[count] = entry;
    spare[count++].island = upper;
  }
  heap_sort(spare.first(count), [&](const ContactOrder& a, const ContactOrder& b) {
    const Real height_a = work[a.island].height, height_b = work[b.island].height;
    return height_b < height_a || (height_a == height_b && a.contact < b.contact);
  });
  for (const ContactOrder& entry : spare.first(count)) {
    const ContactState& state = contacts[entry.contact].state;
    const uint32_t upper = entry.island, lower = upper == state.body_a ? state.body_b : state.body_a;
    if (!is_dynamic(properties[lower])) continue;
    BodyWork& below = work[lower];
    below.carried = add(below.carried, divide(work[upper].carried, scaled_from_count(work[upper].supports)));
  }
}

}  // namespace

void choose_substeps(const StepSettings& settings, Span<const BodyProperties> properties, Span<BodyWork> work,
                     Span<const uint32_t> bodies, Span<const ContactOrder> order, Span<Island> islands,
                     Span<ContactWork> contacts, Span<BodyActivity> activities) {
  for (Island& island : islands) {
    const bool jointed = island.joint_count != 0;
    const uint32_t alone = island.contact_count != 0 ? k_contact_substeps_min : 1;
    const uint32_t least = alone < island.substeps ? island.substeps : alone;
    const uint32_t for_joints = jointed ? notch_for(island.joint_need, least, settings.substeps_max) : 0;
    Scaled need[2] = {0.0, 0.0};  // largest need: of contacts on edges and faces; of rolling contacts
    bool kinematic = false;
    for (uint32_t i = 0; i < island.contact_count; ++i) {
      const ContactWork& contact = contacts[order[island.first_contact + i].contact];
      const uint32_t a = contact.state.body_a, b = contact.state.body_b;
      const uint32_t body = is_dynamic(properties[a]) ? a : b;
      if (is_kinematic(properties[a + b - body])) kinematic = true;
      const uint32_t run = work[body].run_length;
      const Scaled wanted = needed(settings, contact, min(work[a].extent, work[b].extent), run, jointed);
      Scaled& most = need[contact.state.point_count < k_edge_points ? 1 : 0];
      if (less(most, wanted)) most = wanted;
    }
    uint32_t before = 0, calm = UINT32_MAX;
    Scaled lightest = properties[bodies[island.first_body]].mass, heaviest = lightest;
    for (uint32_t i = 0; i < island.body_count; ++i) {
      const uint32_t slot = bodies[island.first_body + i];
      const BodyActivity& activity = activities[slot];
      before = activity.substeps > before ? activity.substeps : before;
      calm = activity.calm_ticks < calm ? activity.calm_ticks : calm;
      const Scaled mass = properties[slot].mass;
      if (less(mass, lightest)) lightest = mass;
      if (less(heaviest, mass)) heaviest = mass;
    }
    uint32_t now = settings.substeps_fixed;
    if (now == 0 && island.contact_count == 0 && !jointed) {
      now = 1;
      before = calm = 0;
    } else if (now == 0) {
      const uint32_t most[2] = {most_for(settings, island, k_face_limit), most_for(settings, island, k_rolling_limit)};
      uint32_t ample = now = for_joints;
      for (int i = 0; i < 2; ++i) {
        const uint32_t held = notch_for(need[i], least, most[i]);
        const uint32_t held_in_hand = notch_for(multiply(need[i], k_in_hand), least, most[i]);
        now = now < held ? held : now;
        ample = ample < held_in_hand ? held_in_hand : ample;
      }
      const uint32_t most_of_all = most[0] < for_joints ? for_joints : most[0];
      before = before < most_of_all ? before : most_of_all;
      const uint32_t lower = next_below(before, least);
      if (now >= before) {
        calm = 0;
      } else {
        calm = lower >= ample ? calm + 1 : 0;
        const bool few = jointed || 2 * ample <= before;
        if (calm < (few ? k_few_calm_ticks : k_calm_ticks)) {
          now = before;
        } else {
          calm = 0;
          if (!jointed) now = lower;
        }
      }
    }
    island.substeps = now;
    const bool limits =
        island.contact_count > 1 && !kinematic && !less(heaviest, scaled_by_power(lightest, k_limited_mass_power));
    for (uint32_t i = 0; i < island.contact_count; ++i) {
      ContactWork& contact = contacts[order[island.first_contact + i].contact];
      const ContactState& state = contact.state;
      const uint32_t body = is_dynamic(properties[state.body_a]) ? state.body_a : state.body_b;
      rescale(activities[body].substeps, now, contact);
    }
    for (uint32_t i = 0; i < island.body_count; ++i) {
      const uint32_t slot = bodies[island.first_body + i];
      work[slot].supports = limits ? 1 : 0;
      BodyActivity& activity = activities[slot];
      activity.substeps = island.contact_count == 0 && !jointed ? 0 : now;
      activity.calm_ticks = calm;
    }
  }
}

void estimate_loads(const StepSettings& settings, Span<const BodyPose> poses, Span<const BodyProperties> properties,
                    Span<const uint32_t> bodies, Span<const Island> islands, Span<const ContactOrder> order,
                    Span<ContactOrder> spare, Span<BodyWork> work, Span<ContactWork> contacts) {
  Vec3<Unit> down;
  Real gravity = 0.0;
  if (!normalise(settings.gravity, down, gravity)) return;
  for (const Island& island : islands) {
    uint32_t fresh = 0;
    for (uint32_t i = 0; i < island.contact_count; ++i)
      fresh += contacts[order[island.first_contact + i].contact].state.age == 0 ? 1u : 0u;
    if (fresh == 0) continue;
    const Span<const ContactOrder> all = {order.data + island.first_contact, island.contact_count};
    if (2 * fresh > island.contact_count) {
      weigh(poses, properties, {bodies.data + island.first_body, island.body_count}, down, work);
      hand_down(properties, down, all, {spare.data + island.first_contact, island.contact_count}, work, contacts);
    }
    for (const ContactOrder& entry : all) {
      ContactWork& contact = contacts[entry.contact];
      if (contact.state.age != 0) continue;
      const uint32_t upper = upper_body(down, contact);
      if (upper == k_neither || !is_dynamic(properties[upper])) continue;
      const Scaled carried = 2 * fresh > island.contact_count
                                 ? divide(work[upper].carried, scaled_from_count(work[upper].supports))
                                 : properties[upper].mass;
      const Scaled share = upper == contact.state.body_a ? contact.inverse_mass_a : contact.inverse_mass_b;
      const Scaled weights = multiply(divide(carried, properties[upper].mass), divide(Scaled(1.0), share));
      bool saturated = false;
      contact.state.load = multiply(gravity, weights, saturated);
    }
  }
}

void store_load(const StepSettings& settings, ContactWork& contact) {
  Real impulse = 0.0;
  // Clamped: the sum of four impulses may exceed the range of Real, and would wrap.
  for (const Real part : contact.state.normal_impulse) impulse += min(part, k_real_max - impulse);
  bool saturated = false;
  const Real force = multiply(impulse, settings.rate, saturated);
  const Real most = max(settings.gravity_size, multiply(contact.state.load, Scaled(2.0), saturated));
  contact.state.load = min(force, most);
  if (force > most) scale_impulses(divide(scaled_from(most), scaled_from(force)), contact);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
