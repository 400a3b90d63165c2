#pragma once
#include <detent/detail/scratch.h>
#include <detent/features.h>
#include <detent/joint.h>

#include "base/span.h"
#include "motion/angular_velocity.h"
#include "motion/solver_bodies.h"
#include "motion/step_settings.h"

/// The joints of a step. With the columns (v_A, w_A, v_B, w_B) of velocities and angular velocities, a joint's row has
/// the Jacobian
///
///     J = (-axis, -arm_A, axis, arm_B)
///
/// so its speed is J v = axis . (v_B - v_A) + arm_B . w_B - arm_A . w_A, and its impulse x applies the wrench J^T x. C
/// is the row's error of position (JointRows::error); joint_rows.cpp has the J and C of each joint. All rows of an
/// island are solved at once, whatever graph the joints form:
///
///     (K + S) x = target - J v,  K = J M^-1 J^T
///
/// S is a small diagonal softness, so redundant rows need no special rule; the row of a spring has a larger one. The
/// factor of K + S is a block L D L^T over the graph of the joints, eliminated by minimum degree (joint_order.cpp,
/// joint_factor.h). It is made anew in each substep.
///
/// A substep gains no energy (joint_solve.cpp). Solving the rows projects the velocities, which only removes energy.
/// Then velocities are added that make the joints follow their curved paths; they are scaled so that they add no more
/// energy than the projection has removed. Errors of position are corrected by shifts without velocity. Sources of the
/// parts of the scheme: Baraff, "Linear-time dynamics using Lagrange multipliers", SIGGRAPH 1996; Tournier, Nesme,
/// Gilles, Faure, "Stable constrained dynamics", 2015; George, Liu, "The evolution of the minimum degree ordering
/// algorithm", 1989.
namespace detent {
inline namespace DETENT_NAMESPACE {

inline constexpr uint32_t k_no_link = UINT32_MAX;
inline constexpr Real k_joint_impulse_max = 16384.0;  ///< limit of a stored row impulse, m/s
/// The impulses that a joint stores are those of its force over 2^-k_kept_power of a tick, whatever the number of
/// substeps is.
inline constexpr int k_kept_power = 3;

/// Lengths or speeds in units of 2^exponent, clamped to the range of a Unit.
Vec3<Unit> clamped_unit(const Vec3<Real>& v, int exponent);

struct JointStage {
  Span<JointState> joints;  ///< all slots that have ever been used
  Span<const BodyPose> poses;
  Span<const BodyActivity> activities;
  Span<JointWork> work;    ///< the active joints, in the order of their slots
  Span<JointBody> bodies;  ///< the bodies of the active joints
  /// Indices into `work`: island by island, in the order of elimination.
  Span<uint32_t> order;
  Span<JointCoupling> couplings;  ///< couplings of the factor
  Span<Real> numbers;             ///< elements of the factor's blocks
  uint32_t count = 0;             ///< number of entries in `work`
  uint32_t body_count = 0;        ///< number of entries in `bodies`
};

/// Collects all joints with an awake body, and the bodies of these joints. start_body() (predict.h) must have been
/// called for the bodies. Fills `work` and `bodies`.
void collect_joints(const SolverBodies& bodies, JointStage& stage);

/// Orders the joints of every island by elimination, makes the couplings that their factor needs, and sets the number
/// of substeps that they need. `slots` lists the bodies by island. Returns the number of couplings that had no room.
uint32_t order_joints(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> slots,
                      Span<Island> islands, JointStage& stage);

/// Begins a substep of an island, `elapsed` after the start of the tick: makes the joints' rows, stores the velocities
/// before anything acts, and sets the bodies' inverse inertias, which joints and contacts both use in the substep.
void begin_joints(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> slots,
                  const Island& island, Real elapsed, JointStage& stage);

/// Whether a body's inverse inertia has changed since the last substep.
inline bool has_renewed_inverse_inertia(const BodyWork& now, const JointStage& stage) {
  return now.joint_body != UINT32_MAX && stage.bodies[now.joint_body].renewed != 0;
}

/// Solves the joints' rows for the bodies' current velocities, `elapsed` after the start of the tick. Returns the
/// number of values that were clamped, and adds to `undecided`.
uint32_t solve_joints(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> slots,
                      const Island& island, Real elapsed, JointStage& stage, uint32_t& undecided);

/// Solves the rows again, to remove the speed that contacts have added since. Returns the number of values that were
/// clamped, and adds to `undecided`.
uint32_t solve_joints_again(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> slots,
                            const Island& island, Real elapsed, JointStage& stage, uint32_t& undecided);

/// Adds the velocities by which the joints follow their curved paths, and computes the shifts that close gaps. Returns
/// the number of values that were clamped.
uint32_t follow_joints(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> slots,
                       const Island& island, Real elapsed, JointStage& stage);

/// Applies the shifts that close gaps, after the bodies have moved. Then converts the bodies' angular momenta back to
/// those with the inertia of the substep. Returns the number of values that were clamped.
uint32_t shift_joints(const SolverBodies& bodies, Span<const uint32_t> slots, JointStage& stage);

/// Ends a substep of an island: removes the speed that contacts have added to the rows since, adds up the impulses of
/// the joints, and restores the bodies' own inverse inertias and angular momenta. Returns the number of values that
/// were clamped, and adds to `undecided`.
uint32_t end_joints(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> slots,
                    const Island& island, Real elapsed, JointStage& stage, uint32_t& undecided);

/// Stores the forces and torques of the joints in the tick.
void store_reactions(const StepSettings& settings, const SolverBodies& bodies, JointStage& stage);

/// Entry of the feature table.
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

// Functions that the files of the stages share.

/// Sets the lowest number of substeps for the joints of an island, and the squared number that their motion needs.
void require_substeps(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> slots,
                      const JointStage& stage, Island& island);

/// Impulses of rows that cancel each other grow up to (target speed) / softness. So impulses are stored divided by
/// 2^k_impulse_power, in the unit in which responses are near 1, and speeds multiplied by it.
inline constexpr int k_impulse_power = DETENT_FIXED ? 6 : 0;

inline bool is_linear(const JointRow& row) { return !(row.axis == k_no_direction); }
/// 0: linear row; 1: angular row.
inline int row_kind(const JointRow& row) { return is_linear(row) ? 0 : 1; }
inline int row_kind(const JointRows& rows, uint32_t k) { return k < 3 && rows.points != 0 ? 0 : row_kind(rows.row[k]); }

/// The unit of impulses of linear (0) or angular (1) rows is 2^impulse_power reference masses times m/s.
inline int impulse_power(const JointWork& work, int kind) { return work.power[kind] + k_impulse_power; }

/// Whether the slot has a joint with rows: not empty, and not a filter joint, which only disables collisions.
inline bool holds(const JointState& joint) {
  return joint.type != 0 && joint.type != static_cast<uint32_t>(JointType::filter);
}
/// Whether the free motion is an angle.
bool is_angular(JointType type, int motion);
/// Number of free motions that have their own settings. The settings of all others have no meaning, except the spring
/// of a ball joint.
int free_motion_count(JointType type);
/// Number of free motions that can be driven. This includes rotations that have only friction, or the spring of a ball
/// joint.
int driven_motion_count(const JointState& joint);
/// Whether the free motion has limits.
bool is_limited(const JointState& joint, int motion);
/// Whether a limit, spring, motor or friction can act on the free motion.
bool is_driven(const JointState& joint, int motion);
/// Whether friction acts on the free motion.
bool is_braked(const JointState& joint, int motion);
/// The rows of a joint at the current poses of its bodies.
JointRows make_joint_rows(const JointStage& stage, const JointWork& work);
/// Chooses the drive mode of each free motion, before the rows are solved and before anything acts in the substep: a
/// limit that the motion would pass in this substep is activated.
void choose_drives(const StepSettings& settings, const SolverBodies& bodies, const JointStage& stage, JointWork& work);
/// Whether the impulse of a motor, spring or friction exceeds its limit in the substep. If `changes`, replaces the row
/// by a constant impulse at that limit.
bool bound_drives(const JointState& joint, Scaled share, bool changes, JointWork& work);
/// Whether the free motion is locked or at a limit.
inline bool is_at_limit(DriveMode mode) {
  return mode == DriveMode::held || mode == DriveMode::lower || mode == DriveMode::upper;
}
/// Whether the row locks a motion. An active limit does.
inline bool is_locked(const JointWork& work, uint32_t row) {
  return row < work.locked_rows || (work.driven[0] == row && is_at_limit(work.mode[0])) ||
         (work.driven[1] == row && is_at_limit(work.mode[1]));
}
/// Activates limits that were not active and that the bodies, at their current velocities, would pass by more than
/// k_passed. A motor or friction that acts with its greatest force gets a row again if it drives the motion beyond its
/// target speed. Skips motors and friction if the island `touches`: contacts are solved in alternation and may still
/// load them. Returns whether anything changed.
bool take_up(const StepSettings& settings, const SolverBodies& bodies, const JointStage& stage, bool touches,
             JointWork& work);
/// Whether the impulse of an active limit would pull. If `changes`, deactivates that limit.
bool release_limits(const JointState& joint, bool changes, JointWork& work);
/// Adds the rows of the driven free motions.
void add_driven_rows(const StepSettings& settings, const SolverBodies& bodies, const JointStage& stage,
                     JointWork& work);
/// The stored force on B in the last substep: the sum of the impulses along the axes of its linear rows.
Real last_pull(const JointStage& stage, const JointWork& work);
/// Sets a body's inertia for this substep: about each of its axes at least the stiffness of the joints' pulls, h sum
/// |impulse| |arm|. So strong forces on a light body do not make it oscillate faster than a substep can follow. Its
/// inverse inertia becomes that of the substep and its angular momentum stays the same, so the body rotates more
/// slowly. Also sets the body's response to forces and torques. The body's pose must be set.
void load_inertia(const StepSettings& settings, const SolverBodies& bodies, const JointStage& stage, JointBody& body);
/// The angular momentum with the body's own inertia, at the angular velocity that it has with the inertia of the
/// substep.
Vec3<Real> own_angular_momentum(const JointBody& body, const Vec3<Real>& angular_momentum);
/// The inverse of own_momentum(). Overflow: clamps, and sets `saturated`.
Vec3<Real> lent_angular_momentum(const JointBody& body, const Vec3<Real>& angular_momentum, bool& saturated);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
