#include "base/float_environment.h"
#include "collision/broadphase.h"
#include "collision/contact_cache.h"
#include "dynamics/contact_order.h"
#include "dynamics/contact_rows.h"
#include "dynamics/finalise.h"
#include "dynamics/predict.h"
#include "dynamics/solve.h"
#include "dynamics/spin.h"
#include "geometry/shape_traits.h"
#include "world/view.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// The work space of a block, as spans over its capacity.
struct Scratch {
  Span<Bounds> bounds;
  Span<BodyWork> bodies;
  Span<uint32_t> body_order;
  Span<uint64_t> pairs;
  Span<ContactWork> contacts;
  Span<ContactOrder> contact_order;
};

Scratch scratch_of(uint8_t* block, const Layout& layout, Capacity capacity) {
  return {{at_offset<Bounds>(block, layout.bounds), capacity.bodies},
          {at_offset<BodyWork>(block, layout.body_work), capacity.bodies},
          {at_offset<uint32_t>(block, layout.body_order), capacity.bodies},
          {at_offset<uint64_t>(block, layout.pairs), capacity.contacts * k_pairs_per_contact},
          {at_offset<ContactWork>(block, layout.contact_work), capacity.contacts},
          {at_offset<ContactOrder>(block, layout.contact_order), capacity.contacts}};
}

/// How far apart a pair may be and still be given contact points: a 64th of the smaller body, and what the pair can
/// close in this tick, up to a quarter of it.
Real contact_reach(const StepSettings& settings, const RowBody& a, const RowBody& b) {
  const Real extent = min(shape_extent(a.traits), shape_extent(b.traits));
  const Real speed =
      speed_bound(a.traits, a.pose.rotation, a.motion) + speed_bound(b.traits, b.pose.rotation, b.motion);
  return scale_by_power(extent, -6) + min(scale_by_power(extent, -2), speed * settings.tick_time);
}

struct ContactCount {
  uint32_t contacts = 0;
  uint32_t points = 0;
  uint32_t dropped = 0;
};

/// Collides every pair and makes the rows of those that touch, in the order of the pairs. `before` is sorted alike.
ContactCount collide_pairs(const StepSettings& settings, Span<const uint64_t> pairs, Span<const BodyPose> poses,
                           Span<const BodyTraits> traits, Span<const BodyMotion> motions,
                           Span<const ContactState> before, Span<ContactWork> contacts) {
  ContactCount count;
  uint32_t next = 0;
  for (const uint64_t key : pairs) {
    const uint32_t slot_a = pair_low(key), slot_b = pair_high(key);
    while (next < before.count && pair_key(before[next].body_a, before[next].body_b) < key) ++next;
    const bool continued = next < before.count && pair_key(before[next].body_a, before[next].body_b) == key;
    const RowBody a = {traits[slot_a], poses[slot_a], motions[slot_a]};
    const RowBody b = {traits[slot_b], poses[slot_b], motions[slot_b]};
    const Matrix3 rotation_a = matrix_from(a.pose.rotation), rotation_b = matrix_from(b.pose.rotation);
    ContactGeometry geometry;
    collide({a.pose, a.traits, rotation_a}, {b.pose, b.traits, rotation_b}, contact_reach(settings, a, b), geometry);
    if (geometry.count == 0) continue;
    if (count.contacts == contacts.count) {
      ++count.dropped;
      continue;
    }
    ContactWork& work = contacts[count.contacts++];
    work.state = continued_contact(slot_a, slot_b, geometry, continued ? &before[next] : nullptr);
    make_rows(settings, a, b, geometry, work);
    count.points += geometry.count;
  }
  return count;
}

/// The stages of a step, in order. Separate from `step`, so that nothing of it moves across the change of the
/// floating-point environment.
__attribute__((noinline)) void run_stages(World& world, StepReport& report) {
  const StateView<uint8_t> state = view_of(world);
  const Scratch scratch = scratch_of(world.block, state.layout, capacity_of(state.header));
  const uint32_t used = state.world.slots_used, before = state.world.contact_count;
  const Span<BodyPose> poses = state.poses.first(used);
  const Span<BodyMotion> motions = state.motions.first(used);
  const Span<BodyTraits> traits = state.traits.first(used);
  const Span<BodyWork> bodies = scratch.bodies.first(used);
  const Span<Bounds> bounds = scratch.bounds.first(used);
  const StepSettings settings = step_settings(state.world);

  predict(settings, poses, traits, motions, bodies);
  bound(settings, poses, traits, motions, bounds);
  const PairCount pairs = find_pairs(traits, bounds, scratch.body_order, scratch.pairs);
  const ContactCount count = collide_pairs(settings, scratch.pairs.first(pairs.kept), poses, traits, motions,
                                           state.contacts.first(before), scratch.contacts);
  const Span<ContactWork> contacts = scratch.contacts.first(count.contacts);
  const Span<ContactOrder> order = scratch.contact_order.first(count.contacts);
  report.colour_overflows = order_contacts(traits, contacts, bodies, order);
  report.saturations = solve(settings, {traits, motions, bodies}, order, contacts);
  report.saturations += finalise(traits, bodies, poses, motions);
  store_contacts(contacts, state.contacts, before);

  state.world.contact_count = count.contacts;
  ++state.world.tick;
  report.tick = state.world.tick;
  report.bodies = state.world.body_count;
  report.pairs = pairs.kept + pairs.dropped;
  report.pairs_dropped = pairs.dropped;
  report.contacts = count.contacts;
  report.contact_points = count.points;
  report.contacts_dropped = count.dropped;
}

}  // namespace

StepReport step(World& world) {
  const FloatEnvironment environment;
  StepReport report;
  run_stages(world, report);
  return report;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
