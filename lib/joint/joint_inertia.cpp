#include "joint/joint.h"
#include "math/root.h"
#include "math/scaled.h"
#include "motion/gyration.h"
#include "motion/spin.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// The sum over the body's joints of impulse times arm, over its mass and its unit of length.
Scaled pulls_on(const JointStage& stage, const JointBody& body) {
  Scaled sum = Scaled(0.0);
  for (uint32_t link = body.first; link != k_no_link;) {
    const JointWork& work = stage.work[link / 2];
    const uint32_t end = link % 2;
    link = work.next[end];
    if (work.pull > k_zero)
      sum = add(sum, multiply(work.lighter_over[end], scaled_from(work.pull * work.arm_length[end])));
  }
  return sum;
}

}  // namespace

Real last_pull(const JointStage& stage, const JointWork& work) {
  const JointState& joint = stage.joints[work.joint];
  Vec3<Real> pull = k_zero_vector;
  if (work.points != 0) pull = {joint.impulse[0], joint.impulse[1], joint.impulse[2]};
  for (uint32_t k = work.points != 0 ? 3 : 0; k < work.rows_held; ++k) pull += work.row[k].axis * joint.impulse[k];
  for (uint32_t i = 0; i < k_free_motions && work.rows_held + i < k_joint_rows_max; ++i)
    pull += work.free_row[i].axis * joint.impulse[work.rows_held + i];
  return length(pull);
}

void load_inertia(const StepSettings& settings, const SolverBodies& bodies, const JointStage& stage, JointBody& body) {
  const BodyTraits& traits = bodies.traits[body.slot];
  BodyWork& now = bodies.work[body.slot];
  // Over the mass and the square of the body's own unit, like the inertia 1 / gyration.
  const Scaled pulls = multiply(pulls_on(stage, body), multiply(scaled_from(settings.time), settings.share));
  const Scaled least = scaled_by_power(pulls, k_kept_power + body.exponent - 2 * traits.size_exponent);
  body.slowed = 0;
  Scaled about[3];
  for (int i = 0; i < 3; ++i) {
    body.kept_turn[i] = Scaled(1.0);
    about[i] = traits.gyration[i];
    const Scaled over = multiply(least, traits.gyration[i]);
    if (!less(Scaled(1.0), over)) continue;
    body.slowed = 1;
    body.kept_turn[i] = divide(Scaled(1.0), over);
    about[i] = divide(Scaled(1.0), least);
  }
  if (body.slowed != 0) {
    now.gyration = world_gyration(about, body.axes);
    body.renewed = 1;
  }
  const WorldGyration& gyration = now.gyration;
  const Scaled turn = scaled_by_power(body.share, gyration.exponent + 2 * body.above);
  bool saturated = false;
  body.pushed = to_real(body.share, saturated);
  for (int i = 0; i < 3; ++i) {
    const Vec3<Unit>& row = gyration.row[i];
    body.turned[i] = multiply({real_from_unit(row.x, 0), real_from_unit(row.y, 0), real_from_unit(row.z, 0)}, turn);
  }
}

Vec3<Real> own_momentum(const JointBody& body, const Vec3<Real>& momentum) {
  if (body.slowed == 0) return momentum;
  const Vec3<Real> local = multiply_transposed(body.axes, momentum);
  return multiply(body.axes, Vec3<Real>{multiply(local.x, body.kept_turn[0]), multiply(local.y, body.kept_turn[1]),
                                        multiply(local.z, body.kept_turn[2])});
}

Vec3<Real> lent_momentum(const JointBody& body, const Vec3<Real>& momentum, bool& saturated) {
  if (body.slowed == 0) return momentum;
  const Vec3<Real> local = multiply_transposed(body.axes, momentum);
  const auto lent = [&](Real part, int axis) {
    return multiply(part, divide(Scaled(1.0), body.kept_turn[axis]), saturated);
  };
  return multiply(body.axes, Vec3<Real>{lent(local.x, 0), lent(local.y, 1), lent(local.z, 2)});
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
