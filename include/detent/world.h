#pragma once
#include <detent/asset.h>
#include <detent/body.h>
#include <detent/event.h>
#include <detent/features.h>
#include <detent/joint.h>
#include <detent/observer.h>
#include <detent/profile.h>
#include <detent/reduction.h>
#include <detent/status.h>

/// @file
/// The world: a static pool of bodies and contacts in one block of the caller's memory.
///
/// Threads: a world is a value. Calls on different worlds may run beside each other; functions that take `const World&`
/// may run beside each other on one world; nothing may run beside a call that takes `World&` on the same world.
/// There is no global state. In f32 and f64 every call that computes sets the rounding mode and flush-to-zero flags it
/// needs and restores the caller's.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// How much of each kind a world can hold. Fixed for the life of the world; at most 2^20 each.
struct Capacity {
  uint32_t bodies = 0;    ///< at least 1
  uint32_t contacts = 0;  ///< pairs of bodies in contact
  uint32_t assets = 0;    ///< assets that can be bound
  bool manifolds =
      true;  ///< room to use contact points again (WorldDef::reuse), which takes 160 bytes a contact (f64 272)
  uint32_t joints = 0;  ///< joints
  uint32_t sensed = 0;  ///< bodies within sensors: pairs of both; 0: no sensors
  /// Equal in every kind.
  friend constexpr bool operator==(Capacity a, Capacity b) {
    return a.bodies == b.bodies && a.contacts == b.contacts && a.assets == b.assets && a.manifolds == b.manifolds &&
           a.joints == b.joints && a.sensed == b.sensed;
  }
};

/// How overlap is undone. Stored: a value is never reused.
enum class Stabilisation : uint32_t {
  soft = 1,  ///< contacts are damped springs, whose speed a relaxation takes out again: what stands tall needs it
  /// Contacts are rigid, and when the substeps are done the bodies are moved apart by what they still overlap, half of
  /// it in a tick, without a change of speed. Source: Cline, Pai, "Post-stabilization for rigid body simulation with
  /// contact and constraints", ICRA 2003.
  post = 2,
};

/// What `create_world` makes. Every field but the capacity has a working default.
struct WorldDef {
  /// Room for bodies, contacts, assets.
  Capacity capacity = {};
  Vec3<Real> gravity = {Real(0.0), Real(-9.81), Real(0.0)};  ///< m/s^2; each component within +-1024
  Real tick = Real(1.0 / 60.0);                              ///< s, the time of one step, [2^-14, 1/4]
  uint32_t substeps = 0;       ///< solver substeps a tick, [1, 64]; 0: chosen for each island by what it carries
  uint32_t substeps_max = 32;  ///< of those chosen, [1, 64]
  uint32_t iterations = 1;     ///< sweeps over the contacts a substep, [1, 64]
  /// The sweeps of a substep end early when the last one changed no velocity by more than 2^-convergence of what
  /// gravity adds in the substep; [0, 30].
  uint32_t convergence = 12;
  /// How overlap is undone.
  Stabilisation stabilisation = Stabilisation::soft;
  Real relaxation = 1.0;        ///< over-relaxation factor of the SOR solver, [1/4, 7/4]
  Real stiffness = Real(0.14);  ///< contact frequency as a fraction of the substep rate, [1/64, 1/4]
  /// Of the soft contacts, [0, 64]: 0.7 of it acts between bodies that move, half with what does not.
  Real damping_ratio = 10.0;
  Real restitution_threshold =
      0.25;                ///< approach speed below which nothing rebounds, in sqrt(g x smaller extent), [0, 64]
  bool continuous = true;  ///< bodies meet at the time of impact, however fast: nothing passes through anything
  bool sleeping = true;    ///< islands that have come to rest are left out of the step until something wakes them
  /// How far apart a pair at rest has contact points, over its smaller extent, [2^-10, 2^-4]; what the pair can close
  /// in a tick is added to it.
  Real breaking = Real(1.0 / 64);
  /// A pair's contact points are used again, and not found anew, until it has moved by this part of its smaller extent;
  /// [0, 1/64]; taken as 0 where the capacity has no room for manifolds.
  Real reuse = Real(1.0 / 256);
  ManifoldReduction reduction = ManifoldReduction::projected_extremes;  ///< which of more than four points are kept
};

/// Bytes of block that a world of this capacity needs; 0 if the capacity is out of range. The same on every target.
constexpr uint32_t world_bytes(Capacity capacity);

/// A world in the caller's block. A value of a few words: copy it freely; it owns nothing.
struct World {
  uint8_t* block = nullptr;                ///< what create_world() was given
  AssetTable assets = {};                  ///< what create_world() was given
  ContactEventBuffer contact_events = {};  ///< filled by each step, from its front; none by default
  JointEventBuffer joint_events = {};      ///< likewise
  const FeatureTable* features = nullptr;  ///< what create_world() was given
  /// Contacts that the solver takes at once: as many as this machine can, which create_world() finds out, or 1. The
  /// bits are the same.
  uint32_t lanes = 1;
  FilterRuleTable filter_rules = {};     ///< what Filter::rule means; none by default. Set it before any body names one
  Profile* profile = nullptr;            ///< times of the stages of each step (profile.h)
  SensorEventBuffer sensor_events = {};  ///< as contact_events
  BodyEventBuffer body_events = {};      ///< likewise
  CapacityEventBuffer capacity_events = {};  ///< likewise
  const StepObserver* observer = nullptr;    ///< is told of the stages of each step (observer.h)
};

/// What one step did. Every count is of this step alone.
struct StepReport {
  uint64_t tick = 0;              ///< ticks completed since the world was created
  uint32_t bodies = 0;            ///< bodies in the world
  uint32_t awake = 0;             ///< dynamic bodies that took part in the step
  uint32_t islands = 0;           ///< groups of awake bodies in contact, single bodies included
  uint32_t substeps_max = 0;      ///< of any island
  uint32_t fell_asleep = 0;       ///< bodies, at the end of the step
  uint32_t woke = 0;              ///< bodies that were touched
  uint32_t sweeps_saved = 0;      ///< over the contacts of an island, as WorldDef::convergence lets it
  uint32_t pairs = 0;             ///< pairs of overlapping bounds of which a body moves
  uint64_t contact_substeps = 0;  ///< contacts times their islands' substeps: the work of the solver
  uint32_t contacts = 0;          ///< pairs with at least one contact point
  /// Of all contacts, at most four each.
  uint32_t contact_points = 0;
  uint32_t contacts_reused = 0;  ///< whose points were not found anew, for the pair has hardly moved
  uint32_t contacts_capped = 0;  ///< found by a search that met its cap (the normal may not be the least way out), or
                                 ///< not found for want of a hull's bytes
  uint32_t contact_events = 0;   ///< in the world's buffer
  uint32_t contact_events_dropped = 0;  ///< beyond it, or hits beyond Capacity::contacts; not where there is no buffer
  uint32_t pairs_dropped = 0;     ///< pairs beyond the pair buffer (the shallowest): their contacts are lost this tick,
                                  ///< but continuous collision tries them all
  uint32_t contacts_dropped = 0;  ///< beyond the capacity or their pair's eight (the shallowest), lost this tick
  uint32_t contact_parts_dropped = 0;    ///< of those: beyond their pair's eight, for which no capacity has room
  uint32_t saturations = 0;              ///< state components clamped to their range
  uint32_t joints = 0;                   ///< of which a body is awake
  uint32_t joints_broken = 0;            ///< and gone
  uint32_t joint_events = 0;             ///< in the world's buffer
  uint32_t joint_events_dropped = 0;     ///< beyond the capacity of the world's buffer
  uint32_t joint_couplings_dropped = 0;  ///< of joints that form too many loops for their solver's room: these give way
  uint32_t joint_decisions_left = 0;     ///< limits and motors still undecided after the last try of a substep
  uint32_t impacts = 0;                  ///< times at which bodies met within the tick and were made to part
  uint32_t impacts_undecided = 0;        ///< times of impact found in part, or that could not be asked for
  uint32_t impacts_dropped = 0;          ///< for want of room, that of contacts: their bodies stayed behind
  uint32_t overlaps_left = 0;            ///< pairs too deep within each other for continuous collision
  /// Bodies that stayed behind in this tick: they had too many impacts (docs/continuous_collision.md), or no room for
  /// one.
  uint32_t bodies_stopped = 0;
  Real lost_time = 0.0;           ///< sum of the parts of the tick that those missed
  uint32_t toi_tests = 0;         ///< times of impact asked for
  uint32_t toi_skipped = 0;       ///< pairs too slow to meet
  uint32_t colour_overflows = 0;  ///< contacts of bodies that touch more than 64 others, solved after the rest
  /// Of sensors (sensor.h), and the other events in the world's buffers.
  uint32_t sensor_events = 0;
  uint32_t sensor_events_dropped = 0;  ///< beyond its capacity; not counted where there is no buffer
  uint32_t sensed_dropped = 0;    ///< bodies in or through a sensor beyond Capacity::sensed, which it does not know of
  uint32_t sensed_undecided = 0;  ///< bodies that count as in or through a sensor, for it could not be decided
  uint32_t body_events = 0;       ///< who fell asleep or woke
  uint32_t body_events_dropped = 0;  ///< likewise
  uint32_t capacity_events = 0;      ///< whom there was no room for
  /// True if nothing was lost: no pool overflowed, no search was capped and no value was clamped.
  constexpr bool complete() const {
    return pairs_dropped == 0 && contacts_dropped == 0 && contacts_capped == 0 && saturations == 0 &&
           bodies_stopped == 0 && sensed_dropped == 0;
  }
};

/// A world's constant and slowly changing facts.
struct WorldInfo {
  Capacity capacity = {};      ///< what the world was created with
  uint64_t tick = 0;           ///< ticks completed since the world was created
  uint32_t bodies = 0;         ///< bodies in the world
  uint32_t contacts = 0;       ///< pairs in contact after the last step, those asleep included
  uint32_t joints = 0;         ///< joints in the world
  uint32_t sensed = 0;         ///< bodies within sensors after the last step: pairs of both
  uint32_t slots_retired = 0;  ///< body slots whose generation is used up
};

/// Makes an empty world in `block` (8-byte aligned, at least world_bytes(def.capacity) bytes).
/// `features`: what the world can do, and so what the program links (features.h); all by default.
/// Errors: buffer_too_small, buffer_misaligned, out_of_range, bad_argument (a reduction or stabilisation that is none),
/// feature_missing.
Status create_world(uint8_t* block, uint32_t block_bytes, const WorldDef& def, AssetTable assets, World& world,
                    const FeatureTable& features = feature_table<Features::all>);

/// Makes a body in the lowest free slot; it takes part in the next step.
/// Errors: pool_full (also a sensor where Capacity::sensed is 0), bad_argument, out_of_range, not_normalised;
/// asset_missing (a hull that is not bound); feature_missing; rule_missing.
Status create_body(World& world, const BodyDef& def, BodyId& id);
/// Takes a body away; its contacts end at once, and whom it touched wakes. Errors: bad_id.
Status destroy_body(World& world, BodyId id);
/// Puts a body elsewhere, m, world; nothing is met on the way, and its velocity is kept. Errors: bad_id, out_of_range,
/// not_normalised.
Status set_pose(World& world, BodyId id, const Position& position, const Quat& rotation);
/// Gives a body a velocity, m/s, and a spin, rad/s, world frame; ranges as in BodyDef. Errors: bad_id, bad_argument (a
/// fixed body), out_of_range.
Status set_velocity(World& world, BodyId id, const Vec3<Real>& velocity, const Vec3<Real>& spin);
/// Adds a force, N, world frame, that acts at the centre of mass during the next step.
/// Errors: bad_id, bad_argument (not dynamic), out_of_range (the speed it would give leaves its range).
Status apply_force(World& world, BodyId id, const Vec3<Scaled>& force);
/// Adds a torque, N m, world frame, that acts during the next step. Errors: as apply_force.
Status apply_torque(World& world, BodyId id, const Vec3<Scaled>& torque);
/// Changes the momentum at once, N s, world frame, through the centre of mass. Errors: as apply_force.
Status apply_impulse(World& world, BodyId id, const Vec3<Scaled>& impulse);
/// Changes the momentum at once through a point given relative to the centre of mass, m, world axes; each component
/// within twice the bounding radius. Errors: as apply_force.
Status apply_impulse_at(World& world, BodyId id, const Vec3<Scaled>& impulse, const Vec3<Real>& arm);
/// Changes the angular momentum at once, N m s, world frame. Errors: as apply_force.
Status apply_angular_impulse(World& world, BodyId id, const Vec3<Scaled>& impulse);
/// Gives the world another gravity, m/s^2, each component within +-1024, and wakes all bodies. Errors: out_of_range.
Status set_gravity(World& world, const Vec3<Real>& gravity);
/// Wakes the body and all that it fell asleep with. Calls that move or push a body do so by themselves.
/// Errors: bad_id, bad_argument (not dynamic).
Status wake_body(World& world, BodyId id);
/// Stops the body and leaves it out of the step until something wakes it.
/// Errors: bad_id, bad_argument (not dynamic), feature_missing.
Status put_to_sleep(World& world, BodyId id);
/// Gives a body another BodyDef::user_data; wakes nobody. Errors: bad_id.
Status set_user_data(World& world, BodyId id, uint32_t user_data);
/// Wakes the body. Contacts that are no longer allowed end in the next step, and the other bodies in them wake.
/// Errors: bad_id, rule_missing.
Status set_filter(World& world, BodyId id, const Filter& filter);
/// Binds the table's asset `index` to the state by its content digest; a cooked hull is checked in full.
/// Errors: asset_missing, out_of_range, asset_mismatch (bodies have the hull that it was), feature_missing (hulls).
Status bind_asset(World& world, uint32_t index);

/// Advances the world by one tick. Never fails: what could not be done is counted in the report.
StepReport step(World& world);

/// Whether the id names a body of this world.
bool is_valid(const World& world, BodyId id);
/// Where a body is. Errors: bad_id.
Status get_pose(const World& world, BodyId id, Pose& pose);
/// The velocity of the centre of mass, m/s, and the spin, rad/s, world frame. Overflow: a component of the spin beyond
/// Real, which only bodies below 12 cm can have, is held to its range. Errors: bad_id.
Status get_velocity(const World& world, BodyId id, Vec3<Real>& velocity, Vec3<Real>& spin);
/// The mass, kg; 0 for fixed and kinematic bodies. What else a definition sets: body_access.h, world_access.h.
/// Errors: bad_id.
Status get_mass(const World& world, BodyId id, Scaled& mass);
/// BodyDef::user_data, or what set_user_data() made of it. Errors: bad_id.
Status get_user_data(const World& world, BodyId id, uint32_t& user_data);
/// What the body collides with. Errors: bad_id.
Status get_filter(const World& world, BodyId id, Filter& filter);
/// Whether a body takes part in the next step. Fixed bodies, and kinematic ones that stand still, are never awake.
/// Errors: bad_id.
Status is_awake(const World& world, BodyId id, bool& awake);
/// The world's facts, as they are now.
WorldInfo get_info(const World& world);
/// Visits bodies in slot order: the first valid id after `previous` (null to begin), or null at the end.
BodyId next_body(const World& world, BodyId previous);

/// 64 bits over every persistent byte, the same on every target and for every capacity. SPEC.md, "Digest".
uint64_t digest(const World& world);

/// Bytes of a snapshot of a world of this capacity.
constexpr uint32_t snapshot_bytes(Capacity capacity);
/// Copies the persistent state into `bytes`. Errors: buffer_too_small.
Status save(const World& world, uint8_t* bytes, uint32_t byte_count);
/// Puts back a snapshot that this program saved from a world of the same capacity: one copy, checked only by its
/// header. Errors: truncated, not_detent, format_unknown, simulation_differs, config_differs, capacity_differs,
/// feature_missing (the world that saved it had one that this world has not).
Status restore(World& world, const uint8_t* bytes, uint32_t byte_count);
/// Puts back a snapshot from outside: every byte is checked before the world is touched. `bytes` is used as work space
/// (8-byte aligned) and its content is unspecified afterwards.
/// Errors: as restore, and buffer_misaligned, corrupt, asset_missing, asset_mismatch, rule_missing.
Status load(World& world, uint8_t* bytes, uint32_t byte_count);

}  // namespace DETENT_NAMESPACE
}  // namespace detent

#include <detent/storage.h>
