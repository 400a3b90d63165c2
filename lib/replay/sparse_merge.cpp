#include <string.h>

#include "base/bytes.h"
#include "broad_phase/pair_key.h"
#include "joint/joint.h"
#include "motion/activity.h"
#include "replay/sparse_rollback.h"
#include "shape/shape_properties.h"
#include "state/used.h"
#include "world/events.h"

#if DETENT_SPARSE

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

template <class T>
bool are_same(Span<const T> a, Span<const T> b, uint32_t index) {
  return have_same_bytes(a[index], b[index]);
}

uint32_t greater_count(uint32_t a, uint32_t b) { return a < b ? b : a; }

/// Merges the elements of `from` that `takes` accepts into the `count` sorted elements at the front of `to`; `from` is
/// sorted, too. `more`: the number of elements that `takes` accepts. `precedes(a, b)`: whether a comes before b in the
/// order. `move(i, k)`: moves element i of `to` to place k. `put(i, k)`: copies element i of `from` to place k of `to`.
template <class T, class From, class Takes, class Precedes, class Move, class Put>
void merge_back(Span<T> to, uint32_t count, Span<From> from, uint32_t more, const Takes& takes,
                const Precedes& precedes, const Move& move, const Put& put) {
  uint32_t left = count, next = from.count;
  for (uint32_t place = count + more; more != 0; --place) {
    while (!takes(from[next - 1])) --next;
    if (left != 0 && precedes(from[next - 1], to[left - 1])) {
      move(--left, place - 1);
      continue;
    }
    put(--next, place - 1);
    --more;
  }
}

/// Returns the exponent of a body's unit for joints as a number other than 0.
uint32_t unit_number(const JointBody& body) { return static_cast<uint32_t>(body.exponent + 1024); }

template <class T, class Takes>
uint32_t count_taken(Span<T> from, const Takes& takes) {
  uint32_t count = 0;
  for (const auto& element : from) count += takes(element) ? 1u : 0u;
  return count;
}

/// Merges the recorded events that `takes` accepts into the caller's buffer. `count`: the number of events in the
/// buffer; the function updates it. Returns false if the buffer has no room for the events.
template <class Event, class Buffer, class Takes, class Precedes>
bool merge_recorded(const Buffer& buffer, uint32_t& count, Span<Event> recorded, const Takes& takes,
                    const Precedes& precedes) {
  const Span<Event> room = room_of(buffer);
  if (room.count == 0) return recorded.count == 0;
  const uint32_t more = count_taken(recorded, takes);
  if (count + more > room.count) return false;
  merge_back(
      room, count, recorded, more, takes, precedes, [&](uint32_t i, uint32_t k) { room[k] = room[i]; },
      [&](uint32_t i, uint32_t k) { room[k] = recorded[i]; });
  count += more;
  return true;
}

}  // namespace

void SparseTick::load(const State& from, const StateView<uint8_t>& block) {
  visible.for_each([&](uint32_t slot) {
    block.poses[slot] = from.poses[slot];
    block.motions[slot] = from.motions[slot];
    block.properties[slot] = from.properties[slot];
    block.activities[slot] = from.activities[slot];
  });
  block.world = from.world;
  block.world.slots_used = used;
  block.world.joints_used = greater_count(before.world.joints_used, now.world.joints_used);
  block.world.idle = 0;
  uint32_t contacts = 0, sensed = 0;
  for (uint32_t i = 0; i < from.world.contact_count; ++i) {
    const ContactState& contact = from.contacts[i];
    if (!owns_contact(contact.body_a, contact.body_b)) continue;
    block.contacts[contacts] = contact;
    if (block.manifolds.count != 0) block.manifolds[contacts] = from.manifolds[i];
    ++contacts;
  }
  for (const SensedState& pair : from.sensed.first(from.world.sensed_count)) {
    if (owns_sensed(pair.sensor, pair.body)) block.sensed[sensed++] = pair;
  }
  block.world.contact_count = contacts;
  block.world.sensed_count = sensed;
  contacts_written = greater_count(contacts_written, contacts);
  sensed_written = greater_count(sensed_written, sensed);
  for (uint32_t& word : anchoring.words) word = 0;
  for (uint32_t slot = 0; slot < block.world.joints_used; ++slot) {
    const JointState& joint = from.joints[slot];
    if (joint.type != 0 && (inside.has(joint.body_a) || inside.has(joint.body_b))) joints.set(slot);
    if (joints.has(slot)) {
      block.joints[slot] = joint;
      continue;
    }
    block.joints[slot].type = 0;  // hides the joint from the step
    if (holds(joint) && (anchors(joint.body_a, joint.body_b) || anchors(joint.body_b, joint.body_a)))
      anchoring.set(slot);
  }
  const StepCacheView cache =
      cache_of(reinterpret_cast<uint8_t*>(&block.header), block.layout, capacity_of(block.header));
  cache.cache.fresh = 1;
  cache.cache.contacts_known = 0;
  cache.tree.make_empty();
  for (uint32_t i = 0; i < cache.active.words.count; ++i) cache.active.words[i] = visible.words[i];
}

void SparseTick::reset(const StateView<uint8_t>& block) const {
  // From these counts copy_used() knows which elements of the block may be other than zero.
  block.world.slots_used = used;
  block.world.joints_used = greater_count(before.world.joints_used, now.world.joints_used);
  block.world.contact_count =
      greater_count(greater_count(contacts_written, now.world.contact_count), block.world.contact_count);
  block.world.sensed_count =
      greater_count(greater_count(sensed_written, now.world.sensed_count), block.world.sensed_count);
  copy_used(now, block);
}

void SparseTick::keep_units(Span<const JointBody> bodies) const {
  for (uint32_t& unit : units) unit = 0;
  for (const JointBody& body : bodies) {
    if (body.mobile == 0) units[body.slot] = unit_number(body);
  }
}

bool SparseTick::has_same_units(Span<const JointBody> bodies) const {
  bool same = true;
  const auto is_kinematic = [&](uint32_t slot) { return type_of(now.properties[slot]) == BodyType::kinematic; };
  uint32_t kinematic = 0;
  for (const JointBody& body : bodies) {
    if (body.mobile != 0) continue;
    const uint32_t before_unit = units[body.slot];
    // If before_unit is 0, the body had no joints in the run from the recorded state. The first joint of a fixed body
    // affects no other joint.
    same = same && (before_unit == unit_number(body) || (before_unit == 0 && !is_kinematic(body.slot)));
    kinematic += is_kinematic(body.slot) ? 1u : 0u;
  }
  for (uint32_t slot = 0; slot < used; ++slot) kinematic -= units[slot] != 0 && is_kinematic(slot) ? 1u : 0u;
  return same && kinematic == 0;
}

bool SparseTick::is_recorded(const StateView<uint8_t>& block) const {
  bool same = true;
  inside.for_each([&](uint32_t slot) {
    same = same && are_same<BodyPose>(block.poses, after.poses, slot) &&
           are_same<BodyMotion>(block.motions, after.motions, slot) &&
           are_same<BodyActivity>(block.activities, after.activities, slot);
  });
  joints.for_each([&](uint32_t slot) { same = same && are_same<JointState>(block.joints, after.joints, slot); });
  uint32_t found = 0;
  for (uint32_t i = 0; same && i < after.world.contact_count; ++i) {
    const ContactState& contact = after.contacts[i];
    if (!owns_contact(contact.body_a, contact.body_b)) continue;
    same = found < block.world.contact_count && have_same_bytes(contact, block.contacts[found]) &&
           (block.manifolds.count == 0 || have_same_bytes(after.manifolds[i], block.manifolds[found]));
    ++found;
  }
  return same && found == block.world.contact_count;
}

bool SparseTick::merge(const StateView<uint8_t>& block) {
  for (uint32_t slot = 0; slot < used; ++slot) {
    if (inside.has(slot)) continue;
    block.poses[slot] = after.poses[slot];
    block.motions[slot] = after.motions[slot];
    block.activities[slot] = after.activities[slot];
  }
  uint32_t joint_count = 0;
  for (uint32_t slot = 0; slot < block.world.joints_used; ++slot) {
    if (!joints.has(slot)) block.joints[slot] = after.joints[slot];
    joint_count += block.joints[slot].type != 0 ? 1u : 0u;
  }

  const auto takes = [&](const ContactState& contact) { return !owns_contact(contact.body_a, contact.body_b); };
  const uint32_t contacts = block.world.contact_count;
  const Span<const ContactState> recorded = after.contacts.first(after.world.contact_count);
  const uint32_t more = count_taken(recorded, takes);
  if (contacts + more > block.contacts.count) return false;
  contacts_written = greater_count(contacts_written, contacts + more);
  const bool has_manifolds = block.manifolds.count != 0;
  merge_back(
      block.contacts, contacts, recorded, more, takes,
      [](const ContactState& a, const ContactState& b) { return key_of(a) < key_of(b); },
      [&](uint32_t i, uint32_t k) {
        block.contacts[k] = block.contacts[i];
        if (has_manifolds) block.manifolds[k] = block.manifolds[i];
      },
      [&](uint32_t i, uint32_t k) {
        block.contacts[k] = after.contacts[i];
        if (has_manifolds) block.manifolds[k] = after.manifolds[i];
      });

  // The run also finds pairs of a sensor and a body that it reads but does not simulate: both are visible, neither is
  // inside. These pairs are removed.
  uint32_t sensed = 0;
  for (uint32_t i = 0; i < block.world.sensed_count; ++i) {
    const SensedState pair = block.sensed[i];
    if (owns_sensed(pair.sensor, pair.body)) block.sensed[sensed++] = pair;
  }
  const auto takes_sensed = [&](const SensedState& pair) { return !owns_sensed(pair.sensor, pair.body); };
  const Span<const SensedState> recorded_sensed = after.sensed.first(after.world.sensed_count);
  const uint32_t more_sensed = count_taken(recorded_sensed, takes_sensed);
  if (sensed + more_sensed > block.sensed.count) return false;
  sensed_written = greater_count(sensed_written, greater_count(block.world.sensed_count, sensed + more_sensed));
  merge_back(
      block.sensed, sensed, recorded_sensed, more_sensed, takes_sensed,
      [](const SensedState& a, const SensedState& b) {
        return a.sensor != b.sensor ? a.sensor < b.sensor : a.body < b.body;
      },
      [&](uint32_t i, uint32_t k) { block.sensed[k] = block.sensed[i]; },
      [&](uint32_t i, uint32_t k) { block.sensed[k] = after.sensed[i]; });

  const uint32_t contact_count = contacts + more, sensed_count = sensed + more_sensed;
  for (uint32_t i = contact_count; i < greater_count(contacts_written, now.world.contact_count); ++i) {
    block.contacts[i] = ContactState{};
    if (has_manifolds) block.manifolds[i] = ManifoldState{};
  }
  const uint32_t sensed_end = greater_count(sensed_written, now.world.sensed_count);
  for (uint32_t i = sensed_count; i < sensed_end; ++i) block.sensed[i] = SensedState{};
  block.world = now.world;
  ++block.world.tick;
  block.world.contact_count = contact_count;
  block.world.sensed_count = sensed_count;
  block.world.joint_count = joint_count;
  bool moves = false;
  for (uint32_t slot = 0; slot < used && !moves; ++slot)
    moves = is_moving(block.properties[slot], block.motions[slot], block.activities[slot]);
  block.world.idle = moves ? 0 : 1;
  return true;
}

bool SparseTick::merge_events(const WorldHooks& hooks, StepReport& report) const {
  EventReport& events = report.events;
  const auto slot_of = [](const BodyId& id) { return id.slot - 1; };
  const auto is_before = [](uint32_t a, uint32_t b, uint32_t other_a, uint32_t other_b) {
    return a != other_a ? a < other_a : b < other_b;
  };
  // The run also raises events of a sensor and a body that it reads but does not simulate: both are visible, neither is
  // inside. These events are removed.
  const Span<SensorEvent> sensed = room_of(hooks.sensor_events);
  uint32_t kept = 0;
  for (uint32_t i = 0; i < events.sensor; ++i) {
    const SensorEvent event = sensed[i];
    if (owns_sensed(slot_of(event.sensor), slot_of(event.body))) sensed[kept++] = event;
  }
  events.sensor = kept;
  return merge_recorded(
             hooks.contact_events, events.contact, record.contact_events.first(record.head.event[0]),
             [&](const ContactEvent& event) { return !owns_contact(slot_of(event.a), slot_of(event.b)); },
             [&](const ContactEvent& a, const ContactEvent& b) {
               return is_before(a.a.slot, a.b.slot, b.a.slot, b.b.slot);
             }) &&
         merge_recorded(
             hooks.joint_events, events.joint, record.joint_events.first(record.head.event[1]),
             [&](const JointEvent& event) { return !joints.has(event.joint.slot - 1); },
             [](const JointEvent& a, const JointEvent& b) { return a.joint.slot < b.joint.slot; }) &&
         merge_recorded(
             hooks.sensor_events, events.sensor, record.sensor_events.first(record.head.event[2]),
             [&](const SensorEvent& event) { return !owns_sensed(slot_of(event.sensor), slot_of(event.body)); },
             [&](const SensorEvent& a, const SensorEvent& b) {
               return is_before(a.sensor.slot, a.body.slot, b.sensor.slot, b.body.slot);
             }) &&
         merge_recorded(
             hooks.body_events, events.body, record.body_events.first(record.head.event[3]),
             [&](const BodyEvent& event) { return !inside.has(slot_of(event.body)); },
             [](const BodyEvent& a, const BodyEvent& b) { return a.body.slot < b.body.slot; });
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent

#endif
