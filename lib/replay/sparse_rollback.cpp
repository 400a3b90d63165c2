#include "replay/sparse_rollback.h"

#include <string.h>

#include "base/bytes.h"
#include "base/float_environment.h"
#include "motion/activity.h"
#include "motion/predict.h"
#include "replay/sparse_report.h"
#include "state/snapshot.h"
#include "state/step_scratch.h"
#include "state/used.h"
#include "world/events.h"

#if DETENT_SPARSE

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr uint32_t k_runs_max = 3;  ///< largest number of rounds in which simulate() runs the bodies
/// When a tick is repeated, the whole world is simulated if the bodies to simulate number more than 1 / k_share_divisor
/// of the bodies that moved in the recorded step. The bodies to simulate may be simulated twice: from the recorded
/// state and from the present state.
constexpr uint32_t k_share_divisor = 3;

/// Whether the used elements of two states are equal.
bool is_same_state(const StateView<const uint8_t>& a, const StateView<const uint8_t>& b) {
  const UsedCounts counts = used_counts(a), others = used_counts(b);
  const auto* bytes_a = reinterpret_cast<const uint8_t*>(&a.header);
  const auto* bytes_b = reinterpret_cast<const uint8_t*>(&b.header);
  for (uint32_t i = 1; i < k_section_count; ++i) {
    const uint32_t offset = a.layout.*k_sections[i].offset;
    if (counts.of[i] != others.of[i] ||
        !have_same_bytes(bytes_a + offset, bytes_b + offset, counts.of[i] * k_sections[i].element_bytes))
      return false;
  }
  return true;
}

StateView<const uint8_t> read_only(const StateView<uint8_t>& state) {
  return const_view_of(reinterpret_cast<const uint8_t*>(&state.header));
}

StepCacheView cache_in(World& world) {
  StateView<uint8_t> state = view_of(world);
  return cache_of(state);
}

bool are_equal_sets(BitSet a, BitSet b) {
  return have_same_bytes(a.words.data, b.words.data, a.words.count * sizeof(uint32_t));
}

bool can_move(const BodyProperties& properties) { return is_dynamic(properties) || is_kinematic(properties); }

}  // namespace

SparseRollback* SparseRollback::begin(uint8_t* memory, const World& world, uint32_t window) {
  const StateView<const uint8_t> state = view_of(world);
  SparseRollback& made = *reinterpret_cast<SparseRollback*>(memory);
  made = SparseRollback{};
  made.capacity_ = capacity_of(state.header);
  made.layout_ = sparse_layout(made.capacity_, window);
  made.window_ = window;
  made.summed = state.world.tick;
  made.memory_ = memory;
  made.images_ = memory + made.layout_.images;
  memset(made.images_, 0, static_cast<uint32_t>(made.layout_.bytes) - made.layout_.images);
  // The images of the states at the starts of ticks come first, then those of the states just before the recorded
  // steps, then the spare image.
  for (uint32_t i = 0; i < 2 * window + 2; ++i)
    *at_offset<BlockHeader>(made.images_ + i * made.layout_.image_bytes, 0) = state.header;
  made.spare_ = 2 * window + 1;
  for (uint32_t i = 0; i < window; ++i) made.record_of(i).head.before = window + 1 + i;
  made.observer_ = {note_stage, &made, make_step};
  return &made;
}

TickRecord SparseRollback::record_of(uint64_t tick) const {
  uint8_t* const at = memory_ + layout_.records + static_cast<uint32_t>(tick % window_) * layout_.record_bytes;
  const uint32_t words = slot_words(capacity_.bodies);
  return {*at_offset<TickHead>(at, 0),
          {at_offset<Bounds>(at, layout_.reach), capacity_.bodies},
          {{at_offset<uint32_t>(at, layout_.movers), words}},
          {{at_offset<uint32_t>(at, layout_.solved), words}},
          {{at_offset<uint32_t>(at, layout_.part_inside), words}},
          {{at_offset<uint32_t>(at, layout_.part_visible), words}},
          {at_offset<ContactEvent>(at, layout_.contact_events), capacity_.contacts},
          {at_offset<JointEvent>(at, layout_.joint_events), capacity_.joints},
          {at_offset<SensorEvent>(at, layout_.sensor_events), 2 * capacity_.sensed},
          {at_offset<BodyEvent>(at, layout_.body_events), capacity_.bodies}};
}

Status SparseRollback::keep(const World& world) {
  const StateView<const uint8_t> state = view_of(world);
  if (!(capacity_of(state.header) == capacity_)) return Status::capacity_differs;
  const uint64_t tick = state.world.tick;
  const StateView<uint8_t> kept = image(start_image(tick));
  if (is_same_state(state, read_only(kept))) return Status::ok;
  copy_used(state, kept);
  // The world was changed after the step of the previous tick, so the state just after that step is lost.
  if (tick == 0) return Status::ok;
  TickHead& last = record_of(tick - 1).head;
  if (last.tick == tick - 1) last.usable = 0;
  return Status::ok;
}

Status SparseRollback::restore(World& world, uint64_t tick) {
  if (const Status status = keep(world); status != Status::ok) return status;
  const StateView<uint8_t> state = view_of(world);
  const StateView<uint8_t> kept = image(start_image(tick));
  const Status status = check_header(kept.header, capacity_, *world.features);
  if (status != Status::ok) return status;
  copy_used(read_only(kept), state);
  take_over(world);
  bodies_again = ticks_whole = 0;
  return Status::ok;
}

World SparseRollback::kept(uint64_t tick) const {
  World world;
  world.block = images_ + start_image(tick) * layout_.image_bytes;
  return world;
}

void SparseRollback::start_tick(World& world, bool again) {
  again_ = again;
  block_ = world.block;
  theirs_ = world.hooks.observer;
  world.hooks.observer = &observer_;
}

void SparseRollback::end_tick(World& world) {
  block_ = nullptr;
  if (world.hooks.observer == &observer_) world.hooks.observer = theirs_;
}

StepReport SparseRollback::make_step(void* context, World& world) {
  SparseRollback& self = *static_cast<SparseRollback*>(context);
  if (world.block == self.block_) return self.step(world);
  // This is not a step of the session: the game has copied the World object, with this observer, and steps the copy
  // with another block or outside of the session's tick.
  World other = world;
  other.hooks.observer = self.theirs_;
  StepProbe probe;
  return step_probed(other, probe);
}

void SparseRollback::note_stage(void* context, const World& world, StepStage stage, uint32_t contacts) {
  SparseRollback& self = *static_cast<SparseRollback*>(context);
  if (!self.inside_ && self.theirs_ != nullptr && self.theirs_->stage_ended != nullptr)
    self.theirs_->stage_ended(self.theirs_->context, world, stage, contacts);
  if (stage != StepStage::find_pairs) return;
  const StateView<const uint8_t> state = view_of(world);
  const StepCacheView cache = cache_of(world.block, state.layout, self.capacity_);
  const auto note = [&](uint32_t slot) { self.reach_[slot] = cache.bounds[slot]; };
  for (uint32_t slot = 0; slot < state.world.slots_used; ++slot) {
    if (cache.tree.has(slot)) note(slot);
  }
  cache.active.for_each([&](uint32_t slot) {
    note(slot);
    if (is_awake(state.properties[slot], state.activities[slot])) self.solved_.set(slot);
  });
  self.noted_ = true;
}

StepReport SparseRollback::step(World& world) {
  const FloatEnvironment environment;
  const StateView<uint8_t> state = view_of(world);
  const uint64_t tick = state.world.tick;
  const TickRecord record = record_of(tick);
  copy_used(read_only(state), image(spare_));
  StepReport report;
  bool made = false;
  if (again_) made = record.head.usable != 0 && record.head.tick == tick && step_sparse(world, record, report);
  if (!made) {
    report = step_whole(world, record);
    ticks_whole += again_ ? 1 : 0;
    bodies_again += again_ ? report.awake : 0;
  }
  const uint32_t before = record.head.before;
  record.head.before = spare_;
  spare_ = before;
  record.head.tick = tick;
  record.head.report = report;
  record.head.buffers = buffers_of(world.hooks);
  record_events(world, report, record);
  copy_used(read_only(state), image(start_image(tick + 1)));
  return report;
}

/// Copies the events of the step to the record. If the record has no room for them, it becomes unusable.
void SparseRollback::record_events(const World& world, const StepReport& report, const TickRecord& record) const {
  const auto copy = [&](const auto& buffer, uint32_t count, const auto& to, uint32_t& kept) {
    if (count > to.count) record.head.usable = 0;
    kept = count > to.count ? 0 : count;
    for (uint32_t i = 0; i < kept; ++i) to[i] = buffer.data[i];
  };
  copy(world.hooks.contact_events, report.events.contact, record.contact_events, record.head.event[0]);
  copy(world.hooks.joint_events, report.events.joint, record.joint_events, record.head.event[1]);
  copy(world.hooks.sensor_events, report.events.sensor, record.sensor_events, record.head.event[2]);
  copy(world.hooks.body_events, report.events.body, record.body_events, record.head.event[3]);
}

/// Sets `reach` to the bounds of all bodies, for an idle step, which does not compute them.
void SparseRollback::reach_at_rest(World& world, Span<Bounds> reach) const {
  const StateView<uint8_t> state = view_of(world);
  const Scratch scratch = scratch_of(world.block, state.layout, capacity_);
  const StepSettings settings = step_settings(state.world);
  for (uint32_t slot = 0; slot < state.world.slots_used; ++slot) {
    if (state.properties[slot].type != 0)
      bound(settings, state.poses, state.properties, state.motions, {&slot, 1}, scratch.bodies, reach);
  }
}

StepReport SparseRollback::step_whole(World& world, const TickRecord& record) {
  const StateView<uint8_t> state = view_of(world);
  const bool is_idle = state.world.idle != 0;
  for (Bounds& bounds : record.reach) bounds = k_nowhere;
  for (uint32_t i = 0; i < record.movers.words.count; ++i) record.movers.words[i] = record.solved.words[i] = 0;
  StepProbe probe;
  probe.reach = reach_ = record.reach;
  solved_ = record.solved;
  inside_ = noted_ = false;
  const StepReport report = step_probed(world, probe);
  if (is_idle) {
    reach_at_rest(world, record.reach);
  } else {
    cache_in(world).active.for_each([&](uint32_t slot) {
      if (can_move(state.properties[slot])) record.movers.set(slot);
    });
  }
  TickHead& head = record.head;
  head.part_known = 0;
  head.impacts = probe.use;
  head.joint_couplings = probe.joint_couplings;
  head.joint_numbers = probe.joint_numbers;
  // In a world with sensors, the record is usable only with continuous collision and a buffer of sensor events. Without
  // continuous collision, a body may leave its bounds, and a sensor could find it there. Bodies that pass through
  // sensors take room in the pool of sensed pairs; only the sensor events tell how many there are.
  const bool is_bounded =
      state.world.sensor_count == 0 || (state.world.continuous != 0 && room_of(world.hooks.sensor_events).count != 0);
  head.usable = (is_idle || noted_) && is_whole(report) && is_bounded && !probe.use.is_spent() ? 1 : 0;
  return report;
}

/// Simulates a step of only the bodies in SparseTick::inside, from the state `from`. Returns false if the step used up
/// a pool or a budget, or if continuous collision stopped a body: then the bodies that are not simulated could change
/// the result.
bool SparseRollback::run(World& world, SparseTick& tick, const StateView<const uint8_t>& from, const WorldHooks& hooks,
                         StepProbe& probe, StepReport& report) {
  tick.load(from, view_of(world));
  for (uint32_t slot = 0; slot < tick.used; ++slot) tick.reach[slot] = k_nowhere;
  for (uint32_t& word : tick.solved.words) word = 0;
  probe = {};
  probe.reach = reach_ = tick.reach;
  probe.joints = from.joints;
  probe.anchoring = tick.anchoring;
  solved_ = tick.solved;
  inside_ = true;
  World part = world;
  part.hooks = hooks;
  part.hooks.observer = &observer_;
  part.hooks.capacity_events = {};
  report = step_probed(part, probe);
  const StateView<uint8_t> state = view_of(world);
  if (tick.contacts_written < state.world.contact_count) tick.contacts_written = state.world.contact_count;
  if (tick.sensed_written < state.world.sensed_count) tick.sensed_written = state.world.sensed_count;
  return is_whole(report) && !probe.use.is_spent() && report.ccd.bodies_stopped == 0;
}

/// If the record already has the result of a run of the same bodies from the recorded state, sets `base` and
/// base_probe_ to this result and returns true.
bool SparseRollback::take_known_part(const SparseTick& tick, StepReport& base) {
  const TickRecord& record = tick.record;
  const TickHead& head = record.head;
  if (head.part_known == 0 || !are_equal_sets(record.part_inside, tick.inside) ||
      !are_equal_sets(record.part_visible, tick.visible))
    return false;
  base = head.part;
  base_probe_ = {};
  base_probe_.use = head.part_impacts;
  base_probe_.joint_couplings = head.part_couplings;
  base_probe_.joint_numbers = head.part_numbers;
  return true;
}

/// Keeps the result of the last run of the simulated bodies, for take_known_part(). The result cannot be used again if
/// a body has joints but is not moved by the solver, because its unit for joints (SparseTick::keep_units()) is not
/// kept.
void SparseRollback::keep_part(const SparseTick& tick, const StepReport& made, TickHead& head) const {
  head.part_known = 1;
  for (const JointBody& body : made_probe_.joint_bodies) {
    if (body.mobile == 0) head.part_known = 0;
  }
  head.part = made;
  head.part_impacts = made_probe_.use;
  head.part_couplings = made_probe_.joint_couplings;
  head.part_numbers = made_probe_.joint_numbers;
  memcpy(tick.record.part_inside.words.data, tick.inside.words.data, tick.inside.words.count * sizeof(uint32_t));
  memcpy(tick.record.part_visible.words.data, tick.visible.words.data, tick.visible.words.count * sizeof(uint32_t));
}

/// Simulates the bodies in SparseTick::inside, once from the recorded state and once from the present state. Repeats
/// this with more bodies, up to k_runs_max rounds in all, until the simulated bodies reach no others. Returns false if
/// the whole world must be simulated instead.
bool SparseRollback::simulate(World& world, SparseTick& tick, StepReport& base, StepReport& made) {
  const StateView<uint8_t> state = view_of(world);
  if (!tick.expand()) return false;
  WorldHooks silent = world.hooks;
  silent.contact_events = {};
  silent.joint_events = {};
  silent.sensor_events = {};
  silent.body_events = {};
  for (uint32_t tries = 0; tries < k_runs_max; ++tries) {
    if (!take_known_part(tick, base) &&
        (!run(world, tick, tick.before, silent, base_probe_, base) || !tick.is_recorded(state)))
      return false;
    tick.keep_units(base_probe_.joint_bodies);
    if (!run(world, tick, tick.now, world.hooks, made_probe_, made)) return false;
    if (!tick.has_same_units(made_probe_.joint_bodies)) return false;
    tick.note_reach(cache_in(world).active);
    if (!tick.expand()) return false;
    if (!tick.grew) return true;
  }
  return false;
}

bool SparseRollback::step_sparse(World& world, const TickRecord& record, StepReport& report) {
  const StateView<uint8_t> state = view_of(world);
  const uint64_t tick_number = state.world.tick;
  if (state.world.idle != 0 || record.head.buffers != buffers_of(world.hooks)) return false;
  const uint32_t words = slot_words(capacity_.bodies);
  uint32_t set = 0;
  const auto next_set = [&] {
    const BitSet made = {{at_offset<uint32_t>(memory_, layout_.sets) + set++ * words, words}};
    for (uint32_t& word : made.words) word = 0;
    return made;
  };
  const uint32_t joint_words = slot_words(capacity_.joints);
  const BitSet joints = {{at_offset<uint32_t>(memory_, layout_.joint_sets), joint_words}},
               anchoring = {{joints.words.data + joint_words, joint_words}};
  for (uint32_t& word : joints.words) word = 0;
  const SparseTick::State before = read_only(image(record.head.before)), now = read_only(image(spare_)),
                          after = read_only(image(start_image(tick_number + 1)));
  const uint32_t used = before.world.slots_used < now.world.slots_used ? now.world.slots_used : before.world.slots_used;
  SparseTick tick = {record,
                     before,
                     after,
                     now,
                     used,
                     next_set(),
                     next_set(),
                     next_set(),
                     next_set(),
                     joints,
                     anchoring,
                     {at_offset<uint32_t>(memory_, layout_.units), capacity_.bodies},
                     {at_offset<Bounds>(memory_, layout_.boxes), capacity_.bodies},
                     {at_offset<Bounds>(memory_, layout_.reach_now), capacity_.bodies},
                     next_set(),
                     {at_offset<uint32_t>(memory_, layout_.list), capacity_.bodies}};
  uint32_t movers = 0;
  record.movers.for_each([&](uint32_t) { ++movers; });
  tick.most = movers / k_share_divisor;
  if (!tick.find_differing()) return false;
  tick.begin(step_settings(now.world), scratch_of(world.block, state.layout, capacity_).bodies);
  StepReport base, made;
  TickHead total = record.head;
  bool is_exact = simulate(world, tick, base, made);
  if (is_exact) {
    replace_sums(base, made, total.report);
    replace_use(base_probe_, made_probe_, total);
    total.report.events = made.events;
    total.report.bodies = now.world.body_count;
    total.report.substeps_max = most_substeps(tick, made.substeps_max);
    // merge_events() writes to the caller's event buffers. If one of the conditions fails, the step of the whole world
    // that follows overwrites them.
    is_exact = has_room(total, capacity_) && tick.merge_events(world.hooks, total.report) && tick.merge(state) &&
               state.world.sensed_count + total.report.events.sensor <= capacity_.sensed;
  }
  const BitSet active = cache_in(world).active;
  cache_in(world).cache.fresh = 0;
  if (!is_exact) {
    tick.reset(state);
    return false;
  }
  const auto put = [](BitSet of, uint32_t slot, bool value) { value ? of.set(slot) : of.clear(slot); };
  tick.inside.for_each([&](uint32_t slot) {
    record.reach[slot] = tick.reach[slot];
    put(record.movers, slot, active.has(slot) && can_move(now.properties[slot]));
    put(record.solved, slot, tick.solved.has(slot));
  });
  keep_part(tick, made, total);
  record.head = total;
  report = total.report;
  bodies_again += made.awake;
  return true;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent

#endif
