#pragma once
#include <detent/world.h>

/// @file
/// Measures how much of its capacity a world uses, and suggests a capacity that fits.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The largest number of entries that any recorded step needed in each pool of a world. All 0 before the first step.
struct CapacityUse {
  uint32_t bodies = 0;    ///< bodies in the world
  uint32_t contacts = 0;  ///< contacts kept (those of sleeping bodies included) and dropped
  /// Pairs with overlapping bounds, kept and dropped; the pool holds 2 x Capacity::contacts.
  uint32_t pairs = 0;
  /// Pairs of continuous collision, kept and dropped; the pool holds Capacity::contacts. 0 if none was dropped.
  uint32_t impacts = 0;
  uint32_t joints = 0;      ///< joints in the world
  uint32_t sensed = 0;      ///< bodies within sensors, kept and dropped
  uint64_t steps_full = 0;  ///< steps in which a pool had no room
};

/// Records a step in `use`. `report`: of the step; `after`: get_info() after it.
constexpr void note_use(const StepReport& report, const WorldInfo& after, CapacityUse& use) {
  const auto note = [](uint32_t& most, uint32_t kept, uint32_t dropped) {
    const uint32_t wanted = kept < UINT32_MAX - dropped ? kept + dropped : UINT32_MAX;
    most = most < wanted ? wanted : most;
  };
  note(use.bodies, after.bodies, 0);
  const uint32_t contacts_dropped = report.lost.contacts - report.lost.contact_parts;
  note(use.contacts, after.contacts, contacts_dropped);
  note(use.pairs, report.contacts.pairs, 0);
  if (report.lost.impacts != 0) note(use.impacts, after.capacity.contacts, report.lost.impacts);
  note(use.joints, after.joints, 0);
  note(use.sensed, after.sensed, report.lost.sensed);
  if (report.lost.pairs != 0 || contacts_dropped != 0 || report.lost.impacts != 0 || report.lost.sensed != 0)
    ++use.steps_full;
}

/// A capacity with room for the recorded use plus a quarter, rounded up, and for at least one body. `assets` and
/// `manifolds` are not recorded: they are copied from `now`. Dropped entries change the motion, so a run with the
/// larger capacity may need still more: record that run too.
constexpr Capacity suggest_capacity(const CapacityUse& use, const Capacity& now) {
  const auto with_spare = [](uint32_t count) {
    const uint32_t spare = count / 4 + (count % 4 != 0 ? 1 : 0);
    return count < UINT32_MAX - spare ? count + spare : UINT32_MAX;
  };
  const uint32_t of_pairs = use.pairs / 2 + use.pairs % 2;
  uint32_t contacts = use.contacts < of_pairs ? of_pairs : use.contacts;
  contacts = contacts < use.impacts ? use.impacts : contacts;
  Capacity fit = now;
  fit.bodies = use.bodies == 0 ? 1 : with_spare(use.bodies);
  fit.contacts = with_spare(contacts);
  fit.joints = with_spare(use.joints);
  fit.sensed = with_spare(use.sensed);
  return fit;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
