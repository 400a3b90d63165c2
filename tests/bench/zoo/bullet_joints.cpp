#include <BulletDynamics/ConstraintSolver/btFixedConstraint.h>
#include <BulletDynamics/ConstraintSolver/btGeneric6DofSpring2Constraint.h>

#include "tests/bench/zoo/bullet.h"

namespace detent_zoo {

namespace {

constexpr Rotation k_z_to_x = {0.5, 0.5, 0.5, 0.5};  ///< a hinge's axis is its frame's z
constexpr int k_first_angle = 3;                     ///< of the six axes of a frame: x, y, z, about x, about y, about z

/// One that is free to move, turn or push along the axes of its frame. It takes angles the other way round.
class Frames : public btGeneric6DofSpring2Constraint {
 public:
  using btGeneric6DofSpring2Constraint::btGeneric6DofSpring2Constraint;

  void set_free(int axis) { setLimit(axis, 1, -1); }
  void set_held(int axis) { setLimit(axis, 0, 0); }
  void set_axis(int axis, const AxisFrame& frame) {
    const double sign = axis < k_first_angle ? 1 : -1;
    if (frame.limited) {
      setLimit(axis, bullet(sign > 0 ? frame.lower : -frame.upper), bullet(sign > 0 ? frame.upper : -frame.lower));
    } else {
      set_free(axis);
    }
    if (is_driven(frame)) {
      enableMotor(axis, true);
      setTargetVelocity(axis, bullet(-frame.speed));
      setMaxMotorForce(axis, bullet(frame.force_max));
    }
    if (is_sprung(frame)) {
      enableSpring(axis, true);
      setEquilibriumPoint(axis, bullet(sign * frame.target));
    }
  }
  void set_friction(int axis, double most) {
    enableMotor(axis, true);
    setTargetVelocity(axis, 0);
    setMaxMotorForce(axis, bullet(most));
  }
  void set_spring(int axis, const Spring& spring) {
    setStiffness(axis, bullet(spring.stiffness), false);  // as it is asked for: too_stiff()
    setDamping(axis, bullet(spring.damping));
  }
};

/// Its springs push by where they are at the start of a step, and by default are made softer from a quarter of this on.
bool too_stiff(const AxisFrame& axis, double tick) { return 2 * M_PI * axis.frequency * tick > 1; }

bool beyond_half_a_turn(const AxisFrame& axis) { return axis.limited && (axis.lower < -M_PI || axis.upper > M_PI); }

}  // namespace

std::string make_bullet_joint(const JointFrame& joint, const Ties& ties, btRigidBody& a, btRigidBody& b, double tick,
                              std::unique_ptr<btTypedConstraint>& constraint) {
  const btTransform frame_a = bullet(joint.frame_a, joint.anchor_a), frame_b = bullet(joint.frame_b, joint.anchor_b);
  const AxisFrame &first = joint.axes[0], &second = joint.axes[1];
  if (joint.type == Held::distance) return "distance joint";
  if (joint.type == Held::ball && is_sprung(first)) return "spring of a ball joint";
  for (const AxisFrame& axis : joint.axes) {
    if (is_sprung(axis) && axis.force_max > 0) return "spring with a greatest force";
    if (is_sprung(axis) && axis.speed != 0) return "spring with a speed";
    if (too_stiff(axis, tick)) return "spring too stiff for its step";
  }
  const auto frames = [&] {
    auto made = std::make_unique<Frames>(a, b, frame_a, frame_b);
    for (int i = 0; i < 6; ++i) made->set_held(i);
    return made;
  };
  if (ties.break_torque > 0) return "joint that a torque breaks";
  if (ties.break_force > 0 && joint.type != Held::ball) return "joint of this type that breaks";
  switch (joint.type) {
    case Held::ball:
      if (ties.friction_torque > 0) return "friction of a ball joint";
      constraint = std::make_unique<btPoint2PointConstraint>(a, b, bullet(joint.anchor_a), bullet(joint.anchor_b));
      if (ties.break_force > 0) constraint->setBreakingImpulseThreshold(bullet(ties.break_force * tick));
      return "";
    case Held::hinge: {
      if (beyond_half_a_turn(first)) return "limit beyond half a turn";
      if (is_sprung(first)) {
        if (ties.friction_torque > 0) return "spring with friction";
        auto made = frames();
        made->set_axis(k_first_angle, first);
        constraint = std::move(made);
        return "";
      }
      auto hinge = std::make_unique<btHingeConstraint>(a, b, bullet(joint.frame_a * k_z_to_x, joint.anchor_a),
                                                       bullet(joint.frame_b * k_z_to_x, joint.anchor_b));
      if (first.limited) hinge->setLimit(bullet(-first.upper), bullet(-first.lower));
      if (is_driven(first)) {
        if (ties.friction_torque > 0) return "motor with friction";
        hinge->enableAngularMotor(true, bullet(-first.speed), bullet(first.force_max * tick));
      } else if (ties.friction_torque > 0) {
        hinge->enableAngularMotor(true, 0, bullet(ties.friction_torque * tick));
      }
      constraint = std::move(hinge);
      return "";
    }
    case Held::fixed:
      constraint = std::make_unique<btFixedConstraint>(a, b, frame_a, frame_b);
      return "";
    case Held::slider: {
      if (ties.friction_force > 0 && (is_driven(first) || is_sprung(first))) return "motor with friction";
      auto made = frames();
      made->set_axis(0, first);
      if (ties.friction_force > 0) made->set_friction(0, ties.friction_force);
      constraint = std::move(made);
      return "";
    }
    case Held::wheel: {
      if (beyond_half_a_turn(second)) return "limit beyond half a turn";
      if (ties.friction_force > 0 || ties.friction_torque > 0) return "friction of a wheel joint";
      auto made = frames();
      made->set_axis(0, first);
      made->set_axis(5, second);
      constraint = std::move(made);
      return "";
    }
    case Held::parallel: {
      if (is_driven(first) || is_sprung(first)) return "motor of a parallel joint";
      auto made = frames();
      for (int i = 0; i < 3; ++i) made->set_free(i);
      made->set_axis(k_first_angle, first);
      if (ties.friction_torque > 0) made->set_friction(k_first_angle, ties.friction_torque);
      constraint = std::move(made);
      return "";
    }
    case Held::cone_twist: {
      if (ties.friction_torque > 0) return "friction of a cone twist";
      if (is_driven(first) || is_sprung(first) || is_driven(second) || is_sprung(second))
        return "motor of a cone twist";
      if (!first.limited || !second.limited) return "cone twist without limits";
      // Its twist has the same limit on both sides: A's frame is turned to the middle of them.
      const double middle = 0.5 * (first.lower + first.upper), span = 0.5 * (first.upper - first.lower);
      const Rotation rotation_vector = {sin(middle / 2), 0, 0, cos(middle / 2)};
      auto cone = std::make_unique<btConeTwistConstraint>(a, b, bullet(joint.frame_a * rotation_vector, joint.anchor_a),
                                                          frame_b);
      cone->setLimit(bullet(second.upper), bullet(second.upper), bullet(span));
      constraint = std::move(cone);
      return "";
    }
    case Held::distance:
    case Held::filter:
      break;
  }
  return "";
}

void set_bullet_springs(const JointFrame& joint, const JointState& state, btTypedConstraint& constraint) {
  Frames& frames = static_cast<Frames&>(constraint);
  const int axes[2] = {joint.type == Held::hinge ? k_first_angle : 0, 5};
  for (int i = 0; i < 2; ++i) {
    if (is_sprung(joint.axes[i])) frames.set_spring(axes[i], spring_of(joint.axes[i], state.masses[i]));
  }
}

}  // namespace detent_zoo
