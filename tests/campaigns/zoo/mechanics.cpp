#include "tests/campaigns/zoo/mechanics.h"

#include <algorithm>

namespace detent_zoo {

namespace {

constexpr Vector k_x = {1, 0, 0}, k_z = {0, 0, 1};

/// I^-1 torque, world axes.
Vector answer_to_torque(const BodyFrame& body, const Vector& torque) {
  if (body.kind != Kind::dynamic) return {};
  const Vector own = rotate(inverse(body.rotation), torque);
  const auto over = [](double value, double moment) { return moment > 0 ? value / moment : 0; };
  return rotate(body.rotation, {over(own.x, body.inertia.x), over(own.y, body.inertia.y), over(own.z, body.inertia.z)});
}

double angular_mass(const BodyFrame& a, const BodyFrame& b, const Vector& axis) {
  const double answer = dot(axis, answer_to_torque(a, axis)) + dot(axis, answer_to_torque(b, axis));
  return answer > 0 ? 1 / answer : 0;
}

double linear_mass(const BodyFrame& a, const BodyFrame& b, const Vector& arm_a, const Vector& arm_b,
                   const Vector& displacement) {
  double answer = 0;
  const auto add = [&](const BodyFrame& body, const Vector& arm) {
    if (body.kind != Kind::dynamic) return;
    const Vector rotation_vector = cross(arm, displacement);
    answer += 1 / body.mass + dot(rotation_vector, answer_to_torque(body, rotation_vector));
  };
  add(a, arm_a);
  add(b, arm_b);
  return answer > 0 ? 1 / answer : 0;
}

double angle_between(const Vector& a, const Vector& b) { return atan2(length(cross(a, b)), dot(a, b)); }

/// The angle of a rotation about one of its axes, in (-pi, pi].
double twist(double sine, double cosine) {
  const double angle = 2 * atan2(sine, cosine);
  return angle > M_PI ? angle - 2 * M_PI : angle <= -M_PI ? angle + 2 * M_PI : angle;
}

double beyond(const AxisFrame& axis, double value) {
  return axis.limited ? std::max({0.0, axis.lower - value, value - axis.upper}) : 0;
}

}  // namespace

Rotation operator*(const Rotation& a, const Rotation& b) {
  return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
          a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}
Rotation inverse(const Rotation& rotation) { return {-rotation.x, -rotation.y, -rotation.z, rotation.w}; }
Vector rotate(const Rotation& q, const Vector& v) {
  const Vector axis = {q.x, q.y, q.z};
  const Vector rotation_vector = 2.0 * cross(axis, v);
  return v + q.w * rotation_vector + cross(axis, rotation_vector);
}

Vector angular_momentum_of(const BodyFrame& body) {
  const Vector own = rotate(inverse(body.rotation), body.angular_velocity);
  return rotate(body.rotation, {body.inertia.x * own.x, body.inertia.y * own.y, body.inertia.z * own.z});
}

double kinetic_energy(const BodyFrame& body) {
  if (body.kind != Kind::dynamic) return 0;
  return 0.5 * (body.mass * dot(body.linear_velocity, body.linear_velocity) +
                dot(body.angular_velocity, angular_momentum_of(body)));
}

double potential_energy(const BodyFrame& body, const Vector& gravity) {
  return body.kind == Kind::dynamic ? -body.mass * body.gravity_scale * dot(gravity, body.position) : 0;
}

double size_of(const BodyFrame& body) {
  const double most = std::max({body.inertia.x, body.inertia.y, body.inertia.z});
  return body.mass > 0 ? sqrt(12 * most / body.mass) : 0;
}

double thickness_of(const BodyFrame& body) {
  const Vector& inertia = body.inertia;
  if (inertia.x <= 0 || inertia.y <= 0 || inertia.z <= 0 || body.mass <= 0) return 0;
  const double most = std::max({inertia.x, inertia.y, inertia.z});
  return sqrt(std::max(0.0, 6 * (inertia.x + inertia.y + inertia.z - 2 * most) / body.mass));
}

JointState state_of(const JointFrame& joint, const Frame& frame) {
  const BodyFrame &a = frame.bodies[joint.a], &b = frame.bodies[joint.b];
  const Vector arm_a = rotate(a.rotation, joint.anchor_a), arm_b = rotate(b.rotation, joint.anchor_b);
  const Vector gap = b.position + arm_b - (a.position + arm_a);
  const Rotation frame_a = a.rotation * joint.frame_a, frame_b = b.rotation * joint.frame_b;
  const Rotation between = inverse(frame_a) * frame_b;
  const Vector x_a = rotate(frame_a, k_x), x_b = rotate(frame_b, k_x);
  JointState state;
  state.gap = length(gap);
  const auto slide = [&] {
    state.values[0] = dot(gap, x_a);
    state.gap = length(gap - state.values[0] * x_a);
    state.masses[0] = linear_mass(a, b, arm_a + gap, arm_b, x_a);
    state.free[0] = true;
  };
  const auto rotation_vector = [&](int i, double value, const Vector& axis) {
    state.values[i] = value;
    state.masses[i] = angular_mass(a, b, axis);
    state.free[i] = true;
  };
  const double whole_turn = 2 * atan2(length({between.x, between.y, between.z}), fabs(between.w));
  switch (joint.type) {
    case Held::ball: {
      if (joint.axes[0].frequency == 0) break;
      const Vector axis = {between.x, between.y, between.z};
      const double sine = length(axis), share = sine > 1e-12 ? copysign(whole_turn, between.w) / sine : 0;
      rotation_vector(0, share * axis.x, x_a);
      rotation_vector(1, share * axis.y, rotate(frame_a, {0, 1, 0}));
      rotation_vector(2, share * axis.z, rotate(frame_a, k_z));
      return state;
    }
    case Held::filter:
      state.gap = 0;
      break;
    case Held::parallel:
      state.gap = 0;
      [[fallthrough]];
    case Held::hinge:
      state.angle = angle_between(x_a, x_b);
      rotation_vector(0, twist(between.x, between.w), x_a);
      break;
    case Held::slider:
      slide();
      state.angle = whole_turn;
      break;
    case Held::distance: {
      const double apart = state.gap;
      const Vector displacement = apart > 0 ? (1 / apart) * gap : x_a;
      state.values[0] = apart;
      state.free[0] = true;
      state.masses[0] = linear_mass(a, b, arm_a, arm_b, displacement);
      state.gap = beyond(joint.axes[0], apart);
      return state;
    }
    case Held::fixed:
      state.angle = whole_turn;
      break;
    case Held::cone_twist: {
      rotation_vector(0, twist(between.x, between.w), x_a);
      const Vector across = cross(x_a, x_b);
      const double sine = length(across);
      rotation_vector(1, angle_between(x_a, x_b), sine > 1e-9 ? (1 / sine) * across : rotate(frame_a, k_z));
      break;
    }
    case Held::wheel:
      slide();
      state.angle = angle_between(rotate(frame_a, k_z), rotate(frame_b, k_z));
      rotation_vector(1, twist(between.z, between.w), rotate(frame_a, k_z));
      break;
  }
  for (int i = 0; i < 2; ++i) {
    if (state.free[i]) state.limit = std::max(state.limit, beyond(joint.axes[i], state.values[i]));
  }
  return state;
}

}  // namespace detent_zoo
