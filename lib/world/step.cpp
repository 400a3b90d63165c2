#include "base/float_environment.h"
#include "broad_phase/broadphase.h"
#include "ccd/impact.h"
#include "contact/contact_cache.h"
#include "joint/joint.h"
#include "motion/activity.h"
#include "motion/angular_velocity.h"
#include "motion/finalise.h"
#include "motion/predict.h"
#include "shape/shape_properties.h"
#include "solver/contact_order.h"
#include "solver/contact_rows.h"
#include "solver/island.h"
#include "solver/solve.h"
#include "solver/solve_lanes.h"
#include "solver/substeps.h"
#include "state/step_cache.h"
#include "state/step_scratch.h"
#include "world/events.h"
#include "world/joints.h"
#include "world/sensors.h"
#include "world/stage_ends.h"
#include "world/step_contacts.h"
#include "world/step_probe.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// Lists the slots of the active set, ascending. After partition_bodies(), the set contains exactly the moving bodies,
/// also those that were woken since.
Span<const uint32_t> list_moving(BitSet active, Span<uint32_t> slots) {
  uint32_t count = 0;
  active.for_each([&](uint32_t slot) { slots[count++] = slot; });
  return slots.first(count);
}

/// Moves the kinematic bodies of `moving` through the tick.
uint32_t integrate_kinematic_bodies(const StepSettings& settings, const SolverBodies& bodies,
                                    Span<const uint32_t> moving) {
  uint32_t clamped = 0;
  for (const uint32_t slot : moving) {
    if (is_dynamic(bodies.properties[slot])) continue;
    clamped += integrate_kinematic(
        settings, {{&bodies.properties[slot], 1}, {&bodies.motions[slot], 1}, {&bodies.work[slot], 1}});
  }
  return clamped;
}

void report_impacts(const ImpactReport& impacts, StepReport& report) {
  report.ccd.impacts = impacts.impacts;
  report.ccd.undecided = impacts.undecided;
  report.lost.impacts = impacts.pairs_dropped;
  report.ccd.overlaps_left = impacts.overlaps_left;
  report.ccd.bodies_stopped = impacts.bodies_stopped;
  report.ccd.lost_time = impacts.lost_time;
  report.ccd.tests = impacts.tests;
  report.ccd.skipped = impacts.skipped;
  report.ccd.kept_apart = impacts.kept_apart;
  report.woke += impacts.woke;
  report.saturations += impacts.clamped;
}

/// The settings of a step. Several contacts are solved at once (in lanes) if create_world() has found that the
/// processor supports this.
StepSettings settings_of(const World& world, const WorldState& state) {
  StepSettings settings = step_settings(state);
  settings.lanes = world.lanes < k_lanes_max ? world.lanes : k_lanes_max;
  return settings;
}

/// One step: its stages, in order, and the data that they pass to later stages.
class Step {
 public:
  Step(World& world, StepProbe* probe, StepReport& report);
  void run();

 private:
  // The stages, named as in StepStage.
  void find_pairs();
  void collide_pairs();
  void build_islands();
  void solve_islands();
  void raise_events();
  void advance();
  void finalise();
  void store();

  /// The number of elements that a stage passes to with_team() for work that calls filter rules: 0 if the caller has
  /// filter rules, so that only one thread calls them, else `elements`.
  uint32_t unless_ruled(uint32_t elements) const { return world_.hooks.filter_rules.count == 0 ? elements : 0; }
  /// Calls work(team) with the threads that the caller lends. `team` is null if the caller lends none, or if there are
  /// too few elements to share.
  template <class Work>
  void with_team(uint32_t elements, const Work& work) {
    detent::with_team(world_.hooks.tasks, elements, work);
  }
  void start_joints();
  void wake_touched_bodies();
  void advance_bodies();
  void end(StepStage stage) { ends_.end(stage, contacts_.count); }
  /// Manifolds of the last tick; empty if contact points are not recycled.
  Span<ManifoldState> manifolds() const {
    return state_.manifolds.first(settings_.contact_recycle_distance > Real(0.0) ? state_.manifolds.count : 0);
  }
  ContactRoom room() const {
    return {scratch_, state_.contacts.count - (contacts_before_ - awake_contacts_.count), manifolds().count != 0};
  }
  /// Whether several islands may be solved together, to fill the lanes of the vector registers. They may not in two
  /// cases: each island may end its iterations early, or positions are corrected island by island after the substeps.
  bool groups_islands() const {
    return uses_lanes(settings_) && settings_.iterations == 1 && !settings_.post_stabilises;
  }
  Island island_group(uint32_t first, uint32_t& count) const;
  void solve_islands(Team* team);
  void solve_island(const Island& island, StepSettings& settings);
  bool is_solved_by_one_thread(const Island& island, uint32_t large) const;
  Span<ContactOrder> contact_order() const { return scratch_.contact_order.first(contacts_.count); }
  Span<ContactEvent> contact_events() const { return room_of(world_.hooks.contact_events); }

  World& world_;
  StepProbe* const probe_;
  StepReport& report_;
  StageEnds ends_;
  const StateView<uint8_t> state_;
  const uint32_t used_ = state_.world.slots_used, contacts_before_ = state_.world.contact_count;
  const Scratch scratch_;
  const StepCacheView cache_;
  const Span<BodySweep> sweeps_ = scratch_.sweeps.first(used_);
  const StepSettings settings_;
  const StepBodies bodies_ = {state_.poses.first(used_),    state_.properties.first(used_),
                              state_.motions.first(used_),  state_.activities.first(used_),
                              scratch_.bodies.first(used_), cache_.active,
                              world_.hooks.assets,          *world_.features};
  const SolverBodies solver_bodies_ = {bodies_.properties, state_.motions.first(used_), bodies_.work};
  const JointOps* const joint_ops_ = state_.world.joint_count == 0 ? nullptr : world_.features->joints;
  const SensorOps* const sensor_ops_ = state_.world.sensor_count == 0 ? nullptr : world_.features->sensors;
  JointStage joints_;
  Overflow overflow_ = {bodies_.properties, room_of(world_.hooks.capacity_events)};
  const Span<const uint64_t> disabled_pairs_;
  PairPool pool_;
  Span<const uint32_t> moving_ = {};          ///< moving bodies, ascending
  Span<const uint32_t> awake_contacts_ = {};  ///< contacts of the last tick with an awake body
  ContactCount count_ = {};
  Span<ContactWork> contacts_ = {};
  Span<Island> islands_ = {};
  EventCount event_count_ = {};
};

Step::Step(World& world, StepProbe* probe, StepReport& report)
    : world_(world),
      probe_(probe),
      report_(report),
      ends_(world),
      state_(view_of(world)),
      scratch_(scratch_of(world.block, state_.layout, capacity_of(state_.header))),
      cache_(cache_of(world.block, state_.layout, capacity_of(state_.header))),
      settings_(settings_of(world, state_.world)),
      joints_{state_.joints.first(joint_ops_ == nullptr ? 0 : state_.world.joints_used),
              bodies_.poses,
              bodies_.activities,
              scratch_.joints,
              scratch_.joint_lanes,
              scratch_.joint_bodies,
              scratch_.joint_order,
              scratch_.joint_couplings,
              scratch_.joint_numbers},
      disabled_pairs_(list_disabled_pairs(joints_.joints, scratch_.disabled_pairs)),
      pool_(bodies_.poses, bodies_.properties, cache_.bounds, scratch_.pair_sort, scratch_.pairs,
            world.hooks.filter_rules, disabled_pairs_) {
  pool_.overflow = &overflow_;
#if DETENT_SPARSE
  if (probe_ == nullptr) return;
  joints_.others = probe_->joints;
  joints_.anchoring = probe_->anchoring;
#endif
}

void Step::run() {
  find_pairs();
  end(StepStage::find_pairs);
  collide_pairs();
  end(StepStage::collide_pairs);
  build_islands();
  end(StepStage::build_islands);
  solve_islands();
  end(StepStage::solve_islands);
  raise_events();
  end(StepStage::raise_events);
  advance();
  end(StepStage::advance);
  finalise();
  end(StepStage::finalise);
  store();
  end(StepStage::store);
}

void Step::find_pairs() {
  report_.woke = wake_jointed(joints_.joints, bodies_.properties, solver_bodies_.motions, bodies_.activities, cache_);
  if (sensor_ops_ != nullptr) sensor_ops_->start(cache_, used_, scratch_.changed);
  with_team(unless_ruled(used_), [&](Team* team) {
    moving_ = partition_bodies(cache_, shared_settings(settings_, team), state_, bodies_.work, scratch_.sweeps,
                               scratch_.moving_bodies);
    pool_.share(team);
    add_moving_pairs(moving_, cache_.tree, scratch_.bounds_keys, scratch_.bounds_sort, pool_);
    pool_.share(nullptr);
  });
  pool_.sort();
  start_joints();
  wake_touched_bodies();
}

/// Collects the joints of the step. First initialises the BodyWork of the jointed bodies that are not in the active
/// set.
void Step::start_joints() {
  if (joint_ops_ == nullptr) return;
  const auto start_ends = [&](const JointState& joint) {
    const uint32_t ends[2] = {joint.body_a, joint.body_b};
    for (const uint32_t slot : ends) {
      if (!cache_.active.has(slot)) bodies_.start(settings_, slot);
    }
  };
  for (const JointState& joint : joints_.joints) {
    if (joint.type != 0) start_ends(joint);
  }
#if DETENT_SPARSE
  joints_.anchoring.for_each([&](uint32_t slot) { start_ends(joints_.others[slot]); });
#endif
  joint_ops_->collect(solver_bodies_, joints_);
  report_.joints.count = joints_.count;
}

/// Wakes the bodies that moving bodies touch. Repeats this, because a woken body with joints has a longer speculative
/// distance, and so may touch further bodies.
void Step::wake_touched_bodies() {
  while (const uint32_t woke = wake_touched(settings_, bodies_, cache_, pool_)) {
    report_.woke += woke;
    moving_ = list_moving(cache_.active, scratch_.moving_bodies);
    for (const uint32_t slot : moving_) bodies_.start(settings_, slot);
    start_joints();
    if (joint_ops_ == nullptr) break;
  }
}

void Step::collide_pairs() {
  awake_contacts_ = list_awake_contacts(cache_, state_);
  with_team(pool_.pairs().count, [&](Team* team) {
    count_ = find_contacts(shared_settings(settings_, team), bodies_, {state_.contacts, manifolds(), awake_contacts_},
                           room(), overflow_, pool_.pairs());
  });
  contacts_ = scratch_.contacts.first(count_.contacts);
}

void Step::build_islands() {
  report_.islands = find_islands(moving_, bodies_.properties, bodies_.activities, contacts_, joints_, bodies_.work,
                                 scratch_.islands, scratch_.island_bodies);
  islands_ = scratch_.islands.first(report_.islands);
  const Span<const uint32_t> slots = scratch_.island_bodies;
  with_team(contacts_.count, [&](Team* team) {
    report_.contacts.colour_overflows = order_contacts(team, bodies_.properties, contacts_, islands_, bodies_.work,
                                                       scratch_.contact_sort, contact_order());
  });
  with_team(islands_.count, [&](Team* team) {
    share(team, islands_, k_islands_shared, [&](Span<Island> part) {
      estimate_loads(settings_, bodies_.poses, bodies_.properties, slots, part, contact_order(), scratch_.contact_sort,
                     bodies_.work, contacts_);
    });
  });
  if (joint_ops_ != nullptr)
    report_.lost.joint_couplings = joint_ops_->order(settings_, solver_bodies_, slots, islands_, joints_);
#if DETENT_SPARSE
  if (probe_ != nullptr) {
    probe_->joint_bodies = joints_.bodies.first(joints_.body_count);
    probe_->joint_couplings = joints_.couplings_used;
    probe_->joint_numbers = joints_.numbers_used;
  }
#endif
  with_team(islands_.count, [&](Team* team) {
    share(team, islands_, k_islands_shared, [&](Span<Island> part) {
      choose_substeps(settings_, bodies_.properties, bodies_.work, slots, contact_order(), part, contacts_,
                      bodies_.activities);
    });
  });
  if (groups_islands())
    group_islands(moving_, bodies_.properties, bodies_.activities, contacts_, islands_, bodies_.work,
                  scratch_.island_bodies, scratch_.contact_sort, contact_order());
}

/// Returns the island `first` and the islands that are solved together with it, combined into one island. Sets `count`
/// to the number of these islands.
Island Step::island_group(uint32_t first, uint32_t& count) const {
  Island group = islands_[first];
  for (count = 1; groups_islands() && first + count < islands_.count; ++count) {
    const Island& next = islands_[first + count];
    if (!are_solved_together(islands_[first], next)) break;
    group.body_count += next.body_count;
    group.contact_count += next.contact_count;
  }
  return group;
}

/// Whether one thread solves this island while other threads solve other islands. False in two cases. First, the island
/// has contacts with kinematic bodies, or joints to bodies that do not move: its solution writes to bodies outside the
/// island. Second, the island has at least `large` contacts or bodies: the threads then share its loops.
bool Step::is_solved_by_one_thread(const Island& island, uint32_t large) const {
  if (island.contact_count >= large || island.body_count >= large) return false;
  for (const uint32_t index : Span<const uint32_t>{joints_.order.data + island.first_joint, island.joint_count}) {
    for (const uint32_t body : joints_.work[index].body) {
      if (joints_.bodies[body].mobile == 0) return false;
    }
  }
  return !has_kinematic_contact(bodies_.properties,
                                {scratch_.contact_order.data + island.first_contact, island.contact_count}, contacts_);
}

void Step::solve_island(const Island& island, StepSettings& settings) {
  const Span<const uint32_t> slots = {scratch_.island_bodies.data + island.first_body, island.body_count};
  const Span<ContactOrder> order = {scratch_.contact_order.data + island.first_contact, island.contact_count};
  const bool jointed = island.joint_count != 0;
  if (island.substeps != settings.substeps || jointed != settings.jointed)
    set_substeps(island.substeps, jointed, settings);
  share(settings.team, slots, k_bodies_shared, [&](Span<const uint32_t> part) {
    predict(settings, bodies_.properties, part, solver_bodies_.motions, bodies_.work);
  });
  if (order.count == 0 && !jointed) {
    Team::add(report_.saturations, integrate_free(settings, solver_bodies_, slots));
    return;
  }
  const IslandJoints joints = {jointed ? joint_ops_ : nullptr, &island, &joints_};
  const uint32_t first_lanes = island.first_contact / 4;  // no two islands use the same LaneSpace
  const Span<LaneSpace> lanes = {scratch_.lane_contacts.data + first_lanes, lane_contact_count(island.contact_count)};
  const SolveCount count = solve(settings, solver_bodies_, slots, {order, contacts_, lanes}, joints);
  Team::add(report_.saturations, count.clamped);
  Team::add(report_.contacts.sweeps_saved, count.sweeps_saved);
  Team::add(report_.joints.undecided, count.undecided);
  share(settings.team, order, k_contacts_shared, [&](Span<const ContactOrder> part) {
    for (const ContactOrder& entry : part) {
      store_load(settings, contacts_[entry.contact]);
      store_impulses(contacts_[entry.contact]);
    }
  });
}

void Step::solve_islands(Team* team) {
  StepSettings settings = shared_settings(settings_, team);
  // Two lists of islands that are solved below. They are stored in BodyWork::run, whose contents are no longer needed.
  // The list from the front on has the islands that one thread solves; the list from the back has the islands that all
  // threads share.
  const auto front = [&](uint32_t k) -> uint32_t& { return bodies_.work[k].run; };
  const auto back = [&](uint32_t k) -> uint32_t& { return bodies_.work[islands_.count - 1 - k].run; };
  uint32_t for_one_thread = 0, for_all = 0, grouped = 0;
  for (uint32_t i = 0; i < islands_.count; i += grouped) {
    const Island island = island_group(i, grouped);
    report_.contacts.substeps += uint64_t{island.substeps} * island.contact_count;
    report_.substeps_max = island.substeps > report_.substeps_max ? island.substeps : report_.substeps_max;
    report_.awake += island.body_count;
    if (team == nullptr)
      solve_island(island, settings);
    else if (is_solved_by_one_thread(island, team->many()))
      front(for_one_thread++) = i;
    else
      back(for_all++) = i;
  }
  if (team == nullptr) return;
  share(team, for_one_thread, 1, [&](uint32_t first, uint32_t last) {
    StepSettings own = settings_;
    for (uint32_t k = first, count = 0; k < last; ++k) solve_island(island_group(front(k), count), own);
  });
  for (uint32_t k = 0; k < for_all; ++k) solve_island(island_group(back(k), grouped), settings);
}

void Step::solve_islands() {
  with_team(moving_.count, [&](Team* team) { solve_islands(team); });
  report_.saturations += integrate_kinematic_bodies(settings_, solver_bodies_, moving_);
}

void Step::raise_events() {
  event_count_ = raise_contact_events(bodies_.poses, bodies_.properties, awake_contacts_, state_.contacts, contacts_,
                                      contact_events());
}

/// Computes the sweeps of the tick, moves bodies along their sweeps to their impacts, and finds the bodies within
/// sensors.
void Step::advance() {
  with_team(moving_.count, [&](Team* team) {
    report_.saturations += share_sum(team, moving_, k_bodies_shared, [&](Span<const uint32_t> part) {
      return make_sweeps(part, bodies_.properties, bodies_.work, bodies_.poses, sweeps_);
    });
  });
  if (joint_ops_ != nullptr) {
    joint_ops_->store(settings_, solver_bodies_, joints_);
    for (const JointBody& body : joints_.bodies.first(joints_.body_count)) {
      if (body.mobile != 0) sweeps_[body.slot].marks |= k_mark_jointed * (bodies_.work[body.slot].island + 1);
    }
  }
  advance_bodies();
  report_.events.contact = event_count_.kept;
  report_.events.contact_dropped = contact_events().count == 0 ? 0 : event_count_.dropped;
}

/// A separate function, because it needs much stack.
__attribute__((noinline)) void Step::advance_bodies() {
  SensorStage sensors = {world_.hooks.assets,
                         *world_.features,
                         {bodies_.properties, world_.hooks.filter_rules, disabled_pairs_},
                         bodies_.properties,
                         bodies_.poses,
                         sweeps_,
                         cache_,
                         scratch_.changed,
                         state_.sensed.first(state_.world.sensed_count),
                         {scratch_.sensed_passed, {}},
                         {scratch_.sensed, {}},
                         overflow_};
  if (state_.world.continuous != 0) {
    const ImpactPairs known = {pool_.pairs(), contacts_, pool_.dropped() == 0 && count_.dropped == 0, disabled_pairs_};
    ImpactBodies bodies = {bodies_.properties,
                           state_.poses.first(used_),
                           solver_bodies_.motions,
                           sweeps_,
                           scratch_.impact_paths.first(used_),
                           bodies_.activities,
                           cache_.bounds,
                           cache_.tree,
                           cache_.active,
                           scratch_.candidates,
                           scratch_.moving_bodies.first(used_),
                           world_.hooks.filter_rules,
                           {sensor_ops_ == nullptr ? nullptr : sensor_ops_->sweep, &sensors}};
#if DETENT_TASKS
    bodies.spare = impact_spare(world_.block, state_.layout, capacity_of(state_.header));
#endif
    with_team(unless_ruled(pool_.pairs().count), [&](Team* team) {
      const ImpactReport impacts =
          world_.features->continuous->advance(shared_settings(settings_, team), world_.hooks.assets, *world_.features,
                                               known, bodies, scratch_.impact_pairs, scratch_.impact_hits, probe_);
      report_impacts(impacts, report_);
      if (impacts.woke != 0) cache_.cache.contacts_known = 0;
      add_hits(bodies_.properties, scratch_.impact_hits.first(impacts.hits), contact_events(), event_count_);
      event_count_.dropped += impacts.hits_dropped;
    });
  }
  if (sensor_ops_ != nullptr) sensor_ops_->end(sensors, state_, world_.hooks.sensor_events, report_);
}

void Step::finalise() {
  with_team(moving_.count, [&](Team* team) {
    report_.saturations += share_sum(team, cache_.active.words.count, 1, [&](uint32_t first, uint32_t last) {
      uint32_t clamped = 0;
      cache_.active.for_each_in(first, last, [&](uint32_t slot) {
        clamped += finalise_body(bodies_.properties[slot], sweeps_[slot], state_.poses[slot], state_.motions[slot]);
      });
      return clamped;
    });
  });
}

/// Lets islands fall asleep, stores the contacts for the next tick, removes broken joints, and fills the report.
void Step::store() {
  if (settings_.sleeping)
    report_.fell_asleep =
        world_.features->sleeping->end_step(settings_, bodies_.properties, bodies_.poses, sweeps_, islands_,
                                            scratch_.island_bodies, solver_bodies_.motions, bodies_.activities);
  store_contacts(contacts_, room().manifolds(), awake_contacts_.count, contacts_before_, state_.contacts, manifolds(),
                 cache_.awake_contacts);
  cache_.cache.awake_contact_count = contacts_.count;
  state_.world.contact_count = contacts_before_ - awake_contacts_.count + contacts_.count;
  if (joint_ops_ != nullptr) break_joints(world_, report_);
  report_.contacts.pairs = pool_.pairs().count + pool_.dropped();
  report_.lost.pairs = pool_.dropped();
  report_.contacts.count = count_.contacts;
  report_.contacts.points = count_.points;
  report_.contacts.recycled = count_.recycled;
  report_.lost.contacts = count_.dropped + count_.parts_dropped;
  report_.lost.contact_parts = count_.parts_dropped;
  report_.contacts.capped = count_.capped;
  const EventCount events =
      raise_body_events(cache_.active, bodies_.properties, bodies_.activities, room_of(world_.hooks.body_events));
  report_.events.body = events.kept;
  report_.events.body_dropped = room_of(world_.hooks.body_events).count == 0 ? 0 : events.dropped;
  report_.events.capacity = overflow_.count;
  bool moves = false;
  cache_.active.for_each([&](uint32_t slot) { moves = moves || bodies_.moving(slot); });
  state_.world.idle = moves ? 0 : 1;
}

/// A separate function, so that the compiler cannot move its code across the change of the floating-point environment.
__attribute__((noinline)) void run_stages(World& world, StepProbe* probe, StepReport& report) {
  Step(world, probe, report).run();
}

StepReport step_with(World& world, StepProbe* probe) {
  const FloatEnvironment environment;
  StepReport report;
  WorldState& state = view_of(world).world;
  if (state.idle == 0) run_stages(world, probe, report);
  ++state.tick;
  report.tick = state.tick;
  report.bodies = state.body_count;
  return report;
}

}  // namespace

StepReport step(World& world) {
#if DETENT_SPARSE
  const StepObserver* const observer = world.hooks.observer;
  if (observer != nullptr && observer->step != nullptr) return observer->step(observer->context, world);
#endif
  return step_with(world, nullptr);
}
StepReport step_probed(World& world, StepProbe& probe) { return step_with(world, &probe); }

}  // namespace DETENT_NAMESPACE
}  // namespace detent
