#include "base/cycle.h"
#include "joint/joint.h"
#include "math/root.h"
#include "math/scaled.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr Unit k_zero_unit = 0.0;

/// Lower bound of 1 + cos l in the row of a twist, with the angle l between the x axes; see free_twist().
constexpr Real k_twist_rate_min = 0.75;

/// The angle of a rotation about an axis, 2 atan2(sine, cosine) of half the angle, rad, in [-pi, pi].
Real twist_of(Unit sine, Unit cosine) {
  const bool turned = cosine < k_zero_unit;  // q and -q are the same rotation
  return scale_by_power(radians(turned ? arc_tangent(-sine, -cosine) : arc_tangent(sine, cosine)), 1);
}

/// Makes the rows of a joint at the current poses of its bodies. Each J has the columns (v_A, w_A, v_B, w_B). r_A and
/// r_B are the arms from the centres to the anchors. u is the joint's unit of length, m; an angle times u is a length.
/// For each row, with the angular parts -arm_A and arm_B of J,
///
///     K = J M^-1 J^T = 1/m_A + 1/m_B (linear rows only) + arm_A . I_A^-1 arm_A + arm_B . I_B^-1 arm_B
struct RowMaker {
  const JointWork& joint;
  const JointBody& a;
  const JointBody& b;
  uint32_t motions;  ///< the free motions whose rows the caller needs, as in make_joint_rows()
  RowParts parts;
  JointRows& rows;
  Vec3<Real> gap = {};  ///< from A's anchor to B's, m: p_B - p_A
  Matrix3 frame = {};   ///< A's joint frame in the world
  Quat relative = {};   ///< B's joint frame in A's

  /// A linear row along d = `axis`. For both bodies the force acts at B's anchor:
  ///
  ///     C = d . gap,  J = (-d, -(r_A + gap) x d, d, r_B x d)
  JointRow linear(const Vec3<Unit>& axis) const {
    const Vec3<Unit> displacement = clamped_unit(real_from_unit(rows.arm[0], a.exponent) + gap, a.exponent);
    return {axis, {clamped_cross(displacement, axis), clamped_cross(rows.arm[1], axis)}};
  }
  /// An angular row about a = `axis`; u is the joint's unit of length:
  ///
  ///     C = angle u,  J = (0, -a u, 0, a u)
  JointRow angular(const Vec3<Unit>& axis) const {
    return {{k_zero_unit, k_zero_unit, k_zero_unit},
            {scale_by_power(axis, joint.exponent - a.exponent), scale_by_power(axis, joint.exponent - b.exponent)}};
  }
  Real length_of(Real angle) const { return scale_by_power(angle, joint.exponent); }

  /// Locks the motion of B's anchor along `axis`.
  void lock_linear(const Vec3<Unit>& axis) {
    rows.error[rows.locked_rows] = dot(gap, axis);
    if (parts == RowParts::all) rows.row[rows.locked_rows] = linear(axis);
    ++rows.locked_rows;
  }
  void lock_angular(const Vec3<Unit>& axis, Real error) {
    rows.error[rows.locked_rows] = error;
    if (parts == RowParts::all) rows.row[rows.locked_rows] = angular(axis);
    ++rows.locked_rows;
  }
  /// Locks the anchors together: three rows, along the axes e of the world.
  ///
  ///     C = e . gap,  J = (-e, -r_A x e, e, r_B x e)
  void lock_points() {
    rows.points = 1;
    rows.error[0] = gap.x;
    rows.error[1] = gap.y;
    rows.error[2] = gap.z;
    rows.locked_rows = 3;
  }
  /// Locks the relative rotation q (`relative`) about one axis of A's joint frame. For a small rotation, twice the
  /// vector part of q is the rotation vector. Therefore C = 2 q_axis u, with the joint's unit of length u.
  void clamp_rotation(int axis, Unit part) {
    const Unit sine = relative.w < k_zero_unit ? -part : part;
    lock_angular(frame.column[axis], length_of(scale_by_power(real_from_unit(sine, 0), 1)));
  }
  /// Keeps the axis b, the axis number `axis` of B's joint frame, aligned with the same axis of A's joint frame. There
  /// are two angular rows, about the other two axes of A's frame. With the components of b in A's frame and the joint's
  /// unit of length u:
  ///
  ///     C = -b_last u (row about the next axis),  C = b_next u (row about the last axis)
  void lock_axis(int axis) {
    const int next = next_of_three(axis), last = previous_of_three(axis);
    const Matrix3 turned = matrix_from(relative);
    const Unit along[3] = {turned.column[axis].x, turned.column[axis].y, turned.column[axis].z};
    lock_angular(frame.column[next], length_of(real_from_unit(-along[last], 0)));
    lock_angular(frame.column[last], length_of(real_from_unit(along[next], 0)));
  }
  bool wants(int i) const { return ((motions >> i) & 1) != 0; }
  void free_motion(int i, Real value) {
    rows.value[i] = value;
    rows.shown[i] = Real(1.0);
  }
  void free_angular(int i, const Vec3<Unit>& axis, Real value) {
    if (parts == RowParts::all) rows.free_row[i] = angular(axis);
    free_motion(i, value);
  }
  /// The displacement along the x axis d of A's joint frame. The value is d . gap.
  void free_slide(int i) {
    if (!wants(i)) return;
    if (parts == RowParts::all) rows.free_row[i] = linear(frame.column[0]);
    free_motion(i, dot(gap, frame.column[0]));
  }
  /// The rotation about one axis of A's joint frame. The value is the angle times u, the joint's unit of length.
  void free_rotation(int i, int axis, Unit sine) {
    if (wants(i)) free_angular(i, frame.column[axis], length_of(twist_of(sine, relative.w)));
  }
  /// The twist about x. The relative rotation is split into the shortest rotation from A's x axis to B's, by the angle
  /// l, and a rotation about x, the twist. The rate of the twist is a . (w_B - w_A), where
  ///
  ///     a = (x_A + x_B) / (1 + cos l)
  ///
  /// The row stores a as its lever arm. If a exceeds the range of a lever arm, the row stores the fraction `shown` of
  /// a.
  void free_twist(int i) {
    if (!wants(i)) return;
    const Vec3<Unit> x = {Unit(1.0), k_zero_unit, k_zero_unit}, leaning = rotate(relative, x);
    const Vec3<Unit> own = frame.column[0], other = multiply(frame, leaning);
    const Real rate = real_from_unit(leaning.x, 0) + Real(1.0);
    const Scaled share = scaled_reciprocal(max(rate, k_twist_rate_min));
    const auto sum = [&](Unit of_a, Unit of_b) {
      return multiply(real_from_unit(of_a, 0) + real_from_unit(of_b, 0), share);
    };
    const Vec3<Unit> axis = clamped_unit({sum(own.x, other.x), sum(own.y, other.y), sum(own.z, other.z)}, 0);
    free_angular(i, axis, length_of(twist_of(relative.x, relative.w)));
    if (rate < k_twist_rate_min) rows.shown[i] = max(multiply(rate, share), k_zero);
  }
  /// The angle between the x axes of A and B. Its row is a rotation about the axis perpendicular to both. If `motions`
  /// contains it, free motion i + 1 is the rotation of B's x axis around A's x axis. It has a row but no value.
  void free_lean(int i) {
    if (!wants(i) && !wants(i + 1)) return;
    const Vec3<Unit> x = {Unit(1.0), k_zero_unit, k_zero_unit}, leaning = rotate(relative, x);
    const Vec3<Real> about = {k_zero, real_from_unit(-leaning.z, 0), real_from_unit(leaning.y, 0)};
    Vec3<Unit> axis;
    Real sine = k_zero;
    if (!normalise(about, axis, sine)) axis = {k_zero_unit, k_zero_unit, Unit(1.0)};
    const Vec3<Unit> in_world = multiply(frame, axis);
    free_angular(i, in_world, length_of(radians(arc_tangent(unit_from_real(sine, 0), leaning.x))));
    if (wants(i + 1)) free_angular(i + 1, clamped_unit(cross(real_from_unit(frame.column[0], 0), in_world), 0), k_zero);
  }
  /// Makes the rows of the three rotations about A's axes, for friction. These rotations have no values.
  void free_turns() {
    for (int i = 0; i < k_free_motions; ++i) free_angular(i, frame.column[i], k_zero);
  }
  /// Makes the rows of the three rotations about A's axes, for a spring. The values are the components of the rotation
  /// vector from A's joint frame to B's, times the joint's unit of length u.
  void free_turns_of_spring() {
    free_turns();
    const Real sign = relative.w < k_zero_unit ? Real(-1.0) : Real(1.0);  // q and -q are the same rotation
    Vec3<Unit> about;
    Real sine = k_zero;
    if (!normalise(real_from_unit(Vec3<Unit>{relative.x, relative.y, relative.z}, 0) * sign, about, sine)) return;
    const Real angle = twist_of(unit_from_real(sine, 0), abs(relative.w));
    rows.value[0] = length_of(angle * about.x);
    rows.value[1] = length_of(angle * about.y);
    rows.value[2] = length_of(angle * about.z);
  }
  /// The distance between the anchors. With d = gap / |gap|, the value is |gap|, and J = (-d, -r_A x d, d, r_B x d).
  void free_distance() {
    Vec3<Unit> axis;
    Real apart = k_zero;
    if (!normalise(gap, axis, apart)) axis = {Unit(1.0), k_zero_unit, k_zero_unit};
    // Unlike in linear(), each body's arm ends at its own anchor.
    if (parts == RowParts::all)
      rows.free_row[0] = {axis, {clamped_cross(rows.arm[0], axis), clamped_cross(rows.arm[1], axis)}};
    free_motion(0, apart);
  }

 private:
  static Vec3<Unit> clamped_cross(const Vec3<Unit>& arm, const Vec3<Unit>& axis) {
    const Vec3<Real> product = cross(real_from_unit(arm, 0), axis);
    return clamped_unit(product, 0);
  }
};

}  // namespace

int free_motion_count(JointType type) {
  if (type == JointType::cone_twist || type == JointType::wheel) return 2;
  return type == JointType::ball || type == JointType::fixed || type == JointType::filter ? 0 : 1;
}

int driven_motion_count(const JointState& joint) {
  const JointType type = static_cast<JointType>(joint.type);
  const bool turns = type == JointType::ball || type == JointType::cone_twist;
  const bool all = has_ball_spring(joint) || (turns && is_positive(joint.friction[1]));
  return all ? k_free_motions : free_motion_count(type);
}

bool is_limited(const JointState& joint, int motion) {
  // Unsigned, so that compilers see that the index is in range even for joints without free motions.
  const uint32_t free_motions = static_cast<uint32_t>(free_motion_count(static_cast<JointType>(joint.type)));
  return static_cast<uint32_t>(motion) < free_motions && joint.limited[motion] != 0;
}

bool is_braked(const JointState& joint, int motion) {
  return is_positive(joint.friction[is_angular(static_cast<JointType>(joint.type), motion) ? 1 : 0]);
}

bool is_angular(JointType type, int motion) {
  return motion >= 1 || !(type == JointType::slider || type == JointType::distance || type == JointType::wheel);
}

void make_joint_rows(const JointStage& stage, const JointWork& work, uint32_t motions, RowParts parts,
                     JointRows& rows) {
  const JointState& joint = stage.joints[work.joint];
  const JointBody &a = stage.bodies[work.body[0]], &b = stage.bodies[work.body[1]];
  const JointType type = static_cast<JointType>(joint.type);
  rows.locked_rows = rows.points = 0;
  for (int i = 0; i < k_free_motions; ++i) {
    rows.free_row[i] = {};
    rows.value[i] = rows.shown[i] = k_zero;
  }
  rows.arm[0] = multiply(a.axes, work.anchor[0]);
  rows.arm[1] = multiply(b.axes, work.anchor[1]);
  RowMaker make = {work, a, b, motions, parts, rows};
  make.gap = work.between + (b.place - a.place) +
             (real_from_unit(rows.arm[1], b.exponent) - real_from_unit(rows.arm[0], a.exponent));
  if ((type != JointType::ball || motions != 0) && type != JointType::distance) {
    const Quat frame_a = multiply(a.rotation, joint.frame_a);
    make.frame = matrix_from(frame_a);
    make.relative = multiply(conjugate(frame_a), multiply(b.rotation, joint.frame_b));
  }
  const Quat& relative = make.relative;
  switch (type) {
    case JointType::ball:
      make.lock_points();
      if (motions == 0) break;
      if (has_ball_spring(joint))
        make.free_turns_of_spring();
      else
        make.free_turns();
      break;
    case JointType::hinge:
      make.lock_points();
      make.lock_axis(0);
      make.free_rotation(0, 0, relative.x);
      break;
    case JointType::slider:
      make.lock_linear(make.frame.column[1]);
      make.lock_linear(make.frame.column[2]);
      make.clamp_rotation(0, relative.x);
      make.clamp_rotation(1, relative.y);
      make.clamp_rotation(2, relative.z);
      make.free_slide(0);
      break;
    case JointType::distance:
      make.free_distance();
      break;
    case JointType::fixed:
      make.lock_points();
      make.clamp_rotation(0, relative.x);
      make.clamp_rotation(1, relative.y);
      make.clamp_rotation(2, relative.z);
      break;
    case JointType::cone_twist:
      make.lock_points();
      make.free_twist(0);
      make.free_lean(1);
      break;
    case JointType::wheel:
      make.lock_linear(make.frame.column[1]);
      make.lock_linear(make.frame.column[2]);
      make.lock_axis(2);
      make.free_slide(0);
      make.free_rotation(1, 2, relative.z);
      break;
    case JointType::parallel:
      make.lock_axis(0);
      make.free_rotation(0, 0, relative.x);
      break;
    default:
      break;
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
