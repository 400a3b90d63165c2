#include "joint/joint.h"
#include "math/scaled.h"
#include "motion/angular_velocity.h"
#include "motion/inverse_inertia.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// During the solves of a substep, a limit is activated if the free motion would pass it by more than k_passed: rad for
/// an angle, k_passed times the joint's unit of length for a length.
constexpr Real k_passed = 0.03125;
/// A motor or friction drives a motion beyond its target speed if the motion exceeds that speed by more than
/// k_overdriven, m/s.
constexpr Real k_overdriven = 0x1p-10;
/// A limit counts as pulling if its impulse pulls by more than k_pulled, in the unit of its row. A smaller impulse may
/// be a rounding error of the solve.
constexpr Real k_pulled = 0x1p-20;

/// The response K of a single row: the change of its speed by a unit impulse, in the joint's unit of impulses.
Scaled own_response(const SolverBodies& bodies, const JointStage& stage, const JointWork& work, const JointRow& row) {
  Scaled sum = Scaled(0.0);
  for (int end = 0; end < 2; ++end) {
    const JointBody& body = stage.bodies[work.body[end]];
    if (body.mobile == 0) continue;
    const WorldInverseInertia& inverse_inertia = bodies.work[body.slot].inverse_inertia;
    const Vec3<Unit>& arm = row.arm[end];
    const Unit rotational =
        scale_by_power(dot(scale_by_power(multiply(inverse_inertia, scale_by_power(arm, -1)), -1), arm), 0);
    const Scaled angular = scaled_by_power(scaled_from(rotational), inverse_inertia.exponent + 2 * body.above + 2);
    const Scaled linear = scaled_from(dot(scale_by_power(row.axis, -1), row.axis));
    sum = add(sum, multiply(body.inverse_mass, add(scaled_by_power(linear, 1), angular)));
  }
  return scaled_by_power(sum, impulse_power(work, row_kind(row)));
}

/// The index of the settings that drive a free motion: 0 for JointDef::axis, 1 for JointDef::second. The spring of a
/// ball joint drives all rotations with the settings of index 0.
int driving_axis(const JointState& joint, int i) {
  return static_cast<JointType>(joint.type) == JointType::ball ? 0 : i;
}

/// A position or speed of a free motion in the units of rows: an angle is multiplied by the joint's unit of length.
Real as_shown(const JointState& joint, const JointWork& work, int i, Real value) {
  return scale_by_power(value, is_angular(static_cast<JointType>(joint.type), i) ? work.exponent : 0);
}
/// The position that a spring pulls to. For a ball joint it is 0: both frames coincide.
Real target_of(const JointState& joint, const JointWork& work, int i) {
  return has_ball_spring(joint) ? k_zero : as_shown(joint, work, i, joint.target[i]);
}
/// The target speed of a motor or a spring.
Real target_speed(const JointState& joint, const JointWork& work, int i) {
  return has_ball_spring(joint) ? k_zero : as_shown(joint, work, i, joint.speed[i]);
}

/// Converts an impulse of a tick to that of one substep, in the unit of the row.
Real in_substep(Real impulse, Scaled share, const JointWork& work, const JointRow& row) {
  bool saturated = false;
  return min(multiply(impulse, scaled_by_power(share, -impulse_power(work, row_kind(row))), saturated),
             k_joint_impulse_max);
}
/// The largest impulse of a motor or spring in a substep.
Real largest_push(const JointState& joint, int i, Scaled share, const JointWork& work) {
  const int axis = driving_axis(joint, i);
  if (!is_positive(joint.force_max[axis])) return k_joint_impulse_max;
  return in_substep(work.bound[axis], share, work, work.free_row[i]);
}
/// The largest impulse of friction in a substep.
Real largest_drag(int i, Scaled share, const JointWork& work) {
  return in_substep(work.brake[row_kind(work.free_row[i])], share, work, work.free_row[i]);
}

/// A damped spring. Its stiffness is such that the two bodies without other joints and contacts oscillate at the given
/// frequency.
/// Source: Catto, "Soft Constraints", GDC 2011.
struct Spring {
  Scaled rate;     ///< angular frequency, rad/s
  Scaled phase;    ///< rate x substep
  Scaled damping;  ///< 2 damping ratio + phase

  Spring(const StepSettings& settings, const JointState& joint, int i)
      : rate(scaled_from(k_two_pi * joint.frequency[driving_axis(joint, i)])),
        phase(multiply(rate, scaled_from(settings.time))),
        damping(add(scaled_by_power(scaled_from(joint.damping_ratio[driving_axis(joint, i)]), 1), phase)) {}
  /// The ratio of the spring's impulse in a substep to the impulse that stops the motion.
  Scaled stiffness() const { return multiply(phase, damping); }
};

DriveMode free_mode(const JointState& joint, int i) {
  if (has_ball_spring(joint)) return DriveMode::spring;
  if (i < free_motion_count(static_cast<JointType>(joint.type))) {
    if (joint.frequency[i] > k_zero) return DriveMode::spring;
    if (is_positive(joint.force_max[i])) return DriveMode::rigid;
  }
  return is_braked(joint, i) ? DriveMode::brake : DriveMode::idle;
}

/// The velocity of B relative to A along free row `i`, before the joints are solved, m/s.
Real speed_of(const JointStage& stage, const JointWork& work, int i) {
  const JointBody &a = stage.bodies[work.body[0]], &b = stage.bodies[work.body[1]];
  const JointRow& row = work.free_row[i];
  return dot(b.linear_velocity - a.linear_velocity, row.axis) + dot(b.angular_velocity, row.arm[1]) -
         dot(a.angular_velocity, row.arm[0]);
}

/// speed_of() at the start of the substep, before forces, damping and the stored impulses of contacts have acted. The
/// damper of a spring acts on this speed. If the damper acted on the speed after them, it would bear a part of these
/// forces and impulses.
Real speed_before(const SolverBodies& bodies, const JointStage& stage, const JointWork& work, int i) {
  const JointRow& row = work.free_row[i];
  Real speed = k_zero;
  for (int end = 0; end < 2; ++end) {
    const JointBody& body = stage.bodies[work.body[end]];
    Vec3<Real> linear_velocity = body.linear_velocity, angular_velocity = body.angular_velocity;
    if (body.mobile != 0) {
      linear_velocity = body.velocity_before;
      angular_velocity = world_angular_velocity(bodies.properties[body.slot], bodies.work[body.slot].inverse_inertia,
                                                body.angular_momentum_before, body.above);
    }
    const Real own = dot(linear_velocity, row.axis) + dot(angular_velocity, row.arm[end]);
    speed += end == 0 ? -own : own;
  }
  return speed;
}

/// Replaces the row of a spring by a constant impulse, if the spring is soft relative to the substep. The impulse
/// follows from the current displacement and speed, so the oscillation loses no energy. A stiff spring keeps its row.
void push_softly(const StepSettings& settings, const SolverBodies& bodies, const JointStage& stage, int i,
                 JointWork& work) {
  const JointState& joint = stage.joints[work.joint];
  const Spring spring(settings, joint, i);
  if (!less(spring.stiffness(), Scaled(0.25))) return;
  const Real off = work.value[i] - target_of(joint, work, i);
  const Real fast = speed_before(bodies, stage, work, i) - target_speed(joint, work, i);
  const Scaled pull = multiply(multiply(spring.rate, spring.phase), scaled_from(off));
  const Scaled damping = scaled_by_power(scaled_from(joint.damping_ratio[driving_axis(joint, i)]), 1);
  const Scaled drag = multiply(multiply(spring.phase, damping), scaled_from(fast));
  const Scaled response = own_response(bodies, stage, work, work.free_row[i]);
  if (!is_positive(response)) return;
  const Real most = largest_push(joint, i, settings.share, work);
  bool saturated = false;
  work.constant[i] = clamp(-to_real(divide(add(pull, drag), response), saturated), -most, most);
  work.mode[i] = DriveMode::constant;
}

/// The impulse of a spring at its current displacement, without damping.
Real standing_pull(const StepSettings& settings, const SolverBodies& bodies, const JointStage& stage, int i,
                   const JointWork& work) {
  const JointState& joint = stage.joints[work.joint];
  const Spring spring(settings, joint, i);
  const Scaled pull =
      multiply(multiply(spring.rate, spring.phase), scaled_from(target_of(joint, work, i) - work.value[i]));
  const Scaled response = own_response(bodies, stage, work, work.free_row[i]);
  if (!is_positive(response)) return k_zero;
  const Real most = largest_push(joint, i, settings.share, work);
  bool saturated = false;
  return clamp(to_real(divide(pull, response), saturated), -most, most);
}

/// Combines friction with a spring on the same free motion, which has only one row. A soft spring acts as a constant
/// impulse, and friction gets the row. If friction can bear the impulse of a stiff spring, friction gets the row and
/// locks the motion. Otherwise the spring gets the row, and friction acts as a constant impulse.
void brake_spring(const StepSettings& settings, const SolverBodies& bodies, const JointStage& stage, int i,
                  JointWork& work) {
  if (work.mode[i] == DriveMode::constant) {
    work.mode[i] = DriveMode::brake;
    return;
  }
  const Real pull = standing_pull(settings, bodies, stage, i, work);
  const Real drag = largest_drag(i, settings.share, work);
  if (abs(pull) <= drag) {
    work.mode[i] = DriveMode::brake;
    work.constant[i] = pull;
  } else {
    const Real speed = speed_of(stage, work, i);
    work.constant[i] = (speed == k_zero ? pull : speed) > k_zero ? -drag : drag;
  }
}

/// Sets the target of a limit's row. C is the position minus the limit (`over`), h the length of the substep. If the
/// position is `within` the limit, the target is J v = -C / h, so that the motion may reach the limit. Beyond the
/// limit, the target is J v = 0, and a shift of positions corrects C.
void drive_to_limit(const StepSettings& settings, Real over, bool within, uint32_t row, JointWork& work) {
  work.target[row] = within ? -speed_over(settings, over) : k_zero;
  work.error[row] = within ? k_zero : over;
}

/// The impulse of a motor or spring on a free motion whose limit is active, if the impulse pushes away from the limit;
/// else 0. The row of the limit then carries the remaining load, or the limit is deactivated.
Real push_off_limit(const StepSettings& settings, const SolverBodies& bodies, const JointStage& stage, int i,
                    const JointWork& work) {
  const JointState& joint = stage.joints[work.joint];
  const bool up = work.mode[i] == DriveMode::lower;
  const Real most = largest_push(joint, i, settings.share, work);
  Real push = k_zero;
  if (free_mode(joint, i) == DriveMode::rigid) {
    push = joint.speed[i] > k_zero ? most : joint.speed[i] < k_zero ? -most : k_zero;
  } else if (free_mode(joint, i) == DriveMode::spring) {
    push = standing_pull(settings, bodies, stage, i, work);
  }
  return up ? max(push, k_zero) : min(push, k_zero);
}

/// Whether a motor or friction acts on free motion `i` with its greatest force.
bool is_at_greatest_force(const JointState& joint, int i, const JointWork& work) {
  if (work.mode[i] != DriveMode::constant) return false;
  const DriveMode mode = free_mode(joint, i);
  return mode == DriveMode::rigid || mode == DriveMode::brake;
}

/// Whether a motor or friction at its greatest force drives the motion beyond its target speed.
bool overdrives(const JointStage& stage, int i, const JointWork& work) {
  const JointState& joint = stage.joints[work.joint];
  if (!is_at_greatest_force(joint, i, work)) return false;
  const Real target = free_mode(joint, i) == DriveMode::rigid ? target_speed(joint, work, i) * work.shown[i] : k_zero;
  const Real push = work.constant[i] + work.driven_total[i] + work.given[i];
  const Real beyond = speed_of(stage, work, i) - target;
  return push > k_zero ? beyond > k_overdriven : beyond < -k_overdriven;
}

/// The limit that a free motion would pass by more than `passed` in the substep. If it would pass none, returns its
/// current mode.
DriveMode mode_at_limit(const StepSettings& settings, const JointStage& stage, int i, Real passed,
                        const JointWork& work) {
  const JointState& joint = stage.joints[work.joint];
  const Real travel = clamp(speed_of(stage, work, i), -k_speed_work_max, k_speed_work_max) * settings.time;
  if (work.value[i] + min(travel, k_zero) + passed <= as_shown(joint, work, i, joint.lower[i])) return DriveMode::lower;
  if (work.value[i] + max(travel, k_zero) - passed >= as_shown(joint, work, i, joint.upper[i])) return DriveMode::upper;
  return work.mode[i];
}

}  // namespace

uint32_t driven_motions(const JointState& joint) {
  uint32_t motions = 0;
  for (int i = 0; i < driven_motion_count(joint); ++i) {
    if (is_limited(joint, i) || free_mode(joint, i) != DriveMode::idle) motions |= 1u << i;
  }
  return motions;
}

void choose_drives(const StepSettings& settings, const SolverBodies& bodies, const JointStage& stage, JointWork& work) {
  const JointState& joint = stage.joints[work.joint];
  for (int i = 0; i < k_free_motions; ++i) {
    work.mode[i] = DriveMode::idle;
    work.constant[i] = work.driven_total[i] = work.given[i] = k_zero;
  }
  for (int i = 0; i < driven_motion_count(joint); ++i) {
    work.mode[i] = free_mode(joint, i);
    if (work.mode[i] == DriveMode::spring) {
      push_softly(settings, bodies, stage, i, work);
      if (is_braked(joint, i)) brake_spring(settings, bodies, stage, i, work);
    }
    if (!is_limited(joint, i)) continue;
    if (joint.lower[i] == joint.upper[i]) {
      work.mode[i] = DriveMode::held;
      work.constant[i] = k_zero;
      continue;
    }
    work.mode[i] = mode_at_limit(settings, stage, i, k_zero, work);
    if (is_at_limit(work.mode[i])) work.constant[i] = push_off_limit(settings, bodies, stage, i, work);
  }
}

bool may_overdrive(const JointState& joint, const JointWork& work) {
  bool may = false;
  for (int i = 0; i < k_free_motions; ++i) may = may || is_at_greatest_force(joint, i, work);
  return may;
}

bool take_up(const StepSettings& settings, const SolverBodies& bodies, const JointStage& stage, bool loads,
             JointWork& work) {
  const JointState& joint = stage.joints[work.joint];
  bool taken = false;
  for (int i = 0; i < driven_motion_count(joint); ++i) {
    DriveMode& mode = work.mode[i];
    if (!loads && overdrives(stage, i, work)) {
      mode = free_mode(joint, i);
      work.driven_total[i] += work.given[i];
      work.constant[i] = work.given[i] = k_zero;
      taken = true;
    }
    if (!is_limited(joint, i) || is_at_limit(mode)) continue;
    const DriveMode limit = mode_at_limit(settings, stage, i, scale_by_power(k_passed, work.exponent), work);
    if (!is_at_limit(limit)) continue;
    mode = limit;
    work.given[i] += work.driven_total[i];
    work.driven_total[i] = k_zero;
    work.constant[i] = push_off_limit(settings, bodies, stage, i, work);
    taken = true;
  }
  return taken;
}

void add_driven_rows(const StepSettings& settings, const SolverBodies& bodies, const JointStage& stage,
                     JointWork& work) {
  work.rows = work.locked_rows;
  const JointState& joint = stage.joints[work.joint];
  for (int i = 0; i < k_free_motions; ++i) {
    const DriveMode mode = work.mode[i];
    work.driven[i] = k_joint_rows_max;
    if (mode == DriveMode::idle || mode == DriveMode::constant) continue;
    const uint32_t row = work.rows++;
    work.driven[i] = row;
    work.row[row] = work.free_row[i];
    work.error[row] = k_zero;
    work.spring[row] = work.target[row] = k_zero;
    if (mode == DriveMode::brake) continue;
    if (is_at_limit(mode)) {
      const Real limit = mode == DriveMode::upper ? joint.upper[i] : joint.lower[i];
      const Real over = work.value[i] - as_shown(joint, work, i, limit);
      const bool within = mode == DriveMode::upper ? over < k_zero : mode == DriveMode::lower && over > k_zero;
      drive_to_limit(settings, over, within, row, work);
    } else {
      work.target[row] = target_speed(joint, work, i);
    }
    if (mode == DriveMode::spring) {
      const Spring spring(settings, joint, i);
      bool saturated = false;
      const Real off = work.value[i] - target_of(joint, work, i);
      work.target[row] -= multiply(off, divide(spring.rate, spring.damping), saturated);
      const Scaled response = own_response(bodies, stage, work, work.free_row[i]);
      work.spring[row] = to_real(scaled_by_power(divide(response, spring.stiffness()),
                                                 work.power[row_kind(work.free_row[i])] - k_impulse_power),
                                 saturated);
    }
    work.target[row] = work.target[row] * work.shown[i];
  }
}

bool release_limits(const JointState& joint, bool changes, JointWork& work) {
  for (int i = 0; i < 2; ++i) {
    DriveMode& mode = work.mode[i];
    const uint32_t row = work.driven[i];
    if (row == k_joint_rows_max) continue;
    const Real impulse = work.driven_total[i] + work.impulse[row];
    const bool pulls = mode == DriveMode::lower ? impulse < -k_pulled : mode == DriveMode::upper && impulse > k_pulled;
    if (!pulls) continue;
    if (changes) {
      mode = free_mode(joint, i);
      work.constant[i] = k_zero;
      work.given[i] += work.driven_total[i];
      work.driven_total[i] = k_zero;
    }
    return true;  // without this limit, the impulse of the other limit must be computed again
  }
  return false;
}

bool bound_drives(const JointState& joint, Scaled share, bool changes, JointWork& work) {
  bool wrong = false;
  for (int i = 0; i < k_free_motions; ++i) {
    DriveMode& mode = work.mode[i];
    const uint32_t row = work.driven[i];
    if (row == k_joint_rows_max) continue;
    const Real impulse = work.driven_total[i] + work.impulse[row], all = impulse + work.given[i];
    if ((mode == DriveMode::rigid || mode == DriveMode::spring) &&
        is_positive(joint.force_max[driving_axis(joint, i)])) {
      const Real bound = largest_push(joint, i, share, work);
      if (all <= bound && all >= -bound) continue;
      wrong = true;
      if (!changes) continue;
      work.constant[i] = (all > k_zero ? bound : -bound) - (work.driven_total[i] + work.given[i]);
      mode = DriveMode::constant;
    } else if (mode == DriveMode::brake) {
      const Real drag = largest_drag(i, share, work);
      if (impulse <= drag && impulse >= -drag) continue;
      wrong = true;
      if (!changes) continue;
      work.constant[i] += (impulse > k_zero ? drag : -drag) - work.driven_total[i];
      mode = DriveMode::constant;
    }
  }
  return wrong;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
