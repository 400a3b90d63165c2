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

/// The bodies that move, once some have been woken.
Span<const uint32_t> list_moving(BitSet active, Span<uint32_t> slots) {
  uint32_t count = 0;
  active.for_each([&](uint32_t slot) { slots[count++] = slot; });
  return slots.first(count);
}

/// Moves the kinematic bodies among those that move.
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

uint32_t solve_islands(StepSettings settings, const SolverBodies& bodies, Span<const Island> islands,
                       const Scratch& scratch, Span<ContactWork> contacts, const JointOps* joint_ops,
                       JointStage& joints, StepReport& report) {
  uint32_t clamped = 0;
  for (const Island& island : islands) {
    const Span<const uint32_t> slots = {scratch.island_bodies.data + island.first_body, island.body_count};
    const Span<const ContactOrder> order = {scratch.contact_order.data + island.first_contact, island.contact_count};
    if (island.substeps != settings.substeps) set_substeps(island.substeps, settings);
    predict(settings, bodies.properties, slots, bodies.motions, bodies.work);
    const bool jointed = island.joint_count != 0;
    const IslandJoints island_joints = {jointed ? joint_ops : nullptr, &island, &joints, &report.joint_decisions_left};
    if (order.count == 0 && !jointed) {
      clamped += integrate_free(settings, bodies, slots);
    } else {
      const SolveCount count = solve(settings, bodies, slots, order, contacts, island_joints);
      clamped += count.clamped;
      report.sweeps_saved += count.sweeps_saved;
    }
    for (const ContactOrder& entry : order) {
      store_load(settings, contacts[entry.contact]);
      store_impulses(contacts[entry.contact]);
    }
    report.contact_substeps += uint64_t{island.substeps} * island.contact_count;
    report.substeps_max = island.substeps > report.substeps_max ? island.substeps : report.substeps_max;
    report.awake += island.body_count;
  }
  return clamped;
}

void report_impacts(const ImpactReport& impacts, StepReport& report) {
  report.impacts = impacts.impacts;
  report.impacts_undecided = impacts.undecided;
  report.impacts_dropped = impacts.pairs_dropped;
  report.overlaps_left = impacts.overlaps_left;
  report.bodies_stopped = impacts.bodies_stopped;
  report.lost_time = impacts.lost_time;
  report.toi_tests = impacts.tests;
  report.toi_skipped = impacts.skipped;
  report.woke += impacts.woke;
  report.saturations += impacts.clamped;
}

const SensorOps* sensor_ops_of(const World& world, const StateView<uint8_t>& state) {
  return state.world.sensor_count == 0 ? nullptr : world.features->sensors;
}

Span<ContactEvent> contact_events_of(const World& world) {
  return {world.contact_events.data, world.contact_events.capacity};
}

/// Bodies that would meet on their sweeps meet, and sensors see who is within them or passes through. Apart, for what
/// it needs of the stack.
__attribute__((noinline)) void advance(World& world, const StateView<uint8_t>& state, const Scratch& scratch,
                                       const StepCacheView& cache, const StepSettings& settings,
                                       const ImpactPairs& known, Overflow& overflow, ImpactProbe* probe,
                                       EventCount& event_count, StepReport& report) {
  const uint32_t used = state.world.slots_used;
  const Span<BodyPose> poses = state.poses.first(used);
  const Span<BodyProperties> properties = state.properties.first(used);
  const Span<BodySweep> sweeps = scratch.sweeps.first(used);
  const SensorOps* const sensor_ops = sensor_ops_of(world, state);
  SensorStage sensors = {world.assets,
                         *world.features,
                         {properties, world.filter_rules, known.disabled_pairs},
                         properties,
                         poses,
                         sweeps,
                         cache,
                         scratch.changed,
                         state.sensed.first(state.world.sensed_count),
                         {scratch.sensed_passed, {}},
                         {scratch.sensed, {}},
                         overflow};
  if (state.world.continuous != 0) {
    const ImpactBodies bodies = {properties,
                                 poses,
                                 state.motions.first(used),
                                 sweeps,
                                 state.activities.first(used),
                                 cache.bounds,
                                 cache.tree,
                                 cache.active,
                                 scratch.candidates,
                                 scratch.moving_bodies.first(used),
                                 world.filter_rules,
                                 {sensor_ops == nullptr ? nullptr : sensor_ops->sweep, &sensors}};
    const ImpactReport impacts = world.features->continuous->advance(
        settings, world.assets, *world.features, known, bodies, scratch.impact_pairs, scratch.impact_hits, probe);
    report_impacts(impacts, report);
    if (impacts.woke != 0) cache.cache.contacts_known = 0;
    add_hits(properties, scratch.impact_hits.first(impacts.hits), contact_events_of(world), event_count);
    event_count.dropped += impacts.hits_dropped;
  }
  if (sensor_ops != nullptr) sensor_ops->end(sensors, state, world.sensor_events, report);
}

/// The stages of a step, in order. Separate from `step`, so that nothing of it moves across the change of the
/// floating-point environment.
__attribute__((noinline)) void run_stages(World& world, ImpactProbe* probe, StepReport& report) {
  StageEnds stages(world);
  const StateView<uint8_t> state = view_of(world);
  const Scratch scratch = scratch_of(world.block, state.layout, capacity_of(state.header));
  const uint32_t used = state.world.slots_used, before = state.world.contact_count;
  const Span<BodyPose> poses = state.poses.first(used);
  const Span<BodyMotion> motions = state.motions.first(used);
  const Span<BodyProperties> properties = state.properties.first(used);
  const Span<BodyActivity> activities = state.activities.first(used);
  const Span<BodyWork> work = scratch.bodies.first(used);
  const Span<BodySweep> sweeps = scratch.sweeps.first(used);
  StepSettings settings = step_settings(state.world);
  settings.lanes = k_built_with_lanes && world.lanes == 4;  // create_world() asked the processor
  const StepCacheView cache = cache_of(world.block, state.layout, capacity_of(state.header));
  const StepBodies bodies = {poses, properties, motions, activities, work, cache.active, world.assets, *world.features};
  const SolverBodies solver_bodies = {properties, motions, work};

  const JointOps* const joint_ops = state.world.joint_count == 0 ? nullptr : world.features->joints;
  JointStage joints = {state.joints.first(joint_ops == nullptr ? 0 : state.world.joints_used),
                       poses,
                       activities,
                       scratch.joints,
                       scratch.joint_bodies,
                       scratch.joint_order,
                       scratch.joint_couplings,
                       scratch.joint_numbers};
  report.woke = wake_jointed(joints.joints, properties, motions, activities, cache);
  const Span<const uint64_t> disabled_pairs = list_disabled_pairs(joints.joints, scratch.disabled_pairs);
  Overflow overflow = {properties, {world.capacity_events.data, world.capacity_events.capacity}};
  const SensorOps* const sensor_ops = sensor_ops_of(world, state);
  if (sensor_ops != nullptr) sensor_ops->start(cache, used, scratch.changed);
  Span<const uint32_t> moving = partition_bodies(cache, settings, state, work, scratch.sweeps, scratch.moving_bodies);
  PairPool pool = {poses,         properties,         cache.bounds,  scratch.pair_sort,
                   scratch.pairs, world.filter_rules, disabled_pairs};
  pool.overflow = &overflow;
  find_pairs(moving, cache.tree, scratch.bounds_keys, scratch.bounds_sort, pool);
  pool.sort();
  const auto start_joined = [&] {
    if (joint_ops == nullptr) return;
    for (const JointState& joint : joints.joints) {
      if (joint.type == 0) continue;
      const uint32_t ends[2] = {joint.body_a, joint.body_b};
      for (const uint32_t slot : ends) {
        if (!cache.active.has(slot)) bodies.start(settings, slot);
      }
    }
    joint_ops->collect(solver_bodies, joints);
    report.joints = joints.count;
  };
  start_joined();
  // Whoever wakes and is held by joints reaches farther (lengths_of), and may touch more.
  while (const uint32_t touched = wake_touched(settings, bodies, cache, pool)) {
    report.woke += touched;
    moving = list_moving(cache.active, scratch.moving_bodies);
    for (const uint32_t slot : moving) bodies.start(settings, slot);
    start_joined();
    if (joint_ops == nullptr) break;
  }
  stages.end(StepStage::find_pairs, 0);
  const Span<const uint64_t> pairs = pool.pairs();
  const Span<const uint32_t> awake_contacts = list_awake_contacts(cache, state);
  const uint32_t room = state.contacts.count - (before - awake_contacts.count);
  const bool recycles = settings.contact_recycle_distance > Real(0.0);
  const Span<ManifoldState> manifolds = state.manifolds.first(recycles ? state.manifolds.count : 0);
  const ContactRoom places = {scratch, room, recycles && state.manifolds.count != 0};
  const ContactCount count =
      collide_pairs(settings, bodies, {state.contacts, manifolds, awake_contacts}, places, overflow, pairs);
  const Span<ContactWork> contacts = scratch.contacts.first(count.contacts);
  const Span<ContactOrder> order = scratch.contact_order.first(count.contacts);
  stages.end(StepStage::collide, contacts.count);

  report.islands =
      find_islands(moving, properties, activities, contacts, joints, work, scratch.islands, scratch.island_bodies);
  const Span<Island> islands = scratch.islands.first(report.islands);
  report.colour_overflows = order_contacts(properties, contacts, islands, work, scratch.contact_sort, order);
  estimate_loads(settings, poses, properties, scratch.island_bodies, islands, order, scratch.contact_sort, work,
                 contacts);
  if (joint_ops != nullptr)
    report.joint_couplings_dropped = joint_ops->order(settings, solver_bodies, scratch.island_bodies, islands, joints);
  choose_substeps(settings, properties, work, scratch.island_bodies, order, islands, contacts, activities);
  stages.end(StepStage::islands, contacts.count);
  report.saturations = solve_islands(settings, solver_bodies, islands, scratch, contacts, joint_ops, joints, report);
  report.saturations += integrate_kinematic_bodies(settings, solver_bodies, moving);
  stages.end(StepStage::solve, contacts.count);
  EventCount event_count =
      raise_events(poses, properties, awake_contacts, state.contacts, contacts, contact_events_of(world));
  stages.end(StepStage::events, contacts.count);
  report.saturations += make_sweeps(moving, properties, work, poses, sweeps);
  if (joint_ops != nullptr) {
    joint_ops->store(settings, solver_bodies, joints);
    for (const JointBody& body : joints.bodies.first(joints.body_count)) {
      if (body.mobile != 0) sweeps[body.slot].marks = k_mark_jointed * (work[body.slot].island + 1);
    }
  }
  const ImpactPairs known = {pairs, contacts, pool.dropped() == 0 && count.dropped == 0, disabled_pairs};
  advance(world, state, scratch, cache, settings, known, overflow, probe, event_count, report);
  stages.end(StepStage::advance, contacts.count);
  report.contact_events = event_count.kept;
  report.contact_events_dropped = world.contact_events.capacity == 0 ? 0 : event_count.dropped;
  cache.active.for_each([&](uint32_t slot) {
    report.saturations += finalise(properties[slot], sweeps[slot], poses[slot], motions[slot]);
  });
  stages.end(StepStage::finalise, contacts.count);
  if (settings.sleeping)
    report.fell_asleep = world.features->sleeping->end_step(settings, properties, poses, sweeps, islands,
                                                            scratch.island_bodies, motions, activities);
  store_contacts(contacts, places.manifolds(), awake_contacts.count, before, state.contacts, manifolds,
                 cache.awake_contacts);
  cache.cache.awake_contact_count = contacts.count;

  state.world.contact_count = before - awake_contacts.count + contacts.count;
  if (joint_ops != nullptr) break_joints(world, report);
  report.pairs = pairs.count + pool.dropped();
  report.pairs_dropped = pool.dropped();
  report.contacts = count.contacts;
  report.contact_points = count.points;
  report.contacts_recycled = count.recycled;
  report.contacts_dropped = count.dropped + count.parts_dropped;
  report.contact_parts_dropped = count.parts_dropped;
  report.contacts_capped = count.capped;
  const EventCount body_events =
      raise_body_events(cache.active, properties, activities, {world.body_events.data, world.body_events.capacity});
  report.body_events = body_events.kept;
  report.body_events_dropped = world.body_events.capacity == 0 ? 0 : body_events.dropped;
  report.capacity_events = overflow.count;
  bool moves = false;
  cache.active.for_each([&](uint32_t slot) { moves = moves || bodies.moving(slot); });
  state.world.idle = moves ? 0 : 1;
  stages.end(StepStage::store, contacts.count);
}

StepReport step_with(World& world, ImpactProbe* probe) {
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

StepReport step(World& world) { return step_with(world, nullptr); }
StepReport step_probed(World& world, ImpactProbe& probe) { return step_with(world, &probe); }

}  // namespace DETENT_NAMESPACE
}  // namespace detent
