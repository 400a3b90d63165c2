#pragma once
#include "ccd/impact.h"
#include "ccd/spare_memory.h"
#include "shape/bounds.h"

/// The data of Time Warp (time_warp.cpp), which processes impacts in several groups of bodies in parallel.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The data of a body that is read when the body is tested against others.
struct WarpSweep {
  BodyPose pose;
  BodySweep sweep;
  ImpactPath path;
  Bounds bounds;
};

/// A group's own copy of a dynamic body. The group changes the copy, and no other group sees it.
struct WarpBody : WarpSweep {
  uint32_t slot;
  uint32_t first_impact;  ///< as ImpactBodies::first_impact, in the group's own entries
  BodyMotion motion;
  // The first and the last test of the body in this tick: indices + 1 in WarpGroup::tests.
  uint32_t first_test, last_test;
  Bounds reach;             ///< contains the bounds of the sweeps that were tested; k_nowhere if there are none
  uint32_t changed;         ///< 0: the group has not changed the body
  uint32_t moved;           ///< 1: the group has moved the body since its last test
  uint32_t moved_untested;  ///< 1: for some state of the body no test was recorded
  Fraction move_time;       ///< time of the last move

  void move(Fraction time) {
    if (moved != 0 && time > move_time) moved_untested = 1;
    changed = moved = 1;
    move_time = time;
  }
};

#if DETENT_TASKS
/// An output whose order among the outputs of all groups matters: a hit, or the time that a stopped body loses.
struct WarpOutput {
  /// The sort key among outputs with the same `hit.time`. It is the highest key of the group's events at that time, up
  /// to and including the event with this output. If all events are processed in the order of time, this event cannot
  /// come before the event with that key.
  uint64_t order;
  ImpactHit hit;  ///< for a stopped body, the key is 0 and `approach` is the lost fraction of the tick
};

/// A record of one test: a group tested a body's new sweep against all bodies near it.
struct WarpTest : WarpSweep {
  Fraction time;
  uint32_t next;  ///< index + 1 of the body's next test; 0: none
};

/// A group of impacts: entries (pairs in ImpactStage::impacts) that are connected by dynamic bodies, directly or
/// through other entries.
struct WarpGroup {
  static constexpr uint32_t k_none = UINT32_MAX;

  uint32_t leader = 0;  ///< index of the group into which this one was merged, or its own index
  // The group's entries at the start: a linked list of indices in ImpactStage::impacts.
  uint32_t first_start = k_none, last_start = k_none, start_count = 0;
  // The result of the group's last run. Only the first body_count, entry_count, ... elements of the spans are used.
  Span<WarpBody> bodies;
  Span<ImpactPair> entries;
  Span<WarpOutput> outputs;
  Span<WarpTest> tests;
  uint32_t body_count = 0, entry_count = 0, output_count = 0, test_count = 0;
  uint32_t work = 0;
  ImpactReport report = {};
};

/// Work space for groups that one thread runs one after the other. It is empty before and after each group.
struct WarpPart {
  Span<uint32_t> places;  ///< by slot: index + 1 of the group's copy, or 0
  BitSet own;             ///< slots with a copy
  BitSet candidates;      ///< as ImpactBodies::candidates
  uint32_t is_clear = 0;

  void clear_once() {
    if (is_clear != 0) return;
    for (uint32_t& place : places) place = 0;
    for (uint32_t& word : own.words) word = 0;
    for (uint32_t& word : candidates.words) word = 0;
    is_clear = 1;
  }
};

/// The data of a body when the groups start, before any group has changed it.
WarpSweep start_of(const ImpactBodies& bodies, uint32_t slot);

/// Doubles the room of a list if it is full. Returns false if there is no memory.
template <class T>
bool make_room(Span<T>& items, uint32_t used, SpareMemory& spare) {
  if (used < items.count) return true;
  const Span<T> more = spare.take<T>(items.count == 0 ? 2 : 2 * items.count);
  if (more.count == 0) return false;
  for (uint32_t i = 0; i < used; ++i) more[i] = items[i];
  items = more;
  return true;
}

/// A group while it is run.
struct WarpRun {
  WarpGroup& group;
  const WarpPart& part;
  const ImpactBodies& bodies;  ///< the bodies as they are when the groups start; no group changes them
  SpareMemory& spare;
  uint32_t& failed;  ///< not 0: some group met a case that only ImpactOrder::global can handle
  Fraction time = 0.0;
  uint64_t order = 0;  ///< WarpOutput::order for outputs of the present event

  bool has_failed() const { return __atomic_load_n(&failed, __ATOMIC_RELAXED) != 0; }
  void fail() const { __atomic_store_n(&failed, 1u, __ATOMIC_RELAXED); }
  void begin_event(const ImpactPair& pair) {
    order = pair.time > time || pair.key > order ? pair.key : order;
    time = pair.time;
  }
  WarpBody* body(uint32_t slot) const {
    const uint32_t place = part.places[slot];
    return place == 0 ? nullptr : &group.bodies[place - 1];
  }
  /// Makes the group's copy of a dynamic body, if there is none. Returns false if there is no memory.
  bool claim(uint32_t slot) const;
  void add_output(const ImpactHit& hit) const;
  /// Records that the body's sweep is now tested against all bodies near it.
  void add_test(uint32_t slot) const;
};
#endif

}  // namespace DETENT_NAMESPACE
}  // namespace detent
