#include "tests/campaigns/joint_fuzz/account.h"

#include <algorithm>

#include "tests/campaigns/joint_fuzz/turn.h"

namespace detent_joint_fuzz {

namespace {

constexpr Triple k_axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

double kinetic(const Inertia& inertia, const State& state) {
  const Triple angular_velocity = unrotate(state.rotation, state.angular_velocity);
  double sum = inertia.mass * dot(state.linear_velocity, state.linear_velocity);
  for (size_t i = 0; i < 3; ++i) sum += inertia.moments[i] * angular_velocity[i] * angular_velocity[i];
  return sum / 2;
}

Triple anchor_of(const State& state, const Triple& anchor) { return state.position + rotate(state.rotation, anchor); }

/// The angle between two axes, rad.
double angle_between(const Triple& a, const Triple& b) { return atan2(length(cross(a, b)), dot(a, b)); }

/// The speed at which the anchors separate along the line between them, or the speed of B's anchor in A's frame, m/s.
double slide_rate(const SceneJoint& joint, const State& a, const State& b) {
  const Triple from = anchor_of(a, joint.anchor_a), to = anchor_of(b, joint.anchor_b);
  const Triple displacement = to - from;
  const Triple of_b = b.linear_velocity + cross(b.angular_velocity, to - b.position);
  const Triple of_a =
      a.linear_velocity + cross(a.angular_velocity, (joint.hold == Hold::distance ? from : to) - a.position);
  const double apart = length(displacement);
  if (joint.hold == Hold::distance && apart > 0) return dot(of_b - of_a, displacement) / apart;
  return length(of_b - of_a);
}

}  // namespace

double energy_of(const Scene& scene, const std::vector<Inertia>& inertia, const States& states, double lag) {
  double sum = 0;
  for (size_t i = 0; i < states.size(); ++i) {
    const double height = states[i].position[1] - lag * states[i].linear_velocity[1];
    sum += kinetic(inertia[i], states[i]) + inertia[i].mass * scene.gravity * height;
  }
  return sum;
}

double scale_of(const Scene& scene, const std::vector<Inertia>& inertia, const States& start) {
  // A scene at rest may creep by rounding errors, in every configuration.
  constexpr double k_speed_least = 1e-2;  // m/s
  double mass = 0, sum = 0;
  for (size_t i = 0; i < start.size(); ++i) {
    mass += inertia[i].mass;
    sum += kinetic(inertia[i], start[i]);
  }
  return sum + 0.1 * mass * scene.gravity * scene.extent + 0.5 * mass * k_speed_least * k_speed_least;
}

Gap gap_of(const SceneJoint& joint, const States& states) {
  const State &a = states[joint.a], &b = states[joint.b];
  const Rotation frame_a = product(a.rotation, joint.frame_a), frame_b = product(b.rotation, joint.frame_b);
  const Triple displacement = anchor_of(b, joint.anchor_b) - anchor_of(a, joint.anchor_a);
  const auto between = [&](const Triple& axis) { return angle_between(rotate(frame_a, axis), rotate(frame_b, axis)); };
  Gap gap;
  switch (joint.hold) {
    case Hold::distance: {
      const double apart = length(displacement);
      gap.length = std::max({0.0, apart - joint.axis.upper, joint.axis.lower - apart});
      return gap;
    }
    case Hold::slider:
    case Hold::wheel: {
      const Triple x = rotate(frame_a, k_axes[0]);
      gap.length = length(displacement - x * dot(displacement, x));
      gap.angle = between(k_axes[2]);
      if (joint.hold == Hold::slider) gap.angle = std::max(gap.angle, between(k_axes[0]));
      return gap;
    }
    case Hold::hinge:
      gap.angle = between(k_axes[0]);
      break;
    case Hold::fixed:
      gap.angle = std::max(between(k_axes[0]), between(k_axes[1]));
      break;
    default:
      break;
  }
  gap.length = length(displacement);
  return gap;
}

Gap greatest_gap(const Scene& scene, const States& states) {
  Gap greatest;
  for (const SceneJoint& joint : scene.joints) {
    const Gap gap = gap_of(joint, states);
    greatest.length = std::max(greatest.length, gap.length);
    greatest.angle = std::max(greatest.angle, gap.angle);
  }
  return greatest;
}

double power_max(const Scene& scene, const States& states) {
  double power = 0;
  for (const SceneJoint& joint : scene.joints) {
    const State &a = states[joint.a], &b = states[joint.b];
    const bool slides = joint.hold == Hold::slider || joint.hold == Hold::wheel || joint.hold == Hold::distance;
    const auto add = [&](const SceneAxis& axis, bool length_axis) {
      const bool brake = axis.frequency == 0 && axis.speed == 0;
      if (axis.force_max == 0 || brake) return;
      const double rate = length_axis ? slide_rate(joint, a, b) : length(b.angular_velocity - a.angular_velocity);
      power += axis.force_max * std::max(rate, fabs(axis.speed));
    };
    add(joint.axis, slides);
    add(joint.second, false);
  }
  return power;
}

}  // namespace detent_joint_fuzz
