#include "replay/sparse_report.h"

#include "replay/sparse_rollback.h"
#include "world/events.h"

#if DETENT_SPARSE

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// In `total`, a count of a step of the whole world, replaces the contribution `base` of the simulated bodies by
/// `made`.
template <class Count>
void replace(const Count& base, const Count& made, Count& total) {
  total = static_cast<Count>(total - base + made);
}

}  // namespace

bool is_whole(const StepReport& report) {
  const LossReport& lost = report.lost;
  const EventReport& events = report.events;
  return (lost.pairs | lost.contacts | lost.joint_couplings | lost.impacts | lost.sensed | lost.sensed_undecided |
          events.capacity | events.contact_dropped | events.joint_dropped | events.sensor_dropped |
          events.body_dropped) == 0;
}

uint32_t buffers_of(const WorldHooks& hooks) {
  const auto bit = [](const auto& buffer, uint32_t index) { return room_of(buffer).count != 0 ? 1u << index : 0u; };
  return bit(hooks.contact_events, 0) | bit(hooks.joint_events, 1) | bit(hooks.sensor_events, 2) |
         bit(hooks.body_events, 3);
}

void replace_sums(const StepReport& base, const StepReport& made, StepReport& total) {
  const auto replace_in = [&](const auto& of) { replace(of(base), of(made), of(total)); };
#define DETENT_SPARSE_SUM(member) replace_in([](auto& report) -> auto& { return report.member; })
  DETENT_SPARSE_SUM(awake);
  DETENT_SPARSE_SUM(islands);
  DETENT_SPARSE_SUM(woke);
  DETENT_SPARSE_SUM(fell_asleep);
  DETENT_SPARSE_SUM(contacts.pairs);
  DETENT_SPARSE_SUM(contacts.count);
  DETENT_SPARSE_SUM(contacts.points);
  DETENT_SPARSE_SUM(contacts.recycled);
  DETENT_SPARSE_SUM(contacts.capped);
  DETENT_SPARSE_SUM(contacts.sweeps_saved);
  DETENT_SPARSE_SUM(contacts.substeps);
  DETENT_SPARSE_SUM(contacts.colour_overflows);
  DETENT_SPARSE_SUM(joints.count);
  DETENT_SPARSE_SUM(joints.broken);
  DETENT_SPARSE_SUM(joints.undecided);
  DETENT_SPARSE_SUM(saturations);
  DETENT_SPARSE_SUM(ccd.impacts);
  DETENT_SPARSE_SUM(ccd.undecided);
  DETENT_SPARSE_SUM(ccd.overlaps_left);
  DETENT_SPARSE_SUM(ccd.tests);
  DETENT_SPARSE_SUM(ccd.skipped);
  DETENT_SPARSE_SUM(ccd.kept_apart);
#undef DETENT_SPARSE_SUM
}

void replace_use(const StepProbe& base, const StepProbe& made, TickHead& total) {
  replace(base.use.entries, made.use.entries, total.impacts.entries);
  replace(base.use.work, made.use.work, total.impacts.work);
  replace(base.use.budget, made.use.budget, total.impacts.budget);
  replace(base.joint_couplings, made.joint_couplings, total.joint_couplings);
  replace(base.joint_numbers, made.joint_numbers, total.joint_numbers);
}

bool has_room(const TickHead& total, Capacity capacity) {
  const StepReport& report = total.report;
  return !total.impacts.is_spent() && total.impacts.entries <= capacity.contacts &&
         report.ccd.impacts <= capacity.contacts && total.joint_couplings <= joint_coupling_count(capacity) &&
         total.joint_numbers <= joint_number_count(capacity) &&
         report.contacts.pairs <= capacity.contacts * k_pairs_per_contact;
}

uint32_t most_substeps(const SparseTick& tick, uint32_t most) {
  const uint32_t fixed = tick.now.world.substeps;
  tick.record.solved.for_each([&](uint32_t slot) {
    if (tick.inside.has(slot)) return;
    const uint32_t own = tick.after.activities[slot].substeps;
    const uint32_t substeps = own != 0 ? own : fixed != 0 ? fixed : 1;  // an island without contacts stores none
    most = substeps > most ? substeps : most;
  });
  return most;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent

#endif
