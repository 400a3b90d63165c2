#pragma once
#include <detent/detail/scratch.h>
#include <detent/features.h>
#include <detent/joint.h>

#include "base/span.h"
#include "dynamics/solve.h"

/// The joints of a step. A joint's row holds the speed
///
///     axis . (velocity B - velocity A) + arm B . spin B - arm A . spin A
///
/// and its impulse goes the same way back. Joints make trees of the bodies that move; those of a tree are solved at
/// once, by elimination from the leaves: a body whose joints below are held answers to a wrench with less than its own
/// response, and that is all that the joint above needs to know. What does not move has no response and joins no trees:
/// a chain between two walls is a tree. The few joints that close loops are solved in turn with the trees.
/// Source: Baraff, "Linear-time dynamics using Lagrange multipliers", SIGGRAPH 1996; Featherstone, "Rigid Body Dynamics
/// Algorithms", 2008, chapter 7.
namespace detent {
inline namespace DETENT_NAMESPACE {

inline constexpr uint32_t k_no_link = UINT32_MAX;
inline constexpr Real k_joint_impulse_max = 8192.0;  ///< of a row, m/s
/// What a joint keeps is what its force would give in 2^-k_kept_power of a tick, however many substeps that has.
inline constexpr int k_kept_power = 3;

/// Lengths or speeds in units of 2^exponent, held within what a Unit holds.
Vec3<Unit> unit_held(const Vec3<Real>& v, int exponent);

struct JointStage {
  Span<JointState> joints;  ///< the slots that were ever used
  Span<const BodyPose> poses;
  Span<const BodyActivity> activities;
  Span<JointWork> work;     ///< of those at work, in the order of their slots
  Span<JointBody> bodies;   ///< that they hold
  Span<uint32_t> order;     ///< of `work`: island by island, from the roots up
  uint32_t count = 0;       ///< of `work`
  uint32_t body_count = 0;  ///< of `bodies`
};

/// Takes up all joints that hold a body that is awake, and the bodies that they hold, which have been started
/// (predict.h). Fills `work`, `bodies`.
void collect_joints(const SolverBodies& bodies, JointStage& stage);

/// Grows the trees of every island whose bodies `slots` lists, and says how many substeps their joints need.
void grow_trees(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> slots,
                Span<Island> islands, JointStage& stage);

/// Solves the joints of an island once, `elapsed` after the start of the tick: where the bodies are now, for where they
/// will be at the end of the substep. Returns how many values were clamped, and adds to `undecided`.
uint32_t solve_joints(const StepSettings& settings, const SolverBodies& bodies, const Island& island, Real elapsed,
                      JointStage& stage, uint32_t& undecided);

/// Stores the reactions of the tick.
void store_reactions(const StepSettings& settings, const SolverBodies& bodies, JointStage& stage);

/// For a feature table.
struct JointCode {
  decltype(&collect_joints) collect;
  decltype(&grow_trees) grow;
  decltype(&solve_joints) solve;
  decltype(&store_reactions) store;
};

// Of the stages above.

/// The squared number of substeps that an island's joints need, whose trees have been grown; 0: any number.
Scaled squared_substeps(const StepSettings& settings, const SolverBodies& bodies, const Island& island,
                        JointStage& stage);

/// Whether a free motion, 0 or 1, is an angle.
bool is_angular(JointType type, int motion);
/// The squared angle by which the body that swings fastest under the pulls of its joints would do so in a tick, as far
/// as the last one tells. Their arms are set. Only of pulls at points; leaves the bodies' `stiffness`.
Scaled swing_of_tick(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> joints,
                     JointStage& stage);
/// Heavy pulls at a light body make it sway faster than a substep can follow, and each one would add to it: such a body
/// is slowed. The rows of the joints are made; sets `turn_share` of the bodies they own, and takes their `stiffness`:
/// in the first substep of a tick that of swing_of_tick().
/// Source: Tournier, Nesme, Gilles, Faure, "Stable constrained dynamics", 2015; that only what is too stiff is damped:
/// Andrews, Teichmann, Kry, "Geometric stiffness for real-time constrained multibody dynamics", 2017.
void hold_sway(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> joints, bool first,
               JointStage& stage);
/// Makes the rows of a joint as its bodies are now.
void make_joint_rows(const StepSettings& settings, const JointStage& stage, JointWork& work);
/// Chooses how the free motions are driven, before anything is solved: a limit that the bodies would pass in this
/// substep holds. Nothing has acted in it yet.
void choose_drives(const StepSettings& settings, const SolverBodies& bodies, const JointStage& stage, JointWork& work);
/// Whether, with the impulses that were found, a limit would pull or a motor or spring do more than it can in the
/// substep. If `changes`, they are then driven otherwise.
bool revise_drives(const JointState& joint, Scaled share, bool changes, JointWork& work);
/// Adds the rows of the free motions that are driven, or notes what pushes without one.
void add_driven_rows(const StepSettings& settings, const SolverBodies& bodies, const JointStage& stage,
                     JointWork& work);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
