#include "dynamics/gyration.h"
#include "dynamics/joint.h"
#include "math/scaled.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// What a substep follows without gaining energy is (rate x substep)^2 = 4 of a swing (symplectic Euler), less a
/// margin: the pulls are those of the last substep.
constexpr Real k_followed = 3.0;
/// No body is slowed as if it swung faster: a chain that is taut between two walls pulls without bound.
constexpr Real k_swing_max = 48.0;
constexpr Real k_stiffness_max = 32768.0;  ///< far beyond what a substep follows; two sums of it fit

bool holds_points(JointType type) {
  return type != JointType::slider && type != JointType::wheel && type != JointType::distance;
}

/// The force on B in the last substep, as it is kept, of a joint that holds no points.
Vec3<Real> pull_of(const JointState& joint, const JointWork& work) {
  Vec3<Real> pull = {k_zero, k_zero, k_zero};
  for (uint32_t k = 0; k < work.rows_held; ++k) pull += work.row[k].axis * joint.impulse[k];
  for (uint32_t i = 0; i < 2 && work.rows_held + i < k_joint_rows_max; ++i)
    pull += work.free_row[i].axis * joint.impulse[work.rows_held + i];
  return pull;
}

/// A force F at an arm r turns a body back as it turns: with the stiffness K = (F.r) - F r^T. The squared rates of its
/// swings are the eigenvalues of G K, where G is 1 / inertia; their sum, tr(G) (F.r) - F.G r, is above each. This is a
/// quarter of it in mantissas of gyration.
Real stiffness(const WorldGyration& gyration, const Vec3<Real>& pull, const Vec3<Unit>& arm) {
  const auto quarter = [](Unit value) { return scale_by_power(value, -2); };
  const Unit trace = quarter(gyration.row[0].x) + quarter(gyration.row[1].y) + quarter(gyration.row[2].z);
  return dot(pull, arm * trace - multiply(gyration, Vec3<Unit>{quarter(arm.x), quarter(arm.y), quarter(arm.z)}));
}

/// The body's inertia grows by what the pulls add to it in an implicit step, and its momentum does not: so what is
/// added damps. (If only torques gave less, energy would come in as the pulls change.)
void slow(const SolverBodies& bodies, Scaled share, JointBody& body) {
  Vec3<Real>& momentum = bodies.motions[body.slot].momentum;
  const Vec3<Real> before = momentum;
  momentum = multiply(before, share);
  if (DETENT_FIXED) bodies.work[body.slot].contact_momentum += before - momentum;  // it is not the contacts'
  body.spin = multiply(body.spin, share);
  body.turn_share = multiply(body.turn_share, share);
}

/// Adds what a joint's pull adds to its bodies' stiffness.
void add_pull(const SolverBodies& bodies, const JointWork& work, const Vec3<Real>& pull, JointStage& stage) {
  for (uint32_t end = 0; end < 2; ++end) {
    JointBody& body = stage.bodies[work.body[end]];
    if (body.mobile == 0) continue;
    const Real own = stiffness(bodies.work[body.slot].gyration, pull, work.arm[end]);
    body.stiffness = clamp(body.stiffness + (end == 0 ? -own : own), -k_stiffness_max, k_stiffness_max);
  }
}

/// Adds the pulls of joints that hold points, or of the others, whose rows must be made.
void add_pulls(const SolverBodies& bodies, Span<const uint32_t> joints, bool of_points, JointStage& stage) {
  for (const uint32_t index : joints) {
    const JointWork& work = stage.work[index];
    const JointState& joint = stage.joints[work.joint];
    if (holds_points(static_cast<JointType>(joint.type)) != of_points) continue;
    if (of_points)
      add_pull(bodies, work, {joint.impulse[0], joint.impulse[1], joint.impulse[2]}, stage);
    else
      add_pull(bodies, work, pull_of(joint, work), stage);
  }
}

/// (rate x time)^2 of a body's swing under the pulls that were added up; `time`: substep x tick, s^2, over the tick.
Real swing_of(const SolverBodies& bodies, Scaled time, const JointBody& body) {
  const int power = bodies.work[body.slot].gyration.exponent + body.above - body.exponent + 2 + k_kept_power;
  bool saturated = false;
  return multiply(body.stiffness, scaled_by_power(multiply(body.turn_share, time), power), saturated);
}

template <class Visit>
void each_owned(Span<const uint32_t> joints, JointStage& stage, const Visit& visit) {
  for (const uint32_t index : joints) {
    for (const uint32_t place : stage.work[index].body) {
      JointBody& body = stage.bodies[place];
      if (body.mobile != 0 && body.owner == index) visit(body);
    }
  }
}

}  // namespace

Scaled swing_of_tick(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> joints,
                     JointStage& stage) {
  add_pulls(bodies, joints, true, stage);
  const Scaled time = scaled_from(settings.tick_time);
  Real most = k_zero;
  each_owned(joints, stage, [&](JointBody& body) {
    body.turn_share = scaled_by_power(body.share, body.above);
    most = max(most, swing_of(bodies, time, body));
  });
  return scaled_from(most);
}

void hold_sway(const StepSettings& settings, const SolverBodies& bodies, Span<const uint32_t> joints, bool first,
               JointStage& stage) {
  if (!first) add_pulls(bodies, joints, true, stage);
  add_pulls(bodies, joints, false, stage);
  const Scaled time = multiply(scaled_from(settings.time), settings.share);
  each_owned(joints, stage, [&](JointBody& body) {
    body.turn_share = scaled_by_power(body.share, body.above);
    const Real swing = swing_of(bodies, time, body);
    if (swing > k_followed) slow(bodies, divide(scaled_from(k_followed), scaled_from(min(swing, k_swing_max))), body);
    body.stiffness = k_zero;
  });
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
