#include "base/float_environment.h"
#include "collision/broadphase.h"
#include "collision/compound_code.h"
#include "collision/contact_cache.h"
#include "collision/manifold_reuse.h"
#include "dynamics/activity.h"
#include "dynamics/contact_order.h"
#include "dynamics/contact_rows.h"
#include "dynamics/finalise.h"
#include "dynamics/impact.h"
#include "dynamics/island.h"
#include "dynamics/joint.h"
#include "dynamics/predict.h"
#include "dynamics/solve.h"
#include "dynamics/spin.h"
#include "dynamics/substeps.h"
#include "geometry/shape_traits.h"
#include "world/events.h"
#include "world/joints.h"
#include "world/sensors.h"
#include "world/stage_clock.h"
#include "world/step_cache.h"
#include "world/step_probe.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// The work space of a block, as spans over its capacity.
struct Scratch {
  Span<uint32_t> moving_bodies;
  BitSet candidates;
  Span<BodyWork> bodies;
  Span<BoundsKey> bounds_keys, bounds_sort;
  Span<uint64_t> pairs, pair_sort;
  Span<ContactWork> contacts;
  Span<ContactOrder> contact_order, contact_sort;
  Span<Island> islands;
  Span<uint32_t> island_bodies;
  Span<BodySweep> sweeps;
  Span<ImpactPair> impact_pairs;
  Span<ImpactHit> impact_hits;
  Span<ManifoldState> manifolds;
  Span<JointWork> joints;
  Span<JointBody> joint_bodies;
  Span<uint32_t> joint_order;
  Span<uint64_t> apart;
  Span<uint64_t> sensed, sensed_passed;
  BitSet changed;
};

Scratch scratch_of(uint8_t* block, const Layout& layout, Capacity capacity) {
  return {{at_offset<uint32_t>(block, layout.moving_bodies), capacity.bodies},
          {{at_offset<uint32_t>(block, layout.candidates), slot_words(capacity.bodies)}},
          {at_offset<BodyWork>(block, layout.body_work), capacity.bodies},
          {at_offset<BoundsKey>(block, layout.bounds_keys), capacity.bodies},
          {at_offset<BoundsKey>(block, layout.bounds_sort), capacity.bodies},
          {at_offset<uint64_t>(block, layout.pairs), capacity.contacts * k_pairs_per_contact},
          {at_offset<uint64_t>(block, layout.pair_sort), capacity.contacts * k_pairs_per_contact},
          {at_offset<ContactWork>(block, layout.contact_work), capacity.contacts},
          {at_offset<ContactOrder>(block, layout.contact_order), capacity.contacts},
          {at_offset<ContactOrder>(block, layout.contact_sort), capacity.contacts},
          {at_offset<Island>(block, layout.islands), capacity.bodies},
          {at_offset<uint32_t>(block, layout.island_bodies), capacity.bodies},
          {at_offset<BodySweep>(block, layout.sweeps), capacity.bodies},
          {at_offset<ImpactPair>(block, layout.impact_pairs), capacity.contacts},
          {at_offset<ImpactHit>(block, layout.impact_hits), capacity.contacts},
          {at_offset<ManifoldState>(block, layout.manifold_work), manifold_count(capacity)},
          {at_offset<JointWork>(block, layout.joint_work), capacity.joints},
          {at_offset<JointBody>(block, layout.joint_bodies), joint_body_count(capacity)},
          {at_offset<uint32_t>(block, layout.joint_order), capacity.joints},
          {at_offset<uint64_t>(block, layout.apart), capacity.joints},
          {at_offset<uint64_t>(block, layout.sensed_work), capacity.sensed},
          {at_offset<uint64_t>(block, layout.sensed_passed), capacity.sensed},
          {{at_offset<uint32_t>(block, layout.changed), capacity.sensed == 0 ? 0 : slot_words(capacity.bodies)}}};
}

/// Lengths of a pair, m.
struct PairLengths {
  Real at_rest;  ///< how far apart it has contact points if it does not move
  Real reach;    ///< and as it moves: what it can close in this tick is added, up to a quarter of the smaller body, or
                 ///< twice that body where joints hold one
  Real reuse;    ///< how far it may move until its contact points are found anew
};

PairLengths lengths_of(const StepSettings& settings, const BodyWork& a, const BodyWork& b) {
  const Real extent = min(a.extent, b.extent), speed = a.speed + b.speed;
  const Real at_rest = extent * settings.breaking;
  // What joints hold is not stopped on its way (impact.h): its contacts foresee more.
  const bool jointed = a.joint_body != k_no_link || b.joint_body != k_no_link;
  const Real reach_max = scale_by_power(extent, jointed ? 1 : -2);
  return {at_rest, at_rest + min(reach_max, speed * settings.tick_time), extent * settings.reuse};
}

/// The bodies of a step, as the stages before the solve read them.
struct Bodies {
  Span<const BodyPose> poses;
  Span<const BodyTraits> traits;
  Span<const BodyMotion> motions;
  Span<BodyActivity> activities;
  Span<BodyWork> work;
  BitSet visits;  ///< of those that move
  AssetTable assets;
  const FeatureTable& features;

  RowBody at(uint32_t slot) const {
    const BodyWork& now = work[slot];
    return {traits[slot], poses[slot], motions[slot], now.gyration, now.spin, now.extent, now.fall};
  }
  CollisionBody collider(uint32_t slot) const { return {poses[slot], traits[slot], work[slot].axes}; }
  void start(const StepSettings& settings, uint32_t slot) const {
    start_body(settings, traits[slot], poses[slot], motions[slot], work[slot]);
  }
  bool awake(uint32_t slot) const { return is_awake(traits[slot], activities[slot]); }
  bool moving(uint32_t slot) const { return is_moving(traits[slot], motions[slot], activities[slot]); }
  bool asleep(uint32_t slot) const { return activities[slot].asleep != 0; }
  bool has_parts(uint32_t slot_a, uint32_t slot_b) const { return detent::has_parts(traits[slot_a], traits[slot_b]); }
};

/// A contact of the last tick; `manifold` null where none are kept.
struct ContactBefore {
  const ContactState* contact = nullptr;
  const ManifoldState* manifold = nullptr;
};

/// Contact points of a pair of bodies that have been started: those of the last tick where they will do, which sets
/// `reused`, or else new ones. Fills `manifold`, unless it is null, with what is kept of them.
void collide_pair(const StepSettings& settings, uint32_t slot_a, uint32_t slot_b, const Bodies& bodies,
                  const ContactBefore& before, ContactGeometry& geometry, ManifoldState* manifold, bool& reused) {
  const CollisionBody body_a = bodies.collider(slot_a), body_b = bodies.collider(slot_b);
  const PairLengths lengths = lengths_of(settings, bodies.work[slot_a], bodies.work[slot_b]);
  // A point that was out of reach then is still farther off than the pair can close in this tick.
  const bool slow = lengths.reach + lengths.reuse <= scale_by_power(lengths.at_rest, 1);
  reused = before.manifold != nullptr && manifold != nullptr && slow &&
           reuse_manifold(body_a, body_b, *before.manifold, before.contact->feature, before.contact->point_count,
                          lengths.reuse, lengths.reach, geometry, *manifold);
  if (reused) return;
  collide(body_a, body_b, lengths.reach, geometry, bodies.assets, settings.reduction, bodies.features);
  if (manifold != nullptr) *manifold = slow ? kept_manifold(body_a, body_b, geometry) : ManifoldState{};
}

/// Likewise the contacts of the parts of a pair. Apart, for what it needs of the stack.
void collide_pair_parts(const StepSettings& settings, uint32_t slot_a, uint32_t slot_b, const Bodies& bodies,
                        SurfaceContacts& contacts) {
  const PairLengths lengths = lengths_of(settings, bodies.work[slot_a], bodies.work[slot_b]);
  collide_parts(bodies.collider(slot_a), bodies.collider(slot_b), lengths.reach, bodies.assets, settings.reduction,
                bodies.features, contacts);
}

__attribute__((noinline)) bool parts_touch(const StepSettings& settings, uint32_t slot_a, uint32_t slot_b,
                                           const Bodies& bodies) {
  SurfaceContacts contacts;
  collide_pair_parts(settings, slot_a, slot_b, bodies, contacts);
  return contacts.count != 0;
}

bool touch(const StepSettings& settings, uint32_t slot_a, uint32_t slot_b, const Bodies& bodies) {
  if (bodies.has_parts(slot_a, slot_b)) return parts_touch(settings, slot_a, slot_b, bodies);
  ContactGeometry geometry;
  bool reused = false;
  collide_pair(settings, slot_a, slot_b, bodies, {}, geometry, nullptr, reused);
  return geometry.count != 0;
}

/// Wakes whoever is touched by a body that moves, and whoever they touch: they leave the tree, and their pairs are
/// found. Returns how many woke.
uint32_t wake_touched(const StepSettings& settings, const Bodies& bodies, const StepCacheView& cache, PairPool& pool) {
  for (uint32_t woke = 0;;) {
    const uint32_t woken_before = woke;
    for (const uint64_t key : pool.pairs()) {
      const uint32_t low = pair_low(key), high = pair_high(key);
      const bool wakes_low = bodies.asleep(low) && bodies.moving(high);
      if (!wakes_low && !(bodies.asleep(high) && bodies.moving(low))) continue;
      bodies.start(settings, wakes_low ? low : high);
      if (!touch(settings, low, high, bodies)) continue;
      woke += wake_all_with(wakes_low ? low : high, bodies.activities, cache.visits);
    }
    if (woke == woken_before) return woke;
    cache.cache.contacts_known = 0;
    pool.go_on();
    cache.visits.for_each([&](uint32_t slot) {
      if (!cache.tree.has(slot)) return;
      cache.tree.remove(slot);
      find_resting_near(slot, cache.tree, pool);
    });
    pool.sort();
  }
}

Real depth_of(const ContactWork& contact) {
  Real least = contact.separation[0];
  for (uint32_t i = 1; i < contact.state.point_count; ++i) least = min(least, contact.separation[i]);
  return -least;
}

/// Leaves out the shallowest contact, the last of equals, if it is shallower than `depth`, keeping the others' order:
/// the last place is free then, and `key` is that of its pair.
bool leave_out_shallowest(Span<ContactWork> contacts, Span<ManifoldState> manifolds, Real depth, uint64_t& key) {
  uint32_t shallowest = contacts.count;
  for (uint32_t i = 0; i < contacts.count; ++i) {
    const Real other = depth_of(contacts[i]);
    if (other > depth || (other == depth && shallowest == contacts.count)) continue;
    depth = other;
    shallowest = i;
  }
  if (shallowest == contacts.count) return false;
  key = key_of(contacts[shallowest].state);
  for (uint32_t i = shallowest; i + 1 < contacts.count; ++i) contacts[i] = contacts[i + 1];
  for (uint32_t i = shallowest; i + 1 < manifolds.count; ++i) manifolds[i] = manifolds[i + 1];
  return true;
}

struct ContactCount {
  uint32_t contacts = 0;
  uint32_t points = 0;
  uint32_t dropped = 0;
  uint32_t parts_dropped = 0;  ///< shallower than those that their pairs keep
  uint32_t capped = 0;
  uint32_t reused = 0;
};

/// The contacts of a tick and, if they are kept, their manifolds.
struct KeptContacts {
  Span<const ContactState> contacts;
  Span<const ManifoldState> manifolds;
};

/// Collides pairs in ascending order and makes the rows of those that touch, sorted by pair and part.
struct Collider {
  const StepSettings& settings;
  const Bodies& bodies;
  Span<const uint32_t> awake;  ///< those of the contacts kept that may go on
  KeptContacts kept;           ///< sorted alike
  Span<ContactWork> contacts;
  Span<ManifoldState> manifolds;  ///< as many places as `contacts`, or none
  Losses& losses;
  ContactCount count = {};
  uint32_t next = 0;
  uint32_t last_started = UINT32_MAX;

  bool reuses() const { return kept.manifolds.count != 0; }

  void meet(uint64_t key) {
    const uint32_t slot_a = pair_low(key), slot_b = pair_high(key);
    // Who still sleeps was not touched when it could wake; points used again could tell otherwise.
    if (bodies.asleep(slot_a) || bodies.asleep(slot_b) || (!bodies.awake(slot_a) && !bodies.awake(slot_b))) return;
    start(slot_a);
    start(slot_b);
    if (bodies.has_parts(slot_a, slot_b)) {
      collide_all_parts(key);
      return;
    }
    ContactGeometry geometry;
    ManifoldState manifold;
    bool reused = false;
    const ContactBefore last = find_before(key, 0);
    collide_pair(settings, slot_a, slot_b, bodies, last, geometry, reuses() ? &manifold : nullptr, reused);
    count.capped += geometry.capped ? 1 : 0;
    count.reused += reused ? 1 : 0;
    if (geometry.count != 0) add(key, 0, geometry, manifold, last.contact);
  }

 private:
  /// One that rests is started when its pairs come; those of the ground come one after the other.
  void start(uint32_t slot) {
    if (bodies.visits.has(slot) || slot == last_started) return;
    bodies.start(settings, slot);
    last_started = slot;
  }

  ContactBefore find_before(uint64_t key, uint32_t part) {
    const auto contact = [&]() -> const ContactState& { return kept.contacts[awake[next]]; };
    while (next < awake.count && (key_of(contact()) < key || (key_of(contact()) == key && contact().part < part)))
      ++next;
    if (next == awake.count || key_of(contact()) != key || contact().part != part) return {};
    return {&contact(), reuses() ? &kept.manifolds[awake[next]] : nullptr};
  }

  __attribute__((noinline)) void collide_all_parts(uint64_t key) {
    SurfaceContacts found;
    collide_pair_parts(settings, pair_low(key), pair_high(key), bodies, found);
    count.capped += found.capped ? 1 : 0;
    count.parts_dropped += found.dropped;
    if (found.dropped != 0) losses.add(CapacityEventType::contact, pair_low(key), pair_high(key));
    for (uint32_t i = 0; i < found.count; ++i) {
      const SurfaceContact& contact = found.contact[i];
      add(key, contact.key, contact.geometry, {}, find_before(key, contact.key).contact);
    }
  }

  void add(uint64_t key, uint32_t part, const ContactGeometry& geometry, const ManifoldState& manifold,
           const ContactState* before) {
    const uint32_t slot_a = pair_low(key), slot_b = pair_high(key);
    if (count.contacts == contacts.count) {
      ++count.dropped;
      Real least = geometry.point[0].separation;
      for (uint32_t i = 1; i < geometry.count; ++i) least = min(least, geometry.point[i].separation);
      uint64_t lost = key;
      const bool has_room = leave_out_shallowest(contacts, manifolds, -least, lost);
      losses.add(CapacityEventType::contact, pair_low(lost), pair_high(lost));
      if (!has_room) return;
      --count.contacts;
    }
    if (reuses()) manifolds[count.contacts] = manifold;
    ContactWork& work = contacts[count.contacts++];
    work.state = continued_contact(slot_a, slot_b, part, geometry, before);
    make_rows(settings, bodies.at(slot_a), bodies.at(slot_b), geometry, work);
  }
};

ContactCount collide_pairs(Collider collider, Span<const uint64_t> pairs) {
  for (const uint64_t key : pairs) collider.meet(key);
  ContactCount& count = collider.count;
  for (const ContactWork& contact : collider.contacts.first(count.contacts)) count.points += contact.state.point_count;
  return count;
}

/// The bodies that move, once some have been woken.
Span<const uint32_t> list_moving(BitSet visits, Span<uint32_t> slots) {
  uint32_t count = 0;
  visits.for_each([&](uint32_t slot) { slots[count++] = slot; });
  return slots.first(count);
}

/// Moves the kinematic bodies among those that move.
uint32_t carry_all(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> moving) {
  uint32_t clamped = 0;
  for (const uint32_t slot : moving) {
    if (is_dynamic(bodies.traits[slot])) continue;
    clamped += carry(settings, {{&bodies.traits[slot], 1}, {&bodies.motions[slot], 1}, {&bodies.work[slot], 1}});
  }
  return clamped;
}

uint32_t solve_islands(StepSettings settings, const SolverBodies& bodies, Span<const Island> islands,
                       const Scratch& scratch, Span<ContactWork> contacts, const JointCode* joint_code,
                       JointStage& joints, StepReport& report) {
  uint32_t clamped = 0;
  for (const Island& island : islands) {
    const Span<const uint32_t> slots = {scratch.island_bodies.data + island.first_body, island.body_count};
    const Span<const ContactOrder> order = {scratch.contact_order.data + island.first_contact, island.contact_count};
    if (island.substeps != settings.substeps) set_substeps(island.substeps, settings);
    predict(settings, bodies.traits, slots, bodies.motions, bodies.work);
    const bool jointed = island.joint_count + island.loop_count != 0;
    const IslandJoints island_joints = {jointed ? joint_code : nullptr, &island, &joints, &report.joint_decisions_left};
    if (order.count == 0 && !jointed) {
      clamped += fly(settings, bodies, slots);
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

/// The stages of a step, in order. Separate from `step`, so that nothing of it moves across the change of the
/// floating-point environment.
__attribute__((noinline)) void run_stages(World& world, ImpactProbe* probe, StepReport& report) {
  StageClock clock(world.profile);
  const StateView<uint8_t> state = view_of(world);
  const Scratch scratch = scratch_of(world.block, state.layout, capacity_of(state.header));
  const uint32_t used = state.world.slots_used, before = state.world.contact_count;
  const Span<BodyPose> poses = state.poses.first(used);
  const Span<BodyMotion> motions = state.motions.first(used);
  const Span<BodyTraits> traits = state.traits.first(used);
  const Span<BodyActivity> activities = state.activities.first(used);
  const Span<BodyWork> work = scratch.bodies.first(used);
  const Span<BodySweep> sweeps = scratch.sweeps.first(used);
  StepSettings settings = step_settings(state.world);
  settings.quads = world.lanes == 4;
  const StepCacheView cache = cache_of(world.block, state.layout, capacity_of(state.header));
  const Bodies bodies = {poses, traits, motions, activities, work, cache.visits, world.assets, *world.features};
  const SolverBodies solver_bodies = {traits, motions, work};

  const JointCode* const joint_code = state.world.joint_count == 0 ? nullptr : world.features->joints;
  JointStage joints = {state.joints.first(joint_code == nullptr ? 0 : state.world.joints_used),
                       poses,
                       activities,
                       scratch.joints,
                       scratch.joint_bodies,
                       scratch.joint_order};
  report.woke = wake_jointed(joints.joints, traits, motions, activities, cache);
  const Span<const uint64_t> apart = list_apart(joints.joints, scratch.apart);
  Losses losses = {traits, {world.capacity_events.data, world.capacity_events.capacity}};
  const SensorCode* const sensor_code = state.world.sensor_count == 0 ? nullptr : world.features->sensors;
  if (sensor_code != nullptr) sensor_code->start(cache, used, scratch.changed);
  Span<const uint32_t> moving = sort_out(cache, settings, state, scratch.sweeps, scratch.moving_bodies);
  PairPool pool = {poses, traits, cache.bounds, scratch.pair_sort, scratch.pairs, world.filter_rules, apart};
  pool.losses = &losses;
  find_pairs(moving, cache.tree, scratch.bounds_keys, scratch.bounds_sort, pool);
  pool.sort();
  const auto start_moving = [&] {
    for (const uint32_t slot : moving) bodies.start(settings, slot);
    if (joint_code == nullptr) return;
    for (const JointState& joint : joints.joints) {
      if (joint.type == 0) continue;
      const uint32_t ends[2] = {joint.body_a, joint.body_b};
      for (const uint32_t slot : ends) {
        if (!cache.visits.has(slot)) bodies.start(settings, slot);
      }
    }
    joint_code->collect(solver_bodies, joints);
    report.joints = joints.count;
  };
  start_moving();
  // Whoever wakes and is held by joints reaches farther (lengths_of), and may touch more.
  while (const uint32_t touched = wake_touched(settings, bodies, cache, pool)) {
    report.woke += touched;
    moving = list_moving(cache.visits, scratch.moving_bodies);
    start_moving();
    if (joint_code == nullptr) break;
  }
  clock.end(StepStage::find_pairs);
  const Span<const uint64_t> pairs = pool.pairs();
  const Span<const uint32_t> awake_contacts = list_awake_contacts(cache, state);
  const uint32_t room = state.contacts.count - (before - awake_contacts.count);
  const bool reuses = settings.reuse > Real(0.0);
  const Span<ManifoldState> manifolds = state.manifolds.first(reuses ? state.manifolds.count : 0);
  const Span<ManifoldState> manifold_work = scratch.manifolds.first(reuses && state.manifolds.count != 0 ? room : 0);
  const ContactCount count = collide_pairs({settings,
                                            bodies,
                                            awake_contacts,
                                            {state.contacts, manifolds},
                                            scratch.contacts.first(room),
                                            manifold_work,
                                            losses},
                                           pairs);
  const Span<ContactWork> contacts = scratch.contacts.first(count.contacts);
  const Span<ContactOrder> order = scratch.contact_order.first(count.contacts);
  clock.end(StepStage::collide);

  report.islands =
      find_islands(moving, traits, activities, contacts, joints, work, scratch.islands, scratch.island_bodies);
  const Span<Island> islands = scratch.islands.first(report.islands);
  report.colour_overflows = order_contacts(traits, contacts, islands, work, scratch.contact_sort, order);
  estimate_loads(settings, poses, traits, scratch.island_bodies, islands, order, scratch.contact_sort, work, contacts);
  if (joint_code != nullptr) joint_code->grow(settings, solver_bodies, scratch.island_bodies, islands, joints);
  choose_substeps(settings, traits, work, scratch.island_bodies, order, islands, contacts, activities);
  clock.end(StepStage::islands);
  report.saturations = solve_islands(settings, solver_bodies, islands, scratch, contacts, joint_code, joints, report);
  report.saturations += carry_all(settings, solver_bodies, moving);
  clock.end(StepStage::solve);
  const Span<ContactEvent> events = {world.contact_events.data, world.contact_events.capacity};
  EventCount event_count = raise_events(poses, traits, awake_contacts, state.contacts, contacts, events);
  clock.end(StepStage::events);
  report.saturations += make_sweeps(moving, traits, work, poses, sweeps);
  if (joint_code != nullptr) {
    joint_code->store(settings, solver_bodies, joints);
    for (const JointBody& body : joints.bodies.first(joints.body_count)) {
      if (body.mobile != 0) sweeps[body.slot].marks = k_mark_jointed * (work[body.slot].island + 1);
    }
  }
  SensorStage sensors = {world.assets,
                         *world.features,
                         {traits, world.filter_rules, apart},
                         traits,
                         poses,
                         sweeps,
                         cache,
                         scratch.changed,
                         state.sensed.first(state.world.sensed_count),
                         {scratch.sensed_passed, {}},
                         {scratch.sensed, {}},
                         losses};
  if (state.world.continuous != 0) {
    const ImpactPairs known = {pairs, contacts, pool.dropped() == 0 && count.dropped == 0, apart};
    const ImpactBodies impact_bodies = {traits,
                                        poses,
                                        motions,
                                        sweeps,
                                        activities,
                                        cache.bounds,
                                        cache.tree,
                                        cache.visits,
                                        scratch.candidates,
                                        world.filter_rules,
                                        {sensor_code == nullptr ? nullptr : sensor_code->stretch, &sensors}};
    const ImpactReport impacts =
        world.features->continuous->advance(settings, world.assets, *world.features, known, impact_bodies,
                                            scratch.impact_pairs, scratch.impact_hits, probe);
    report_impacts(impacts, report);
    if (impacts.woke != 0) cache.cache.contacts_known = 0;
    add_hits(traits, scratch.impact_hits.first(impacts.hits), events, event_count);
    event_count.dropped += impacts.hits_dropped;
  }
  clock.end(StepStage::advance);
  report.contact_events = event_count.kept;
  report.contact_events_dropped = events.count == 0 ? 0 : event_count.dropped;
  if (sensor_code != nullptr) sensor_code->end(sensors, state, world.sensor_events, report);
  cache.visits.for_each(
      [&](uint32_t slot) { report.saturations += finalise(traits[slot], sweeps[slot], poses[slot], motions[slot]); });
  clock.end(StepStage::finalise);
  if (settings.sleeping)
    report.fell_asleep = world.features->sleeping->end_step(settings, traits, poses, islands, scratch.island_bodies,
                                                            motions, activities);
  store_contacts(contacts, manifold_work, awake_contacts.count, before, state.contacts, manifolds,
                 cache.awake_contacts);
  cache.cache.awake_contact_count = contacts.count;

  state.world.contact_count = before - awake_contacts.count + contacts.count;
  if (joint_code != nullptr) break_joints(world, report);
  report.pairs = pairs.count + pool.dropped();
  report.pairs_dropped = pool.dropped();
  report.contacts = count.contacts;
  report.contact_points = count.points;
  report.contacts_reused = count.reused;
  report.contacts_dropped = count.dropped + count.parts_dropped;
  report.contacts_capped = count.capped;
  const EventCount body_events =
      raise_body_events(cache.visits, traits, activities, {world.body_events.data, world.body_events.capacity});
  report.body_events = body_events.kept;
  report.body_events_dropped = world.body_events.capacity == 0 ? 0 : body_events.dropped;
  report.capacity_events = losses.count;
  bool moves = false;
  cache.visits.for_each([&](uint32_t slot) { moves = moves || bodies.moving(slot); });
  state.world.idle = moves ? 0 : 1;
  clock.end(StepStage::store);
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
