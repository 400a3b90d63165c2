#pragma once
#include <detent/detail/scratch.h>
#include <detent/detail/shared.h>
#include <detent/features.h>
#include <detent/joint.h>

#include "base/bit_set.h"
#include "base/span.h"
#include "motion/angular_velocity.h"
#include "motion/solver_bodies.h"
#include "motion/step_settings.h"

/// The joints of a step. With the columns (v_A, w_A, v_B, w_B) of velocities and angular velocities, a joint's row has
/// the Jacobian
///
///     J = (-axis, -arm_A, axis, arm_B)
///
/// so the speed of the row is J v = axis . (v_B - v_A) + arm_B . w_B - arm_A . w_A, and an impulse x of the row applies
/// the wrench J^T x. C is the position error of the row (JointRows::error). joint_rows.cpp has the J and C of each
/// joint, joint_drives.cpp its limits, motors, springs and friction. An *assembly* is a set of bodies that joints
/// connect, directly or through other mobile bodies, together with these joints. All rows of an assembly are solved at
/// once, for any graph of joints:
///
///     (K + S) x = target - J v,  K = J M^-1 J^T
///
/// M is the mass matrix. S is a diagonal matrix of small softnesses, which makes redundant rows solvable; the row of a
/// spring has a larger softness. K + S is factored as a block L D L^T over the graph of the joints, with elimination by
/// minimum degree (joint_order.cpp, joint_factor.h). Each substep computes the factor anew.
///
/// A substep adds no energy (joint_solve.cpp). It begins with the impulses of the last substep, scaled down until they
/// add no energy. The solve of the rows then projects the velocities, which only removes energy. Then the solver adds
/// velocities that make the joints follow their curved paths. These velocities are scaled so that they add at most the
/// energy that the projection has removed. Shifts of the bodies correct position errors; they keep the bodies'
/// velocities and angular momenta, except that a body whose energy a shift would raise is slowed down.
/// Sources: Baraff, "Linear-time dynamics using Lagrange multipliers", SIGGRAPH 1996; Tournier, Nesme, Gilles, Faure,
/// "Stable constrained dynamics", 2015; George, Liu, "The evolution of the minimum degree ordering algorithm", 1989.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// Whether this build solves the rows of a joint side by side (joint_lanes.h).
#if DETENT_QUADS && defined(DETENT_F32)
#define DETENT_JOINT_LANES 1
#else
#define DETENT_JOINT_LANES 0
#endif

inline constexpr uint32_t k_no_link = UINT32_MAX;
/// Limit, m/s, of three impulses that are divided by a mass: the stored impulse of a row, the impulse of a drive
/// (limit, motor, spring or friction) in a substep, and JointWork::pull.
inline constexpr Real k_joint_impulse_max = 16384.0;
/// A joint stores the impulse of a substep times (number of substeps) / 2^k_kept_power. This value does not depend on
/// the number of substeps.
inline constexpr int k_kept_power = 3;

/// Converts the components of `v`, m or m/s, to units of 2^exponent m or m/s. Overflow: clamps to the range of a Unit.
Vec3<Unit> clamped_unit(const Vec3<Real>& v, int exponent);

struct JointStage {
  Span<JointState> joints;  ///< all slots that have ever been used
  Span<const BodyPose> poses;
  Span<BodyActivity> activities;
  Span<JointWork> work;    ///< the active joints, in the order of their slots
  Span<JointLanes> lanes;  ///< rows of the active joints by lanes; used only if DETENT_JOINT_LANES is 1
  Span<JointBody> bodies;  ///< the bodies of the active joints
  /// Indices into `work`: by island, assembly by assembly, in the order of elimination.
  Span<uint32_t> order;
  Span<JointCoupling> couplings;  ///< couplings of the factor
  Span<Real> numbers;             ///< elements of the factor's blocks; see joint_number_room()
  uint32_t count = 0;             ///< number of entries in `work`
  uint32_t body_count = 0;        ///< number of entries in `bodies`
#if DETENT_SPARSE
  /// `anchoring` selects active joints of `others`, which this step does not solve. Their fixed and kinematic bodies
  /// are in `bodies`, too (collect_anchors() in joint_collect.cpp).
  Span<const JointState> others = {};
  BitSet anchoring = {};                          ///< indices in `others`
  uint32_t couplings_used = 0, numbers_used = 0;  ///< elements used of `couplings` and `numbers`, by all islands
#endif
};

/// Collects all joints with an awake body, and the bodies of these joints. start_body() (predict.h) must have been
/// called for the bodies. Fills `work` and `bodies`.
void collect_joints(const SolverBodies& bodies, JointStage& stage);

/// For every island: lists the assemblies, computes the elimination order of their joints, makes the couplings
/// (off-diagonal blocks, each for two joints) that the factors need, and sets the number of substeps that the joints
/// need. `slots` lists the bodies by island. Returns the number of couplings that had no room.
uint32_t order_joints(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> slots,
                      Span<Island> islands, JointStage& stage);

/// Begins a substep of an island, `elapsed`, s, after the start of the tick: makes the joints' rows, and stores the
/// velocities that the bodies have before anything acts in the substep. Also sets the bodies' inverse inertias for the
/// substep, which joints and contacts both use.
void begin_joints(const StepSettings& settings, const SolverBodies& bodies, const Island& island, Real elapsed,
                  JointStage& stage);

/// Whether a body's inverse inertia has changed since the last substep.
inline bool has_renewed_inverse_inertia(const BodyWork& now, const JointStage& stage) {
  return now.joint_body != UINT32_MAX && stage.bodies[now.joint_body].renewed != 0;
}

/// Solves the joints' rows for the bodies' current velocities, `elapsed`, s, after the start of the tick. Returns the
/// number of values that were clamped. Increases `undecided` by the number of assemblies in which the mode of a limit,
/// motor or friction (DriveMode) still disagrees with its impulse after the last solve.
uint32_t solve_joints(const StepSettings& settings, const SolverBodies& bodies, const Island& island, Real elapsed,
                      JointStage& stage, uint32_t& undecided);

/// Solves the rows again, to remove the row speeds that contacts have added since BodyWork::velocity_before was stored.
/// Skips the assemblies in which contacts changed no velocity by more than `enough`, m/s. Returns the number of values
/// that were clamped, and increases `undecided` as solve_joints() does.
uint32_t solve_joints_again(const StepSettings& settings, const SolverBodies& bodies, const Island& island,
                            Real elapsed, Real enough, JointStage& stage, uint32_t& undecided);

/// Adds the velocities that make the anchors follow the curved paths on which rotating bodies carry them. Computes the
/// shifts of the bodies that close gaps between anchors. Returns the number of values that were clamped.
uint32_t follow_joints(const StepSettings& settings, const SolverBodies& bodies, const Island& island, Real elapsed,
                       JointStage& stage);

/// Applies the shifts that close gaps, after the bodies have moved. Then converts the bodies' angular momenta back to
/// the inertia of the substep (load_inertia()). Returns 1 if a value was clamped, else 0.
uint32_t shift_joints(const SolverBodies& bodies, const Island& island, JointStage& stage);

/// Ends a substep of an island: removes the row speeds that contacts have added, as solve_joints_again() does, adds the
/// impulses of the joints to their sums over the tick, and restores the bodies' own inverse inertias and angular
/// momenta. Returns the number of values that were clamped, and increases `undecided` as solve_joints() does.
uint32_t end_joints(const StepSettings& settings, const SolverBodies& bodies, const Island& island, Real elapsed,
                    Real enough, JointStage& stage, uint32_t& undecided);

/// Stores the forces and torques of the joints in the tick. A body whose motor moves its joint does not count as at
/// rest, however slowly the motor moves.
void store_reactions(const StepSettings& settings, const SolverBodies& bodies, JointStage& stage);

/// FeatureTable points to these functions if the feature is linked.
struct JointOps {
  decltype(&collect_joints) collect;
  decltype(&order_joints) order;
  decltype(&begin_joints) begin;
  decltype(&solve_joints) solve;
  decltype(&solve_joints_again) solve_again;
  decltype(&follow_joints) follow;
  decltype(&shift_joints) shift;
  decltype(&end_joints) end;
  decltype(&store_reactions) store;
};

// Functions that several files of lib/joint share.

/// Calls `visit` for each assembly of an island, with the range of its joints.
template <class Visit>
void each_assembly(const Island& island, const JointStage& stage, const Visit& visit) {
  for (uint32_t done = 0; done < island.joint_count;) {
    uint32_t* const first = stage.order.data + island.first_joint + done;
    const uint32_t count = stage.work[*first].assembly_joints;
    visit(Span<uint32_t>{first, count});
    done += count;
  }
}
/// Returns the mobile (dynamic and awake) body after `body` in the assembly, or null if `body` is the last. If `body`
/// is null, returns the first mobile body.
DETENT_SHARED inline JointBody* next_mobile_body(Span<const uint32_t> order, const JointStage& stage,
                                                 const JointBody* body) {
  JointBody* const next = &stage.bodies[body == nullptr ? stage.work[order[0]].mark : body->next];
  return next == body ? nullptr : next;
}
/// Visits the mobile bodies of an assembly. Every assembly has at least one.
template <class Visit>
void each_mobile_body(Span<const uint32_t> order, const JointStage& stage, const Visit& visit) {
  JointBody* body = nullptr;
  while ((body = next_mobile_body(order, stage, body)) != nullptr) visit(*body);
}

/// A number of rows that is a compile-time constant.
template <uint32_t k_rows>
struct ConstantRows {
  constexpr operator uint32_t() const { return k_rows; }
};
/// Calls `visit` with the number of rows of a joint: a compile-time constant for the usual numbers, so that sums over
/// the rows are unrolled.
template <class Visit>
inline void with_rows(uint32_t rows, const Visit& visit) {
#if !defined(__OPTIMIZE_SIZE__)
  if (rows == 3) return visit(ConstantRows<3>());
  if (rows == 4) return visit(ConstantRows<4>());
  if (rows == 5) return visit(ConstantRows<5>());
  if (rows == 6) return visit(ConstantRows<6>());
#endif
  visit(rows);
}

/// The distance, in elements, from one row of a coupling's block to the next. `rows`: number of rows of the coupling's
/// joint that is eliminated later.
constexpr uint32_t block_stride(uint32_t rows) { return !DETENT_JOINT_LANES ? rows : rows > 4 ? 8 : 4; }

/// Sets Island::substeps to the least number of substeps that the joints permit, and Island::joint_need to the square
/// of the number that their motion needs.
void require_substeps(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> slots,
                      const JointStage& stage, Island& island);

/// The impulses of rows that oppose each other can grow up to (target speed) / softness. Therefore the solve stores
/// impulses and right-hand sides divided by 2^k_impulse_power.
inline constexpr int k_impulse_power = DETENT_FIXED ? 6 : 0;

inline bool is_linear(const JointRow& row) { return !(row.axis == k_no_direction); }
/// The kind of a row: 0 if it is linear, 1 if it is angular.
inline int row_kind(const JointRow& row) { return is_linear(row) ? 0 : 1; }
inline int row_kind(const JointRows& rows, uint32_t k) { return k < 3 && rows.points != 0 ? 0 : row_kind(rows.row[k]); }
/// Index of the first row that is not one of the three rows of the anchor points.
inline uint32_t first_other(const JointRows& rows) { return rows.points != 0 ? 3 : 0; }

/// The unit of impulses of linear (0) or angular (1) rows is 2^impulse_power reference masses times m/s.
inline int impulse_power([[maybe_unused]] const JointWork& work, [[maybe_unused]] int kind) {
  return DETENT_FIXED ? work.power[kind] + k_impulse_power : 0;
}

/// Whether the slot has a joint with rows: not empty, and not a filter joint, which only disables collisions.
inline bool holds(const JointState& joint) {
  return joint.type != 0 && joint.type != static_cast<uint32_t>(JointType::filter);
}
/// Whether the free motion (a degree of freedom that the joint leaves) is an angle.
bool is_angular(JointType type, int motion);
/// Number of free motions that have their own settings (JointDef::axis, second). Settings beyond this number have no
/// meaning, except the spring of a ball joint.
int free_motion_count(JointType type);
/// Whether the joint is a ball joint with a spring, which acts on all its rotations.
DETENT_SHARED inline bool has_ball_spring(const JointState& joint) {
  return static_cast<JointType>(joint.type) == JointType::ball && joint.frequency[0] > k_zero;
}
/// Number of free motions that can be driven. This includes rotations that only friction or the spring of a ball joint
/// can drive.
int driven_motion_count(const JointState& joint);
/// Whether the free motion has limits.
bool is_limited(const JointState& joint, int motion);
/// Whether friction acts on the free motion.
bool is_braked(const JointState& joint, int motion);
/// The free motions on which a limit, spring, motor or friction can act: bit i for free motion i.
uint32_t driven_motions(const JointState& joint);
/// The members of JointRows that make_joint_rows() sets: all, or only `locked_rows`, `points`, `arm`, `error`, and the
/// values of the free motions (`errors`).
enum class RowParts : uint8_t { all, errors };
/// Makes the rows of a joint at the current poses of its bodies. `motions`: the free motions that the caller needs (bit
/// i for free motion i); others may be left out.
void make_joint_rows(const JointStage& stage, const JointWork& work, uint32_t motions, RowParts parts, JointRows& rows);
/// Chooses the drive mode of each free motion, before the first solve of the substep. Activates each limit that the
/// motion would pass in this substep.
void choose_drives(const StepSettings& settings, const SolverBodies& bodies, const JointStage& stage, JointWork& work);
/// Whether the impulse of a motor, spring or friction exceeds its limit in the substep. If `changes` is true, replaces
/// the row of such a drive by a constant impulse at that limit.
bool bound_drives(const JointState& joint, Scaled share, bool changes, JointWork& work);
/// Whether the free motion is locked or at a limit.
inline bool is_at_limit(DriveMode mode) {
  return mode == DriveMode::held || mode == DriveMode::lower || mode == DriveMode::upper;
}
/// Whether the row locks a motion: it always acts, or it is the row of an active limit.
inline bool is_locked(const JointWork& work, uint32_t row) {
  return row < work.locked_rows || (work.driven[0] == row && is_at_limit(work.mode[0])) ||
         (work.driven[1] == row && is_at_limit(work.mode[1]));
}
/// Activates each limit that the bodies, at their current velocities, would pass by more than k_passed. A motor or
/// friction that acts with its greatest force gets a row again if it drives the motion beyond its target speed.
/// `loads`: the contacts will be solved again in this substep, and may still change the speed of the motion. Then a
/// motor or friction gets no row again, and stays at its greatest force. Returns whether a drive mode changed.
bool take_up(const StepSettings& settings, const SolverBodies& bodies, const JointStage& stage, bool loads,
             JointWork& work);
/// Whether a motor or friction of the joint acts with its greatest force, so that it may drive a motion beyond its
/// target speed.
bool may_overdrive(const JointState& joint, const JointWork& work);
/// Whether the impulse of an active limit pulls the motion towards the limit, which a limit cannot do. If `changes` is
/// true, deactivates the first such limit.
bool release_limits(const JointState& joint, bool changes, JointWork& work);
/// Adds the rows of the driven free motions after the rows that always act, and sets their targets.
void add_driven_rows(const StepSettings& settings, const SolverBodies& bodies, const JointStage& stage,
                     JointWork& work);
/// The linear impulse of the joint on B so far in the current substep, in the unit of the joint's linear rows.
Vec3<Real> linear_impulse(const JointWork& work);
/// The magnitude of `impulse`, which is in the unit of the joint's linear rows, divided by the mass of the lighter
/// body, m/s. Overflow: clamps to k_joint_impulse_max.
Real pull_of(const JointWork& work, const Vec3<Real>& impulse);
/// Replaces an impulse below 2^-40 by 0, so that the squares of impulses do not underflow.
inline Real zero_if_tiny(Real impulse) { return abs(impulse) < Real(0x1p-40) ? k_zero : impulse; }
/// The reference mass of a joint's assembly, kg: masses and impulses of the assembly are divided by it.
Scaled reference_mass(const SolverBodies& bodies, const JointStage& stage, const JointWork& work);
/// JointWork::pull (the impulse in a substep divided by the mass of the lighter body) at the start of a tick, m/s, for
/// the current number of substeps. It is computed from the mean force of the joint in the last tick. It is at least the
/// pull of the stored impulses, which are the warm start, and at most twice that pull.
Real last_pull(const StepSettings& settings, const SolverBodies& bodies, const JointStage& stage,
               const JointWork& work);
/// Sets JointWork::kept to the stored impulses, scaled to the current number of substeps. Range: choose_unit() has been
/// called. Overflow: clamps to Real's range.
void load_impulses(const StepSettings& settings, const JointStage& stage, JointWork& work);
/// Stores the impulses with which the first substep of the next tick begins: those of the last of `substeps` substeps,
/// without the impulses that follow curved paths. Overflow: each impulse is clamped to k_joint_impulse_max.
void store_impulses(uint32_t substeps, const JointWork& work, JointState& joint);
/// Sets a body's inertia for this substep. About each axis of the body, the inertia is at least h sum |impulse| |arm|
/// over the joints of the body, with the length h, s, of the substep. Without this lower bound, strong forces on a
/// light body would make the body oscillate faster than a substep can follow. The angular momentum does not change, so
/// a body with a larger inertia rotates more slowly. Also sets the body's inverse inertia, and its response to forces
/// and torques. The body's pose must be set before the call.
void load_inertia(const StepSettings& settings, const SolverBodies& bodies, const JointStage& stage, JointBody& body);
/// Converts an angular momentum from the inertia of the substep to the body's own inertia, at equal angular velocity.
Vec3<Real> own_angular_momentum(const JointBody& body, const Vec3<Real>& angular_momentum);
/// The inverse of own_angular_momentum(): converts from the body's own inertia to that of the substep. Overflow:
/// clamps, and sets `saturated`.
Vec3<Real> lent_angular_momentum(const JointBody& body, const Vec3<Real>& angular_momentum, bool& saturated);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
