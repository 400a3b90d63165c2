#include "base/heap.h"
#include "broad_phase/bounds_integer.h"
#include "ccd/impact_stage.h"

/// Processes the impacts of a tick in groups of bodies. Several groups are processed at the same time, each of them to
/// the end of the tick. The result is that of the global order, in which all impacts of the world are processed in the
/// order of time.
///
/// A group is optimistic: it takes all bodies but its own as they were when the groups started. A body becomes the
/// group's own when the group makes an entry (an ImpactPair) with it; the group then changes a copy of the body. When
/// all groups have ended, they are compared. Two groups conflict if they have copies of the same body. They may also
/// conflict through a body of one group and a body of the other group: each group tested its own body against the other
/// body's state at the start, not against the state that the other body has in the global order. Therefore the tests of
/// the two bodies are repeated with the states of the global order, if the bounds of their sweeps overlap. If a
/// repeated test finds an event, the groups conflict. Otherwise the repeated tests only correct the counts (PairTests).
/// Groups without a conflict have the result of the global order.
///
/// Groups that conflict are rolled back: their copies are discarded, and they are run again as one group. The number
/// of groups falls each time.
namespace detent {
inline namespace DETENT_NAMESPACE {

#if DETENT_TASKS

WarpSweep start_of(const ImpactBodies& bodies, uint32_t slot) {
  return {bodies.poses[slot], bodies.sweeps[slot], bodies.paths[slot], bodies.bounds[slot]};
}

bool WarpRun::claim(uint32_t slot) const {
  if (part.places[slot] != 0) return true;
  if (!make_room(group.bodies, group.body_count, spare)) return false;
  WarpBody& body = group.bodies[group.body_count++];
  body = {};
  static_cast<WarpSweep&>(body) = start_of(bodies, slot);
  body.slot = slot;
  body.motion = bodies.motions[slot];
  body.reach = k_nowhere;
  part.places[slot] = group.body_count;
  part.own.set(slot);
  return true;
}

void WarpRun::add_output(const ImpactHit& hit) const {
  if (make_room(group.outputs, group.output_count, spare))
    group.outputs[group.output_count++] = {order, hit};
  else
    fail();
}

void WarpRun::add_test(uint32_t slot) const {
  if (!make_room(group.tests, group.test_count, spare)) {
    fail();
    return;
  }
  WarpTest& test = group.tests[group.test_count++];
  WarpBody& own = *body(slot);
  static_cast<WarpSweep&>(test) = own;
  test.time = time;
  test.next = 0;
  (own.first_test == 0 ? own.first_test : group.tests[own.last_test - 1].next) = group.test_count;
  own.last_test = group.test_count;
  own.moved = 0;
}

bool ImpactStage::make_room_for(uint64_t key) {
  const uint32_t room = impacts.count;
  const uint32_t slots[2] = {pair_low(key), pair_high(key)};
  for (const uint32_t slot : slots) {
    if (dynamic(slot) && !warp->claim(slot)) warp->fail();
  }
  if (!make_room(impacts, impact_count, warp->spare)) warp->fail();
  if (heads.is_made() && impacts.count != room) heads.make(impacts.count, warp->spare);
  return !gives_up();
}

namespace {

constexpr uint32_t k_warp_parts_max = 64;
/// If groups still conflict after this number of rounds, all impacts are processed in the order of time, without
/// groups. Each round costs at most as much as that.
constexpr uint32_t k_warp_rounds_max = 4;

/// The bounds of all sweeps of a changed body.
struct WarpRange {
  Bounds bounds;
  uint32_t group, body;
};

/// The place of an output in the order of the outputs of all groups.
struct WarpPlace {
  Fraction time;
  uint64_t order;
  uint32_t group, output;
};

/// Repeats the tests of two bodies of different groups. Each group has tested its body only against the state that the
/// other group's body had when the groups started.
class PairTests {
 public:
  PairTests(const ImpactStage& start, const WarpPart& part) : stage_(start), part_(part) {
    group_.bodies = {bodies_, 2};
    group_.body_count = 2;
    stage_.warp = &run_;
    stage_.impacts = {};  // a test that finds an event has no room for its entry, and fails
    stage_.impact_count = 0;
    stage_.heads = {};
  }
  PairTests(const PairTests&) = delete;
  PairTests& operator=(const PairTests&) = delete;

  /// What the tests would have counted if each group had known the other body, minus what they counted.
  ImpactReport correction = {};

  /// Repeats the tests of the two bodies. Each test is made with the states that both bodies have, in the global order,
  /// at the time of the test. Returns true if no repeated test finds an event; `correction` then includes the changes
  /// of the counts. Also returns false if a body was moved without a later test, or if a test of one body has the same
  /// time as a test of the other body.
  bool agree(const WarpGroup& group_a, const WarpBody& a, const WarpGroup& group_b, const WarpBody& b) {
    if ((a.moved | b.moved | a.moved_untested | b.moved_untested) != 0) return false;
    const uint32_t slots[2] = {a.slot, b.slot};
    uint32_t next[2] = {a.first_test, b.first_test};
    const WarpSweep* now[2] = {nullptr, nullptr};
    while (next[0] != 0 || next[1] != 0) {
      const WarpTest* const tests[2] = {next[0] == 0 ? nullptr : &group_a.tests[next[0] - 1],
                                        next[1] == 0 ? nullptr : &group_b.tests[next[1] - 1]};
      if (tests[0] != nullptr && tests[1] != nullptr && tests[0]->time == tests[1]->time) return false;
      const int i = tests[1] == nullptr || (tests[0] != nullptr && tests[0]->time < tests[1]->time) ? 0 : 1;
      const WarpTest& test = *tests[i];
      if (now[1 - i] != nullptr) {
        if (finds_event(slots[i], test, slots[1 - i], *now[1 - i], test.time)) return false;
        for (const auto number : k_impact_numbers) correction.*number += stage_.report.*number;
        finds_event(slots[i], test, slots[1 - i], start_of(stage_.bodies, slots[1 - i]), test.time);
        for (const auto number : k_impact_numbers) correction.*number -= stage_.report.*number;
      }
      now[i] = &test;
      next[i] = test.next;
    }
    return true;
  }

 private:
  /// Tests two bodies with these sweeps. Returns whether the test finds an event; `stage_.report` has its counts.
  bool finds_event(uint32_t slot, const WarpSweep& sweep, uint32_t other, const WarpSweep& other_sweep, Fraction time) {
    failed_ = 0;
    place(0, slot, sweep);
    place(1, other, other_sweep);
    stage_.report = {};
    stage_.work_left = UINT32_MAX;
    stage_.test_if_near(slot, other, time);
    part_.places[slot] = part_.places[other] = 0;
    return run_.has_failed();
  }
  void place(uint32_t index, uint32_t slot, const WarpSweep& sweep) {
    static_cast<WarpSweep&>(bodies_[index]) = sweep;
    bodies_[index].slot = slot;
    bodies_[index].first_impact = 0;
    part_.places[slot] = index + 1;
  }

  ImpactStage stage_;
  const WarpPart& part_;
  uint32_t failed_ = 0;
  WarpBody bodies_[2] = {};
  WarpGroup group_ = {};
  SpareMemory none_ = {};
  WarpRun run_ = {group_, part_, stage_.bodies, none_, failed_};
};

class TimeWarp {
 public:
  TimeWarp(ImpactStage& stage, WarpCount& count) : stage_(stage), count_(count) {}

  bool run(bool is_conservative) {
    if (!make_groups(is_conservative)) return false;
    uint32_t round = 0;
    do {
      if (round++ == k_warp_rounds_max) fail();
      if (failed_ == 0) run_groups();
    } while (failed_ == 0 && merge_conflicting());
    return failed_ == 0 && commit();
  }

 private:
  void fail() { failed_ = 1; }
  template <class T>
  bool take(Span<T>& span, uint32_t count) {
    span = stage_.spare.take<T>(count);
    return span.count == count;
  }

  uint32_t leader_of(uint32_t slot) {
    while (leaders_[slot] != slot) slot = leaders_[slot] = leaders_[leaders_[slot]];
    return slot;
  }
  void unite(uint64_t key) {
    if (!stage_.dynamic(pair_low(key)) || !stage_.dynamic(pair_high(key))) return;
    const uint32_t a = leader_of(pair_low(key)), b = leader_of(pair_high(key));
    leaders_[a > b ? a : b] = a > b ? b : a;
  }
  uint32_t asleep(uint32_t slot) const { return stage_.bodies.activities[slot].asleep; }
  /// The leader of the dynamic bodies of an entry, which all have the same leader (`leaders_`).
  uint32_t leader_of(const ImpactPair& entry) {
    return leader_of(stage_.dynamic(pair_low(entry.key)) ? pair_low(entry.key) : pair_high(entry.key));
  }
  /// Makes one group of all entries that dynamic bodies connect. Returns false if groups do not pay, if a group would
  /// have to wake a body, or if memory is short.
  bool make_groups(bool is_conservative) {
    const uint32_t slots = stage_.bodies.properties.count, entries = stage_.impact_count;
    if (!take(leaders_, slots) || !take(groups_of_, slots) || !take(next_start_, entries)) return false;
    for (uint32_t slot = 0; slot < slots; ++slot) {
      leaders_[slot] = slot;
      groups_of_[slot] = WarpGroup::k_none;
    }
    const Span<const ImpactPair> all = stage_.impacts.first(entries);
    for (const ImpactPair& entry : all) {
      if ((asleep(pair_low(entry.key)) | asleep(pair_high(entry.key))) != 0) return false;
    }
    for (const ImpactPair& entry : all) unite(entry.key);
    for (uint32_t i = 0; is_conservative && i < stage_.known.pairs.count; ++i) unite(stage_.known.pairs[i]);
    uint32_t group_count = 0;
    for (const ImpactPair& entry : all) {
      uint32_t& group = groups_of_[leader_of(entry)];
      if (group == WarpGroup::k_none) group = group_count++;
    }
    if (!take(groups_, group_count) || !take(to_run_, group_count)) return false;
    for (uint32_t i = 0; i < group_count; ++i) {
      groups_[i] = {};
      groups_[i].leader = to_run_[i] = i;
    }
    for (uint32_t i = 0; i < entries; ++i) {
      next_start_[i] = WarpGroup::k_none;
      append(groups_[groups_of_[leader_of(all[i])]], i, i, 1);
    }
    for (const WarpGroup& group : groups_) {
      if (is_too_large(group)) return false;
    }
    return group_count > 1 && take(parts_, k_warp_parts_max);
  }
  /// Whether the group has more than 3/4 of all entries, so that the other threads would mostly wait for it.
  bool is_too_large(const WarpGroup& group) const {
    return stage_.settings.team != nullptr && 4 * group.start_count > 3 * stage_.impact_count;
  }
  void append(WarpGroup& group, uint32_t first, uint32_t last, uint32_t count) {
    (group.start_count == 0 ? group.first_start : next_start_[group.last_start]) = first;
    group.last_start = last;
    group.start_count += count;
  }

  bool make_part(WarpPart& part) {
    const uint32_t words = stage_.bodies.active.words.count;
    part = {};
    return take(part.places, stage_.bodies.properties.count) && take(part.own.words, words) &&
           take(part.candidates.words, words);
  }
  /// Runs the groups in `to_run_`. The groups are distributed over `parts` parts, which the threads share. In the order
  /// of decreasing size, group number i goes to part i modulo `parts`, so the parts are about equal.
  void run_groups() {
    heap_sort(to_run_, [&](uint32_t a, uint32_t b) {
      const uint32_t size_a = groups_[a].start_count, size_b = groups_[b].start_count;
      return size_a > size_b || (size_a == size_b && a < b);
    });
    const uint32_t most = stage_.settings.team == nullptr ? 1 : k_warp_parts_max;
    const uint32_t parts = to_run_.count < most ? to_run_.count : most;
    for (; part_count_ < parts; ++part_count_) {
      if (make_part(parts_[part_count_])) continue;
      fail();
      return;
    }
    share(stage_.settings.team, parts, 1, [&](uint32_t first, uint32_t last) {
      for (uint32_t part = first; part < last; ++part) {
        parts_[part].clear_once();
        for (uint32_t i = part; i < to_run_.count; i += parts) run_group(groups_[to_run_[i]], parts_[part]);
      }
    });
    ++count_.rounds;
    count_.speculations += to_run_.count;
  }
  void run_group(WarpGroup& group, const WarpPart& part) {
    WarpRun run = {group, part, stage_.bodies, stage_.spare, failed_};
    if (run.has_failed()) return;
    ImpactStage stage = start_;
    stage.warp = &run;
    stage.impacts = group.entries;
    stage.impact_count = 0;
    stage.heads = {};
    stage.report = {};
    group.body_count = group.output_count = group.test_count = 0;
    for (uint32_t i = group.first_start; i != WarpGroup::k_none; i = next_start_[i]) {
      ImpactPair* const entry = stage.add_entry(stage_.impacts[i].key);
      if (entry == nullptr) break;
      const uint32_t more[2] = {entry->more[0], entry->more[1]};
      *entry = stage_.impacts[i];
      entry->more[0] = more[0];
      entry->more[1] = more[1];
    }
    if (!run.has_failed()) stage.process_events();
    group.entries = stage.impacts;
    group.entry_count = stage.impact_count;
    group.report = stage.report;
    group.work = start_.work_left - stage.work_left;
    if (stage.is_spent()) run.fail();
    for (const WarpBody& body : group.bodies.first(group.body_count)) {
      part.places[body.slot] = 0;
      part.own.clear(body.slot);
    }
  }

  uint32_t group_leader(uint32_t group) const {
    while (groups_[group].leader != group) group = groups_[group].leader;
    return group;
  }
  void merge(uint32_t a, uint32_t b) {
    a = group_leader(a);
    b = group_leader(b);
    groups_[a > b ? a : b].leader = a > b ? b : a;
  }
  /// Whether a test of one body may depend on changes that another group made to the other body.
  bool may_conflict(const WarpBody& a, const WarpBody& b) const {
    const Span<Bounds> start = stage_.bodies.bounds;
    return overlap(a.reach, b.reach) || overlap(a.reach, start[b.slot]) || overlap(b.reach, start[a.slot]);
  }
  /// Lists the changed bodies of all groups in `ranges_`. Merges groups that have copies of the same body.
  void list_changed() {
    for (uint32_t& group : groups_of_) group = WarpGroup::k_none;
    Bounds all = k_nowhere;
    ranges_.count = 0;
    for (uint32_t i = 0; i < groups_.count; ++i) {
      for (uint32_t k = 0; k < groups_[i].body_count; ++k) {
        const WarpBody& body = groups_[i].bodies[k];
        uint32_t& owner = groups_of_[body.slot];
        if (owner == WarpGroup::k_none)
          owner = i;
        else
          merge(owner, i);
        if (body.changed == 0) continue;
        WarpRange& range = ranges_.data[ranges_.count++];
        range = {stage_.bodies.bounds[body.slot], i, k};
        include(body.reach, range.bounds);
        include(range.bounds, all);
      }
    }
    const auto length = [&](int axis) {
      return static_cast<uint64_t>(integer_from(all.upper.*k_axes[axis])) -
             static_cast<uint64_t>(integer_from(all.lower.*k_axes[axis]));
    };
    int widest = 0;
    for (int axis = 1; axis < 3; ++axis) widest = length(axis) > length(widest) ? axis : widest;
    axis_ = k_axes[widest];
  }

  /// Compares range number `part`, and every `part_count_`th range from there on, with the ranges after it that overlap
  /// it. Merges groups that conflict.
  void compare_some(uint32_t part) {
    PairTests tests(start_, parts_[part]);
    for (uint32_t i = part; i < ranges_.count; i += part_count_) {
      const WarpRange& range_a = ranges_[i];
      const WarpGroup& group_a = groups_[range_a.group];
      const WarpBody& a = group_a.bodies[range_a.body];
      for (uint32_t k = i + 1; k < ranges_.count; ++k) {
        const WarpRange& range_b = ranges_[k];
        if (range_a.bounds.upper.*axis_ < range_b.bounds.lower.*axis_) break;
        if (range_a.group == range_b.group || !overlap(range_a.bounds, range_b.bounds)) continue;
        const WarpGroup& group_b = groups_[range_b.group];
        const WarpBody& b = group_b.bodies[range_b.body];
        if (a.slot == b.slot) continue;  // list_changed() has merged their groups
        if (!may_conflict(a, b) || tests.agree(group_a, a, group_b, b)) continue;
        alone(stage_.settings.team, [&] { merge(range_a.group, range_b.group); });
      }
    }
    for (const auto number : k_impact_numbers) Team::add(correction_.*number, tests.correction.*number);
  }

  /// Merges the groups that conflict, and lists the merged groups in `to_run_`. Returns false if no groups conflict.
  bool merge_conflicting() {
    uint32_t bodies = 0;
    for (const WarpGroup& group : groups_) bodies += group.body_count;
    if (bodies > range_room_ && !take(ranges_, bodies)) {
      fail();
      return false;
    }
    range_room_ = bodies > range_room_ ? bodies : range_room_;
    list_changed();
    heap_sort(ranges_, [this](const WarpRange& a, const WarpRange& b) {
      const Coord lower_a = a.bounds.lower.*axis_, lower_b = b.bounds.lower.*axis_;
      if (!(lower_a == lower_b)) return lower_a < lower_b;
      return a.group < b.group || (a.group == b.group && a.body < b.body);
    });
    correction_ = {};
    share(stage_.settings.team, part_count_, 1, [&](uint32_t first, uint32_t last) {
      for (uint32_t part = first; part < last; ++part) compare_some(part);
    });
    to_run_.count = 0;
    for (uint32_t i = 0; i < groups_.count; ++i) {
      WarpGroup& group = groups_[i];
      if (group.leader == i || group.start_count == 0) continue;
      WarpGroup& leader = groups_[group_leader(i)];
      if (leader.body_count != 0) {
        leader.body_count = 0;  // marks it as listed
        to_run_.data[to_run_.count++] = leader.leader;
        ++count_.rollbacks;
      }
      append(leader, group.first_start, group.last_start, group.start_count);
      if (is_too_large(leader)) fail();
      group.start_count = group.body_count = group.output_count = 0;
      ++count_.rollbacks;
    }
    return to_run_.count != 0;
  }

  /// Copies the bodies and the outputs of all groups back to the stage. Returns false, and changes nothing, if the
  /// groups together need more work, entries or memory than there is.
  bool commit() {
    uint32_t entries = 0, output_count = 0;
    uint64_t work = 0;
    for (const WarpGroup& group : groups_) {
      if (group.start_count == 0) continue;
      work += group.work;
      entries += group.entry_count;
      output_count += group.output_count;
    }
    Span<WarpPlace> places;
    work += static_cast<uint64_t>(static_cast<int32_t>(correction_.tests));
    if (work >= stage_.work_left || entries > stage_.impacts.count || !take(places, output_count)) return false;
    stage_.take_work(static_cast<uint32_t>(work));
    stage_.impact_count = entries;
    for (const auto number : k_impact_numbers) stage_.report.*number += correction_.*number;
    uint32_t next = 0;
    for (uint32_t i = 0; i < groups_.count; ++i) {
      const WarpGroup& group = groups_[i];
      if (group.start_count == 0) continue;
      for (const auto number : k_impact_numbers) stage_.report.*number += group.report.*number;
      for (const WarpBody& body : group.bodies.first(group.body_count)) give_back(body);
      for (uint32_t k = 0; k < group.output_count; ++k)
        places[next++] = {group.outputs[k].hit.time, group.outputs[k].order, i, k};
    }
    heap_sort(places, [](const WarpPlace& a, const WarpPlace& b) {
      if (!(a.time == b.time)) return a.time < b.time;
      return a.order < b.order || (a.order == b.order && a.output < b.output);
    });
    for (const WarpPlace& place : places) {
      const ImpactHit& hit = groups_[place.group].outputs[place.output].hit;
      if (hit.key != 0)
        stage_.add_hit(hit);
      else
        stage_.report.lost_time += hit.approach;
    }
    return true;
  }
  void give_back(const WarpBody& body) {
    if (body.changed == 0) return;
    const uint32_t slot = body.slot;
    stage_.leave_rest(slot);
    stage_.pose_of(slot) = body.pose;
    stage_.motion_of(slot) = body.motion;
    stage_.sweep_of(slot) = body.sweep;
    stage_.path_of(slot) = body.path;
    stage_.bounds_of(slot) = body.bounds;
#if DETENT_SPARSE
    if (stage_.probe != nullptr && stage_.probe->reach.count != 0) include(body.reach, stage_.probe->reach[slot]);
#endif
  }

  ImpactStage& stage_;
  WarpCount& count_;
  const ImpactStage start_ = stage_;  ///< a copy that no thread changes
  uint32_t failed_ = 0;
  Span<uint32_t> leaders_;     ///< by slot: the bodies of a group have the same leader
  Span<uint32_t> groups_of_;   ///< by slot: index of the group that this body leads, or that has copied it
  Span<uint32_t> next_start_;  ///< by entry: index of the next entry in the list of its group
  Span<WarpGroup> groups_;
  Span<uint32_t> to_run_;  ///< indices of the groups that the next round runs
  Span<WarpRange> ranges_;
  uint32_t range_room_ = 0;
  Coord Position::*axis_ = nullptr;  ///< the axis along which `ranges_` is sorted
  ImpactReport correction_ = {};
  Span<WarpPart> parts_;
  uint32_t part_count_ = 0;
};

}  // namespace

bool process_in_groups(ImpactStage& stage, ImpactOrder order, WarpCount& count) {
  ++count.ticks;
  if (stage.moving.make(stage.bodies.active, stage.bodies.bounds, stage.spare) &&
      TimeWarp(stage, count).run(order == ImpactOrder::conservative))
    return true;
  ++count.returns;
  return false;
}
#endif

}  // namespace DETENT_NAMESPACE
}  // namespace detent
