#pragma once
#include <detent/detail/scratch.h>

#include "base/span.h"
#include "joint/joint.h"
#include "motion/angular_velocity.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Groups the awake dynamic bodies into islands: bodies that are connected by contacts and joints, directly or through
/// other dynamic bodies. Fixed and kinematic bodies connect nothing. `slots` contains all awake bodies, ascending.
///
/// Sets `island`, `run`, `run_length` and `contacts` of `work` for `slots`. Fills `bodies` with the slots, island by
/// island, and ascending within each island. Islands are in the order of their first slots. Also counts the contacts of
/// each island, and sets the island's range in the order of the solve. Returns the number of islands.
///
/// A *run* is a set of dynamic bodies that contacts connect, each with at most two contacts, for example a tower.
uint32_t find_islands(Span<const uint32_t> slots, Span<const BodyProperties> properties,
                      Span<const BodyActivity> activities, Span<const ContactWork> contacts, const JointStage& joints,
                      Span<BodyWork> work, Span<Island> islands, Span<uint32_t> bodies);

/// Sets the first body and the first contact of each island, from the numbers of bodies and contacts of the islands
/// before it. Lists the bodies of each island in `bodies`, ascending. `work`: has the island of each body.
void list_island_bodies(Span<const uint32_t> slots, Span<const BodyProperties> properties,
                        Span<const BodyActivity> activities, Span<const BodyWork> work, Span<Island> islands,
                        Span<uint32_t> bodies);

/// The island of a contact: the island of its dynamic body.
inline uint32_t island_of(Span<const BodyProperties> properties, Span<const BodyWork> work,
                          const ContactState& contact) {
  return work[is_dynamic(properties[contact.body_a]) ? contact.body_a : contact.body_b].island;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
