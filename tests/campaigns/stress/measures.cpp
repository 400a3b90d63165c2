#include "tests/campaigns/stress/measures.h"

#include <math.h>

#include "tests/common/queries/triple.h"

namespace detent_stress {

namespace {

using detent_queries::cross;
using detent_queries::operator+;
using detent_queries::operator*;
using detent_queries::dot;
using detent_queries::rotate;
using detent_queries::Rotation;
using detent_queries::Triple;

bool can_move(const StageBody& body) { return body.role == Role::dynamic; }
Triple triple(const double (&v)[3]) { return {v[0], v[1], v[2]}; }

}  // namespace

double length(const std::array<double, 3>& v) { return detent_queries::length(v); }
std::array<double, 3> operator-(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return detent_queries::operator-(a, b);
}
double angle_between(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return atan2(length(cross(a, b)), dot(a, b));
}
std::array<double, 3> to_local(const double (&rotation)[4], const std::array<double, 3>& v) {
  return rotate(Rotation{-rotation[0], -rotation[1], -rotation[2], rotation[3]}, v);
}
std::array<double, 3> to_world(const double (&rotation)[4], const std::array<double, 3>& v) {
  return rotate(Rotation{rotation[0], rotation[1], rotation[2], rotation[3]}, v);
}

double drift(const Stage& stage, const States& states) {
  double result = 0;
  for (size_t i = 0; i < states.size(); ++i) {
    if (!can_move(stage.bodies[i])) continue;
    const double x = states[i].position[0] - stage.bodies[i].position[0];
    const double z = states[i].position[2] - stage.bodies[i].position[2];
    result = fmax(result, sqrt(x * x + z * z));
  }
  return result;
}

double sag(const Stage& stage, const States& states) {
  double result = 0;
  for (size_t i = 0; i < states.size(); ++i) {
    if (can_move(stage.bodies[i])) result = fmax(result, stage.bodies[i].position[1] - states[i].position[1]);
  }
  return result;
}

double speed_mean(const Stage& stage, const States& states) {
  double sum = 0;
  uint32_t count = 0;
  for (size_t i = 0; i < states.size(); ++i) {
    if (!can_move(stage.bodies[i])) continue;
    sum += length(triple(states[i].linear_velocity));
    ++count;
  }
  return count != 0 ? sum / count : 0;
}

double stretch(const Stage& stage, const States& states) {
  double gaps = 0, links = 0;
  for (size_t i = 0; i < stage.joints.size(); ++i) {
    const StageJoint& joint = stage.joints[i];
    gaps += length(point_of(states[joint.b], joint.anchor_b) - point_of(states[joint.a], joint.anchor_a));
    if (i != 0) links += length(triple(joint.anchor_a) - triple(stage.joints[i - 1].anchor_b));
  }
  return gaps / links;
}

double late_mean(const std::vector<double>& values) {
  const size_t first = values.size() - (values.size() + 2) / 3;
  double sum = 0;
  for (size_t i = first; i < values.size(); ++i) sum += values[i];
  return sum / static_cast<double>(values.size() - first);
}

Sums sums_of(const Stage& stage, const States& states) {
  Sums sums;
  for (size_t i = 0; i < states.size(); ++i) {
    const StageBody& body = stage.bodies[i];
    if (!can_move(body)) continue;
    const BodyState& state = states[i];
    const double mass = mass_of(body);
    const Triple linear_velocity = triple(state.linear_velocity), position = triple(state.position);
    const Triple angular_velocity = to_local(state.rotation, triple(state.angular_velocity));
    const std::array<double, 3> inverse_inertia = inverse_inertia_of(body);
    Triple own;
    double turning = 0;
    for (size_t axis = 0; axis < 3; ++axis) {
      own[axis] = mass * inverse_inertia[axis] * angular_velocity[axis];
      turning += own[axis] * angular_velocity[axis] / 2;
    }
    sums.linear = sums.linear + linear_velocity * mass;
    sums.angular = sums.angular + to_world(state.rotation, own) + cross(position, linear_velocity * mass);
    sums.energy += mass * dot(linear_velocity, linear_velocity) / 2 + turning;
    sums.potential += mass * stage.gravity * position[1];
  }
  return sums;
}

}  // namespace detent_stress
