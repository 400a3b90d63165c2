#pragma once
#include <detent/detail/scratch.h>
#include <detent/features.h>
#include <detent/joint.h>

#include "base/span.h"
#include "motion/solver_bodies.h"
#include "motion/spin.h"
#include "motion/step_settings.h"

/// The joints of a step. A joint's row holds the speed
///
///     axis . (velocity B - velocity A) + arm B . spin B - arm A . spin A
///
/// and its impulse goes the same way back. The rows of all joints of an island, J, are held at once, whatever they
/// form: with the bodies' responses W, the impulses x of J W J^T x = (wanted speeds - J v) come from a block L D L^T of
/// the joints' graph, eliminated by minimum degree (joint_order.cpp, joint_factor.h), made anew in each substep. Each
/// row is a little soft, so that rows that others hold already need no rule of their own.
///
/// A substep is made to gain no energy (joint_solve.cpp): holding the rows projects the motion, which only takes
/// energy; what is then added so that joints follow the curve of their way is scaled to what the projection took; and
/// errors of positions are made up for without speed. Source of the scheme's parts: Baraff, "Linear-time dynamics using
/// Lagrange multipliers", SIGGRAPH 1996; Tournier, Nesme, Gilles, Faure, "Stable constrained dynamics", 2015; George,
/// Liu, "The evolution of the minimum degree ordering algorithm", 1989.
namespace detent {
inline namespace DETENT_NAMESPACE {

inline constexpr uint32_t k_no_link = UINT32_MAX;
inline constexpr Real k_joint_impulse_max = 16384.0;  ///< of a row, m/s
/// What a joint keeps is what its force would give in 2^-k_kept_power of a tick, however many substeps that has.
inline constexpr int k_kept_power = 3;

/// Lengths or speeds in units of 2^exponent, held within what a Unit holds.
Vec3<Unit> unit_held(const Vec3<Real>& v, int exponent);

struct JointStage {
  Span<JointState> joints;  ///< the slots that were ever used
  Span<const BodyPose> poses;
  Span<const BodyActivity> activities;
  Span<JointWork> work;           ///< of those at work, in the order of their slots
  Span<JointBody> bodies;         ///< that they hold
  Span<uint32_t> order;           ///< of `work`: island by island, in the order of elimination
  Span<JointCoupling> couplings;  ///< of the factor
  Span<Real> numbers;             ///< of its blocks
  uint32_t count = 0;             ///< of `work`
  uint32_t body_count = 0;        ///< of `bodies`
};

/// Takes up all joints that hold a body that is awake, and the bodies that they hold, which have been started
/// (predict.h). Fills `work`, `bodies`.
void collect_joints(const SolverBodies& bodies, JointStage& stage);

/// Lists the joints of every island, whose bodies `slots` lists, in the order in which they are eliminated, with the
/// couplings that their factor needs, and says how many substeps they need. Returns how many couplings had no room.
uint32_t order_joints(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> slots,
                      Span<Island> islands, JointStage& stage);

/// Begins a substep of an island, `elapsed` after the start of the tick: makes the joints' rows, notes how their bodies
/// move before anything acts, and gives these the gyrations that the substep has for joints and contacts alike.
void begin_joints(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> slots,
                  const Island& island, Real elapsed, JointStage& stage);

/// Whether a body's gyration is another than in the last substep.
inline bool has_renewed_gyration(const BodyWork& now, const JointStage& stage) {
  return now.joint_body != UINT32_MAX && stage.bodies[now.joint_body].renewed != 0;
}

/// Holds the joints' rows, `elapsed` after the start of the tick: of the bodies' velocities. Returns how many values
/// were clamped, and adds to `undecided`.
uint32_t hold_joints(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> slots,
                     const Island& island, Real elapsed, JointStage& stage, uint32_t& undecided);

/// Takes out what contacts have added to the rows' speeds since. Returns how many values were clamped, and adds to
/// `undecided`.
uint32_t hold_joints_again(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> slots,
                           const Island& island, Real elapsed, JointStage& stage, uint32_t& undecided);

/// Adds what the curves of the joints' ways ask for, and finds the shifts that close gaps. Returns how many values were
/// clamped.
uint32_t follow_joints(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> slots,
                       const Island& island, Real elapsed, JointStage& stage);

/// Shifts the bodies, which have moved, so that gaps close, and lends them the momentum that they have with the inertia
/// of the substep again. Returns how many values were clamped.
uint32_t shift_joints(const SolverBodies& bodies, Span<const uint32_t> slots, JointStage& stage);

/// Ends a substep of an island: takes out what contacts have added to the rows' speeds since, adds up what the joints
/// gave, and gives the bodies their own gyrations and momenta. Returns how many values were clamped, and adds to
/// `undecided`.
uint32_t end_joints(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> slots,
                    const Island& island, Real elapsed, JointStage& stage, uint32_t& undecided);

/// Stores the reactions of the tick.
void store_reactions(const StepSettings& settings, const SolverBodies& bodies, JointStage& stage);

/// For a feature table.
struct JointOps {
  decltype(&collect_joints) collect;
  decltype(&order_joints) order;
  decltype(&begin_joints) begin;
  decltype(&hold_joints) hold;
  decltype(&hold_joints_again) hold_again;
  decltype(&follow_joints) follow;
  decltype(&shift_joints) shift;
  decltype(&end_joints) end;
  decltype(&store_reactions) store;
};

// Of the stages above.

/// Sets the fewest substeps that an island's joints may have, and the squared number that their motion asks for.
void ask_for_substeps(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> slots,
                      const JointStage& stage, Island& island);

/// Impulses that others cancel grow to the speeds that are asked for over the rows' softness: so they are over
/// 2^k_impulse_power of the unit in which responses are near 1, and speeds under it.
inline constexpr int k_impulse_power = DETENT_FIXED ? 6 : 0;

inline bool is_linear(const JointRow& row) { return !(row.axis == k_no_direction); }
/// 0: linear; 1: angular.
inline int row_kind(const JointRow& row) { return is_linear(row) ? 0 : 1; }
inline int row_kind(const JointRows& rows, uint32_t k) { return k < 3 && rows.points != 0 ? 0 : row_kind(rows.row[k]); }

/// Of a row's impulses: they are over 2^it reference masses.
inline int impulse_power(const JointWork& work, int kind) { return work.power[kind] + k_impulse_power; }

/// Whether a slot has a joint that holds anything: not one that only keeps its bodies from colliding.
inline bool holds(const JointState& joint) {
  return joint.type != 0 && joint.type != static_cast<uint32_t>(JointType::filter);
}
/// Whether a free motion is an angle.
bool is_angular(JointType type, int motion);
/// Those that an axis each describes: what is set of the others has no meaning, but the spring of a ball.
int free_motion_count(JointType type);
/// And with those that friction brakes, or the spring of a ball turns.
int driven_motion_count(const JointState& joint);
/// Whether limits hold a free motion.
bool is_limited(const JointState& joint, int motion);
/// Whether a limit, spring, motor or friction can act on it.
bool is_driven(const JointState& joint, int motion);
/// Whether friction brakes it.
bool is_braked(const JointState& joint, int motion);
/// The rows of a joint as its bodies are now.
JointRows make_joint_rows(const JointStage& stage, const JointWork& work);
/// Chooses how the free motions are driven, before anything is solved: a limit that the bodies would pass in this
/// substep holds. Nothing has acted in it yet.
void choose_drives(const StepSettings& settings, const SolverBodies& bodies, const JointStage& stage, JointWork& work);
/// Whether, with the impulses that were found, a motor, spring or friction would do more than it can in the substep. If
/// `changes`, it then does that.
bool bound_drives(const JointState& joint, Scaled share, bool changes, JointWork& work);
/// Whether a free motion is held where it is.
inline bool is_at_limit(DriveMode mode) {
  return mode == DriveMode::held || mode == DriveMode::lower || mode == DriveMode::upper;
}
/// Whether a row holds something where it is: a limit does while it is reached.
inline bool is_held(const JointWork& work, uint32_t row) {
  return row < work.rows_held || (work.driven[0] == row && is_at_limit(work.mode[0])) ||
         (work.driven[1] == row && is_at_limit(work.mode[1]));
}
/// Whether the bodies, as they move now, would pass limits that did not act, by more than a little, or motors and
/// friction at their greatest force take them beyond the speeds that they want: those limits act now, and those drives
/// hold. Drives not where the island `touches`: contacts, which are held in turn, may load them yet.
bool take_up(const StepSettings& settings, const SolverBodies& bodies, const JointStage& stage, bool touches,
             JointWork& work);
/// Whether, with those impulses, a limit would pull. If `changes`, it does not act.
bool release_limits(const JointState& joint, bool changes, JointWork& work);
/// Adds the rows of the free motions that are driven, or notes what pushes without one.
void add_driven_rows(const StepSettings& settings, const SolverBodies& bodies, const JointStage& stage,
                     JointWork& work);
/// The force on B in the last substep, as it is kept: of the rows that push along something.
Real last_pull(const JointStage& stage, const JointWork& work);
/// Gives a body the inertia that its joints' pulls let it have in this substep: about each of its axes no less than a
/// substep's stiffness of the pulls, h sum |impulse| |arm|, so that heavy pulls at a light body do not make it sway
/// faster than a substep can follow. Its gyration becomes that one's, its momentum stays, so it is slowed. And notes
/// how it responds to forces and torques. The body is placed.
void load_inertia(const StepSettings& settings, const SolverBodies& bodies, const JointStage& stage, JointBody& body);
/// The momentum with its own inertia of a body that spins as it does with that of the substep.
Vec3<Real> own_momentum(const JointBody& body, const Vec3<Real>& momentum);
/// And back. Overflow: clamps, and sets `saturated`.
Vec3<Real> lent_momentum(const JointBody& body, const Vec3<Real>& momentum, bool& saturated);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
