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
/// Sets `island`, `run`, `run_length` and `contacts` of `work` for `slots`. `bodies` becomes the list of slots, island
/// by island, ascending in each island; islands are in the order of their first slots. Also counts the contacts of each
/// island and sets their range in the order of the solve. Returns the number of islands.
///
/// A *run* is a row of bodies that touch at most two others each, for example a tower.
uint32_t find_islands(Span<const uint32_t> slots, Span<const BodyProperties> properties,
                      Span<const BodyActivity> activities, Span<const ContactWork> contacts, const JointStage& joints,
                      Span<BodyWork> work, Span<Island> islands, Span<uint32_t> bodies);

/// Sets the ranges of the islands, in their order, from their numbers of bodies and contacts, and lists their bodies in
/// `bodies`, ascending in each island. `work` has the bodies' islands.
void list_island_bodies(Span<const uint32_t> slots, Span<const BodyProperties> properties,
                        Span<const BodyActivity> activities, Span<const BodyWork> work, Span<Island> islands,
                        Span<uint32_t> bodies);

/// The island of a contact is that of its dynamic body.
inline uint32_t island_of(Span<const BodyProperties> properties, Span<const BodyWork> work,
                          const ContactState& contact) {
  return work[is_dynamic(properties[contact.body_a]) ? contact.body_a : contact.body_b].island;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
