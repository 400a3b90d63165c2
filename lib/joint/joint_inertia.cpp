#include "joint/joint.h"
#include "math/root.h"
#include "math/scaled.h"
#include "motion/angular_velocity.h"
#include "motion/inverse_inertia.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// The sum of |impulse| |arm| over the body's joints, divided by the body's mass and unit of length.
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
  for (uint32_t k = work.points != 0 ? 3 : 0; k < work.locked_rows; ++k) pull += work.row[k].axis * joint.impulse[k];
  for (uint32_t i = 0; i < k_free_motions && work.locked_rows + i < k_joint_rows_max; ++i)
    pull += work.free_row[i].axis * joint.impulse[work.locked_rows + i];
  return length(pull);
}

void load_inertia(const StepSettings& settings, const SolverBodies& bodies, const JointStage& stage, JointBody& body) {
  const BodyProperties& properties = bodies.properties[body.slot];
  BodyWork& now = bodies.work[body.slot];
  // Divided by the mass and the square of the body's unit, as the inertia per unit mass is.
  const Scaled pulls = multiply(pulls_on(stage, body), multiply(scaled_from(settings.time), settings.share));
  const Scaled least = scaled_by_power(pulls, k_kept_power + body.exponent - 2 * properties.size_exponent);
  body.slowed = 0;
  Scaled about[3];
  for (int i = 0; i < 3; ++i) {
    body.kept_rotation[i] = Scaled(1.0);
    about[i] = properties.inverse_inertia[i];
    const Scaled over = multiply(least, properties.inverse_inertia[i]);
    if (!less(Scaled(1.0), over)) continue;
    body.slowed = 1;
    body.kept_rotation[i] = divide(Scaled(1.0), over);
    about[i] = divide(Scaled(1.0), least);
  }
  if (body.slowed != 0) {
    now.inverse_inertia = world_inverse_inertia(about, body.axes);
    body.renewed = 1;
  }
  const WorldInverseInertia& inverse_inertia = now.inverse_inertia;
  const Scaled rotational = scaled_by_power(body.inverse_mass, inverse_inertia.exponent + 2 * body.above);
  bool saturated = false;
  body.pushed = to_real(body.inverse_mass, saturated);
  for (int i = 0; i < 3; ++i) {
    const Vec3<Unit>& row = inverse_inertia.row[i];
    body.turned[i] =
        multiply({real_from_unit(row.x, 0), real_from_unit(row.y, 0), real_from_unit(row.z, 0)}, rotational);
  }
}

Vec3<Real> own_angular_momentum(const JointBody& body, const Vec3<Real>& angular_momentum) {
  if (body.slowed == 0) return angular_momentum;
  const Vec3<Real> local = multiply_transposed(body.axes, angular_momentum);
  return multiply(body.axes,
                  Vec3<Real>{multiply(local.x, body.kept_rotation[0]), multiply(local.y, body.kept_rotation[1]),
                             multiply(local.z, body.kept_rotation[2])});
}

Vec3<Real> lent_angular_momentum(const JointBody& body, const Vec3<Real>& angular_momentum, bool& saturated) {
  if (body.slowed == 0) return angular_momentum;
  const Vec3<Real> local = multiply_transposed(body.axes, angular_momentum);
  const auto lent = [&](Real part, int axis) {
    return multiply(part, divide(Scaled(1.0), body.kept_rotation[axis]), saturated);
  };
  return multiply(body.axes, Vec3<Real>{lent(local.x, 0), lent(local.y, 1), lent(local.z, 2)});
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
