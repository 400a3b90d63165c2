#pragma once
#include <detent/body.h>

/// The structs of the persistent state, which is the content of a snapshot. The digest covers this state without its
/// header. No struct has padding (asserted by lib/state/fields.h), a pointer or a size_t. The layout is the same on
/// every target.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The header of a block. Its values are checked when a snapshot is restored. The digest does not cover it.
struct alignas(8) BlockHeader {
  uint32_t magic;
  uint32_t format;
  uint32_t simulation;
  Config config;
  uint32_t capacity_bodies;
  uint32_t capacity_contacts;
  uint32_t capacity_assets;
  uint32_t left_out;   ///< features of Features::all that the world's feature table lacks
  uint32_t manifolds;  ///< 1 if the block has room for manifolds
  uint32_t capacity_joints;
  uint32_t capacity_sensed;
  uint32_t zero;
};

struct alignas(8) WorldState {
  uint64_t tick;           ///< number of ticks completed
  uint32_t body_count;     ///< bodies alive
  uint32_t slots_used;     ///< number of body slots that have ever been used; all later slots are zero
  uint32_t free_word;      ///< the words of the array `slots` before this index have no free slot
  uint32_t slots_retired;  ///< number of body slots that are no longer used, because their generations are used up
  uint32_t contact_count;  ///< contacts, sorted by (body_a, body_b, part)
  uint32_t joint_count;    ///< joints alive
  uint32_t joints_used;    ///< number of joint slots that have ever been used; all later slots are zero
  uint32_t sensor_count;   ///< bodies that are sensors
  uint32_t sensed_count;   ///< pairs of a sensor and a body within it, sorted by (sensor, body)
  uint32_t substeps;       ///< 0: chosen for each island
  uint32_t substeps_max;
  uint32_t iterations;
  uint32_t sleeping;       ///< 1 if islands at rest fall asleep
  uint32_t continuous;     ///< 1 if continuous collision is on
  uint32_t idle;           ///< 1 if no body moves or was changed: the next step only counts the tick
  uint32_t reduction;      ///< ManifoldReduction
  uint32_t stabilisation;  ///< Stabilisation
  uint32_t convergence;    ///< WorldDef::convergence
  Vec3<Real> gravity;      ///< m/s^2
  Real tick_time;          ///< s
  Real relaxation;
  Real contact_frequency;
  Real damping_ratio;
  Real restitution_threshold;
  Real contact_margin;            ///< WorldDef::contact_margin
  Real contact_recycle_distance;  ///< WorldDef::contact_recycle_distance; 0 without manifolds
  Real resting_penetration;       ///< WorldDef::resting_penetration
#if defined(DETENT_F32)
  uint32_t zero;
#endif
};

struct BodyPose {
  Position position;  ///< position of the centre of mass, m, world
#if defined(DETENT_FX32)
  uint16_t remainder[3];  ///< in units of 2^-32 m: the exact coordinate is position + remainder
  uint16_t zero;
#endif
  Quat rotation;  ///< local to world
};

struct BodyMotion {
  Vec3<Real> linear_velocity;  ///< m/s
  /// Of a dynamic body: angular momentum / (mass x 2^size_exponent), m/s. Of a kinematic body: angular velocity x
  /// 2^size_exponent, m/s.
  Vec3<Real> angular_momentum;
  /// The changes of linear_velocity and angular_momentum during the next step by the forces and torques that were
  /// applied since the last step, m/s.
  Vec3<Real> pending_velocity;
  Vec3<Real> pending_angular_momentum;
};

struct BodyProperties {
  uint32_t type;        ///< BodyType; 0: the slot is empty, and all members but the generation are zero
  uint32_t generation;  ///< generation of the body in the slot, or of the last body that was in it
  uint32_t shape;       ///< ShapeType
  /// The body's unit of length is 2^size_exponent m: the bounding radius lies in [1/2, 1) of this unit.
  int32_t size_exponent;
  uint32_t category;  ///< Filter::category
  uint32_t mask;      ///< Filter::mask
  int32_t group;      ///< Filter::group
  uint32_t rule;      ///< Filter::rule
  /// In the body's unit. Box: half extents. Sphere, capsule, cylinder, cone: (radius, half length, 0). Hull, terrain,
  /// compound: the greatest |x|, |y|, |z|.
  Vec3<Unit> size;
  Unit bounding_radius;  ///< in the body's unit, `rounding` included
  /// In the body's unit. Box, cylinder, cone, hull: radius of the ball that rounds it. Compound: least half thickness
  /// of a child. Other shapes: 0.
  Unit rounding;
  Scaled mass;  ///< kg; of a non-dynamic body: the mass that it gets when it becomes dynamic, or 0
  /// mass x (2^size_exponent)^2 / inertia about each body axis; 0 about a locked axis, and if the body is not dynamic.
  Scaled inverse_inertia[3];
  Scaled friction;
  Scaled restitution;
  Scaled rolling_resistance;
  Scaled linear_damping;   ///< 1/s
  Scaled angular_damping;  ///< 1/s
  Scaled gravity_scale;
  uint32_t user_data;
  uint32_t restitution_rule;  ///< RestitutionRule
  uint32_t asset;             ///< of a hull, terrain or compound: its index in the world's asset table; else 0
  uint16_t rotation_locks;    ///< k_rotation_lock_x, ...: the inverse inertia about these axes is 0
  uint16_t sensor;            ///< 1 if the body is a sensor
};

/// Substeps and sleep of a body. All zero for a body that is not dynamic.
struct BodyActivity {
  /// Number of substeps of the body's island in the last tick. 0 before the first tick, and if the island had neither
  /// contacts nor joints.
  uint32_t substeps;
  uint32_t calm_ticks;   ///< ticks in a row in which fewer substeps would have been enough
  uint16_t still_ticks;  ///< ticks in a row at rest
  uint16_t
      pending_event;  ///< the BodyEventType that the step will report at its end; 0: none. Between steps: woke or 0
  uint32_t asleep;    ///< slot + 1 of the first body of those that fell asleep together; 0: awake
};

constexpr uint32_t k_manifold_points_max = 4;

/// A contact of two bodies, or of two parts of them, with the impulses that warm-start the next tick.
struct ContactState {
  uint32_t body_a;  ///< slot index; body_a < body_b
  uint32_t body_b;
  uint32_t part;     ///< key of the parts that touch; 0 if both bodies are convex. Distinct among a pair's contacts
  uint16_t age;      ///< ticks for which the contact existed before this tick, at most 65535
  uint8_t touching;  ///< 1 if the bodies pushed each other in the last tick
  uint8_t point_count;
  uint32_t feature[k_manifold_points_max];  ///< keys of the features that touch; distinct; 0 beyond point_count
  /// Impulse / mass of the lighter dynamic body, m/s; 0 beyond point_count.
  Real normal_impulse[k_manifold_points_max];
  Vec3<Real> friction_impulse;  ///< impulse on B / mass of the lighter dynamic body, m/s, world
  /// Angular impulse on B / (mass of the lighter dynamic body x the pair's unit of length), m/s, world.
  Vec3<Real> angular_impulse;
  /// Normal force / mass of the lighter dynamic body, m/s^2; the number of substeps is chosen from it.
  Real load;
};

/// The relative pose and the points of a contact when its points were computed. The points are recycled while the pair
/// hardly moves. All zero for a contact whose points are recomputed in each tick. The *base* is the body with the
/// larger bounding radius, or A if the radii are equal. Where no unit is given, lengths are relative to 4 times the
/// base's unit of length.
struct ManifoldState {
  Vec3<Unit> normal;  ///< from the base to the other body, in the base's axes
  Vec3<Unit> offset;  ///< from the base's centre to the other body's, in the base's axes
  Quat rotation;      ///< rotation of the other body, relative to the base's axes
  /// Of each point: its separation minus its coordinate along the normal, relative to the base's centre.
  Unit height[k_manifold_points_max];
  /// The points, from the centre of the other body, in that body's axes, in 2^-15 of that body's unit of length.
  int16_t anchor[k_manifold_points_max][3];
};

/// A body that was within a sensor at the end of the last step.
struct alignas(8) SensedState {
  uint32_t sensor;  ///< slot index of the sensor
  uint32_t body;    ///< slot index of the body
};

inline constexpr uint32_t k_joint_rows_max = 6;

/// A joint: the values of its definition (joint.h), and its last impulses. In arrays of two, index 0 is JointDef::axis,
/// and index 1 is JointDef::second.
struct alignas(8) JointState {
  uint32_t type;        ///< JointType; 0: the slot is empty, and all members but the generation are zero
  uint32_t generation;  ///< generation of the joint in the slot, or of the last joint that was in it
  uint32_t body_a;      ///< slot index
  uint32_t body_b;
  uint32_t collide;  ///< 1 if the two bodies collide with each other
  uint32_t user_data;
  Vec3<Real> anchor_a;  ///< from A's centre of mass, m, in A's axes; anchor_b likewise for B
  Vec3<Real> anchor_b;
  Quat frame_a;
  Quat frame_b;
  Real lower[2];  ///< limits of the two motions, rad or m
  Real upper[2];
  Real frequency[2];
  Real damping_ratio[2];
  Real target[2];
  Real speed[2];
  Scaled force_max[2];
  uint32_t limited[2];
  Scaled friction[2];  ///< JointDef::friction_force, N; JointDef::friction_torque, N m
  Scaled break_force;
  Scaled break_torque;
  Vec3<Scaled> force;   ///< mean force of the joint on B in the last tick, N, world
  Vec3<Scaled> torque;  ///< mean torque of the joint on B in the last tick, N m, world
  /// Impulses of the joint's rows in the last substep, times (number of substeps) / 2^k_kept_power (lib/joint/joint.h),
  /// m/s. They do not include the impulses by which the joint follows its curved path. The next tick begins with the
  /// stored impulses.
  Real impulse[k_joint_rows_max];
};

/// The kind of a bound asset. Stored in snapshots: a value is never reused.
enum class AssetKind : uint32_t {
  none = 0,      ///< not bound
  other = 1,     ///< bytes that the library does not read
  hull = 2,      ///< a cooked hull, of which bind_asset() has checked every byte
  terrain = 3,   ///< a cooked mesh or height field, of which bind_asset() has checked every byte
  compound = 4,  ///< a cooked compound, of which bind_asset() has checked every byte
};

struct AssetState {
  uint64_t digest;
  uint32_t byte_count;
  uint32_t kind;  ///< AssetKind
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
