#include "world/events.h"

#include "broad_phase/broadphase.h"
#include "motion/angular_velocity.h"
#include "shape/sweep.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// The greatest closing speed, m/s, of the contact's points that received an impulse in this step.
Real approach_of(const ContactWork& contact) {
  Real least = k_zero;
  for (uint32_t i = 0; i < contact.state.point_count; ++i) {
    if (contact.impulse_max[i] > k_zero) least = min(least, contact.approach[i]);
  }
  return -least;
}

bool pushes(const ContactWork& contact) {
  bool result = false;
  for (uint32_t i = 0; i < contact.state.point_count; ++i) result = result || contact.impulse_max[i] > k_zero;
  return result;
}

struct EventWriter {
  Span<const BodyPose> poses;
  Span<const BodyProperties> properties;
  Span<ContactEvent> events;
  EventCount count = {};

  BodyId id_of(uint32_t slot) const { return {slot + 1, properties[slot].generation}; }
  void add(const ContactEvent& event) {
    if (count.kept == events.count)
      ++count.dropped;
    else
      events[count.kept++] = event;
  }
  ContactEvent event_of(ContactEventType type, uint32_t a, uint32_t b) const {
    ContactEvent event;
    event.type = type;
    event.a = id_of(a);
    event.b = id_of(b);
    event.approach_speed = k_zero;
    return event;
  }
  void add_contact(const ContactWork& contact, bool touched) {
    const ContactState& state = contact.state;
    const bool from_a = is_dynamic(properties[state.body_a]);
    const uint32_t body = from_a ? state.body_a : state.body_b;
    const Vec3<Unit>& arm = from_a ? contact.middle_a : contact.middle_b;
    const int exponent = properties[body].size_exponent;
    ContactEvent event =
        event_of(touched ? ContactEventType::touch : ContactEventType::begin, state.body_a, state.body_b);
    event.normal = contact.normal;
    event.point = moved(poses[body].position, real_from_unit(arm, exponent));
    add(event);
    const Real approach = approach_of(contact);
    if (approach < contact.rebound_min) return;
    event.type = ContactEventType::hit;
    event.approach_speed = approach;
    add(event);
  }
};

}  // namespace

EventCount raise_contact_events(Span<const BodyPose> poses, Span<const BodyProperties> properties,
                                Span<const uint32_t> awake, Span<const ContactState> before, Span<ContactWork> contacts,
                                Span<ContactEvent> events) {
  EventWriter writer = {poses, properties, events};
  uint32_t old = 0;
  const auto old_contact = [&]() -> const ContactState& { return before[awake[old]]; };
  /// Moves `old` past the contacts that the next pair had in the last step. Returns true if one of them touched.
  const auto pass_pair = [&] {
    const uint64_t key = key_of(old_contact());
    bool touched = false;
    for (; old < awake.count && key_of(old_contact()) == key; ++old) touched = touched || old_contact().touching != 0;
    return touched;
  };
  const auto end_up_to = [&](uint64_t key) {
    while (old < awake.count && key_of(old_contact()) < key) {
      const ContactState& state = old_contact();
      if (pass_pair()) writer.add(writer.event_of(ContactEventType::end, state.body_a, state.body_b));
    }
  };
  for (uint32_t i = 0; i < contacts.count;) {
    const ContactState& state = contacts[i].state;
    const uint64_t key = key_of(state);
    end_up_to(key);
    const bool touched = old < awake.count && key_of(old_contact()) == key && pass_pair();
    const ContactWork* hardest = nullptr;
    for (; i < contacts.count && key_of(contacts[i].state) == key; ++i) {
      ContactWork& contact = contacts[i];
      contact.state.touching = pushes(contact) ? 1 : 0;
      if (contact.state.touching == 0) continue;
      if (hardest == nullptr || approach_of(contact) > approach_of(*hardest)) hardest = &contact;
    }
    if (hardest != nullptr)
      writer.add_contact(*hardest, touched);
    else if (touched)
      writer.add(writer.event_of(ContactEventType::end, state.body_a, state.body_b));
  }
  end_up_to(UINT64_MAX);
  return writer.count;
}

void add_hits(Span<const BodyProperties> properties, Span<const ImpactHit> hits, Span<ContactEvent> events,
              EventCount& count) {
  const auto comes_before = [](const ContactEvent& a, const ContactEvent& b) {
    if (a.a.slot != b.a.slot) return a.a.slot < b.a.slot;
    if (a.b.slot != b.b.slot) return a.b.slot < b.b.slot;
    return a.type < b.type;
  };
  for (const ImpactHit& hit : hits) {
    const uint32_t a = pair_low(hit.key), b = pair_high(hit.key);
    const ContactEvent event = {ContactEventType::hit,
                                {a + 1, properties[a].generation},
                                {b + 1, properties[b].generation},
                                hit.normal,
                                hit.point,
                                hit.approach};
    uint32_t place = count.kept;
    while (place > 0 && comes_before(event, events[place - 1])) --place;
    const bool full = count.kept == events.count;
    count.dropped += full ? 1 : 0;
    if (place == events.count) continue;
    count.kept += full ? 0 : 1;
    for (uint32_t i = count.kept - 1; i > place; --i) events[i] = events[i - 1];
    events[place] = event;
  }
}

EventCount raise_body_events(BitSet active, Span<const BodyProperties> properties, Span<BodyActivity> activities,
                             Span<BodyEvent> events) {
  EventCount count;
  active.for_each([&](uint32_t slot) {
    uint16_t& pending_event = activities[slot].pending_event;
    if (pending_event == 0) return;
    if (count.kept == events.count)
      ++count.dropped;
    else
      events[count.kept++] = {static_cast<BodyEventType>(pending_event), {slot + 1, properties[slot].generation}};
    pending_event = 0;
  });
  return count;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
