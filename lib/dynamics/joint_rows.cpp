#include "dynamics/gyration.h"
#include "dynamics/joint.h"
#include "dynamics/spin.h"
#include "math/root.h"
#include "math/scaled.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr Unit k_zero_unit = 0.0;

/// A substep makes up for half of what the joint has given way. By w^2/2 of its length a joint gives way when it turns
/// by w in a substep; what is left of it and what is made up for then balance where the half of that is the speed
/// inwards that the chord of the way asks for: a swing keeps its height. Any other share would gain or lose.
constexpr int k_correction_power = -1;

constexpr Real k_twist_rate_min = 0.75;

Vec3<Real> in_metres(const Vec3<Unit>& v, int exponent) {
  return {real_from_unit(v.x, exponent), real_from_unit(v.y, exponent), real_from_unit(v.z, exponent)};
}

/// The angle of a turn about an axis by twice atan2 of these, rad, in [-pi, pi].
Real twist_of(Unit sine, Unit cosine) {
  const bool turned = cosine < k_zero_unit;  // q and -q are the same turn
  return scale_by_power(radians(turned ? arc_tangent(-sine, -cosine) : arc_tangent(sine, cosine)), 1);
}

/// A joint's bodies as they are now, and the rows made of them.
struct RowMaker {
  const StepSettings& settings;
  const JointState& joint;
  const JointBody& a;
  const JointBody& b;
  JointWork& work;
  Vec3<Real> gap = {};  ///< from A's anchor to B's, m
  Matrix3 frame = {};   ///< of A, in the world
  Quat relative = {};   ///< B's frame in A's

  Real correction(Real error) const {
    const Real limit = real_from_unit(Unit(1.0), work.exponent > 14 ? 14 : work.exponent);
    return -scale_by_power(speed_over(settings, clamp(error, -limit, limit)), k_correction_power);
  }
  /// What is within a limit may go as far as that; what is beyond comes back.
  Real up_to_limit(Real over, bool within) const { return within ? -speed_over(settings, over) : correction(over); }
  /// A row that acts along `axis` at B's anchor, whichever way off A's is.
  JointRow linear(const Vec3<Unit>& axis) const {
    const Vec3<Unit> way = unit_held(in_metres(work.arm[0], a.exponent) + gap, a.exponent);
    return {axis, {held_cross(way, axis), held_cross(work.arm[1], axis)}};
  }
  JointRow angular(const Vec3<Unit>& axis) const {
    return {{k_zero_unit, k_zero_unit, k_zero_unit},
            {scale_by_power(axis, work.exponent - a.exponent), scale_by_power(axis, work.exponent - b.exponent)}};
  }
  Real length_of(Real angle) const { return scale_by_power(angle, work.exponent); }

  void hold(const JointRow& row, Real error) {
    work.wanted[work.rows] = correction(error);
    work.row[work.rows++] = row;
  }
  void hold_points() {
    work.points = 1;
    work.wanted[0] = correction(gap.x);
    work.wanted[1] = correction(gap.y);
    work.wanted[2] = correction(gap.z);
    work.rows = 3;
  }
  /// Twice the vector part of the relative turn is the turn where it is small.
  void hold_turn(int axis, Unit part) {
    const Unit sine = relative.w < k_zero_unit ? -part : part;
    hold(angular(frame.column[axis]), length_of(scale_by_power(real_from_unit(sine, 0), 1)));
  }
  /// Keeps A's axis `axis` on B's: two rows, about A's next two.
  void hold_axis(int axis) {
    const int next = (axis + 1) % 3, last = (axis + 2) % 3;
    const Matrix3 turned = matrix_from(relative);
    const Unit along[3] = {turned.column[axis].x, turned.column[axis].y, turned.column[axis].z};
    hold(angular(frame.column[next]), length_of(real_from_unit(-along[last], 0)));
    hold(angular(frame.column[last]), length_of(real_from_unit(along[next], 0)));
  }
  void free_motion(int i, const JointRow& row, Real value) {
    work.free_row[i] = row;
    work.value[i] = value;
    work.shown[i] = Real(1.0);
  }
  void free_slide(int i) { free_motion(i, linear(frame.column[0]), dot(gap, frame.column[0])); }
  void free_turn(int i, int axis, Unit sine) {
    free_motion(i, angular(frame.column[axis]), length_of(twist_of(sine, relative.w)));
  }
  /// The twist about x that is left of the turn once x has leaned the shortest way: it goes with the spin about the sum
  /// of the two x, over 1 and the cosine of the lean. Where that grows beyond an arm's range the row shows a part of
  /// it.
  void free_twist(int i) {
    const Vec3<Unit> x = {Unit(1.0), k_zero_unit, k_zero_unit}, leaning = rotate(relative, x);
    const Vec3<Unit> own = frame.column[0], other = multiply(frame, leaning);
    const Real rate = real_from_unit(leaning.x, 0) + Real(1.0);
    const Scaled share = scaled_reciprocal(max(rate, k_twist_rate_min));
    const auto sum = [&](Unit of_a, Unit of_b) {
      return multiply(real_from_unit(of_a, 0) + real_from_unit(of_b, 0), share);
    };
    const Vec3<Unit> axis = unit_held({sum(own.x, other.x), sum(own.y, other.y), sum(own.z, other.z)}, 0);
    free_motion(i, angular(axis), length_of(twist_of(relative.x, relative.w)));
    if (rate < k_twist_rate_min) work.shown[i] = max(multiply(rate, share), k_zero);
  }
  /// How far B's x leans off A's, about the axis that it leans about.
  void free_lean(int i) {
    const Vec3<Unit> x = {Unit(1.0), k_zero_unit, k_zero_unit}, leaning = rotate(relative, x);
    const Vec3<Real> about = {k_zero, real_from_unit(-leaning.z, 0), real_from_unit(leaning.y, 0)};
    Vec3<Unit> axis;
    Real sine = k_zero;
    if (!normalise(about, axis, sine)) axis = {k_zero_unit, k_zero_unit, Unit(1.0)};
    const Vec3<Unit> in_world = multiply(frame, axis);
    free_motion(i, angular(in_world), length_of(radians(arc_tangent(unit_from_real(sine, 0), leaning.x))));
  }
  void free_distance() {
    Vec3<Unit> axis;
    Real apart = k_zero;
    if (!normalise(gap, axis, apart)) axis = {Unit(1.0), k_zero_unit, k_zero_unit};
    // Each end is pulled at its own anchor.
    const JointRow row = {axis, {held_cross(work.arm[0], axis), held_cross(work.arm[1], axis)}};
    free_motion(0, row, apart);
  }

 private:
  static Vec3<Unit> held_cross(const Vec3<Unit>& arm, const Vec3<Unit>& axis) {
    const Vec3<Real> product = cross(in_metres(arm, 0), axis);
    return unit_held(product, 0);
  }
};

/// The response of a row with no joint but this one, over the reference mass.
Scaled own_response(const SolverBodies& bodies, const JointStage& stage, const JointWork& work, const JointRow& row) {
  Scaled sum = Scaled(0.0);
  for (int end = 0; end < 2; ++end) {
    const JointBody& body = stage.bodies[work.body[end]];
    if (body.mobile == 0) continue;
    const WorldGyration& gyration = bodies.work[body.slot].gyration;
    const Vec3<Unit>& arm = row.arm[end];
    const Unit turn = scale_by_power(dot(scale_by_power(multiply(gyration, scale_by_power(arm, -1)), -1), arm), 0);
    const Scaled angular = scaled_by_power(scaled_from(turn), gyration.exponent + 2 * body.above + 2);
    const Scaled linear = scaled_from(dot(scale_by_power(row.axis, -1), row.axis));
    sum = add(sum, multiply(body.share, add(scaled_by_power(linear, 1), angular)));
  }
  return sum;
}

/// A damped spring whose stiffness is that of the frequency with the two bodies alone. Source: Catto, "Soft
/// Constraints", GDC 2011.
struct Spring {
  Scaled rate;     ///< rad/s
  Scaled phase;    ///< rate x substep
  Scaled damping;  ///< 2 damping ratio + phase

  Spring(const StepSettings& settings, const JointState& joint, int i)
      : rate(scaled_from(k_two_pi * joint.frequency[i])),
        phase(multiply(rate, scaled_from(settings.time))),
        damping(add(scaled_by_power(scaled_from(joint.damping_ratio[i]), 1), phase)) {}
  /// What it gives in a substep over what would stop the motion at once.
  Scaled stiffness() const { return multiply(phase, damping); }
};

DriveMode free_mode(const JointState& joint, int i) {
  if (joint.frequency[i] > k_zero) return DriveMode::spring;
  return is_positive(joint.force_max[i]) ? DriveMode::rigid : DriveMode::idle;
}

/// How fast a free motion goes before anything is solved, m/s.
Real speed_of(const JointStage& stage, const JointWork& work, int i) {
  const JointBody &a = stage.bodies[work.body[0]], &b = stage.bodies[work.body[1]];
  const JointRow& row = work.free_row[i];
  return dot(b.velocity - a.velocity, row.axis) + dot(b.spin, row.arm[1]) - dot(a.spin, row.arm[0]);
}

/// What of that gravity, forces and torques have just added: a damper that held against it would carry a part of it.
Real speed_pushed(const SolverBodies& bodies, const JointStage& stage, const JointWork& work, int i) {
  const JointRow& row = work.free_row[i];
  Real speed = k_zero;
  for (int end = 0; end < 2; ++end) {
    const JointBody& body = stage.bodies[work.body[end]];
    if (body.mobile == 0) continue;
    const BodyWork& now = bodies.work[body.slot];
    const Vec3<Real> spin = world_spin(bodies.traits[body.slot], now.gyration, now.twist, body.above);
    const Real own = dot(now.push, row.axis) + dot(spin, row.arm[end]);
    speed += end == 0 ? -own : own;
  }
  return speed;
}

/// A spring that is soft beside the substep needs no row: it pushes by where it is, which loses nothing of its swing.
void push_softly(const StepSettings& settings, const SolverBodies& bodies, const JointStage& stage, int i,
                 JointWork& work) {
  const JointState& joint = stage.joints[work.joint];
  const Spring spring(settings, joint, i);
  if (!less(spring.stiffness(), Scaled(0.25))) return;
  const int power = is_angular(static_cast<JointType>(joint.type), i) ? work.exponent : 0;
  const Real off = work.value[i] - scale_by_power(joint.target[i], power);
  const Real fast =
      speed_of(stage, work, i) - speed_pushed(bodies, stage, work, i) - scale_by_power(joint.speed[i], power);
  const Scaled pull = multiply(multiply(spring.rate, spring.phase), scaled_from(off));
  const Scaled drag =
      multiply(multiply(spring.phase, scaled_by_power(scaled_from(joint.damping_ratio[i]), 1)), scaled_from(fast));
  const Scaled response = own_response(bodies, stage, work, work.free_row[i]);
  if (!is_positive(response)) return;
  const Real most = is_positive(joint.force_max[i]) ? multiply(work.bound[i], settings.share) : k_joint_impulse_max;
  bool saturated = false;
  work.constant[i] = clamp(-to_real(divide(add(pull, drag), response), saturated), -most, most);
  work.mode[i] = DriveMode::constant;
}

/// What is set of the others has no meaning.
int free_motion_count(JointType type) {
  if (type == JointType::ball || type == JointType::fixed) return 0;
  return type == JointType::cone_twist || type == JointType::wheel ? 2 : 1;
}

/// What a motor or spring gives beside a limit that holds, if it pushes away from it: then the limit bears the rest, or
/// is let go.
Real push_off_limit(const StepSettings& settings, const SolverBodies& bodies, const JointStage& stage, int i,
                    const JointWork& work) {
  const JointState& joint = stage.joints[work.joint];
  const bool up = work.mode[i] == DriveMode::lower;
  const Real most = is_positive(joint.force_max[i]) ? multiply(work.bound[i], settings.share) : k_joint_impulse_max;
  Real push = k_zero;
  if (free_mode(joint, i) == DriveMode::rigid) {
    push = joint.speed[i] > k_zero ? most : joint.speed[i] < k_zero ? -most : k_zero;
  } else if (free_mode(joint, i) == DriveMode::spring) {
    const int power = is_angular(static_cast<JointType>(joint.type), i) ? work.exponent : 0;
    const Spring spring(settings, joint, i);
    const Scaled pull = multiply(multiply(spring.rate, spring.phase),
                                 scaled_from(scale_by_power(joint.target[i], power) - work.value[i]));
    const Scaled response = own_response(bodies, stage, work, work.free_row[i]);
    bool saturated = false;
    if (is_positive(response)) push = clamp(to_real(divide(pull, response), saturated), -most, most);
  }
  return up ? max(push, k_zero) : min(push, k_zero);
}

}  // namespace

bool is_angular(JointType type, int motion) {
  return motion == 1 || type == JointType::hinge || type == JointType::cone_twist;
}

void make_joint_rows(const StepSettings& settings, const JointStage& stage, JointWork& work) {
  const JointState& joint = stage.joints[work.joint];
  const JointBody &a = stage.bodies[work.body[0]], &b = stage.bodies[work.body[1]];
  const JointType type = static_cast<JointType>(joint.type);
  work.rows = work.points = 0;
  for (Real& softness : work.softness) softness = k_zero;
  work.arm[0] = multiply(a.axes, work.anchor[0]);
  work.arm[1] = multiply(b.axes, work.anchor[1]);
  RowMaker make = {settings, joint, a, b, work};
  make.gap =
      work.between + (b.place - a.place) + (in_metres(work.arm[1], b.exponent) - in_metres(work.arm[0], a.exponent));
  if (type != JointType::ball && type != JointType::distance) {
    const Quat frame_a = multiply(a.rotation, joint.frame_a);
    make.frame = matrix_from(frame_a);
    make.relative = multiply(conjugate(frame_a), multiply(b.rotation, joint.frame_b));
  }
  const Quat& relative = make.relative;
  switch (type) {
    case JointType::ball:
      make.hold_points();
      break;
    case JointType::hinge:
      make.hold_points();
      make.hold_axis(0);
      make.free_turn(0, 0, relative.x);
      break;
    case JointType::slider:
      make.hold(make.linear(make.frame.column[1]), dot(make.gap, make.frame.column[1]));
      make.hold(make.linear(make.frame.column[2]), dot(make.gap, make.frame.column[2]));
      make.hold_turn(0, relative.x);
      make.hold_turn(1, relative.y);
      make.hold_turn(2, relative.z);
      make.free_slide(0);
      break;
    case JointType::distance:
      make.free_distance();
      break;
    case JointType::fixed:
      make.hold_points();
      make.hold_turn(0, relative.x);
      make.hold_turn(1, relative.y);
      make.hold_turn(2, relative.z);
      break;
    case JointType::cone_twist:
      make.hold_points();
      make.free_twist(0);
      make.free_lean(1);
      break;
    case JointType::wheel:
      make.hold(make.linear(make.frame.column[1]), dot(make.gap, make.frame.column[1]));
      make.hold(make.linear(make.frame.column[2]), dot(make.gap, make.frame.column[2]));
      make.hold_axis(2);
      make.free_slide(0);
      make.free_turn(1, 2, relative.z);
      break;
    default:
      break;
  }
  work.rows_held = work.rows;
}

void choose_drives(const StepSettings& settings, const SolverBodies& bodies, const JointStage& stage, JointWork& work) {
  const JointState& joint = stage.joints[work.joint];
  work.mode[0] = work.mode[1] = DriveMode::idle;
  work.constant[0] = work.constant[1] = work.driven_total[0] = work.driven_total[1] = k_zero;
  work.given[0] = work.given[1] = k_zero;
  for (int i = 0; i < free_motion_count(static_cast<JointType>(joint.type)); ++i) {
    work.mode[i] = free_mode(joint, i);
    if (work.mode[i] == DriveMode::spring) push_softly(settings, bodies, stage, i, work);
    if (joint.limited[i] == 0) continue;
    if (joint.lower[i] == joint.upper[i]) {
      work.mode[i] = DriveMode::held;
      work.constant[i] = k_zero;
      continue;
    }
    const int power = is_angular(static_cast<JointType>(joint.type), i) ? work.exponent : 0;
    const Real reach = clamp(speed_of(stage, work, i), -k_speed_work_max, k_speed_work_max) * settings.time;
    if (work.value[i] + min(reach, k_zero) <= scale_by_power(joint.lower[i], power))
      work.mode[i] = DriveMode::lower;
    else if (work.value[i] + max(reach, k_zero) >= scale_by_power(joint.upper[i], power))
      work.mode[i] = DriveMode::upper;
    else
      continue;
    work.constant[i] = push_off_limit(settings, bodies, stage, i, work);
  }
}

void add_driven_rows(const StepSettings& settings, const SolverBodies& bodies, const JointStage& stage,
                     JointWork& work) {
  work.rows = work.rows_held;
  work.driven[0] = work.driven[1] = k_joint_rows_max;
  if (work.mode[0] == DriveMode::idle && work.mode[1] == DriveMode::idle) return;
  const JointState& joint = stage.joints[work.joint];
  const JointBody &a = stage.bodies[work.body[0]], &b = stage.bodies[work.body[1]];
  const RowMaker make = {settings, joint, a, b, work};
  for (int i = 0; i < 2; ++i) {
    const DriveMode mode = work.mode[i];
    if (mode == DriveMode::idle || mode == DriveMode::constant) continue;
    const uint32_t row = work.rows++;
    work.driven[i] = row;
    work.row[row] = work.free_row[i];
    work.softness[row] = k_zero;
    const int power = is_angular(static_cast<JointType>(joint.type), i) ? work.exponent : 0;
    const Real lower = scale_by_power(joint.lower[i], power), upper = scale_by_power(joint.upper[i], power);
    if (mode == DriveMode::held) {
      work.wanted[row] = make.correction(work.value[i] - lower);
    } else if (mode == DriveMode::lower) {
      work.wanted[row] = make.up_to_limit(work.value[i] - lower, work.value[i] > lower);
    } else if (mode == DriveMode::upper) {
      work.wanted[row] = make.up_to_limit(work.value[i] - upper, work.value[i] < upper);
    } else {
      work.wanted[row] = scale_by_power(joint.speed[i], power);
    }
    if (mode == DriveMode::spring) {
      const Spring spring(settings, joint, i);
      bool saturated = false;
      const Real off = work.value[i] - scale_by_power(joint.target[i], power);
      work.wanted[row] -= multiply(off, divide(spring.rate, spring.damping), saturated);
      const Scaled response = own_response(bodies, stage, work, work.free_row[i]);
      work.softness[row] = to_real(divide(response, spring.stiffness()), saturated);
    }
    work.wanted[row] = work.wanted[row] * work.shown[i];
  }
}

bool revise_drives(const JointState& joint, Scaled share, bool changes, JointWork& work) {
  bool wrong = false;
  for (int i = 0; i < 2; ++i) {
    DriveMode& mode = work.mode[i];
    const uint32_t row = work.driven[i];
    if (row == k_joint_rows_max) continue;
    const Real impulse = work.driven_total[i] + work.impulse[row], all = impulse + work.given[i];
    if ((mode == DriveMode::lower && impulse < k_zero) || (mode == DriveMode::upper && impulse > k_zero)) {
      wrong = true;
      if (!changes) continue;
      mode = free_mode(joint, i);
      work.constant[i] = k_zero;
      work.given[i] += work.driven_total[i];
      work.driven_total[i] = k_zero;
    } else if ((mode == DriveMode::rigid || mode == DriveMode::spring) && is_positive(joint.force_max[i])) {
      const Real bound = multiply(work.bound[i], share);
      if (all <= bound && all >= -bound) continue;
      wrong = true;
      if (!changes) continue;
      work.constant[i] = (all > k_zero ? bound : -bound) - (work.driven_total[i] + work.given[i]);
      mode = DriveMode::constant;
    }
  }
  return wrong;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
