#pragma once
#include <detent/detail/state.h>
#include <detent/numbers.h>

/// Work space of a step, in the block behind the persistent state. Only the step cache keeps its content from step to
/// step. Members that can be doubles have an explicit alignment, because i686 aligns a double in a struct to 4 bytes.
namespace detent {
inline namespace DETENT_NAMESPACE {

struct Bounds {
  Position lower, upper;
};

/// A node of the tree of resting bodies (lib/broad_phase/resting_tree.h).
struct TreeNode {
  Bounds bounds;      ///< bounds that contain all leaves below this node
  uint32_t child[2];  ///< links to the two children, which are nodes or leaves (RestingTree::node_link(), leaf_link())
  /// Of a node in the tree: index of the parent node + RestingTree::k_first_parent; RestingTree::k_above_root for the
  /// root. Of a node in the list of free nodes: index + 1 of the next free node; 0: none.
  uint32_t parent;
  /// Index of the first bit in which the keys of the leaves below differ. The bit is 1 in the keys below child[1].
  uint32_t bit;
};

struct alignas(8) TreeRoot {
  uint32_t link;  ///< link to the root node or leaf; 0 if the tree is empty
  uint32_t free;  ///< index + 1 of the first node of the free list; 0: the list is empty
  uint32_t nodes_used;
  uint32_t zero;
};

/// The header of the step cache: data that is kept between ticks so that steps can skip resting bodies. The cached data
/// are the tree, the bounds and the (zero) sweeps of the bodies in the tree, the set of bodies that take part in the
/// next step, and the list of awake contacts. All of them can be recomputed from the state.
struct alignas(8) StepCache {
  uint32_t fresh;           ///< 0: the next step recomputes the cache
  uint32_t contacts_known;  ///< 1: the list of awake contacts is complete; 0: the next step searches all contacts
  uint32_t awake_contact_count;
  uint32_t zero;
  TreeRoot tree;
};

/// A body's bounds in the sort and sweep, in cells of a grid over all bodies; coordinates are rounded down. If the
/// rounded bounds of two bodies are disjoint, so are their exact bounds.
struct BoundsKey {
  uint32_t lower, upper;  ///< bounds along the sort axis, cells
  uint32_t slot;
  uint32_t is_dynamic;
  uint32_t across_lower, across_upper;  ///< bounds along the other two axes, cells: 15 bits for each axis
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
  Scaled common;    ///< inverse inertia about the axis after the odd axis, in the cyclic order x, y, z, x
  Scaled odd_rate;  ///< inverse inertia about the odd axis minus `common`
  Scaled rest;      ///< inverse inertia about the third axis minus `common`
  int32_t odd;      ///< index of the odd axis
};

/// A bit of BodyWork::colours. It is set if the body may be near another body with which it has no contact
/// (ContactGeometry::near, seam).
inline constexpr uint64_t k_has_near = uint64_t{1} << 63;

/// A body during the substeps. Members from `axes` to `speed` are set at the start of the tick; joints may change
/// `inverse_inertia` in a substep.
struct alignas(8) BodyWork {
  uint64_t colours;     ///< bit set of the colours of the body's contacts, with the flag k_has_near
  uint32_t island;      ///< while islands are found: a link towards the island's first body; then the island's index
  /// While islands are found: a link towards the first body of the body's run; afterwards work space. A *run* is a
  /// chain of dynamic bodies with at most two contacts each.
  uint32_t run;
  uint32_t run_length;  ///< number of bodies in the body's run
  uint32_t contacts;    ///< number of the body's contacts
  /// While loads are estimated: number of contacts that support the body. In the substeps: 1 if the warm start of the
  /// body's island is limited (lib/solver/warm_start.h), else 0.
  uint32_t supports;
  uint32_t joint_body;  ///< index of its JointBody; UINT32_MAX if the body has no joint
  /// While loads are estimated: the mass of the body plus that of the bodies on it, kg. In the substeps: the fraction
  /// of the warm-start impulses that the body's island keeps in this substep.
  alignas(sizeof(Real)) Scaled carried;
  /// While loads are estimated: height of the body above the first body of its island, against gravity, m.
  Real height;
  Quat rotation;  ///< local to world, at the current point of the tick
  Matrix3 axes;   ///< local to world, at the start of the tick
  WorldInverseInertia inverse_inertia;
  FreeRotation free_rotation;
  Real extent;              ///< smallest diameter of the shape, m (shape_extent())
  Real fall;                ///< sqrt(gravity x `extent`), m/s (fall_speed())
  Real speed;               ///< upper bound of the speed of any point of the body, m/s
  Vec3<Real> displacement;  ///< since the start of the tick, m
  /// Sum over the substeps since the start of the tick: angular velocity x length of the substep x 2^size_exponent, m.
  Vec3<Real> rotation_vector;
  /// Angular velocity times the body's unit of length 2^size_exponent m, in units of 2^k_angular_velocity_power m/s.
  Vec3<Real> angular_velocity;
  Vec3<Real> push;          ///< velocity that gravity and forces add in a substep, m/s
  Vec3<Real> twist;         ///< angular momentum (BodyMotion::angular_momentum) that torques add in a substep, m/s
  /// The velocity and the angular momentum (BodyMotion) that contacts added in this substep, m/s. In float, these two
  /// members are the sums of the changes by contacts. In fixed point, differences are exact, so these members store the
  /// negative of the motion without contacts; the change is the current motion plus the member (contact_motion.h).
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
  Vec3<Unit> moment_a, moment_b;  ///< arms of the normal impulse: middle_a x normal, middle_b x normal
  Unit unit_a, unit_b;          ///< the pair's unit of length / the unit of body A, B; 0 for a fixed body
  /// Element (i, k): the normal speed at point i per unit normal impulse at point k. Mantissas, times
  /// 2^coupling_exponent.
  Unit coupling[k_manifold_points_max][k_manifold_points_max];
  int32_t coupling_exponent;
  // Coordinates of the points along the two tangents, relative to the points' middle, in the pair's unit of length; 0
  // beyond the number of points.
  alignas(sizeof(Unit)) Unit x[k_manifold_points_max];
  Unit y[k_manifold_points_max];
  /// Effective masses of the points along the normal / reference mass, in (0, 1]. All 0 if continuous collision handles
  /// the contact instead of the solver (leave_to_impact() in lib/solver/contact_rows.h).
  Unit normal_mass[k_manifold_points_max];
  uint32_t apart[k_manifold_points_max];     ///< 1 if the point's gap does not close in the substep
  uint32_t static_pair;                      ///< 1 if only one of the bodies is dynamic
  uint32_t angular_rows;                     ///< number of angular rows: 0; 1 (twist friction); 3 (also rolling)
  /// Relative inverse mass of A: reference mass / mass; 0 if A is not dynamic.
  alignas(sizeof(Unit)) Scaled inverse_mass_a;
  Scaled inverse_mass_b;                            ///< relative inverse mass of B

  Vec3<Unit> middle_a, middle_b;  ///< the points' middle, from the centre of mass of A and of B, in that body's unit
  /// The change of the pair's relative motion by a unit wrench: a symmetric 6 x 6 matrix, of which one half is stored
  /// (response_index()). Mantissas, times 2^response_exponent.
  Unit response[21];
  int32_t response_exponent;
  alignas(sizeof(Unit)) Unit friction_mass;  ///< effective mass along the tangents / reference mass, in (0, 1]
  Scaled friction;
  Scaled twist_arm;        ///< largest angular impulse about the normal, divided by the normal impulse
  Scaled rolling_arm;      ///< largest angular impulse about the tangents, divided by the normal impulse
  Scaled twist_mass;       ///< effective mass about the normal
  Scaled rolling_mass;     ///< effective mass about the tangents
  Scaled restitution;

  /// Separation at the start of the tick, m. For round shapes it includes the growth of the gap by sliding
  /// (parted_by_sliding() in lib/solver/contact_rows.cpp).
  alignas(sizeof(Real)) Real separation[k_manifold_points_max];
  Real impulse_max[k_manifold_points_max];  ///< largest normal impulse of each point so far in this tick, m/s
  Real friction_impulse[2];                 ///< friction impulses along the tangents / reference mass, m/s
  /// Angular impulses about the normal and the tangents / (reference mass x the pair's unit of length), m/s.
  Real angular_impulse[3];
  Real deep;                                ///< depth, m, beyond which the stiffness of the spring doubles
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
/// Work space for up to four contacts that are solved at once (LaneContact in lib/solver/lane_contact.h). A group of
/// five to eight contacts takes two elements.
struct alignas(8) LaneSpace {
  uint8_t bytes[DETENT_FIXED ? 2472 : 2120];
};

/// The position of a contact in the solve order.
struct ContactOrder {
  /// Hash of the ids of the contact's bodies. Contacts that are solved at once form a group: for the first contact of a
  /// group, while the group is solved, `key` is the index of the group's LaneSpace.
  uint32_t key;
  uint32_t contact;
  uint16_t colour;
  uint16_t kind;  ///< numbers of points and of angular rows, and group_size() (contact_order.h)
  uint32_t island;
};

/// An island: awake bodies that contacts or joints connect, directly or through other bodies, and these contacts and
/// joints. An *assembly* is the part of an island that joints alone connect (lib/joint/joint.h).
struct Island {
  uint32_t first_body, body_count;        ///< range in the list of bodies by island
  uint32_t first_contact, contact_count;  ///< range in the solve order
  uint32_t substeps;                      ///< number of substeps; until it is chosen, the least that the joints permit
  uint32_t first_joint, joint_count;      ///< range in the order of the joints, assembly by assembly
  uint32_t joint_couplings_dropped;       ///< number of couplings of its joints for which JointStage had no room
  Scaled joint_need;                      ///< square of the number of substeps that its joints need
};

/// A body with joints, while joints are solved: the part that is set once a tick.
struct alignas(8) JointBodyStart {
  uint32_t slot;
  uint32_t mobile;                     ///< 1 if the body is dynamic and awake
  /// First and last entry in the list of its joints; UINT32_MAX if the list is empty. An entry is 2 x joint + end,
  /// where `end` is 0 if the body is the joint's A, and 1 if it is B.
  uint32_t first, last;
  uint32_t next;                       ///< next mobile body of its assembly (Island); of the last one: its own index
  int32_t exponent;                    ///< the body's unit for joints is 2^exponent m
  int32_t above;                       ///< `exponent` minus the body's size_exponent
  uint32_t renewed;                    ///< 1 if its inverse inertia has changed since the last substep
  uint32_t slowed;                     ///< 1 if its joints increase its inertia: an element of kept_rotation is below 1
  int32_t power;                       ///< greatest exponent of the units of its joints' impulses; at least 0
  alignas(sizeof(Real)) Scaled inverse_mass;  ///< reference mass of its assembly / its mass; 0 if no joint moves it
};
/// The part of a body with joints that each substep recomputes. The body's *unit for joints* is a power of two, m, that
/// is at least as long as its joints' arms. Angular velocities and angular momenta are in this unit
/// (angular_velocity.h). Of a body that the solver does not move, only the members from `rotation` to
/// `angular_velocity` are set.
struct alignas(8) JointBody : JointBodyStart {
  Vec3<Real> velocity_before;  ///< velocity at the start of the substep, before forces and impulses, m/s
  /// Angular momentum at the start of the substep, before forces and impulses, m/s (angular_velocity.h). While
  /// positions are integrated: the angular momentum at the inertia that joints have increased (kept_rotation).
  Vec3<Real> angular_momentum_before;
  Quat rotation;              ///< local to world, now
  Matrix3 axes;               ///< `rotation` as a matrix
  Vec3<Real> place;           ///< displacement of its centre since the start of the tick, m
  Vec3<Real> linear_velocity, angular_velocity;  ///< velocities that determine the speeds of the rows, m/s
  Vec3<Real> turned[3];  ///< angular velocity per unit angular impulse: rows of a symmetric matrix
  // Code with registers of four floats reads and writes one float beyond `push` and beyond `twist`: `pushed` and
  // kept_rotation[0] must follow them.
  Vec3<Real> push;  ///< velocity that the rows' impulses add, m/s; see gather() for its unit while they are summed
  Real pushed;      ///< velocity per unit impulse
  Vec3<Real> twist;  ///< angular momentum that the rows' impulses add, in the body's unit for joints, m/s
  /// About each body axis: the ratio, in (0, 1], of the body's own inertia to its inertia in this substep, which joints
  /// may increase (joint_inertia.cpp). At equal angular velocity, the angular momenta have the same ratio.
  alignas(sizeof(Real)) Scaled kept_rotation[3];
  /// Velocity, m/s, and angular momentum, scaled as `twist`, that explicit impulses add. Explicit impulses have no row
  /// in the system of equations. Soft springs, and motors and friction at their greatest force, apply them.
  Vec3<Real> given_push, given_twist;
  Vec3<Real> shift;                    ///< translation in this substep that corrects position errors of joints, m
  Vec3<Real> shift_rotation;               ///< rotation vector in this substep that corrects position errors, rad
};

/// One row of a joint. A linear row constrains the motion along `axis`. If `axis` is 0, the row is angular: it
/// constrains a rotation.
struct JointRow {
  Vec3<Unit> axis;    ///< direction of the force on B; 0 for an angular row
  Vec3<Unit> arm[2];  ///< the angular impulses by a unit impulse of the row: -arm[0] on A, arm[1] on B
};

/// The largest number of free motions of one joint that can have rows. Such free motions are those of JointDef::axis
/// and JointDef::second, and rotations on which only friction or a spring acts.
inline constexpr int k_free_motions = 3;

/// The rows of a joint for the current poses of its bodies.
struct alignas(8) JointRows {
  uint32_t locked_rows;                 ///< number of rows that always act
  uint32_t points;                    ///< 1 if the first three rows hold the anchors of A and B together
  Vec3<Unit> arm[2];                  ///< from the bodies' centres to the anchors, in the bodies' units, world axes
  JointRow row[k_joint_rows_max];     ///< the rows; the first three are not set if `points` is 1
  JointRow free_row[k_free_motions];  ///< rows of the free motions
  /// Position errors of the rows that always act, m (angles: rad x 2^JointWork::exponent).
  alignas(sizeof(Real)) Real error[k_joint_rows_max];
  Real value[k_free_motions];  ///< positions of the free motions, m (angles: rad x 2^JointWork::exponent)
  Real shown[k_free_motions];  ///< fraction of a free motion's speed that its row measures; below 1 only for a twist
};

/// What acts on a free motion of a joint in a substep: nothing, a lock, one of the limits, a rigid motor, a spring,
/// friction (brake), or a constant impulse.
enum class DriveMode : uint8_t { idle, held, lower, upper, rigid, spring, brake, constant };

/// A joint that is solved in this tick: the part that is set once a tick.
struct alignas(8) JointWorkStart {
  uint32_t joint;                   ///< slot
  uint32_t body[2];                 ///< indices of A and B among the bodies with joints
  uint32_t next[2];                 ///< next entries in the joint lists of A and of B (JointBodyStart::first)
  uint32_t rows_max;                ///< largest number of rows that it can have
  uint32_t place;                   ///< position in the elimination order; UINT32_MAX: not eliminated yet
  uint32_t coupling;                ///< first coupling with a joint that is eliminated later; UINT32_MAX: none
  uint32_t degree;                  ///< while the order is computed: number of couplings with joints not eliminated yet
  /// For the first joint of an assembly in the elimination order: index of the first mobile body of the assembly. While
  /// the order is computed: index + 1 of the last joint that marked this one as a neighbour.
  uint32_t mark;
  uint32_t around[2];               ///< while the order is computed: previous and next joint of the same degree
  /// For the first joint of an assembly in the elimination order: the number of the assembly's joints.
  uint32_t assembly_joints;
  uint32_t rows;                    ///< number of rows in this substep
  uint32_t driven[k_free_motions];  ///< index of each free motion's row; k_joint_rows_max if it has no row now
  alignas(4) DriveMode mode[k_free_motions + 1];  ///< drive mode of each free motion; the last element is unused
  int32_t exponent;                               ///< angular rows act at a radius of 2^exponent m
  int32_t power[2];  ///< exponents of the impulse units of linear and of angular rows (impulse_power() in joint.h)
  /// The anchors on A and B, from the bodies' centres, in the bodies' axes and units for joints (JointBody).
  alignas(sizeof(Real)) Vec3<Unit> anchor[2];
  Unit arm_length[2];                             ///< lengths of the two anchor vectors, in the same units
  alignas(sizeof(Real)) Scaled over_lighter;      ///< reference mass / mass of the lighter of its bodies
  Scaled lighter_over[2];             ///< mass of the lighter body / mass of each body; 0 if the joint does not move it
  Vec3<Real> between;                 ///< from A's centre to B's at the start of the tick, m
  Real bound[2];  ///< for each JointAxis: largest impulse of its motor or spring in a tick / reference mass, m/s
  Real brake[2];  ///< largest impulses of linear and of angular friction in a tick / reference mass, m/s
  /// For each free motion: the explicit impulse that the next solve applies, m/s. Explicit impulses have no row in the
  /// system of equations; for example, a motor at its greatest force applies one. The solve then adds it to `given`.
  Real constant[k_free_motions];
  Real driven_total[k_free_motions];  ///< impulse of each free motion's present row so far in this substep
  /// For each free motion: all other impulses in this substep, both explicit ones and those of earlier drive modes.
  Real given[k_free_motions];
  /// Sums over the tick of the joint's impulses on B, and of its angular impulses on B in B's unit for joints; both in
  /// the units of `power`.
  Vec3<Real> force_sum, torque_sum;
};
/// The part of a solved joint that each substep recomputes.
struct alignas(8) JointWork : JointWorkStart, JointRows {
  alignas(sizeof(Real)) Scaled inverse[k_joint_rows_max];  ///< reciprocals of the pivots of the factor
  Real least[k_joint_rows_max];                            ///< lower bound of each pivot: the row's softness
  /// Softness of the spring of a row, which is added to the row's diagonal element of the matrix; 0 without a spring.
  Real spring[k_joint_rows_max];
  Real target[k_joint_rows_max];                           ///< target speed of each row, m/s
  /// Lower half of the joint's own block of K + S, the matrix of the joint solve (lib/joint/joint.h); then L of the
  /// block's factor L D L^T.
  Real response[k_joint_rows_max][k_joint_rows_max];
  Real side[k_joint_rows_max];                             ///< right-hand side b of a solve; then L^-1 b
  Real impulse[k_joint_rows_max];                          ///< impulses of the rows that the last solve computed
  Real total[k_joint_rows_max];                            ///< impulses in this substep of the rows that always act
  Real kept[k_joint_rows_max];  ///< warm start of the rows that always act: their impulses for the next substep
  Real pull;  ///< magnitude of the linear impulse in the last substep / mass of the lighter body, m/s
  int32_t row_power[k_joint_rows_max];  ///< exponent of the unit of each row's impulse: an element of `power`
};

/// The rows of a joint side by side (lib/joint/joint_lanes.h): rows and columns of the joint's Jacobian J for each
/// body, without the minus sign of A's part, and the upper half of the matrix JointWork::response. A column has, for
/// one component of the body's velocity or angular velocity, the coefficients of all rows. A row has the three
/// coefficients of the velocity, 0, the three of the angular velocity, and 0.
struct alignas(8) JointLanes {
  Real column[2][6][8];
  Real row[2][k_joint_rows_max][8];
  Real upper[k_joint_rows_max][8];
};

/// A coupling of two joints: an off-diagonal block of the factor. Either the two joints share a body, or the block is
/// fill-in from the elimination of joints between them.
struct JointCoupling {
  uint32_t joint[2];  ///< first the joint that is eliminated earlier, then the other one
  /// While the elimination order is computed: for each of the two joints, the next coupling in the joint's list, as
  /// 2 x coupling + the joint's index (0 or 1) in that coupling.
  /// Afterwards only next[0] is used: the next coupling of joint[0], with a joint that is eliminated still later.
  uint32_t next[2];
  /// Index of the block's first element in JointStage::numbers. The block has as many rows as the first joint, and as
  /// many columns as the second; with vector code, each row is padded to 4 or 8 numbers.
  uint32_t block;
};

/// The motion of a body for the rest of the tick, from its pose at `from`: constant velocity and constant angular
/// velocity, world axes.
struct BodySweep {
  /// A bit of `marks`. It is set if BodyWork::colours of the body has the bit k_has_near.
  static constexpr uint32_t k_mark_near = 64;
  Fraction from;            ///< start of the sweep, as a fraction of the tick
  Vec3<Real> displacement;  ///< displacement in a whole tick at the constant velocity, m
  Vec3<Real> rotation_vector;          ///< rotation vector of a whole tick at the constant angular velocity, rad
  Real speed;                          ///< BodyWork::speed, m/s
  uint32_t impacts;         ///< number of impacts of the body so far in this tick
  /// Flags of continuous collision (k_mark_stopped and others, lib/ccd/impact_stage.h). For a body with joints, also
  /// k_mark_jointed (lib/ccd/impact.h) times the number of its island.
  uint32_t marks;
};

/// The motion of a body in the tick, while impacts are found. As long as the body has not been hit, only `bound` is
/// set. Nothing is set for a body that has not been hit and does not move.
struct ImpactPath {
  Vec3<Real> displacement;     ///< from the start of the tick to BodySweep::from, m
  Vec3<Real> rotation_vector;  ///< sum of the rotation vectors from the start of the tick to BodySweep::from, rad
  /// As long as the body has not been hit: upper bound of the displacement of any of its surface points in the whole
  /// tick, m. After a hit: upper bound of the displacement of any surface point by the body's rotation until
  /// BodySweep::from, m.
  Real bound;
};

/// A pair of bodies that will collide in this tick, or has collided in it.
struct ImpactPair {
  uint64_t key;       ///< pair_key() of the slots
  Fraction time;      ///< time of the pair's next event, as a fraction of the tick
  Fraction last;      ///< time of the pair's last impact
  Vec3<Real> point;   ///< point of the next impact on A's surface, m, from A's position at `time`, world axes
  Vec3<Unit> normal;  ///< normal of the next impact, from A to B
  uint32_t more[2];   ///< index + 1 of the next pair of the body with the lower, the higher slot; 0: no further pair
  uint8_t next;       ///< kind of the next event: none, impact, undecided time, or new test (lib/ccd/impact_stage.h)
  uint8_t impacts;    ///< number of the pair's impacts so far
  uint8_t tests;      ///< number of new tests (k_next_test) that were planned for the pair so far
  /// 1 after the shrink depth of the pair (lib/ccd/impact_pair.h) was increased, because the pair hit at a seam or the
  /// work budget was spent. From then on the pair's impacts are resolved without such an increase.
  uint8_t farther_in;
};

/// An impact that changed how two bodies move, for contact events.
struct ImpactHit {
  uint64_t key;       ///< pair_key() of the slots
  Fraction time;      ///< time of the impact, as a fraction of the tick
  Position point;     ///< point of the impact, m, world
  Vec3<Unit> normal;  ///< from A to B
  Real approach;      ///< approach speed of the surfaces, m/s
};

/// A segment of a body's motion in a tick, recorded for tests. It ends where the body's next segment begins; the last
/// one ends with the tick.
struct SweepSegment {
  uint32_t body;  ///< slot
  uint32_t zero;
  Fraction from;
  BodyPose start;           ///< pose of the body at the time `from`
  Vec3<Real> displacement;  ///< from `from` to the end of the tick, m
  Vec3<Real> rotation_vector;          ///< from `from` to the end of the tick, rad
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
