#pragma once
#include <detent/detail/scratch.h>
#include <detent/event.h>

#include "base/bit_set.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

struct EventCount {
  uint32_t kept = 0;
  uint32_t dropped = 0;
};

/// The caller's event buffer as a span; empty if `data` is null.
template <class Buffer>
auto room_of(const Buffer& buffer) {
  return Span(buffer.data, buffer.data == nullptr ? 0u : buffer.capacity);
}

/// Compares the contacts of the last step, `before`, with those of this step, `contacts`; both are sorted by their
/// bodies. Writes the begin, touch, end and hit events of each pair. If a pair has several contacts, the point, the
/// normal and the speed of its events are those of the contact with the greatest closing speed. `poses`: at the start
/// of the step. `awake`: the indices of the contacts of `before` with an awake body; all other contacts are skipped.
/// Sets `touching` of each contact.
EventCount raise_contact_events(Span<const BodyPose> poses, Span<const BodyProperties> properties,
                                Span<const uint32_t> awake, Span<const ContactState> before, Span<ContactWork> contacts,
                                Span<ContactEvent> events);

/// Inserts the impacts of continuous collision, as hit events, into the sorted `events`. Updates `count`. Range: `hits`
/// are in the order of time.
void add_hits(Span<const BodyProperties> properties, Span<const ImpactHit> hits, Span<ContactEvent> events,
              EventCount& count);

/// Writes the pending events (fell asleep, woke) of the bodies in the active set and clears them.
EventCount raise_body_events(BitSet active, Span<const BodyProperties> properties, Span<BodyActivity> activities,
                             Span<BodyEvent> events);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
