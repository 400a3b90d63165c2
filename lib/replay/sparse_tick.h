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

/// The fixed-size part of the record of a step: the state from which the step started, and what it did.
struct TickHead {
  uint64_t tick;      ///< before the step
  uint32_t usable;    ///< 1 if the tick can be repeated in part
  uint32_t before;    ///< index of the image of the state just before the step
  uint32_t buffers;   ///< bits 0 to 3: the world had a buffer for contact, joint, sensor, body events
  uint32_t event[4];  ///< numbers of events in these buffers
  ImpactUse impacts;
  uint32_t joint_couplings, joint_numbers;
  StepReport report;
  /// 1 if the tick was repeated in part, and its result can be used again. Then the members below are of the run of the
  /// bodies in TickRecord::part_inside.
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

/// A tick that is repeated in part. The bodies *inside* are simulated. The *visible* bodies are the bodies inside and
/// the resting and kinematic bodies that these may touch. All bodies that are not inside take their recorded states.
struct SparseTick {
  using State = StateView<const uint8_t>;

  TickRecord record;
  State before;    ///< recorded, just before the step
  State after;     ///< recorded, just after the step
  State now;       ///< of the tick that is repeated, just before the step
  uint32_t used;   ///< number of slots used: the greater of those in `before` and `now`
  BitSet differs;  ///< bodies whose state before the step is not the recorded one
  BitSet inside;
  BitSet visible;
  BitSet groups;            ///< sleeping groups of bodies inside
  BitSet joints;            ///< joints of bodies inside, and joints that differ from the record
  BitSet anchoring;         ///< other active joints of visible bodies that are not dynamic
  Span<uint32_t> units;     ///< by slot: keep_units()
  Span<Bounds> boxes;       ///< by slot, of bodies inside: what they reach in either run
  Span<Bounds> reach;       ///< as TickRecord::reach, for the latest run of the bodies inside
  BitSet solved;            ///< as TickRecord::solved, for the latest run
  Span<uint32_t> list;      ///< bodies inside that may move or that differ: they reach others
  uint32_t count = 0;       ///< number of bodies in `list`
  uint32_t most = 0;        ///< the greatest permitted `count`
  bool grew = false;        ///< a body became visible or inside
  bool has_groups = false;  ///< `groups` is not empty
  uint32_t contacts_written = 0, sensed_written = 0;  ///< elements of the block that may be other than zero

  bool is_dynamic(uint32_t slot) const {
    return detent::is_dynamic(now.properties[slot]) || detent::is_dynamic(before.properties[slot]);
  }
  /// Whether a pair of this body and any other body can have a contact or be sensed.
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
  /// Adds the bodies that differ to the bodies inside, with their bounds in this tick.
  void begin(const StepSettings& settings, Span<BodyWork> work);
  /// Adds all bodies that the bodies inside reach to the bodies inside. Returns false if `count` exceeds `most`.
  bool expand();
  /// Adds to `boxes` what the bodies inside have reached in their run. `active`: the active bodies after this run.
  void note_reach(BitSet active);

  // sparse_merge.cpp

  /// Writes the states of the visible bodies to the block, and the contacts, joints and sensed pairs of the bodies
  /// inside. Restricts the step cache to the visible bodies.
  void load(const State& from, const StateView<uint8_t>& block);
  /// Writes the whole state `now` to the block again.
  void reset(const StateView<uint8_t>& block) const;
  /// After the run from the recorded state: stores the units for joints of the bodies that joints hold on to but do not
  /// move.
  void keep_units(Span<const JointBody> bodies) const;
  /// After the run from the present state: whether these units are the same as after the run from the recorded state.
  /// If a unit differs, joints outside may be affected, because all joints of a body share the body's unit.
  bool has_same_units(Span<const JointBody> bodies) const;
  /// Whether the states of the bodies inside in the block are those that were recorded after the step.
  bool is_recorded(const StateView<uint8_t>& block) const;
  /// Completes the block with the recorded states of all other bodies. Returns false if the contacts or the sensed
  /// pairs do not fit.
  bool merge(const StateView<uint8_t>& block);
  /// Adds the recorded events of all other bodies to the events of this step in the caller's buffers. `report` counts
  /// the events. Returns false if the events do not fit.
  bool merge_events(const WorldHooks& hooks, StepReport& report) const;

 private:
  void add(uint32_t slot);
  bool meets(uint32_t slot, uint32_t from, uint32_t end) const;
  void add_jointed(Span<const JointState> all);
  void add_sleeping();
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
