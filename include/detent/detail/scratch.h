#pragma once
#include <detent/detail/state.h>
#include <detent/fraction.h>

/// Work space of a step, in the block behind the persistent state. What outlives a step is a cache of what the state
/// says (StepCache). Aligned by hand where i686 would pack a double.
namespace detent {
inline namespace DETENT_NAMESPACE {

struct Bounds {
  Position lower, upper;
};

/// A node of the tree of resting bodies (lib/broad_phase/resting_tree.h).
struct TreeNode {
  Bounds bounds;  ///< of all that is below
  uint32_t child[2];
  uint32_t parent;  ///< of a node that is free: the next free one
  uint32_t bit;     ///< of the keys below, the first that differs: the second child's is 1
};

struct alignas(8) TreeRoot {
  uint32_t link;  ///< to the uppermost node or leaf; 0 if the tree is empty
  uint32_t free;  ///< index + 1 of a node that was given back; 0 if there is none
  uint32_t nodes_used;
  uint32_t visited;  ///< nodes and leaves looked at in the last step
};

/// What steps keep from tick to tick so as not to look at what rests: the tree, the bounds of the bodies in it, their
/// sweeps, which are zero, the bodies that the next step must look at, and the awake contacts. All of it follows from
/// the state.
struct alignas(8) StepCache {
  uint32_t fresh;           ///< 0: all of it is to be made anew
  uint32_t contacts_known;  ///< 1: none but the listed contacts can have an awake body
  uint32_t awake_contact_count;
  uint32_t zero;
  TreeRoot tree;
};

/// A body's bounds in the sort and sweep, rounded down to a grid over all bodies: what is apart in it is apart.
struct BoundsKey {
  uint32_t lower, upper;  ///< along the axis of the sweep
  uint32_t slot;
  uint32_t is_dynamic;
  uint32_t across_lower, across_upper;  ///< along the other two, 15 bits each
};

/// A body's gyration in world axes: spin = gyration x momentum. Symmetric; 2^-exponent.
struct alignas(sizeof(Unit)) WorldGyration {
  Vec3<Unit> row[3];
  int32_t exponent;
};

/// How a body turns freely: its gyrations as that of two axes near each other and what the others differ from it by.
struct alignas(sizeof(Unit)) FreeTurn {
  Scaled common;    ///< of the axis after the odd one
  Scaled odd_rate;  ///< of the odd one, less `common`
  Scaled rest;      ///< of the third, less `common`
  int32_t odd;      ///< the axis whose gyration is farthest from the other two
};

/// A body during the substeps.
struct alignas(8) BodyWork {
  uint64_t colours;     ///< taken by the contacts of this body
  uint32_t island;      ///< while islands are found: a body on the way to the island's first; then the island
  uint32_t run;         ///< likewise, of the row of bodies with no more than two contacts each that it is part of
  uint32_t run_length;  ///< bodies in that row, at its first
  uint32_t contacts;    ///< of this body
  uint32_t supports;    ///< contacts that carry it, while loads are estimated
  uint32_t joint_body;  ///< of a body that a joint holds: its place among those, else UINT32_MAX
  alignas(sizeof(Real)) Scaled carried;  ///< its own mass and what rests on it, kg, likewise
  Real height;                           ///< against gravity, over the island's first body, m, likewise
  Quat rotation;                         ///< now
  Matrix3 axes;                          ///< at the start of the tick, like all up to `speed`
  WorldGyration gyration;
  FreeTurn free_turn;
  Real extent;                  ///< shape_extent(), m
  Real fall;                    ///< fall_speed() of it, m/s
  Real speed;                   ///< speed_bound(), m/s
  Vec3<Real> displacement;      ///< from the start of the tick, m
  Vec3<Real> turn;              ///< sum of spin x substep x 2^size_exponent from the start of the tick, m
  Vec3<Real> spin;              ///< gyration x momentum, or that of a kinematic body, 2^-k_spin_power m/s
  Vec3<Real> push;              ///< velocity that gravity and forces add in a substep, m/s
  Vec3<Real> twist;             ///< momentum that torques add in a substep, m/s
  Vec3<Real> contact_velocity;  ///< what contacts add in this substep, m/s: in float the sum so far, in fixed
  Vec3<Real> contact_momentum;  ///< point, where differences are exact, less the motion; see contact_motion.h
  Vec3<Real> velocity_before;   ///< of the last sweep, where there are several, m/s
  Scaled linear_kept;           ///< share of the velocity that damping leaves in a substep
  Scaled angular_kept;
};

/// A contact during the step. Impulses are over the reference mass: that of the lighter dynamic body. The pair's unit
/// of length is that of its smaller moving body. The solver reads four contacts at once, in fours of words and of
/// Reals: what a pass over the normals needs lies before what friction needs (lib/solver/quad_contact.h).
struct alignas(8) ContactWork {
  ContactState state;  ///< becomes the world's contact when the step ends

  Vec3<Unit> normal;  ///< from A to B
  Vec3<Unit> tangent[2];
  Vec3<Unit> lever_a, lever_b;  ///< middle x normal
  Unit unit_a, unit_b;          ///< the pair's unit of length in the body's
  Unit coupling[k_manifold_points_max]
               [k_manifold_points_max];  ///< what an impulse at one point adds to the speed at another, 2^-exponent
  int32_t coupling_exponent;
  // Of the points, from the middle along the tangents, in the pair's unit of length; 0 beyond their count.
  alignas(sizeof(Unit)) Unit x[k_manifold_points_max];
  Unit y[k_manifold_points_max];
  Unit inverse_mass[k_manifold_points_max];  ///< effective masses over the reference mass, in (0, 1]
  uint32_t apart[k_manifold_points_max];     ///< 1 unless it meets in the substep
  uint32_t static_pair;                      ///< 1 if only one of the bodies is dynamic
  uint32_t angular_rows;                     ///< 0; 1: twist; 3: and rolling
  alignas(sizeof(Unit)) Scaled share_a;
  Scaled share_b;  ///< reference mass / mass; 0 if not dynamic

  Vec3<Unit> middle_a, middle_b;  ///< of the points, from each centre of mass, in the body's unit of length
  Unit response[21];              ///< of the pair's motion to a wrench, by response_index(), 2^-response_exponent
  int32_t response_exponent;
  alignas(sizeof(Unit)) Unit friction_mass[2];  ///< effective masses along the tangents, like those of the points
  Scaled friction;
  Scaled twist_arm;        ///< limit of the angular impulse about the normal over the normal impulse
  Scaled rolling_arm;      ///< likewise about the tangents
  Scaled angular_mass[3];  ///< effective masses about the normal and the tangents
  Scaled restitution;

  alignas(sizeof(Real)) Real separation[k_manifold_points_max];  ///< at the start of the tick, and what they part by sliding, m
  Real impulse_max[k_manifold_points_max];                       ///< largest normal impulse of this tick, m/s
  Real friction_impulse[2];                                      ///< along the tangents
  Real angular_impulse[3];                                       ///< about the normal and the tangents
  Real push_max;                         ///< largest separating speed of the position correction, m/s
  Real rebound_min;                      ///< approach speed below which nothing rebounds, m/s
  Real approach[k_manifold_points_max];  ///< normal velocity at the start of the tick, m/s; negative when closing
};

/// Where a contact stands in the order of the solve.
struct ContactOrder {
  uint32_t key;  ///< hash of the pair's ids
  uint32_t contact;
  uint16_t colour, kind;
  uint32_t island;
};

/// Awake bodies in contact with each other, directly or through others, and their contacts.
struct Island {
  uint32_t first_body, body_count;        ///< of the list of bodies by island
  uint32_t first_contact, contact_count;  ///< of the order of the solve
  uint32_t substeps;                  ///< until they are chosen, the fewest that its joints may have
  uint32_t first_joint, joint_count;  ///< of the order of the joints
  uint32_t joint_couplings_dropped;   ///< for which the factor of its joints had no room
  Scaled joint_need;                  ///< squared substeps that its joints ask for
};

/// A body that joints hold, while joints are solved: what a tick starts with.
struct alignas(8) JointBodyStart {
  uint32_t slot;
  uint32_t mobile;                     ///< 1 if it is dynamic and awake
  uint32_t first, last;                ///< of its joints, as 2 x joint + end; UINT32_MAX: none
  int32_t exponent;                    ///< of the unit, m
  int32_t above;                       ///< by how much that is more than the body's own
  uint32_t renewed;                    ///< 1 if its gyration is not that of the last substep
  uint32_t slowed;                     ///< 1 if its pulls leave less than all of a momentum
  alignas(sizeof(Real)) Scaled share;  ///< reference mass / mass; 0 if it takes no part
};
/// And what each substep makes anew. Its *unit* is a power of two that holds its joints' arms; spins and momenta are
/// those of that unit (spin.h). What does not move for the solver takes no part but by its motion.
struct alignas(8) JointBody : JointBodyStart {
  Vec3<Real> velocity_before;        ///< at the start of the substep, before anything acts, m/s
  Vec3<Real> momentum_before;        ///< likewise, m/s (spin.h); while positions are integrated, that with the inertia of now
  Quat rotation;                     ///< now
  Matrix3 axes;                      ///< likewise
  Vec3<Real> place;                  ///< of its centre, from where it was at the start of the tick, m
  Vec3<Real> velocity, spin;         ///< as the joints see them, m/s
  Real pushed;                       ///< velocity by a unit force
  Vec3<Real> turned[3];              ///< spin by a torque: the rows of a symmetric matrix
  alignas(sizeof(Real)) Scaled kept_turn[3];  ///< what its pulls leave of a momentum about its axes: joint_inertia.cpp
  Vec3<Real> push, twist;            ///< what joints have given its velocity and momentum, m/s
  Vec3<Real> given_push, given_twist;  ///< likewise without a row: motors at their limit
  Vec3<Real> shift;                  ///< of its centre in this substep, that closes gaps, m
  Vec3<Real> shift_turn;             ///< likewise of its rotation, rad
};

/// What one row of a joint holds: the motion along `axis`, or about it if it is `angular`.
struct JointRow {
  Vec3<Unit> axis;    ///< of a force; 0 for an angular row
  Vec3<Unit> arm[2];  ///< of A, of B: what a unit of impulse gives to the momentum
};

/// Free motions of a joint that can have rows: those of its axes, and the other turns that friction brakes.
inline constexpr int k_free_motions = 3;

/// The rows of a joint where its bodies are.
struct alignas(8) JointRows {
  uint32_t rows_held;               ///< always
  uint32_t points;                  ///< 1 if the first three rows hold the anchors together
  Vec3<Unit> arm[2];                ///< from the bodies' centres to the anchors, in their units, world axes
  JointRow row[k_joint_rows_max];   ///< those beyond the points
  JointRow free_row[k_free_motions];                   ///< of the free motions
  alignas(sizeof(Real)) Real error[k_joint_rows_max];  ///< by how much the rows held have given way, m (angles: times 2^exponent)
  Real value[k_free_motions];                          ///< of the free motions, likewise
  Real shown[k_free_motions];                          ///< what of a free motion's speed its row shows
};

/// How a free motion of a joint is driven in a substep.
enum class DriveMode : uint8_t { idle, held, lower, upper, rigid, spring, brake, constant };

/// A joint at work: what a tick starts with.
struct alignas(8) JointWorkStart {
  uint32_t joint;                              ///< slot
  uint32_t body[2];                            ///< places of A and B
  uint32_t next[2];                            ///< of the joints of A, of B: 2 x joint + end
  uint32_t rows_max;                           ///< held and driven, at most
  uint32_t place;                              ///< in the order of elimination; UINT32_MAX: not yet
  uint32_t coupling;                           ///< the first of those with joints eliminated later; UINT32_MAX: none
  uint32_t degree;                             ///< while the order is made: couplings with joints not eliminated
  uint32_t mark;                               ///< likewise: the last joint whose neighbours were marked
  uint32_t around[2];                          ///< likewise: the joints before and after it of the same degree
  uint32_t rows;                               ///< held and driven, in this substep
  uint32_t driven[k_free_motions];             ///< the row of each free motion that is driven now, or k_joint_rows_max
  alignas(4) DriveMode mode[k_free_motions + 1];  ///< of each free motion
  int32_t exponent;                            ///< 2^exponent m: how far angular rows reach
  int32_t power[2];                            ///< of the units of linear and of angular rows: joint_factor.h
  alignas(sizeof(Real)) Vec3<Unit> anchor[2];  ///< in the bodies' axes and units
  Unit arm_length[2];                          ///< of the anchors
  alignas(sizeof(Real)) Scaled over_lighter;   ///< the reference mass over that of the lighter of its bodies
  Scaled lighter_over[2];                      ///< that mass over each body's; 0 if it takes no part
  Vec3<Real> between;                          ///< from A's centre to B's at the start of the tick, m
  Real bound[2];                               ///< largest impulse of a motor or spring, over the reference mass, m/s
  Real brake[2];                               ///< likewise of friction: of what slides, of what turns
  Real constant[k_free_motions];               ///< that is to act without a row, m/s
  Real driven_total[k_free_motions];           ///< of the rows of the free motions, in this substep
  Real given[k_free_motions];                  ///< and without rows
  Vec3<Real> force_sum, torque_sum;            ///< of the tick, m/s, torques over 2^exponent m
};
/// And what each substep makes anew.
struct alignas(8) JointWork : JointWorkStart, JointRows {
  alignas(sizeof(Real)) Scaled inverse[k_joint_rows_max];  ///< of the pivots
  Real least[k_joint_rows_max];                            ///< that a pivot counts as: the row's softness
  Real spring[k_joint_rows_max];                           ///< what a spring adds to a row's response
  Real wanted[k_joint_rows_max];                           ///< speed of each row, m/s
  Real response[k_joint_rows_max][k_joint_rows_max];       ///< the lower half; then L of its L D L^T
  Real side[k_joint_rows_max];                             ///< the right-hand side of a solve, then L^-1 of it
  Real impulse[k_joint_rows_max];                          ///< of a solve
  Real total[k_joint_rows_max];                            ///< of the rows always held, in this substep
  Real pull;                                               ///< in the last substep, as the joint keeps its impulses
  int32_t row_power[k_joint_rows_max];                     ///< of the unit of each row
};

/// Two joints that share a body, or see each other once joints between them are eliminated: a block of the factor.
struct JointCoupling {
  uint32_t joint[2];  ///< the one eliminated first, the other
  uint32_t next[2];   ///< of the first's couplings with joints eliminated later; while the order is made: of those of
                      ///< each, as 2 x coupling + end
  uint32_t block;     ///< where its numbers begin: rows of the first by rows of the other
};

/// The motion of a body for the rest of the tick, from its pose at `from`: constant velocity and constant world spin.
struct BodySweep {
  Fraction from;
  Vec3<Real> displacement;  ///< m, in a whole tick at this velocity
  Vec3<Real> turn;          ///< rad, likewise
  Real reach;               ///< no point of the surface moves farther in the tick, m, unless the body is struck
  uint32_t impacts;         ///< that the body has had in this tick
  uint32_t marks;           ///< of the impact stage
};

/// A pair of bodies that meets in this tick, or has met.
struct ImpactPair {
  uint64_t key;       ///< pair_key() of the slots
  Fraction time;      ///< of what comes next
  Fraction last;      ///< of the last impact
  Vec3<Real> point;   ///< of the next impact, on A's surface, m, from A's position then, world axes
  Vec3<Unit> normal;  ///< of the next impact, from A to B
  uint32_t more[2];   ///< the next pair of the lower slot's list, of the higher's: its index and 1; 0 at the end
  uint8_t next;       ///< what comes next: nothing, an impact, a time found in part, or a look from farther out
  uint8_t impacts;    ///< so far
  uint8_t looks;      ///< so far
  uint8_t farther_in;  ///< 1 since it is tested farther in, for it met at a seam or the work was spent: it meets next
};

/// An impact that changed how two bodies move, for contact events.
struct ImpactHit {
  uint64_t key;       ///< pair_key() of the slots
  Fraction time;      ///< part of the tick
  Position point;     ///< m, world
  Vec3<Unit> normal;  ///< from A to B
  Real approach;      ///< speed at which the surfaces came together, m/s
};

/// A stretch of a body's motion in a tick, until its next one begins or the tick ends; for tests.
struct SweepSegment {
  uint32_t body;  ///< slot
  uint32_t zero;
  Fraction from;
  BodyPose start;           ///< at `from`
  Vec3<Real> displacement;  ///< from `from` to the end of the tick, m
  Vec3<Real> turn;          ///< likewise, rad
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
