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

/// Compares the contacts of the last step with those of this one, both sorted by their bodies, and writes what began,
/// went on, ended and hit; of a pair whose parts touch in several places the hardest. `poses` are those of the start of
/// the step. Of the contacts `before` those that sleep are passed over: `awake` lists the others. Sets the contacts'
/// `touching`.
EventCount raise_events(Span<const BodyPose> poses, Span<const BodyTraits> traits, Span<const uint32_t> awake,
                        Span<const ContactState> before, Span<ContactWork> contacts, Span<ContactEvent> events);

/// Puts the impacts of continuous collision, which come in the order of their times, among the events.
void add_hits(Span<const BodyTraits> traits, Span<const ImpactHit> hits, Span<ContactEvent> events, EventCount& count);

/// Tells who fell asleep and who woke among the bodies that move, and forgets the news.
EventCount raise_body_events(BitSet visits, Span<const BodyTraits> traits, Span<BodyActivity> activities,
                             Span<BodyEvent> events);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
