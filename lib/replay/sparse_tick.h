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

/// The part of the record of a step that has a fixed size: where the state before the step is, and what the step did.
struct TickHead {
  uint64_t tick;      ///< number of ticks completed before the step
  uint32_t usable;    ///< 1 if a repetition of the tick may simulate only a part of the bodies
  uint32_t before;    ///< index of the image (SparseRollback) of the state just before the step
  uint32_t buffers;   ///< bits 0 to 3: the world had a buffer for contact, joint, sensor, body events
  uint32_t event[4];  ///< numbers of events in these buffers
  ImpactUse impacts;  ///< what the step used of pools and budgets, like the two members below (StepProbe)
  uint32_t joint_couplings, joint_numbers;
  StepReport report;
  /// 1 if the last repetition simulated only the bodies in TickRecord::part_inside, and its result can be used again
  /// (take_known_part()). The members below are then those of the run of these bodies.
  uint32_t part_known;
  uint32_t part_couplings, part_numbers;
  ImpactUse part_impacts;
  StepReport part;
};
static_assert(sizeof(TickHead) <= k_tick_head_bytes);

/// The record of a step.
struct TickRecord {
  TickHead& head;
  Span<Bounds> reach;                ///< by slot: bounds of all places in which the step looked for pairs of the body
  BitSet movers;                     ///< dynamic and kinematic bodies that moved or woke in the step
  BitSet solved;                     ///< dynamic bodies that the solver moved
  BitSet part_inside, part_visible;  ///< SparseTick::inside and visible of the run of TickHead::part_known
  Span<ContactEvent> contact_events;
  Span<JointEvent> joint_events;
  Span<SensorEvent> sensor_events;
  Span<BodyEvent> body_events;
};

/// A tick that is repeated in part. The bodies *inside* are simulated; all others are *outside*, and take their
/// recorded states. The *visible* bodies are those that the simulation reads: the bodies inside, and the fixed and
/// kinematic bodies that the bodies inside may touch or are joined to.
struct SparseTick {
  using State = StateView<const uint8_t>;

  TickRecord record;
  State before;    ///< the recorded state just before the step
  State after;     ///< the recorded state just after the step
  State now;       ///< the present state: just before the step that is repeated
  uint32_t used;   ///< number of slots used: the greater of those in `before` and `now`
  BitSet differs;  ///< bodies whose state in `now` is not that in `before`
  BitSet inside;
  BitSet visible;
  BitSet groups;  ///< sleeping groups that contain a simulated body (`inside`)
  BitSet joints;  ///< joints of simulated bodies, and joints that differ from the record
  /// Active joints that are not simulated, but hold a visible fixed or kinematic body (anchors()).
  BitSet anchoring;
  Span<uint32_t> units;  ///< by slot: the numbers that keep_units() stores
  /// By slot, of simulated bodies: the bounds of all that they reach in either of the two runs.
  Span<Bounds> boxes;
  Span<Bounds> reach;  ///< as TickRecord::reach, for the latest run of the simulated bodies
  BitSet solved;       ///< as TickRecord::solved, for the latest run
  /// Simulated bodies that may move or that differ from the record: expand() adds what they reach.
  Span<uint32_t> list;
  uint32_t count = 0;       ///< number of bodies in `list`
  uint32_t most = 0;        ///< the greatest permitted `count`
  bool grew = false;        ///< the last expand() added a body to `inside` or `visible`
  bool has_groups = false;  ///< `groups` is not empty
  /// How many elements at the front of the arrays of contacts and of sensed pairs in the world's block may be other
  /// than zero.
  uint32_t contacts_written = 0, sensed_written = 0;

  bool is_dynamic(uint32_t slot) const {
    return detent::is_dynamic(now.properties[slot]) || detent::is_dynamic(before.properties[slot]);
  }
  /// Whether a pair of this body and any other body can have a contact or be sensed.
  bool can_act(uint32_t slot) const {
    return is_dynamic(slot) || is_sensor(now.properties[slot]) || is_sensor(before.properties[slot]);
  }
  /// Whether the contact of two bodies is simulated: one of the two bodies is simulated (inside), and neither is a
  /// dynamic body that moved in the recorded step but is not simulated (outside).
  bool owns_contact(uint32_t a, uint32_t b) const {
    if (!inside.has(a) && !inside.has(b)) return false;
    const auto is_outside = [&](uint32_t slot) {
      return !inside.has(slot) && record.movers.has(slot) && is_dynamic(slot);
    };
    return !is_outside(a) && !is_outside(b);
  }
  /// Whether a joint between the bodies `slot` and `other` that is not simulated is active and must count for `slot`:
  /// `slot` is visible and not dynamic, and the solver moved `other` in the recorded step.
  bool anchors(uint32_t slot, uint32_t other) const {
    return visible.has(slot) && !is_dynamic(slot) && record.solved.has(other);
  }
  /// Whether the pair of a sensor and a body in it is simulated: one of the two is inside.
  bool owns_sensed(uint32_t sensor, uint32_t body) const { return inside.has(sensor) || inside.has(body); }

  // sparse_reach.cpp

  /// Sets `differs`, and adds the joints that differ to `joints`. Returns false if the settings or the assets differ,
  /// which concern all bodies.
  bool find_differing();
  /// Adds the bodies that differ from the record to the simulated bodies (`inside`), and their bounds in `now` to
  /// `boxes`.
  void begin(const StepSettings& settings, Span<BodyWork> work);
  /// Adds all bodies that the simulated bodies reach: dynamic bodies to `inside`, fixed and kinematic bodies to
  /// `visible`. Repeats this until no more are reached. Returns false if `count` exceeds `most`.
  bool expand();
  /// After a run: extends `boxes` by what the simulated bodies reached in the run, and `list` by those simulated bodies
  /// that rested in the recorded step but are active now. `active`: the active bodies after the run.
  void note_reach(BitSet active);

  // sparse_merge.cpp

  /// Prepares the block of a world for a run: writes the states that the visible bodies have in `from`, and the
  /// contacts, joints and sensed pairs of the simulated bodies (`inside`). Restricts the step cache to the visible
  /// bodies.
  void load(const State& from, const StateView<uint8_t>& block);
  /// Writes the whole state `now` to the block again, after load() or merge() has changed the block.
  void reset(const StateView<uint8_t>& block) const;
  /// After the run from the recorded state: stores the *unit for joints* (JointBody::exponent) of those bodies with
  /// joints that the solver does not move, and 0 for all other slots. `bodies`: StepProbe::joint_bodies of the run.
  void keep_units(Span<const JointBody> bodies) const;
  /// After the run from the present state: whether the units for joints of the bodies that the solver does not move are
  /// those that keep_units() stored. If a unit differs, joints that are not simulated may be affected, because all
  /// joints of a body share the body's unit.
  bool has_same_units(Span<const JointBody> bodies) const;
  /// Whether the simulated bodies (`inside`) have in the block the states that were recorded just after the step
  /// (`after`).
  bool is_recorded(const StateView<uint8_t>& block) const;
  /// After a run: completes the block with the recorded states (`after`) of all bodies that were not simulated, and of
  /// their contacts, joints and sensed pairs. Returns false if there is no room for the contacts or the sensed pairs.
  bool merge(const StateView<uint8_t>& block);
  /// Adds the recorded events of all bodies that were not simulated to the events of the run in the caller's buffers,
  /// and updates the numbers of events in `report`. Returns false if there is no room for the events.
  bool merge_events(const WorldHooks& hooks, StepReport& report) const;

 private:
  void add(uint32_t slot);
  bool meets(uint32_t slot, uint32_t from, uint32_t end) const;
  void add_jointed(Span<const JointState> all);
  void add_sleeping();
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
