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

Vec3<Real> linear_impulse(const JointWork& work) {
  Vec3<Real> sum = k_zero_vector;
  const auto add_row = [&](const JointRow& row, Real impulse) {
    if (is_linear(row)) sum += row.axis * impulse;
  };
  if (work.points != 0) sum = {work.total[0], work.total[1], work.total[2]};
  for (uint32_t k = first_other(work); k < work.locked_rows; ++k) add_row(work.row[k], work.total[k]);
  for (int i = 0; i < k_free_motions; ++i) add_row(work.free_row[i], work.driven_total[i] + work.given[i]);
  return sum;
}

Real pull_of(const JointWork& work) {
  bool saturated = false;
  const Scaled unit = scaled_by_power(work.over_lighter, impulse_power(work, 0));
  return min(multiply(length(linear_impulse(work)), unit, saturated), k_joint_impulse_max);
}

Real last_pull(const StepSettings& settings, const JointStage& stage, const JointWork& work) {
  const Real(&impulse)[k_joint_rows_max] = stage.joints[work.joint].impulse;
  Vec3<Real> sum = k_zero_vector;
  if (work.points != 0) sum = {impulse[0], impulse[1], impulse[2]};
  for (uint32_t k = first_other(work); k < work.locked_rows; ++k) sum += work.row[k].axis * impulse[k];
  for (uint32_t i = 0; i < k_free_motions && work.locked_rows + i < k_joint_rows_max; ++i)
    sum += work.free_row[i].axis * impulse[work.locked_rows + i];
  bool saturated = false;
  return min(multiply(length(sum), scaled_by_power(settings.share, k_kept_power), saturated), k_joint_impulse_max);
}

void store_impulses(uint32_t substeps, const JointWork& work, JointState& joint) {
  const Real now = pull_of(work);
  Scaled share = multiply(scaled_by_power(scaled_from_count(substeps), -k_kept_power), work.over_lighter);
  if (now > work.pull) share = multiply(share, divide(scaled_from(work.pull), scaled_from(now)));
  const auto store = [&](uint32_t k, int kind, Real total) {
    bool saturated = false;
    const Real impulse = multiply(total, scaled_by_power(share, impulse_power(work, kind)), saturated);
    joint.impulse[k] = clamp(impulse, -k_joint_impulse_max, k_joint_impulse_max);
  };
  for (uint32_t k = 0; k < work.locked_rows; ++k) store(k, row_kind(work, k), work.total[k]);
  for (uint32_t i = 0; i < k_free_motions && work.locked_rows + i < k_joint_rows_max; ++i)
    store(work.locked_rows + i, row_kind(work.free_row[i]), work.driven_total[i] + work.given[i]);
}

void load_inertia(const StepSettings& settings, const SolverBodies& bodies, const JointStage& stage, JointBody& body) {
  const BodyProperties& properties = bodies.properties[body.slot];
  BodyWork& now = bodies.work[body.slot];
  // Divided by the mass and the square of the body's unit, as the inertia per unit mass is.
  const Scaled pulls = multiply(pulls_on(stage, body), scaled_from(settings.time));
  const Scaled least = scaled_by_power(pulls, body.exponent - 2 * properties.size_exponent);
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
