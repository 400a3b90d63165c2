#pragma once
#include <detent/detail/scratch.h>

#include "base/span.h"
#include "joint/joint.h"
#include "motion/spin.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Groups the awake dynamic bodies by contact and joint: those so connected, directly or through other dynamic ones,
/// are one island; fixed and kinematic bodies join nobody. Sets `island`, `run`, `run_length` and `contacts` of `work`,
/// and the islands' lists of bodies, of those in `slots`, which holds all awake ones, ascending: `bodies` holds the
/// slots island by island, ascending in each, and the islands come in the order of their first slots. The islands'
/// contacts are counted, and have their room in the order of the solve. Returns how many islands there are.
///
/// A *run* is a row of bodies that touch no more than two others each, as in a tower.
uint32_t find_islands(Span<const uint32_t> slots, Span<const BodyTraits> traits, Span<const BodyActivity> activities,
                      Span<const ContactWork> contacts, const JointStage& joints, Span<BodyWork> work,
                      Span<Island> islands, Span<uint32_t> bodies);

/// The island of a contact: that of its dynamic body.
inline uint32_t island_of(Span<const BodyTraits> traits, Span<const BodyWork> work, const ContactState& contact) {
  return work[is_dynamic(traits[contact.body_a]) ? contact.body_a : contact.body_b].island;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
