#pragma once
#include <detent/detail/scratch.h>

#include "base/span.h"
#include "motion/step_settings.h"

/// Chooses the number of substeps of an island: the fewest that are stiff enough for its loads.
///
/// A soft contact of frequency w under a force W sinks by W / (k w^2), where k is the sum of its points' effective
/// masses. A column of n such contacts buckles unless k w^2 > W n^2 / (its width). The frequency is a fixed fraction of
/// the substep rate, so both conditions give a number of substeps.
/// Source: the sag of a spring; Euler, "De curvis elasticis", 1744, for a column with elastic joints.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Permitted sag of a contact, as a power of two of the smaller body's extent: 8 mm of 1 m.
inline constexpr int k_sag_power = -7;
/// Limits for large islands: contacts times substeps is at most k_contact_substeps, but at least k_pile_substeps
/// substeps are permitted. So a single contact cannot make a whole pile expensive. Contacts on edges and faces
/// (k_edge_points points or more) can buckle. Rolling contacts only sink, and have the smaller limit
/// k_rolling_substeps. A joint counts as k_joint_contacts contacts.
inline constexpr uint32_t k_contact_substeps = 65536;
inline constexpr uint32_t k_rolling_substeps = 2048;
inline constexpr uint32_t k_edge_points = 2;
inline constexpr uint32_t k_joint_contacts = 8;
inline constexpr uint32_t k_pile_substeps = 4;
/// Ticks in which fewer substeps would be enough, before their number is reduced.
inline constexpr uint32_t k_calm_ticks = 60;
/// The same with joints, which need more substeps while they rotate.
inline constexpr uint32_t k_joint_calm_ticks = 8;

/// Sets the number of substeps of each island and of its bodies' activities, from the loads of its contacts and from
/// the needs of its joints, which `islands` has. The number grows at once. It falls to the next lower entry of
/// k_notches after k_calm_ticks; with joints, to the number that is needed after k_joint_calm_ticks. Impulses from a
/// tick with another number of substeps are scaled.
void choose_substeps(const StepSettings& settings, Span<const BodyProperties> properties, Span<const BodyWork> work,
                     Span<const uint32_t> bodies, Span<const ContactOrder> order, Span<Island> islands,
                     Span<ContactWork> contacts, Span<BodyActivity> activities);

/// Sets the loads of new contacts to the weight of the upper body. If more than half of the island's contacts are new,
/// as at the start of a scene, it instead uses the weight of the upper body and of all bodies on it, divided among its
/// supports. So nothing sinks before the loads are measured, and no tower begins to sway. `spare` is work space as
/// large as `order`.
void estimate_loads(const StepSettings& settings, Span<const BodyPose> poses, Span<const BodyProperties> properties,
                    Span<const uint32_t> bodies, Span<const Island> islands, Span<const ContactOrder> order,
                    Span<ContactOrder> spare, Span<BodyWork> work, Span<ContactWork> contacts);

/// Stores the force of the last substep as the contact's load, limited to the larger of twice the old load and the
/// bodies' own weight, so that an impact does not count as a load. If the limit applies, it also scales the impulses
/// for the next tick to the load, so that an impact is not carried over.
void store_load(const StepSettings& settings, ContactWork& contact);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
