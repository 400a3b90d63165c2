#include "tests/bench/zoo/ode.h"

namespace detent_zoo {

namespace {

struct Place {
  Vector position;
  Rotation rotation;
};

Place place_of(const OdeBody& body) {
  if (body.body == nullptr) return {body.position, body.rotation};
  return {vector_from_ode(dBodyGetPosition(body.body)), from_ode(dBodyGetQuaternion(body.body))};
}
void put(const OdeBody& body, const Place& place) {
  const dQuaternion q = {place.rotation.w, place.rotation.x, place.rotation.y, place.rotation.z};
  dBodySetPosition(body.body, place.position.x, place.position.y, place.position.z);
  dBodySetQuaternion(body.body, q);
}

/// Sets a parameter of a hinge or slider.
void set(dJointID joint, int parameter, double value) {
  if (dJointGetType(joint) == dJointTypeHinge)
    dJointSetHingeParam(joint, parameter, value);
  else
    dJointSetSliderParam(joint, parameter, value);
}

/// Limits, motor and friction. A spring is a limit on both sides that gives.
std::string set_axis(const AxisFrame& axis, double friction, const OdeJoint& made) {
  const dJointID joint = made.joint;
  if (is_sprung(axis)) {
    if (axis.limited) return "spring with limits";
    if (axis.force_max > 0) return "spring with a greatest force";
    if (axis.speed != 0) return "spring with a speed";
    if (friction > 0) return "spring with friction";
    set(joint, dParamLoStop, made.sign * axis.target);
    set(joint, dParamHiStop, made.sign * axis.target);
    return "";
  }
  if (axis.limited) {
    if (dJointGetType(joint) == dJointTypeHinge && (axis.lower < -M_PI || axis.upper > M_PI))
      return "limit beyond half a turn";
    const double low = made.sign > 0 ? axis.lower : -axis.upper, high = made.sign > 0 ? axis.upper : -axis.lower;
    for (int i = 0; i < 2; ++i) {  // neither is taken while it is beyond the other
      set(joint, dParamLoStop, low);
      set(joint, dParamHiStop, high);
    }
  }
  if (is_driven(axis)) {
    if (friction > 0) return "motor with friction";
    set(joint, dParamVel, made.sign * axis.speed);
    set(joint, dParamFMax, axis.force_max);
  } else if (friction > 0) {
    set(joint, dParamVel, 0);
    set(joint, dParamFMax, friction);
  }
  return "";
}

std::string make_distance(dWorldID world, const JointFrame& given, const Vector& anchor_one, const Vector& anchor_two,
                          dBodyID one, dBodyID two, OdeJoint& made) {
  const AxisFrame& axis = given.axes[0];
  if (is_driven(axis)) return "motor of a distance joint";
  if (is_sprung(axis) ? axis.limited : !axis.limited || axis.lower != axis.upper) {
    return is_sprung(axis) ? "spring with limits" : "rope";
  }
  if (is_sprung(axis) && (axis.force_max > 0 || axis.speed != 0)) return "spring with a greatest force";
  made.joint = dJointCreateDBall(world, nullptr);
  dJointAttach(made.joint, one, two);
  dJointSetDBallAnchor1(made.joint, anchor_one.x, anchor_one.y, anchor_one.z);
  dJointSetDBallAnchor2(made.joint, anchor_two.x, anchor_two.y, anchor_two.z);
  dJointSetDBallDistance(made.joint, is_sprung(axis) ? axis.target : axis.lower);
  return "";
}

}  // namespace

std::string make_ode_joint(dWorldID world, const JointFrame& given, const Ties& ties, OdeBody& a, OdeBody& b,
                           OdeJoint& made) {
  if (given.type == Held::filter) return "";
  if (ties.break_torque > 0) return "joint that a torque breaks";
  // The first body is one that moves. ODE takes what a joint holds together from where the bodies are: so for a moment
  // the first one is put where its frame lies on that of the second, which is also where all angles are 0.
  const bool swapped = a.body == nullptr;
  OdeBody &one = swapped ? b : a, &two = swapped ? a : b;
  const Vector &anchor_one = swapped ? given.anchor_b : given.anchor_a,
               &anchor_two = swapped ? given.anchor_a : given.anchor_b;
  const Rotation &frame_one = swapped ? given.frame_b : given.frame_a,
                 &frame_two = swapped ? given.frame_a : given.frame_b;
  made.sign = swapped ? 1 : -1;
  const Place before = place_of(one), other = place_of(two);
  const Vector point = other.position + rotate(other.rotation, anchor_two);
  if (given.type == Held::distance) {
    return make_distance(world, given, before.position + rotate(before.rotation, anchor_one), point, one.body, two.body,
                         made);
  }
  Place held;
  held.rotation = other.rotation * frame_two * inverse(frame_one);
  held.position = point - rotate(held.rotation, anchor_one);
  const Vector axis = rotate(other.rotation * frame_two, {1, 0, 0});
  put(one, held);
  std::string problem;
  switch (given.type) {
    case Held::ball:
      if (is_sprung(given.axes[0])) problem = "spring of a ball joint";
      if (ties.friction_torque > 0) problem = "friction of a ball joint";
      made.joint = dJointCreateBall(world, nullptr);
      dJointAttach(made.joint, one.body, two.body);
      dJointSetBallAnchor(made.joint, point.x, point.y, point.z);
      break;
    case Held::hinge:
      made.joint = dJointCreateHinge(world, nullptr);
      dJointAttach(made.joint, one.body, two.body);
      dJointSetHingeAnchor(made.joint, point.x, point.y, point.z);
      dJointSetHingeAxis(made.joint, axis.x, axis.y, axis.z);
      problem = set_axis(given.axes[0], ties.friction_torque, made);
      break;
    case Held::slider:
      made.joint = dJointCreateSlider(world, nullptr);
      dJointAttach(made.joint, one.body, two.body);
      dJointSetSliderAxis(made.joint, axis.x, axis.y, axis.z);
      problem = set_axis(given.axes[0], ties.friction_force, made);
      break;
    case Held::fixed:
      made.joint = dJointCreateFixed(world, nullptr);
      dJointAttach(made.joint, one.body, two.body);
      dJointSetFixed(made.joint);
      break;
    case Held::cone_twist:
      problem = "cone twist";
      break;
    case Held::wheel:
      problem = "wheel joint";
      break;
    case Held::parallel:
      problem = "parallel joint";
      break;
    default:
      problem = "joint type";
      break;
  }
  put(one, before);
  if (problem.empty() && ties.break_force > 0) {
    made.break_force = ties.break_force;
    made.feedback = std::make_unique<dJointFeedback>();
    dJointSetFeedback(made.joint, made.feedback.get());
  }
  return problem;
}

void set_ode_spring(const JointFrame& joint, const JointState& state, double tick, const OdeJoint& made) {
  const Spring spring = spring_of(joint.axes[0], state.masses[0]);
  const double pull = tick * spring.stiffness, whole = pull + spring.damping;  // as the manual has it
  if (!(whole > 0)) return;
  if (joint.type == Held::distance) {
    dJointSetDBallParam(made.joint, dParamERP, pull / whole);
    dJointSetDBallParam(made.joint, dParamCFM, 1 / whole);
  } else {
    set(made.joint, dParamStopERP, pull / whole);
    set(made.joint, dParamStopCFM, 1 / whole);
  }
}

}  // namespace detent_zoo
