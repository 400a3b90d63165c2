#pragma once
#include <detent/detail/scratch.h>

#include "base/span.h"
#include "motion/step_settings.h"

/// Chooses the number of substeps of an island: the fewest that are stiff enough for its loads.
///
/// A soft contact of angular frequency w, rad/s, under a force W, N, sinks by W / (k w^2), m, where k is the sum of the
/// effective masses of its points, kg. A column of n such contacts buckles if k w^2 is not above W n^2 / (width of the
/// column). w is a fixed fraction of the substep rate, so that more substeps make contacts stiffer. Therefore both the
/// permitted sag (WorldDef::resting_penetration) and the stability of the column require a minimum number of substeps.
/// In islands with joints, w is a fraction of a fixed rate instead (k_jointed_stiffness), because a substep costs much
/// there.
/// Source: the sag of a spring; Euler, "De curvis elasticis", 1744, for a column with elastic joints.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Limits of the number of substeps, so that a single contact cannot make a whole large island expensive.
struct SubstepLimit {
  uint32_t contact_substeps;  ///< largest product of contacts and substeps; a joint counts as k_joint_contacts contacts
  uint32_t always;            ///< this number of substeps is always permitted
};
inline constexpr uint32_t k_contact_substeps = 20480;
inline constexpr uint32_t k_rolling_substeps = 2048;
/// The limit for contacts on edges and faces (k_edge_points points or more), which can buckle. An island of 900
/// contacts may take 22 substeps, one of 2,000 may take 10.
inline constexpr SubstepLimit k_face_limit = {k_contact_substeps, 6};
/// The limit for rolling contacts (contacts of one point), which can only sink.
inline constexpr SubstepLimit k_rolling_limit = {k_rolling_substeps, 4};
inline constexpr uint32_t k_edge_points = 2;
/// The largest number of substeps that an island with joints takes for the sag of its contacts. It is small, because
/// the contacts of such an island are stiff already (k_jointed_stiffness). In islands with joints this number is always
/// permitted.
inline constexpr uint32_t k_jointed_sag_substeps = 6;
inline constexpr uint32_t k_joint_contacts = 8;
/// The number of substeps decreases after k_calm_ticks ticks in a row for which fewer substeps were enough.
inline constexpr uint32_t k_calm_ticks = 60;
/// Replaces k_calm_ticks in two cases. The first case is that half the number of substeps is enough: the high number
/// came from an impact, not from a load. The second case is an island with joints, which needs more substeps only while
/// its bodies rotate.
inline constexpr uint32_t k_few_calm_ticks = 8;

/// Sets the number of substeps of each island, in `islands` and in the activities of its bodies. The number follows
/// from the loads of the contacts and from Island::joint_need. It increases at once. Without joints, it decreases to
/// the next lower entry of k_notches after k_calm_ticks, or after k_few_calm_ticks if half the number is enough. With
/// joints, it decreases to the number that is needed, after k_few_calm_ticks. The function scales contact impulses that
/// were stored with another number of substeps. It also sets BodyWork::supports to 1 for the bodies of islands whose
/// warm start is limited (limit_warm_start()), else to 0.
void choose_substeps(const StepSettings& settings, Span<const BodyProperties> properties, Span<BodyWork> work,
                     Span<const uint32_t> bodies, Span<const ContactOrder> order, Span<Island> islands,
                     Span<ContactWork> contacts, Span<BodyActivity> activities);

/// Sets the load of each new contact to the weight of its upper body. If more than half of the island's contacts are
/// new, for example at the start of a scene, the load also includes the weight of all bodies on the upper body, and is
/// divided equally among the supports of the upper body. With these loads, stacks do not sink or begin to sway before
/// the loads are measured. `spare` is work space as large as `order`.
void estimate_loads(const StepSettings& settings, Span<const BodyPose> poses, Span<const BodyProperties> properties,
                    Span<const uint32_t> bodies, Span<const Island> islands, Span<const ContactOrder> order,
                    Span<ContactOrder> spare, Span<BodyWork> work, Span<ContactWork> contacts);

/// Stores the normal force of the last substep as the contact's load. The load is limited to twice the old load or the
/// weight of the lighter dynamic body, whichever is greater, so that an impact does not count as a load. If the limit
/// applies, the function also scales the impulses for the next tick to the limited load, so that the impact is not
/// carried over.
void store_load(const StepSettings& settings, ContactWork& contact);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
