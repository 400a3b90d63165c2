#include "joint/joint.h"
#include "math/root.h"
#include "math/scaled.h"
#include "motion/angular_velocity.h"
#include "motion/inverse_inertia.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// The sum of |impulse| |arm| over the body's joints, divided by the mass and the unit of length of the body, m/s.
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

/// The impulses of a joint in this substep: those of the rows that always act (`locked`), then those of the free
/// motions.
struct RowImpulses {
  Real of[k_joint_rows_max] = {};

  RowImpulses(const JointWork& work, const Real (&locked)[k_joint_rows_max]) {
    for (uint32_t k = 0; k < work.locked_rows; ++k) of[k] = locked[k];
    for (uint32_t i = 0; i < free_rows(work); ++i) of[work.locked_rows + i] = work.driven_total[i] + work.given[i];
  }
  static uint32_t free_rows(const JointRows& rows) {
    const uint32_t rest = k_joint_rows_max - rows.locked_rows;
    return rest < k_free_motions ? rest : k_free_motions;
  }
};

/// The sum of impulse times axis over the linear rows. `impulse` is in the order of RowImpulses.
Vec3<Real> linear_sum(const JointRows& rows, const Real (&impulse)[k_joint_rows_max]) {
  Vec3<Real> sum = k_zero_vector;
  const auto add_row = [&](const JointRow& row, Real part) {
    if (is_linear(row)) sum += row.axis * part;
  };
  if (rows.points != 0) sum = {impulse[0], impulse[1], impulse[2]};
  for (uint32_t k = first_other(rows); k < rows.locked_rows; ++k) add_row(rows.row[k], impulse[k]);
  for (uint32_t i = 0; i < RowImpulses::free_rows(rows); ++i) add_row(rows.free_row[i], impulse[rows.locked_rows + i]);
  return sum;
}

/// The magnitude of an impulse. Components below 2^-40 count as 0, so that their squares do not underflow.
Real magnitude_of(const Vec3<Real>& impulse) {
  return length({zero_if_tiny(impulse.x), zero_if_tiny(impulse.y), zero_if_tiny(impulse.z)});
}

}  // namespace

Vec3<Real> linear_impulse(const JointWork& work) { return linear_sum(work, RowImpulses(work, work.total).of); }

Real pull_of(const JointWork& work, const Vec3<Real>& impulse) {
  bool saturated = false;
  const Scaled unit = scaled_by_power(work.over_lighter, impulse_power(work, 0));
  return min(multiply(magnitude_of(impulse), unit, saturated), k_joint_impulse_max);
}

Scaled reference_mass(const SolverBodies& bodies, const JointStage& stage, const JointWork& work) {
  const JointBody &a = stage.bodies[work.body[0]], &b = stage.bodies[work.body[1]];
  const JointBody& mobile = b.mobile != 0 ? b : a;
  return multiply(bodies.properties[mobile.slot].mass, mobile.inverse_mass);
}

Real last_pull(const StepSettings& settings, const SolverBodies& bodies, const JointStage& stage,
               const JointWork& work) {
  const JointState& joint = stage.joints[work.joint];
  const Scaled in_substep = multiply(work.over_lighter, scaled_from(settings.time));
  const Scaled unit = divide(in_substep, reference_mass(bodies, stage, work));
  bool saturated = false;
  const auto part = [&](Scaled force) { return to_real(multiply(force, unit), saturated); };
  const Real mean = magnitude_of({part(joint.force.x), part(joint.force.y), part(joint.force.z)});
  const Scaled share = scaled_by_power(settings.share, k_kept_power);
  const Real last = min(multiply(magnitude_of(linear_sum(work, joint.impulse)), share, saturated), k_joint_impulse_max);
  return clamp(mean, last, scale_by_power(last, 1));
}

void load_impulses(const StepSettings& settings, const JointStage& stage, JointWork& work) {
  const Scaled share = divide(scaled_by_power(settings.share, k_kept_power), work.over_lighter);
  for (uint32_t k = 0; k < work.locked_rows; ++k) {
    const Scaled unit = scaled_by_power(share, -impulse_power(work, row_kind(work, k)));
    bool saturated = false;
    work.kept[k] = multiply(stage.joints[work.joint].impulse[k], unit, saturated);
  }
}

void store_impulses(uint32_t substeps, const JointWork& work, JointState& joint) {
  const RowImpulses impulses(work, work.kept);
  const Scaled share = multiply(scaled_by_power(scaled_from_count(substeps), -k_kept_power), work.over_lighter);
  for (uint32_t k = 0; k < work.locked_rows + RowImpulses::free_rows(work); ++k) {
    const int kind = k < work.locked_rows ? row_kind(work, k) : row_kind(work.free_row[k - work.locked_rows]);
    bool saturated = false;
    const Real impulse = multiply(impulses.of[k], scaled_by_power(share, impulse_power(work, kind)), saturated);
    joint.impulse[k] = clamp(impulse, -k_joint_impulse_max, k_joint_impulse_max);
  }
}

void load_inertia(const StepSettings& settings, const SolverBodies& bodies, const JointStage& stage, JointBody& body) {
  const BodyProperties& properties = bodies.properties[body.slot];
  BodyWork& now = bodies.work[body.slot];
  // `least` is the least inertia divided by the mass and by the square of the body's unit, as in the inertia per unit
  // mass.
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
    body.turned[i] = multiply(real_from_unit(row, 0), rotational);
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
