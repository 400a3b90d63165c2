#pragma once
#include <detent/body.h>

/// The persistent state: what a snapshot holds and the digest covers. Every struct is tiled by its fields without
/// padding (asserted by lib/state/fields.h), holds no pointer and no size_t, and has the same layout on every target.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// What a block is. Checked by value when a snapshot comes in; not part of the digest.
struct alignas(8) BlockHeader {
  uint32_t magic;
  uint32_t format;
  uint32_t simulation;
  Config config;
  uint32_t capacity_bodies;
  uint32_t capacity_contacts;
  uint32_t capacity_assets;
  uint32_t left_out;   ///< of Features::all, what the world's table lacks; 0: nothing
  uint32_t manifolds;  ///< 1 if the block has room for them
  uint32_t capacity_joints;
  uint32_t capacity_sensed;
  uint32_t zero;
};

struct alignas(8) WorldState {
  uint64_t tick;           ///< ticks completed
  uint32_t body_count;     ///< bodies alive
  uint32_t slots_used;     ///< body slots ever used: the slots beyond are all zero
  uint32_t free_word;      ///< no slot is free in the words of `slots` before this one
  uint32_t slots_retired;  ///< body slots whose generation is used up
  uint32_t contact_count;  ///< contacts, sorted by (body_a, body_b, part)
  uint32_t joint_count;    ///< joints alive
  uint32_t joints_used;    ///< joint slots ever used: the slots beyond are all zero
  uint32_t sensor_count;   ///< bodies that are sensors
  uint32_t sensed_count;   ///< bodies within sensors, sorted by (sensor, body)
  uint32_t substeps;       ///< 0: chosen for each island
  uint32_t substeps_max;
  uint32_t iterations;
  uint32_t sleeping;       ///< 1 if islands at rest fall asleep
  uint32_t continuous;     ///< 1 if bodies meet at the time of impact
  uint32_t idle;           ///< 1 if nothing is awake: a step has nothing to do
  uint32_t reduction;      ///< ManifoldReduction
  uint32_t stabilisation;  ///< Stabilisation
  uint32_t convergence;    ///< the sweeps of a substep end when the last one changed less than 2^-convergence
  Vec3<Real> gravity;      ///< m/s^2
  Real tick_time;          ///< s
  Real relaxation;
  Real stiffness;
  Real damping_ratio;
  Real restitution_threshold;
  Real breaking;  ///< of a contact, over the smaller extent
  Real reuse;     ///< motion, over the smaller extent, within which contact points are used again
};

struct BodyPose {
  Position position;  ///< of the centre of mass, m
#if defined(DETENT_FX32)
  uint16_t remainder[3];  ///< of the position, 2^-32 m: the true coordinate is position + remainder
  uint16_t zero;
#endif
  Quat rotation;  ///< local to world
};

struct BodyMotion {
  Vec3<Real> velocity;          ///< m/s
  Vec3<Real> momentum;          ///< angular momentum / (mass 2^size_exponent), m/s; kinematic: spin 2^size_exponent
  Vec3<Real> pending_velocity;  ///< what the forces applied since the last step add during the next, m/s
  Vec3<Real> pending_momentum;  ///< likewise for `momentum`
};

struct BodyTraits {
  uint32_t type;        ///< BodyType, or 0: the slot is empty, and all but the generation is zero
  uint32_t generation;  ///< of the body in the slot, or of the last one
  uint32_t shape;       ///< ShapeType
  int32_t
      size_exponent;  ///< 2^size_exponent m is the body's unit of length: the bounding radius lies in [1/2, 1) of it
  uint32_t category;  ///< these four: of the body's Filter
  uint32_t mask;
  int32_t group;
  uint32_t rule;
  Vec3<Unit> size;  ///< in that unit: half extents; (radius, half length, 0); or of a hull, surface or compound the
                    ///< greatest |x|, |y|, |z|
  Unit bounding_radius;  ///< in that unit, `rounding` included
  /// In that unit: radius of the ball that rounds a box, cylinder, cone or hull; of a compound the least half thickness
  /// of a child; else 0.
  Unit rounding;
  Scaled mass;         ///< kg; if not dynamic what it would have, or 0
  Scaled gyration[3];  ///< m (2^size_exponent)^2 / I about each body axis; 0 if locked or not dynamic
  Scaled friction;
  Scaled restitution;
  Scaled rolling_resistance;
  Scaled linear_damping;   ///< 1/s
  Scaled angular_damping;  ///< 1/s
  Scaled gravity_scale;
  uint32_t user_data;
  uint32_t restitution_rule;  ///< RestitutionRule
  uint32_t asset;             ///< of a hull, surface or compound: its index in the world's table; else 0
  uint16_t turn_locks;        ///< k_turn_lock_x, ...: body axes about which it does not turn, whose gyration is 0
  uint16_t sensor;            ///< 1 if it is one
};

/// What a body's island does with its time. All zero for what is not dynamic.
struct BodyActivity {
  uint32_t substeps;     ///< of the last tick; 0 before the first one and without contacts
  uint32_t calm_ticks;   ///< ticks in which fewer substeps would have done
  uint16_t still_ticks;  ///< ticks at rest
  uint16_t news;         ///< BodyEventType that the end of the step tells, or 0; between steps no other than woke
  uint32_t asleep;       ///< slot + 1 of the first body it fell asleep with; 0: awake
};

constexpr uint32_t k_manifold_points_max = 4;

/// A contact of two bodies, or of a part of one, and what the next tick starts from.
struct ContactState {
  uint32_t body_a;  ///< slot index; body_a < body_b
  uint32_t body_b;
  uint32_t part;     ///< which parts of them touch; 0 where both are convex. Distinct among a pair's contacts
  uint16_t age;      ///< ticks in contact before this one, at most 65535
  uint8_t touching;  ///< 1 if they pushed each other in the last tick
  uint8_t point_count;
  uint32_t feature[k_manifold_points_max];  ///< which features touch; distinct; 0 beyond point_count
  Real
      normal_impulse[k_manifold_points_max];  ///< impulse / mass of the lighter dynamic body, m/s; 0 beyond point_count
  Vec3<Real> friction_impulse;                ///< likewise, on B, world
  Vec3<Real> angular_impulse;                 ///< likewise, per unit length of the pair, on B, world
  Real load;  ///< normal force / mass of the lighter dynamic body that the island's substeps are chosen by, m/s^2
};

/// What the points of a contact were found from, so that they can be used again while the pair hardly moves. All zero
/// for a contact that is found anew in each tick. The *base* is the larger body by its bounding radius, of equals A;
/// its unit of length, times 4, is that of the lengths here.
struct ManifoldState {
  Vec3<Unit> normal;                         ///< from the base to the other body, in the base's axes
  Vec3<Unit> offset;                         ///< of the other's centre from the base's, in the base's axes
  Quat rotation;                             ///< of the other body in the base's axes
  Unit height[k_manifold_points_max];        ///< what makes a point's place along the normal its separation
  int16_t anchor[k_manifold_points_max][3];  ///< the points, from the other's centre, in its axes; 2^-15 of its unit
};

/// A body within a sensor.
struct alignas(8) SensedState {
  uint32_t sensor;  ///< slot index
  uint32_t body;
};

inline constexpr uint32_t k_joint_rows_max = 6;

/// A joint, by what its definition says (joint.h). Of the two free motions the first is JointDef::axis.
struct alignas(8) JointState {
  uint32_t type;        ///< JointType, or 0: the slot is empty, and all but the generation is zero
  uint32_t generation;  ///< of the joint in the slot, or of the last one
  uint32_t body_a;      ///< slot index
  uint32_t body_b;
  uint32_t collide;  ///< 1 if the two collide with each other
  uint32_t user_data;
  Vec3<Real> anchor_a;  ///< m, in the body's axes
  Vec3<Real> anchor_b;
  Quat frame_a;
  Quat frame_b;
  Real lower[2];  ///< rad or m
  Real upper[2];
  Real frequency[2];
  Real damping_ratio[2];
  Real target[2];
  Real speed[2];
  Scaled force_max[2];
  uint32_t limited[2];
  Scaled friction[2];  ///< N of what slides, N m of what turns
  Scaled break_force;
  Scaled break_torque;
  Vec3<Scaled> force;              ///< on B in the last tick, N, world
  Vec3<Scaled> torque;             ///< N m
  Real impulse[k_joint_rows_max];  ///< of its rows in the last substep, over the reference mass, m/s (joint.h)
};

/// What a bound asset's bytes are. Stored: a value is never reused.
enum class AssetKind : uint32_t {
  none = 0,      ///< not bound
  other = 1,     ///< nothing that the library reads
  hull = 2,      ///< a cooked hull, checked in full
  surface = 3,   ///< a cooked mesh or height field, checked in full
  compound = 4,  ///< a cooked compound, checked in full
};

struct AssetState {
  uint64_t digest;
  uint32_t byte_count;
  uint32_t kind;  ///< AssetKind
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
