#pragma once
#include <detent/detail/state.h>
#include <detent/numbers.h>

/// Work space of a step, in the block behind the persistent state. Only the step cache keeps its content from step to
/// step. Alignment is explicit where i686 would align a double to 4 bytes.
namespace detent {
inline namespace DETENT_NAMESPACE {

struct Bounds {
  Position lower, upper;
};

/// A node of the tree of resting bodies (lib/broad_phase/resting_tree.h).
struct TreeNode {
  Bounds bounds;  ///< of all leaves below
  uint32_t child[2];
  uint32_t parent;  ///< of a free node: the next free node
  uint32_t bit;     ///< the first key bit in which the leaves below differ; it is 1 in the second child
};

struct alignas(8) TreeRoot {
  uint32_t link;  ///< link to the root node or leaf; 0 if the tree is empty
  uint32_t free;  ///< index + 1 of the first node of the free list; 0: the list is empty
  uint32_t nodes_used;
  uint32_t zero;
};

/// The header of the step cache: data that is kept between ticks so that steps can skip resting bodies. The cached data
/// are the tree, the bounds and the (zero) sweeps of the bodies in the tree, the active set of the next step, and the
/// list of awake contacts. All of them can be recomputed from the state.
struct alignas(8) StepCache {
  uint32_t fresh;           ///< 0: the next step recomputes the cache
  uint32_t contacts_known;  ///< 1: every contact with an awake body is in the list of awake contacts
  uint32_t awake_contact_count;
  uint32_t zero;
  TreeRoot tree;
};

/// A body's bounds in the sort and sweep, in cells of a grid over all bodies; coordinates are rounded down. If two
/// bounds are disjoint on the grid, they are disjoint.
struct BoundsKey {
  uint32_t lower, upper;  ///< along the sort axis
  uint32_t slot;
  uint32_t is_dynamic;
  uint32_t across_lower, across_upper;  ///< along the other two axes, 15 bits each
};

/// A body's inverse inertia (per unit mass) in world axes: angular velocity = inverse inertia x angular momentum, in
/// the units of angular_velocity.h. A symmetric matrix; values are mantissas times 2^exponent.
struct alignas(sizeof(Unit)) WorldInverseInertia {
  Vec3<Unit> row[3];
  int32_t exponent;
};

/// The inverse inertias (per unit mass) of a body about its axes, split for its free rotation (rotate_freely() in
/// angular_velocity.h): two of the axes have similar values, and the *odd* axis differs most.
struct alignas(sizeof(Unit)) FreeRotation {
  Scaled common;    ///< inverse inertia about the axis after the odd axis
  Scaled odd_rate;  ///< inverse inertia about the odd axis minus `common`
  Scaled rest;      ///< inverse inertia about the third axis minus `common`
  int32_t odd;      ///< index of the odd axis
};

/// In BodyWork::colours: the body may be near another body with which it has no contact (ContactGeometry::near, seam).
inline constexpr uint64_t k_has_near = uint64_t{1} << 63;

/// A body during the substeps. Members from `axes` to `speed` are set at the start of the tick.
struct alignas(8) BodyWork {
  uint64_t colours;     ///< bit set of the colours of the body's contacts, and k_has_near
  uint32_t island;      ///< while islands are found: a link towards the island's first body; then the island's index
  uint32_t run;         ///< as `island`, for the body's run: a chain of bodies with at most two contacts each
  uint32_t run_length;  ///< of the run's first body: number of bodies in the run
  uint32_t contacts;    ///< number of the body's contacts
  uint32_t supports;    ///< number of contacts that support it, while loads are estimated; then 1 if the warm start of
                        ///< its island is limited (lib/solver/warm_start.h), else 0
  uint32_t joint_body;  ///< its index among the bodies that have joints, else UINT32_MAX
  /// Its own mass plus that of the bodies on it, kg, while loads are estimated. Then the share of the warm start that
  /// its island keeps in this substep.
  alignas(sizeof(Real)) Scaled carried;
  Real height;    ///< height above the island's first body, against gravity, m, while loads are estimated
  Quat rotation;  ///< current
  Matrix3 axes;
  WorldInverseInertia inverse_inertia;
  FreeRotation free_rotation;
  Real extent;              ///< shape_extent(), m
  Real fall;                ///< fall_speed() of `extent`, m/s
  Real speed;               ///< upper bound of the speed of any point of the body, m/s
  Vec3<Real> displacement;  ///< since the start of the tick, m
  /// Sum of angular velocity x substep x 2^size_exponent since the start of the tick, m.
  Vec3<Real> rotation_vector;
  Vec3<Real> angular_velocity;          ///< times 2^size_exponent, in units of 2^k_angular_velocity_power m/s
  Vec3<Real> push;          ///< velocity that gravity and forces add in a substep, m/s
  Vec3<Real> twist;         ///< angular momentum that torques add in a substep, m/s
  /// The velocity and the angular momentum that contacts added in this substep, m/s. In float these members are the
  /// sums of these changes. In fixed point differences are exact, so they are minus the motion at the start of the
  /// substep: their sum with the current motion is the change (contact_motion.h).
  Vec3<Real> contact_velocity;
  Vec3<Real> contact_angular_momentum;
  Vec3<Real> velocity_before;  ///< velocity before the last solver iteration, if there are several, m/s
  Scaled linear_kept;          ///< fraction of the velocity that damping leaves in a substep
  Scaled angular_kept;         ///< fraction of the angular momentum that damping leaves in a substep
};

/// A contact during the step. Impulses and masses are relative to the reference mass: the mass of the lighter dynamic
/// body. The pair's unit of length is that of its smaller moving body. The vector solver processes several contacts at
/// once, and reads four words or four Reals of a contact at a time. The members for normal impulses come before those
/// for friction (lib/solver/lane_contact.h).
struct alignas(8) ContactWork {
  ContactState state;  ///< becomes the world's contact when the step ends

  Vec3<Unit> normal;  ///< from A to B
  Vec3<Unit> tangent[2];
  Vec3<Unit> moment_a, moment_b;  ///< r x n: middle_a x normal, middle_b x normal
  Unit unit_a, unit_b;          ///< the pair's unit of length, in the body's unit; 0 for a fixed body
  /// Element (i, k): the normal speed at point i per unit normal impulse at point k. Mantissas, times
  /// 2^coupling_exponent.
  Unit coupling[k_manifold_points_max][k_manifold_points_max];
  int32_t coupling_exponent;
  // Coordinates of the points along the two tangents, relative to the points' middle, in the pair's unit of length; 0
  // beyond the number of points.
  alignas(sizeof(Unit)) Unit x[k_manifold_points_max];
  Unit y[k_manifold_points_max];
  Unit normal_mass[k_manifold_points_max];   ///< effective masses of the points, in (0, 1]
  uint32_t apart[k_manifold_points_max];     ///< 1 if the point does not touch in the substep
  uint32_t static_pair;                      ///< 1 if only one of the bodies is dynamic
  uint32_t angular_rows;                     ///< 0: none; 1: twist friction; 3: twist and rolling friction
  /// Relative inverse mass of A: reference mass / mass; 0 if A is not dynamic.
  alignas(sizeof(Unit)) Scaled inverse_mass_a;
  Scaled inverse_mass_b;                            ///< relative inverse mass of B

  Vec3<Unit> middle_a, middle_b;  ///< the points' middle, from the centre of mass of A and of B, in that body's unit
  /// Motion of the pair per unit wrench; response_index() gives the index. Mantissas, times 2^response_exponent.
  Unit response[21];
  int32_t response_exponent;
  alignas(sizeof(Unit)) Unit friction_mass;  ///< effective mass along the tangents, in (0, 1]
  Scaled friction;
  Scaled twist_arm;        ///< largest angular impulse about the normal / normal impulse
  Scaled rolling_arm;      ///< largest angular impulse about the tangents / normal impulse
  Scaled twist_mass;       ///< effective mass about the normal
  Scaled rolling_mass;     ///< effective mass about the tangents
  Scaled restitution;

  /// Separation at the start of the tick, m. For round shapes it includes the growth of the gap by sliding
  /// (parted_by_sliding() in lib/solver/contact_rows.cpp).
  alignas(sizeof(Real)) Real separation[k_manifold_points_max];
  Real impulse_max[k_manifold_points_max];  ///< largest normal impulse of this tick, m/s
  Real friction_impulse[2];                 ///< along the tangents, m/s
  Real angular_impulse[3];                  ///< about the normal and the tangents, m/s
  Real deep;                                ///< depth, m, from which on the spring is twice as stiff
  Real push_max;                            ///< largest separating speed of the position correction, m/s
  Real rebound_min;                         ///< approach speed below which the contact does not rebound, m/s
  /// Normal velocity at the time of touch, predicted from the motion at the start of the tick, m/s; negative if the gap
  /// closes.
  Real approach[k_manifold_points_max];
};

/// Whether builds for this machine may solve several contacts at once (lib/solver/lanes.h).
#if (defined(__x86_64__) && !defined(DETENT_F64)) || \
    ((defined(__aarch64__) || defined(__wasm_simd128__)) && defined(DETENT_F32))
inline constexpr bool k_may_have_lanes = true;
#else
inline constexpr bool k_may_have_lanes = false;
#endif
/// Whether builds for this machine may solve the rows of a joint side by side (lib/joint/joint_lanes.h).
#if defined(DETENT_F32)
inline constexpr bool k_may_have_joint_lanes = k_may_have_lanes;
#else
inline constexpr bool k_may_have_joint_lanes = false;
#endif
/// Work space for up to four contacts that are solved at once (LaneContact in lib/solver/lane_contact.h). Five to eight
/// contacts take two of these.
struct alignas(8) LaneSpace {
  uint8_t bytes[DETENT_FIXED ? 2472 : 2120];
};

/// The position of a contact in the solve order.
struct ContactOrder {
  /// Hash of the pair's ids. Of the first contact of a group, while the group is solved: the index of its LaneSpace.
  uint32_t key;
  uint32_t contact;
  uint16_t colour;
  uint16_t kind;  ///< kind of work, and group_size() (contact_order.h)
  uint32_t island;
};

/// An island: awake bodies that contacts or joints connect, directly or through other bodies, and these contacts and
/// joints. An *assembly* is the part of an island that joints alone connect (lib/joint/joint.h).
struct Island {
  uint32_t first_body, body_count;        ///< range in the list of bodies by island
  uint32_t first_contact, contact_count;  ///< range in the solve order
  uint32_t substeps;                      ///< number of substeps; before this is chosen, the minimum for the joints
  uint32_t first_joint, joint_count;      ///< range in the order of the joints, assembly by assembly
  uint32_t joint_couplings_dropped;       ///< couplings of its joints that had no room in the factor
  Scaled joint_need;                      ///< square of the number of substeps that its joints need
};

/// A body with joints, while joints are solved: the part that is set once a tick.
struct alignas(8) JointBodyStart {
  uint32_t slot;
  uint32_t mobile;                     ///< 1 if it is dynamic and awake
  uint32_t first, last;                ///< ends of the list of its joints, as 2 x joint + end; UINT32_MAX: empty
  uint32_t next;                       ///< next mobile body of its assembly; of the last one: its own index
  int32_t exponent;                    ///< the body's unit for joints is 2^exponent m
  int32_t above;                       ///< `exponent` minus the body's size_exponent
  uint32_t renewed;                    ///< 1 if its inverse inertia differs from that of the last substep
  uint32_t slowed;                     ///< 1 if its joints increase its inertia: an element of kept_rotation is below 1
  alignas(sizeof(Real)) Scaled inverse_mass;  ///< relative inverse mass: reference mass / mass; 0 if no joint moves it
};
/// The part of a body with joints that each substep recomputes. The body's *unit for joints* is a power of two, m, that
/// is at least as long as its joints' arms. Angular velocities and angular momenta are in this unit
/// (angular_velocity.h). Of a body that the solver does not move, only the velocity and the angular velocity are set.
struct alignas(8) JointBody : JointBodyStart {
  Vec3<Real> velocity_before;  ///< at the start of the substep, before forces and impulses, m/s
  /// Angular momentum at the start of the substep, before forces and impulses, m/s (angular_velocity.h). While
  /// positions are integrated: the angular momentum that belongs to the inertia of the substep.
  Vec3<Real> angular_momentum_before;
  Quat rotation;              ///< current
  Matrix3 axes;               ///< current
  Vec3<Real> place;           ///< displacement of its centre since the start of the tick, m
  Vec3<Real> linear_velocity, angular_velocity;  ///< the speeds of the rows are computed from these, m/s
  Vec3<Real> turned[3];  ///< angular velocity per unit angular impulse: rows of a symmetric matrix
  // A register of four floats may read and write `push` together with `pushed`, and `twist` with a kept_rotation.
  Vec3<Real> push;  ///< velocity that the rows' impulses add, m/s
  Real pushed;      ///< velocity per unit impulse
  Vec3<Real> twist;  ///< angular momentum that the rows' impulses add, m/s
  /// About each body axis: the body's own inertia over its inertia in this substep, which joints may increase
  /// (joint_inertia.cpp). At equal angular velocity, it is also the ratio of the angular momenta.
  alignas(sizeof(Real)) Scaled kept_rotation[3];
  /// As `push` and `twist`, by impulses without a row: motors at full force, soft springs.
  Vec3<Real> given_push, given_twist;
  Vec3<Real> shift;                    ///< translation of its centre in this substep that closes gaps, m
  Vec3<Real> shift_rotation;               ///< rotation vector in this substep that closes gaps, rad
};

/// One row of a joint. A linear row constrains the motion along `axis`. If `axis` is 0, the row is angular: it
/// constrains a rotation.
struct JointRow {
  Vec3<Unit> axis;    ///< direction of the force; 0 for an angular row
  Vec3<Unit> arm[2];  ///< of A, of B: angular momentum per unit impulse
};

/// The largest number of free motions of one joint that can have rows. These are the motions of JointDef::axis and
/// JointDef::second, and rotations that have only friction or a spring.
inline constexpr int k_free_motions = 3;

/// The rows of a joint for the current poses of its bodies.
struct alignas(8) JointRows {
  uint32_t locked_rows;                 ///< number of rows that always act
  uint32_t points;                    ///< 1 if the first three rows keep the anchors together
  Vec3<Unit> arm[2];                  ///< from the bodies' centres to the anchors, in the bodies' units, world axes
  JointRow row[k_joint_rows_max];     ///< the rows; the first three are not set if `points` is 1
  JointRow free_row[k_free_motions];  ///< rows of the free motions
  /// Position errors of the rows that always act, m (angles: rad x 2^exponent).
  alignas(sizeof(Real)) Real error[k_joint_rows_max];
  Real value[k_free_motions];  ///< positions of the free motions, m (angles: rad x 2^exponent)
  Real shown[k_free_motions];  ///< fraction of a free motion's speed that its row measures
};

/// What acts on a free motion of a joint in a substep: nothing, a lock, one of the limits, a rigid motor, a spring,
/// friction (brake), or a constant impulse.
enum class DriveMode : uint8_t { idle, held, lower, upper, rigid, spring, brake, constant };

/// A joint that is solved in this tick: the part that is set once a tick.
struct alignas(8) JointWorkStart {
  uint32_t joint;                   ///< slot
  uint32_t body[2];                 ///< indices of A and B among the bodies with joints
  uint32_t next[2];                 ///< next joint in the lists of A and of B: 2 x joint + end
  uint32_t rows_max;                ///< largest number of rows that it can have
  uint32_t place;                   ///< position in the elimination order; UINT32_MAX: not eliminated yet
  uint32_t coupling;                ///< first coupling with a joint eliminated later; UINT32_MAX: none
  uint32_t degree;                  ///< while the order is computed: couplings with joints not eliminated yet
  /// Of the first joint of an assembly in the elimination order: the first of its mobile bodies. While the order is
  /// computed: the last joint that marked this one as a neighbour.
  uint32_t mark;
  uint32_t around[2];               ///< while the order is computed: previous and next joint of the same degree
  /// Of the first joint of an assembly in the elimination order: the number of the assembly's joints.
  uint32_t assembly_joints;
  uint32_t rows;                    ///< number of rows in this substep
  uint32_t driven[k_free_motions];  ///< row of each free motion that is driven now, else k_joint_rows_max
  alignas(4) DriveMode mode[k_free_motions + 1];  ///< of each free motion
  int32_t exponent;                               ///< angular rows act at a radius of 2^exponent m
  int32_t power[2];                               ///< exponents of units: linear rows, angular rows (joint_factor.h)
  alignas(sizeof(Real)) Vec3<Unit> anchor[2];     ///< in the bodies' axes and units
  Unit arm_length[2];                             ///< lengths of `anchor`
  alignas(sizeof(Real)) Scaled over_lighter;      ///< reference mass / mass of the lighter of its bodies
  Scaled lighter_over[2];             ///< mass of the lighter body / mass of each body; 0 if the joint does not move it
  Vec3<Real> between;                 ///< from A's centre to B's at the start of the tick, m
  Real bound[2];                      ///< largest impulse of a motor or spring / reference mass, m/s
  Real brake[2];                      ///< largest impulse of linear and angular friction / reference mass, m/s
  Real constant[k_free_motions];      ///< impulse of each free motion that acts without a row, m/s
  Real driven_total[k_free_motions];  ///< impulse of each free motion's row, in this substep
  Real given[k_free_motions];         ///< impulse of each free motion without a row, in this substep
  Vec3<Real> force_sum, torque_sum;   ///< sums over the tick of impulses and of angular impulses / 2^exponent m, m/s
};
/// The part of a solved joint that each substep recomputes.
struct alignas(8) JointWork : JointWorkStart, JointRows {
  alignas(sizeof(Real)) Scaled inverse[k_joint_rows_max];  ///< reciprocals of the pivots
  Real least[k_joint_rows_max];                            ///< lower bound of each pivot: the row's softness
  Real spring[k_joint_rows_max];                           ///< softness of a spring, added to the row's response
  Real target[k_joint_rows_max];                           ///< target speed of each row, m/s
  Real response[k_joint_rows_max][k_joint_rows_max];       ///< lower half of the matrix, then L of its L D L^T
  Real side[k_joint_rows_max];                             ///< right-hand side of a solve, then L^-1 times it
  Real impulse[k_joint_rows_max];                          ///< solution of a solve
  Real total[k_joint_rows_max];                            ///< impulses of the rows that always act, in this substep
  Real kept[k_joint_rows_max];  ///< impulses of the rows that always act, with which the next substep begins
  Real pull;  ///< magnitude of the linear impulse in the last substep / mass of the lighter body, m/s
  int32_t row_power[k_joint_rows_max];  ///< exponent of the unit of each row
};

/// The rows of a joint side by side (lib/joint/joint_lanes.h): rows and columns of the joint's Jacobian J for each
/// body, without the minus sign of A's part, and the upper half of the matrix JointWork::response. A column has the
/// numbers of all rows for one component of (v, w). A row is (v, 0, w, 0).
struct alignas(8) JointLanes {
  Real column[2][6][8];
  Real row[2][k_joint_rows_max][8];
  Real upper[k_joint_rows_max][8];
};

/// A coupling of two joints: a block of the factor. Either the two joints share a body, or the elimination of joints
/// between them has coupled them.
struct JointCoupling {
  uint32_t joint[2];  ///< the joint that is eliminated first, the other joint
  /// Index 0: the next coupling of the first joint, with a joint that is eliminated still later. While the order is
  /// computed: the next coupling of each of the two joints, as 2 x coupling + end.
  uint32_t next[2];
  /// Index of the block's first number. The block has rows of the first joint x rows of the other joint numbers; with
  /// lanes, a row is rounded up to 4 or 8 numbers.
  uint32_t block;
};

/// The motion of a body for the rest of the tick, from its pose at `from`: constant velocity and constant angular
/// velocity, world axes.
struct BodySweep {
  /// A bit of `marks`, set if k_has_near was set in BodyWork::colours of the body.
  static constexpr uint32_t k_mark_near = 64;
  Fraction from;
  Vec3<Real> displacement;  ///< in a whole tick at this velocity, m
  Vec3<Real> rotation_vector;          ///< in a whole tick at this angular velocity, rad
  Real speed;                          ///< BodyWork::speed, m/s
  uint32_t impacts;         ///< impacts of the body in this tick
  uint32_t marks;           ///< flags of the impact stage
};

/// The motion of a body in the tick, while impacts are found. If the body has not been hit, only `bound` is set; if it
/// does not move either, nothing is set.
struct ImpactPath {
  Vec3<Real> displacement;     ///< from the start of the tick to BodySweep::from, m
  Vec3<Real> rotation_vector;  ///< sum of the rotation vectors from the start of the tick to BodySweep::from, rad
  /// Upper bound of the displacement of any surface point in the tick without impacts, m. Of a body that was hit: upper
  /// bound of the displacement of any surface point by the rotation until BodySweep::from.
  Real bound;
};

/// A pair of bodies that will collide in this tick, or has collided in it.
struct ImpactPair {
  uint64_t key;       ///< pair_key() of the slots
  Fraction time;      ///< of the next event
  Fraction last;      ///< of the last impact
  Vec3<Real> point;   ///< of the next impact, on A's surface, m, from A's position then, world axes
  Vec3<Unit> normal;  ///< of the next impact, from A to B
  uint32_t more[2];   ///< index + 1 of the next pair in the lists of the lower and the higher slot; 0 at the end
  uint8_t next;       ///< kind of the next event: none, impact, undecided time, or new test (lib/ccd/impact_stage.h)
  uint8_t impacts;    ///< impacts so far
  uint8_t tests;      ///< new tests so far
  /// 1 after the shrink depth of the pair was increased, because the pair hit at a seam or the work budget was spent.
  /// The pair's next event is then handled as an impact.
  uint8_t farther_in;
};

/// An impact that changed how two bodies move, for contact events.
struct ImpactHit {
  uint64_t key;       ///< pair_key() of the slots
  Fraction time;      ///< in the tick
  Position point;     ///< m, world
  Vec3<Unit> normal;  ///< from A to B
  Real approach;      ///< approach speed of the surfaces, m/s
};

/// A segment of a body's motion in a tick. It ends where the next segment begins, or with the tick. For tests.
struct SweepSegment {
  uint32_t body;  ///< slot
  uint32_t zero;
  Fraction from;
  BodyPose start;           ///< at `from`
  Vec3<Real> displacement;  ///< from `from` to the end of the tick, m
  Vec3<Real> rotation_vector;          ///< from `from` to the end of the tick, rad
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
