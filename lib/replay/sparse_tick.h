#pragma once
#include <detent/rollback.h>

#include "base/bit_set.h"
#include "shape/body.h"
#include "shape/bounds.h"
#include "state/step_cache.h"
#include "world/step_probe.h"

/// The parts of sparse rollback that work on one tick.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// What a step was made from and what it did.
struct TickHead {
  uint64_t tick;      ///< before the step
  uint32_t usable;    ///< 1 if the tick can be made again in part
  uint32_t before;    ///< image of the state just before the step
  uint32_t buffers;   ///< bits 0 to 3: the world had a buffer for contact, joint, sensor, body events
  uint32_t event[4];  ///< events in these buffers
  ImpactUse impacts;
  uint32_t joint_couplings, joint_numbers;
  StepReport report;
  /// 1 if the tick was made again in part: the members below are of the run of TickRecord::part_inside.
  uint32_t part_known;
  uint32_t part_couplings, part_numbers;
  ImpactUse part_impacts;
  StepReport part;
};
static_assert(sizeof(TickHead) <= k_tick_head_bytes);

struct TickRecord {
  TickHead& head;
  Span<Bounds> reach;                ///< by slot: bounds of all places in which the step looked for pairs of the body
  BitSet movers;                     ///< dynamic and kinematic bodies that moved or woke in the step
  BitSet solved;                     ///< dynamic bodies that the solver moved
  BitSet part_inside, part_visible;  ///< see TickHead::part_known
  Span<ContactEvent> contact_events;
  Span<JointEvent> joint_events;
  Span<SensorEvent> sensor_events;
  Span<BodyEvent> body_events;
};

/// A tick that is made again in part. *Inside* are the bodies that are simulated; *visible* are these and the resting
/// and kinematic bodies that they may touch. All other bodies take their recorded states.
struct SparseTick {
  using State = StateView<const uint8_t>;

  TickRecord record;
  State before;    ///< recorded, just before the step
  State after;     ///< recorded, just after the step
  State now;       ///< of the tick that is made again, just before the step
  uint32_t used;   ///< slots used, in `before` or in `now`
  BitSet differs;  ///< bodies whose state before the step is not the recorded one
  BitSet inside;
  BitSet visible;
  BitSet groups;         ///< sleeping groups of bodies inside
  BitSet joints;         ///< joints inside, and those that differ
  BitSet anchoring;      ///< other active joints of visible bodies that are not dynamic
  Span<uint32_t> units;  ///< by slot: of a body that joints hold on to but do not move, its unit for joints in one run
  Span<Bounds> boxes;    ///< of bodies inside: what they reach in either run
  Span<Bounds> reach;    ///< TickRecord::reach of the run of the bodies inside
  BitSet solved;         ///< TickRecord::solved of this run
  Span<uint32_t> list;   ///< bodies inside that may move or that differ: they reach others
  uint32_t count = 0;    ///< of `list`
  uint32_t most = 0;     ///< the greatest number of bodies in `list`
  bool grew = false;     ///< a body became visible or inside
  bool has_groups = false;                            ///< `groups` is not empty
  uint32_t contacts_written = 0, sensed_written = 0;  ///< elements of the block that may be other than zero

  bool is_dynamic(uint32_t slot) const {
    return detent::is_dynamic(now.properties[slot]) || detent::is_dynamic(before.properties[slot]);
  }
  /// Whether a pair with this body can touch or sense, whatever the other body is.
  bool can_act(uint32_t slot) const {
    return is_dynamic(slot) || is_sensor(now.properties[slot]) || is_sensor(before.properties[slot]);
  }
  /// Whether a contact belongs to the bodies inside.
  bool owns_contact(uint32_t a, uint32_t b) const {
    if (!inside.has(a) && !inside.has(b)) return false;
    const auto is_outside = [&](uint32_t slot) {
      return !inside.has(slot) && record.movers.has(slot) && is_dynamic(slot);
    };
    return !is_outside(a) && !is_outside(b);
  }
  /// Whether an active joint of the body `other`, which is not inside, holds on to the visible body `slot`.
  bool anchors(uint32_t slot, uint32_t other) const {
    return visible.has(slot) && !is_dynamic(slot) && record.solved.has(other);
  }
  bool owns_sensed(uint32_t sensor, uint32_t body) const { return inside.has(sensor) || inside.has(body); }

  // sparse_reach.cpp

  /// Finds the bodies that differ. Returns false if something differs that concerns all bodies.
  bool find_differing();
  /// Puts the bodies that differ inside, with their bounds in this tick.
  void begin(const StepSettings& settings, Span<BodyWork> work);
  /// Puts all bodies inside that the bodies inside reach. Returns false if there are too many.
  bool expand();
  /// Adds what the bodies inside have reached in their run. `active`: after this run.
  void note_reach(BitSet active);

  // sparse_merge.cpp

  /// Writes the state of the visible bodies to the block, with the contacts, joints and sensed pairs of those inside,
  /// and restricts the step cache to them.
  void load(const State& from, const StateView<uint8_t>& block);
  /// Writes the whole state `now` to the block again.
  void reset(const StateView<uint8_t>& block) const;
  /// Keeps the units of the bodies that joints hold on to but do not move, after the run from the recorded state.
  void keep_units(Span<const JointBody> bodies) const;
  /// Whether these units are as before, after the other run. All joints of a body share its unit.
  bool has_same_units(Span<const JointBody> bodies) const;
  /// Whether the block has the recorded state after the step, for the bodies inside.
  bool is_recorded(const StateView<uint8_t>& block) const;
  /// Completes the block with the recorded states of all other bodies. False if the contacts do not fit.
  bool merge(const StateView<uint8_t>& block);
  /// Completes the events of this step in the caller's buffers, which `report` counts. False if they do not fit.
  bool merge_events(const WorldHooks& hooks, StepReport& report) const;

 private:
  void add(uint32_t slot);
  bool meets(uint32_t slot, uint32_t from, uint32_t end) const;
  void add_jointed(Span<const JointState> all);
  void add_sleeping();
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
