#pragma once
#include <detent/asset.h>
#include <detent/body.h>
#include <detent/contact.h>
#include <detent/event.h>
#include <detent/features.h>
#include <detent/joint.h>
#include <detent/status.h>
#include <detent/tasks.h>

/// @file
/// The world: pools of bodies, contacts and joints, of fixed capacity, in one block of the caller's memory.
///
/// Threads: the library has no global state. Calls on different worlds may run concurrently. On one world, functions
/// that take `const World&` may run concurrently with each other; a call that takes `World&` must run alone. In f32 and
/// f64, every call that computes sets the floating-point modes (rounding, flush-to-zero) that it needs, and at its end
/// restores the modes of the caller. A step uses several threads if the caller lends them (WorldHooks::tasks).
namespace detent {
inline namespace DETENT_NAMESPACE {

/// How many objects of each kind a world can hold, at most 2^20 of each. A world's capacity never changes.
struct Capacity {
  uint32_t bodies = 0;    ///< number of bodies, at least 1
  uint32_t contacts = 0;  ///< a pair of convex bodies needs one, a pair with a terrain or compound up to 16
  uint32_t assets = 0;    ///< number of assets that can be bound
  /// Whether contact points can be recycled (WorldDef::contact_recycle_distance). This takes 160 bytes for each contact
  /// of the capacity (f64: 272).
  bool manifolds = true;
  uint32_t joints = 0;  ///< number of joints
  uint32_t sensed = 0;  ///< number of pairs of a sensor and a body within it; 0: no sensors
  /// Equal in every member.
  friend constexpr bool operator==(Capacity a, Capacity b) {
    return a.bodies == b.bodies && a.contacts == b.contacts && a.assets == b.assets && a.manifolds == b.manifolds &&
           a.joints == b.joints && a.sensed == b.sensed;
  }
};

/// How the solver corrects penetration. Stored in snapshots and recordings: a value is never reused.
enum class Stabilisation : uint32_t {
  /// Soft contacts (damped springs) followed by a relaxation pass, which removes the speed that the springs add; needed
  /// by tall stacks.
  soft = 1,
  /// Rigid contacts. After the substeps of a tick, positions are corrected by half of the remaining penetration;
  /// velocities do not change. Source: Cline, Pai, "Post-stabilization for rigid body simulation with contact and
  /// constraints", ICRA 2003.
  post = 2,
};

/// The settings of a world. Every field but the capacity has a working default.
///
/// The *extent* of a body is its smallest diameter, m. The *smaller extent* of a pair is the lesser of the extents of
/// its two bodies.
struct WorldDef {
  /// How many objects of each kind the world can hold.
  Capacity capacity = {};
  Vec3<Real> gravity = {Real(0.0), Real(-9.81), Real(0.0)};  ///< m/s^2; each component within +-1024
  Real tick = Real(1.0 / 60.0);                              ///< length of a step, s, [2^-14, 1/4]
  /// Solver substeps per tick, [1, 64]; 0: the step chooses the number for each island from its contact loads and its
  /// joints.
  uint32_t substeps = 0;
  uint32_t substeps_max = 32;  ///< largest number that the step chooses if `substeps` is 0, [1, 64]
  /// The accuracy of contacts at rest: the step chooses so many substeps that a contact sinks under its load by at most
  /// this fraction of the smaller extent, [2^-12, 2^-3]. A quarter of the value takes about twice as many substeps. To
  /// reach this accuracy, an island takes at most `substeps_max` substeps, or 6 if it has joints, and fewer if it has
  /// many contacts (SPEC.md, "Substeps").
  Real resting_penetration = Real(1.0 / 144);
  uint32_t iterations = 1;  ///< solver iterations over the contacts in a substep, [1, 64]
  /// The iterations of a substep end early if the last iteration changed no velocity by more than g h / 2^convergence.
  /// Here h is the length of the substep, s, and g is the magnitude of the gravity, or 1 m/s^2 if that is larger.
  /// Range: [0, 30].
  uint32_t convergence = 12;
  /// How the solver corrects penetration.
  Stabilisation stabilisation = Stabilisation::soft;
  Real relaxation = 1.0;                ///< over-relaxation factor of the SOR solver, [1/4, 7/4]
  /// Frequency of soft contacts, as a fraction of the substep rate. An island with joints and fewer than 24 substeps
  /// uses the frequency that it would have with 24. Range: [1/64, 1/4].
  Real contact_frequency = Real(0.14);
  /// Damping ratio of soft contacts, [0, 64]. Contacts between two dynamic bodies use 0.7 times this value, all other
  /// contacts half of it.
  Real damping_ratio = 10.0;
  /// Approach speed below which a contact does not rebound, as a multiple of sqrt(g x smaller extent). Here g is the
  /// magnitude of the gravity, or 1 m/s^2 if that is larger. Range: [0, 64].
  Real restitution_threshold = 0.25;
  bool continuous = true;  ///< continuous collision: bodies collide at the time of impact, however fast they move
  bool sleeping = true;    ///< islands at rest fall asleep: steps skip them until a contact, joint or call wakes them
  /// Contact margin (breaking distance) of a pair at rest, as a fraction of the pair's smaller extent, [2^-10, 2^-4].
  /// Two surfaces have contact points if their distance is below the margin. For a moving pair, a step adds the
  /// distance by which the bodies can approach in a tick, but at most a quarter of the smaller extent (if a body has
  /// joints, twice the smaller extent).
  Real contact_margin = Real(1.0 / 64);
  /// The contact points of a pair are recycled until the bodies' relative motion since the points were computed exceeds
  /// this fraction of the pair's smaller extent; [0, 1/64]. If Capacity::manifolds is false, the world uses 0.
  Real contact_recycle_distance = Real(1.0 / 256);
  /// Which four contact points of a pair are kept if there are more.
  ManifoldReduction reduction = ManifoldReduction::projected_extremes;
};

/// The stages of a step, in their order.
enum class StepStage : uint32_t {
  find_pairs,     ///< finds the moving bodies, their bounds and the pairs with overlapping bounds; wakes bodies
  collide_pairs,  ///< computes the contact points of the pairs and the rows of the solver
  build_islands,  ///< finds the islands, the order of the solve, the loads and the numbers of substeps
  solve_islands,  ///< computes the substeps
  raise_events,   ///< writes the contact events
  advance,        ///< computes the sweeps, continuous collision and the sensors
  finalise,       ///< computes the new poses
  store,          ///< puts bodies to sleep, stores the contacts, removes broken joints and writes body events
};
inline constexpr uint32_t k_step_stage_count = 8;  ///< number of stages
/// Returns the name of a stage: that of its enumerator. Never null.
const char* stage_name(StepStage stage);

/// Times of the stages of a step, by the caller's clock, summed over steps. Set WorldHooks::profile to measure them. A
/// profile does not change the state.
struct Profile {
  uint64_t (*now)(void* user) = nullptr;    ///< the clock; it must not run backwards, nor use the world
  void* user = nullptr;                     ///< passed to `now`
  uint64_t ticks[k_step_stage_count] = {};  ///< clock ticks in each stage, summed over steps; the caller may reset them
  uint64_t steps = 0;                       ///< number of steps that were not idle
};

struct StepReport;

/// A callback at the end of each stage of a step. An idle step does not call it: if no body moves and none was changed,
/// a step only counts the tick. The callback is for tools that find the stage in which two machines begin to differ.
/// Set WorldHooks::observer to use it. An observer does not change the state.
struct StepObserver {
  /// `contacts`: number of contacts that the step has found so far. They are in its work space, not yet in the state.
  /// The callback must not change the world. The state is incomplete within the step, so the callback may call only
  /// these functions of world.h: `digest`, `save` and the getters.
  void (*stage_ended)(void* context, const World& world, StepStage stage, uint32_t contacts) = nullptr;
  void* context = nullptr;  ///< passed to `stage_ended`
  /// @cond
  // Internal, for RollbackSession: computes the step in place of step().
  StepReport (*step)(void* context, World& world) = nullptr;
  /// @endcond
};

/// Bytes of the block that a world of this capacity needs; 0 if the capacity is out of range. Builds with vector code
/// (World::lanes) need more than others.
constexpr uint32_t world_bytes(Capacity capacity);

/// Memory and functions of the caller that a world uses: assets, filter rules, event buffers, profile, observer, tasks.
/// The memory must outlive the world. By default all are empty.
/// An event buffer without `data` counts as no buffer, whatever its capacity.
struct WorldHooks {
  AssetTable assets = {};  ///< the assets that can be bound (asset.h)
  /// The rules that Filter::rule names.
  FilterRuleTable filter_rules = {};
  ContactEventBuffer contact_events = {};    ///< for contact events; each step fills every buffer from its front
  JointEventBuffer joint_events = {};        ///< for events of joints that broke
  SensorEventBuffer sensor_events = {};      ///< for events of bodies that entered or left a sensor
  BodyEventBuffer body_events = {};          ///< for events of bodies that fell asleep or woke
  CapacityEventBuffer capacity_events = {};  ///< for events of entries that a step dropped because a pool was full
  Profile* profile = nullptr;                ///< times of the stages of each step
  const StepObserver* observer = nullptr;    ///< called at the end of each stage of each step
  Tasks tasks = {};                          ///< threads for parts of each step, and for batches of queries
};

/// A handle to a world in the caller's block. It owns nothing and may be copied.
struct World {
  uint8_t* block = nullptr;                ///< the block passed to create_world()
  const FeatureTable* features = nullptr;  ///< the features passed to create_world()
  /// The largest number of contacts that the solver processes at once, in vector registers: 1, 4 or 8. create_world()
  /// sets what this machine supports: 8 on x86-64 (in fixed point only with AVX-512 and not on Windows, else 4), 4 in
  /// other builds with vector code, else 1. The results are bit-identical. Do not set more than this machine supports.
  uint32_t lanes = 1;
  /// The hooks passed to create_world(). They may be changed between calls, but the assets and filter rules that bodies
  /// use must stay available.
  WorldHooks hooks = {};
};

/// The contacts of awake bodies in one step.
struct ContactReport {
  uint32_t pairs = 0;     ///< pairs with overlapping bounds and a moving body; dropped pairs count too
  uint32_t count = 0;     ///< contacts, each with at least one contact point
  uint32_t points = 0;    ///< points of all these contacts, at most four each
  uint32_t recycled = 0;  ///< contacts whose points were recycled because the pair had hardly moved
  /// Pairs whose contact search reached its iteration cap (the normal may not be the direction of least penetration),
  /// and pairs that have no contact because an asset's bytes are missing.
  uint32_t capped = 0;
  uint32_t sweeps_saved = 0;  ///< solver iterations skipped because an island converged (WorldDef::convergence)
  uint64_t substeps = 0;      ///< work of the solver: sum, over all contacts, of the substeps of the contact's island
  /// Contacts that found no colour, and are therefore solved last in their island. A colour is a set of contacts that
  /// share no dynamic body. A contact finds no colour if the other contacts of its two bodies use all 63 colours.
  uint32_t colour_overflows = 0;
};

/// The joints in one step.
struct JointReport {
  uint32_t count = 0;      ///< joints with at least one awake body
  uint32_t broken = 0;     ///< joints that broke and were removed
  uint32_t undecided = 0;  ///< joint solves that stopped before the state of every limit, motor and friction was found
};

/// Continuous collision in one step.
struct CcdReport {
  uint32_t impacts = 0;        ///< impacts within the tick that changed how bodies move
  uint32_t undecided = 0;      ///< searches for a time of impact that stopped early, or that were impossible
  uint32_t overlaps_left = 0;  ///< pairs that overlap too deeply for continuous collision
  /// Bodies that stopped before the end of the tick. Reasons: too many impacts (docs/continuous_collision.md), a full
  /// impact pool, or an overlap that is too deep. They stay at their last safe pose until the tick ends.
  uint32_t bodies_stopped = 0;
  Real lost_time = 0.0;  ///< sum over the stopped bodies: the fraction of the tick for which the body stood still
  uint32_t tests = 0;    ///< number of times of impact that were computed
  /// Pairs not tested for impact because they are too slow to collide in the tick. After an impact of one of its
  /// bodies, a pair can count again, here and in `kept_apart`.
  uint32_t skipped = 0;
  uint32_t kept_apart = 0;  ///< pairs not tested for impact because the solver's contacts already stop the bodies
};

/// What one step lost: entries for which a pool had no room, and sensor tests left undecided.
struct LossReport {
  /// Pairs beyond the pair pool. The pairs whose bounds overlap least are dropped. They have no contacts in this tick,
  /// but continuous collision tests them all.
  uint32_t pairs = 0;
  /// Contacts beyond Capacity::contacts, or beyond 16 for one pair if their normals are too different to be merged. The
  /// shallowest are dropped: they are not solved in this tick.
  uint32_t contacts = 0;
  /// The part of `contacts` that was beyond 16 for one pair and not merged. A larger capacity does not prevent this.
  uint32_t contact_parts = 0;
  /// Couplings of two joints that had no room in the joint solver, because the joints form too many loops. The joints
  /// of such a coupling become softer.
  uint32_t joint_couplings = 0;
  uint32_t impacts = 0;  ///< impacts beyond the impact pool (Capacity::contacts): their bodies stop early
  /// Bodies beyond Capacity::sensed that are within a sensor or passed through it. The sensor does not report them.
  uint32_t sensed = 0;
  /// Bodies that count as within a sensor, or as passing through it, because a test was undecided.
  uint32_t sensed_undecided = 0;
};

/// The numbers of events that one step wrote to the buffers of WorldHooks, and the numbers of those that it dropped. If
/// the caller gave no buffer for a kind of event, the numbers of this kind are 0.
struct EventReport {
  uint32_t contact = 0;   ///< events written to WorldHooks::contact_events
  uint32_t joint = 0;     ///< events written to WorldHooks::joint_events
  uint32_t sensor = 0;    ///< events written to WorldHooks::sensor_events (sensor.h)
  uint32_t body = 0;      ///< events written to WorldHooks::body_events (bodies that fell asleep or woke)
  uint32_t capacity = 0;  ///< events written to WorldHooks::capacity_events
  /// Contact events beyond the capacity of their buffer, and hit events of impacts beyond Capacity::contacts.
  uint32_t contact_dropped = 0;
  uint32_t joint_dropped = 0;   ///< joint events beyond the capacity of their buffer
  uint32_t sensor_dropped = 0;  ///< sensor events beyond the capacity of their buffer
  uint32_t body_dropped = 0;    ///< body events beyond the capacity of their buffer
};

/// The counts of one step. Every count is of this step alone.
struct StepReport {
  uint64_t tick = 0;            ///< ticks completed since the world was created
  uint32_t bodies = 0;          ///< bodies in the world
  uint32_t awake = 0;           ///< dynamic bodies that took part in the step
  uint32_t islands = 0;         ///< groups of awake bodies that contacts or joints connect; a body alone counts, too
  uint32_t substeps_max = 0;    ///< the largest number of substeps of any island
  uint32_t woke = 0;            ///< sleeping bodies that contacts, joints or impacts woke in the step
  uint32_t fell_asleep = 0;     ///< bodies that fell asleep at the end of the step
  ContactReport contacts = {};  ///< pairs and contacts
  JointReport joints = {};      ///< joints
  uint32_t saturations = 0;     ///< state components clamped to their range
  CcdReport ccd = {};           ///< continuous collision
  LossReport lost = {};         ///< what the step lost
  EventReport events = {};      ///< events written and dropped
  /// Returns true if the step dropped no pair, contact or sensed body, capped no contact search, clamped no value and
  /// stopped no body early. It ignores undecided tests and solves, overlaps left, joint couplings and dropped events.
  constexpr bool complete() const {
    return lost.pairs == 0 && lost.contacts == 0 && contacts.capped == 0 && saturations == 0 &&
           ccd.bodies_stopped == 0 && lost.sensed == 0;
  }
};

/// A world's capacity and its current counts.
struct WorldInfo {
  Capacity capacity = {};      ///< WorldDef::capacity
  uint64_t tick = 0;           ///< ticks completed since the world was created
  uint32_t bodies = 0;         ///< bodies in the world
  uint32_t contacts = 0;       ///< contacts after the last step, those of sleeping bodies included
  uint32_t joints = 0;         ///< joints in the world
  uint32_t sensed = 0;         ///< pairs of a sensor and a body within it, after the last step
  uint32_t slots_retired = 0;  ///< body slots that are no longer used because their generations are used up
};

/// Makes an empty world in `block` (8-byte aligned, at least world_bytes(def.capacity) bytes).
/// `hooks`: memory and functions of the caller that the world uses; {}: none. `features`: the features of the world;
/// they determine the code that the program links (features.h). Errors: buffer_too_small, buffer_misaligned,
/// out_of_range, bad_argument (`reduction` or `stabilisation` is not a value of its enumeration), feature_missing.
Status create_world(uint8_t* block, uint32_t block_bytes, const WorldDef& def, const WorldHooks& hooks,
                    const FeatureTable& features, World& world);
/// As create_world() above, with all features.
inline Status create_world(uint8_t* block, uint32_t block_bytes, const WorldDef& def, const WorldHooks& hooks,
                           World& world) {
  return create_world(block, block_bytes, def, hooks, feature_table<Features::all>, world);
}

/// Creates a body in the lowest free slot; it takes part in the next step.
/// Errors: pool_full (also for a sensor if Capacity::sensed is 0), bad_argument, out_of_range, not_normalised,
/// asset_missing (the shape's asset is not bound), feature_missing, rule_missing.
Status create_body(World& world, const BodyDef& def, BodyId& id);
/// Removes a body and its joints. Its contacts end at once. The bodies that touched it or were joined to it wake.
/// Errors: bad_id.
Status destroy_body(World& world, BodyId id);
/// Moves a body to a pose, m, world, without collisions on the way. The body keeps its velocity. The body wakes, and so
/// do the bodies that touch it or are joined to it.
/// Errors: bad_id, out_of_range, not_normalised.
Status set_pose(World& world, BodyId id, const Position& position, const Quat& rotation);
/// Sets a body's velocity, m/s, and angular velocity, rad/s, both in world axes; ranges as in BodyDef.
/// Errors: bad_id, bad_argument (a fixed body that would move, a half-space that would rotate), out_of_range.
Status set_velocity(World& world, BodyId id, const Vec3<Real>& velocity, const Vec3<Real>& angular_velocity);
/// Adds a force, N, world frame, that acts at the centre of mass during the next step.
/// Errors: bad_id, bad_argument (not dynamic), out_of_range (the resulting speed would leave its range).
Status apply_force(World& world, BodyId id, const Vec3<Scaled>& force);
/// Adds a torque, N m, world frame, that acts during the next step. Errors: as apply_force.
Status apply_torque(World& world, BodyId id, const Vec3<Scaled>& torque);
/// Applies an impulse, N s, world frame, at the centre of mass; the velocity changes at once. Errors: as apply_force.
Status apply_impulse(World& world, BodyId id, const Vec3<Scaled>& impulse);
/// Applies an impulse, N s, world frame, at the point `arm` from the centre of mass, m, world axes, each component
/// within twice the bounding radius; the velocities change at once. Errors: as apply_force.
Status apply_impulse_at(World& world, BodyId id, const Vec3<Scaled>& impulse, const Vec3<Real>& arm);
/// Applies an angular impulse, N m s, world frame; the angular velocity changes at once. Errors: as apply_force.
Status apply_angular_impulse(World& world, BodyId id, const Vec3<Scaled>& impulse);
/// Sets the gravity, m/s^2, each component within +-1024, and wakes all bodies. Errors: out_of_range.
Status set_gravity(World& world, const Vec3<Real>& gravity);
/// Wakes the body and all bodies that it fell asleep with. Calls that move a body, or apply a force or impulse to it,
/// wake it too. Errors: bad_id, bad_argument (not dynamic).
Status wake_body(World& world, BodyId id);
/// Stops the body and puts it to sleep: steps skip it until something wakes it. Forces and torques that have not acted
/// yet are lost. Errors: bad_id, bad_argument (not dynamic), feature_missing.
Status sleep_body(World& world, BodyId id);
/// Sets BodyDef::user_data of a body. If a filter rule then forbids a contact of the body, both bodies of this contact
/// wake; no other body wakes. Errors: bad_id.
Status set_user_data(World& world, BodyId id, uint32_t user_data);
/// Sets the filter of a body, and wakes the body. Contacts that the filter now forbids end in the next step; the other
/// bodies of these contacts wake. Errors: bad_id, rule_missing.
Status set_filter(World& world, BodyId id, const Filter& filter);
/// Binds the asset `index` of WorldHooks::assets: the state stores the digest of its content. Cooked shapes are checked
/// in full.
/// Errors: asset_missing, out_of_range, asset_mismatch (bodies use the asset that was bound at this index),
/// feature_missing (the world has neither hulls, terrains nor compounds).
Status bind_asset(World& world, uint32_t index);

/// Advances the world by one tick. A step never fails: the report counts overflows, clamped values and undecided tests.
StepReport step(World& world);

/// Whether the id names a body of this world.
bool is_valid(const World& world, BodyId id);
/// Gets the pose of a body, m, world. Errors: bad_id.
Status get_pose(const World& world, BodyId id, Pose& pose);
/// Gets the velocity of the centre of mass, m/s, and the angular velocity, rad/s, both in world axes. Overflow:
/// components of the angular velocity are clamped to the range of Real; only those of a body with a bounding radius
/// below 12.5 cm can exceed it. Errors: bad_id.
Status get_velocity(const World& world, BodyId id, Vec3<Real>& velocity, Vec3<Real>& angular_velocity);
/// Gets the mass, kg; 0 for fixed and kinematic bodies. body.h has the getters of the other properties.
/// Errors: bad_id.
Status get_mass(const World& world, BodyId id, Scaled& mass);
/// Gets BodyDef::user_data, or the value that set_user_data() last set. Errors: bad_id.
Status get_user_data(const World& world, BodyId id, uint32_t& user_data);
/// Gets the filter of a body. Errors: bad_id.
Status get_filter(const World& world, BodyId id, Filter& filter);
/// Sets `awake` to whether a body takes part in the next step. Fixed bodies, and kinematic bodies at rest, are never
/// awake.
/// Errors: bad_id.
Status is_awake(const World& world, BodyId id, bool& awake);
/// The world's capacity and counts, as they are now.
WorldInfo get_info(const World& world);
/// Iterates over bodies in slot order: returns the first valid id after `previous` (null to begin), or null at the end.
BodyId next_body(const World& world, BodyId previous);

/// A 64-bit hash of the persistent state, the same on every target and for every capacity (SPEC.md, "Digest").
uint64_t digest(const World& world);

/// Bytes of a snapshot of a world of this capacity; 0 if the capacity is out of range.
constexpr uint32_t snapshot_bytes(Capacity capacity);
/// Copies the persistent state into `bytes`. Errors: buffer_too_small.
Status save(const World& world, uint8_t* bytes, uint32_t byte_count);
/// Restores a snapshot that this program saved from a world of the same capacity. The function checks only the header
/// of the snapshot, and copies the bytes.
/// Errors: truncated, not_detent, format_unknown, simulation_differs, config_differs, capacity_differs, feature_missing
/// (the saved world had a feature that this world lacks).
Status restore(World& world, const uint8_t* bytes, uint32_t byte_count);
/// Restores a snapshot from an untrusted source: every byte is checked before the world is changed. `bytes` must be
/// 8-byte aligned; it is used as work space, and its content is unspecified afterwards.
/// Errors: as restore, and buffer_misaligned, corrupt, asset_missing, asset_mismatch, rule_missing.
Status load(World& world, uint8_t* bytes, uint32_t byte_count);

/// The definition that creates an empty world with this world's settings and capacity.
WorldDef get_settings(const World& world);
/// Changes all settings and wakes every body; `def.capacity` is ignored. A force that was applied since the last step
/// still changes the velocity by as much as it does in a tick of the old length. Example:
///
///     WorldDef def = get_settings(world);
///     def.substeps = 8;
///     Status status = set_settings(world, def);
///
/// Errors: those of create_world() for a wrong setting: out_of_range, bad_argument, feature_missing.
Status set_settings(World& world, const WorldDef& def);

/// The largest number of entries that any recorded step needed in each pool of a world. All 0 before the first step.
struct CapacityUse {
  uint32_t bodies = 0;    ///< bodies in the world
  uint32_t contacts = 0;  ///< contacts kept (those of sleeping bodies included) and contacts dropped
  /// Pairs with overlapping bounds, kept and dropped together; the pool holds 2 x Capacity::contacts.
  uint32_t pairs = 0;
  /// Pairs of continuous collision, kept and dropped together. Only steps that dropped such pairs count; 0 if no step
  /// did. The pool holds Capacity::contacts.
  uint32_t impacts = 0;
  uint32_t joints = 0;      ///< joints in the world
  uint32_t sensed = 0;      ///< bodies within sensors, kept and dropped together
  uint64_t steps_full = 0;  ///< steps in which a pool had no room
};

/// Adds a step to the record `use`. `report`: the report of the step. `after`: get_info() after the step.
constexpr void note_use(const StepReport& report, const WorldInfo& after, CapacityUse& use) {
  const auto note = [](uint32_t& most, uint32_t kept, uint32_t dropped) {
    const uint32_t wanted = kept < UINT32_MAX - dropped ? kept + dropped : UINT32_MAX;
    most = most < wanted ? wanted : most;
  };
  note(use.bodies, after.bodies, 0);
  const uint32_t contacts_dropped = report.lost.contacts - report.lost.contact_parts;
  note(use.contacts, after.contacts, contacts_dropped);
  note(use.pairs, report.contacts.pairs, 0);
  if (report.lost.impacts != 0) note(use.impacts, after.capacity.contacts, report.lost.impacts);
  note(use.joints, after.joints, 0);
  note(use.sensed, after.sensed, report.lost.sensed);
  if (report.lost.pairs != 0 || contacts_dropped != 0 || report.lost.impacts != 0 || report.lost.sensed != 0)
    ++use.steps_full;
}

/// Returns a capacity with room for the recorded use plus a quarter of it, rounded up, and for at least one body.
/// `assets` and `manifolds` are not recorded, but copied from `now`. If entries were dropped, bodies move differently
/// in a run with the larger capacity, and that run may need still more capacity: record it too.
constexpr Capacity suggest_capacity(const CapacityUse& use, const Capacity& now) {
  const auto with_spare = [](uint32_t count) {
    const uint32_t spare = count / 4 + (count % 4 != 0 ? 1 : 0);
    return count < UINT32_MAX - spare ? count + spare : UINT32_MAX;
  };
  const uint32_t of_pairs = use.pairs / 2 + use.pairs % 2;
  uint32_t contacts = use.contacts < of_pairs ? of_pairs : use.contacts;
  contacts = contacts < use.impacts ? use.impacts : contacts;
  Capacity fit = now;
  fit.bodies = use.bodies == 0 ? 1 : with_spare(use.bodies);
  fit.contacts = with_spare(contacts);
  fit.joints = with_spare(use.joints);
  fit.sensed = with_spare(use.sensed);
  return fit;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent

#include <detent/detail/layout.h>

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Memory for a world whose capacity is known at compile time.
template <Capacity capacity>
struct WorldStorage {
  static constexpr uint32_t k_bytes = world_bytes(capacity);  ///< size of the block
  static_assert(k_bytes != 0, "detent: capacity out of range");
  alignas(8) uint8_t block[k_bytes];  ///< the world's memory; nothing else may write to it

  /// Calls create_world() with this block and this capacity; `def.capacity` is ignored.
  Status create(WorldDef def, const WorldHooks& hooks, const FeatureTable& features, World& world) {
    def.capacity = capacity;
    return create_world(block, k_bytes, def, hooks, features, world);
  }
  /// As create() above, with all features.
  Status create(const WorldDef& def, const WorldHooks& hooks, World& world) {
    return create(def, hooks, feature_table<Features::all>, world);
  }
  /// As create() above, without hooks.
  Status create(const WorldDef& def, World& world) { return create(def, {}, world); }
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
