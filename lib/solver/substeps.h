#pragma once
#include <detent/detail/scratch.h>

#include "base/span.h"
#include "motion/step_settings.h"

/// How many substeps an island takes: as few as hold what it carries.
///
/// A soft contact of frequency w under a force W sinks by W / (k w^2), where k is the sum of its points' effective
/// masses, and a column of n such contacts buckles unless k w^2 > W n^2 / (its width). The frequency is a fixed part of
/// the substep rate, so both ask for a number of substeps.
/// Source: the sag of a spring; Euler, "De curvis elasticis", 1744, for a column held by its joints' stiffness.
namespace detent {
inline namespace DETENT_NAMESPACE {

inline constexpr int k_sag_power = -7;  ///< a contact may sink by this part of the smaller body: 8 mm of 1 m
/// An island of many contacts takes no more substeps than make so many contact substeps, but at least k_pile_substeps:
/// one contact must not make a whole pile dear. What stands on faces and edges, of k_edge_points and more, buckles;
/// what rolls only sinks, and is given fewer. A joint counts as k_joint_contacts of them.
inline constexpr uint32_t k_contact_substeps = 65536;
inline constexpr uint32_t k_rolling_substeps = 2048;
inline constexpr uint32_t k_edge_points = 2;
inline constexpr uint32_t k_joint_contacts = 8;
inline constexpr uint32_t k_pile_substeps = 4;
inline constexpr uint32_t k_calm_ticks = 60;       ///< in which fewer substeps would have done, before they are taken
inline constexpr uint32_t k_joint_calm_ticks = 8;  ///< likewise with joints, which ask for more while they turn

/// Sets the islands' substeps, and those of their bodies' activities, from the contacts' loads and from what their
/// joints ask for, which `islands` has. More are taken at once; fewer after k_calm_ticks, one notch, or with joints
/// after k_joint_calm_ticks, as many as are needed. Impulses carried over from a tick with other substeps are scaled.
void choose_substeps(const StepSettings& settings, Span<const BodyTraits> traits, Span<const BodyWork> work,
                     Span<const uint32_t> bodies, Span<const ContactOrder> order, Span<Island> islands,
                     Span<ContactWork> contacts, Span<BodyActivity> activities);

/// Sets the loads of contacts that begin: the weight of the upper body. In an island most of whose contacts begin, as
/// when a scene starts, the upper body's share of all that rests on it: then nothing sinks before the loads are
/// measured, and no tower begins to sway. `spare` is work space as large as `order`.
void estimate_loads(const StepSettings& settings, Span<const BodyPose> poses, Span<const BodyTraits> traits,
                    Span<const uint32_t> bodies, Span<const Island> islands, Span<const ContactOrder> order,
                    Span<ContactOrder> spare, Span<BodyWork> work, Span<ContactWork> contacts);

/// Takes over the force of the last substep as the contact's load: at once if it is less than before, and if it is more
/// by no more than twice, or the bodies' own weight, so that a blow does not count as a load. Nor is a blow carried
/// over: the impulses that the next tick starts from are scaled to the load.
void store_load(const StepSettings& settings, ContactWork& contact);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
