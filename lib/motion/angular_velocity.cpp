#include "motion/angular_velocity.h"

#include "base/cycle.h"
#include "math/trig.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// A body that rotates by at most about 2^-k_slow_power rad is rotated once by rotate_freely(), not four times: the
/// rotations commute except for half the product of two of their angles, which is below the precision of a Quat.
#if defined(DETENT_F64)
constexpr int k_slow_power = 29;
#elif defined(DETENT_F32)
constexpr int k_slow_power = 14;
#else
constexpr int k_slow_power = 17;
#endif

struct BodyFrame {
  Quat rotation;
  Real angular_momentum[3];  ///< in the body's axes
};

/// Rotates the frame about one of its axes for `time`, s. The angular velocity is `rate` times the angular momentum
/// about that axis, m/s at the radius 2^exponent m. The angular momentum stays constant in world axes. Sets `clamped`
/// if the angular velocity or the angle leaves its range.
void rotate_about(int axis, Scaled rate, int exponent, Real time, BodyFrame& frame, bool& clamped) {
  const Real angular_velocity = multiply(frame.angular_momentum[axis], rate, clamped);
  const Real angle = angle_of(angular_velocity * time, exponent, clamped);
  Unit sine = 0.0, cosine = 1.0;
  sine_cosine_of_half_radians(angle, sine, cosine);
  frame.rotation = multiply_about(frame.rotation, axis, sine, cosine);
  const Unit sine_whole = scale_by_power(sine * cosine, 1);
  const Unit cosine_whole = cosine * cosine - sine * sine;
  Real& next = frame.angular_momentum[next_of_three(axis)];
  Real& after = frame.angular_momentum[previous_of_three(axis)];
  const Real turned = next * cosine_whole + after * sine_whole;
  after = after * cosine_whole - next * sine_whole;
  next = turned;
}

Scaled difference(Scaled a, Scaled b) { return a == b ? Scaled(0.0) : add(a, negate(b)); }

/// Returns `rotation` rotated for `time`, s, with the constant `angular_velocity`: m/s at the radius 2^exponent m,
/// world axes. Sets `clamped` if a component of the rotation vector is clamped by angle_of().
Quat turned(const Quat& rotation, const Vec3<Real>& angular_velocity, int exponent, Real time, bool& clamped) {
  const Vec3<Real> angle = {angle_of(angular_velocity.x * time, exponent, clamped),
                            angle_of(angular_velocity.y * time, exponent, clamped),
                            angle_of(angular_velocity.z * time, exponent, clamped)};
  return normalise(multiply(rotation_from_vector(angle), rotation));
}

}  // namespace

Scaled rotational_energy(const BodyProperties& properties, const Vec3<Real>& local) {
  const auto term = [&](Real value, int i) {
    const Scaled factor = scaled_from(value);
    return multiply(multiply(factor, factor), properties.inverse_inertia[i]);
  };
  return add(term(local.x, 0), add(term(local.y, 1), term(local.z, 2)));
}

FreeRotation free_rotation_of(const BodyProperties& properties) {
  FreeRotation free = {Scaled(0.0), Scaled(0.0), Scaled(0.0), 0};
  if (!is_dynamic(properties) || is_isotropic(properties)) return free;
  const Scaled(&inverse_inertia)[3] = properties.inverse_inertia;
  Scaled apart[3], distance[3];  // of the two axes that follow each axis in the cycle
  for (int i = 0; i < 3; ++i) {
    apart[i] = difference(inverse_inertia[next_of_three(i)], inverse_inertia[previous_of_three(i)]);
    distance[i] = is_positive(apart[i]) ? apart[i] : negate(apart[i]);
  }
  // The axis whose inverse inertia differs most from the other two.
  free.odd = less(distance[1], distance[0]) ? 1 : 0;
  if (less(distance[2], distance[free.odd])) free.odd = 2;
  free.common = inverse_inertia[next_of_three(free.odd)];
  free.odd_rate = apart[previous_of_three(free.odd)];
  free.rest = negate(apart[free.odd]);
  return free;
}

bool rotate_freely(const BodyProperties& properties, const FreeRotation& free, const Vec3<Real>& angular_momentum,
                   Real time, int halvings, Quat& rotation, Vec3<Real>& angular_velocity) {
  const Real zero = 0.0;
  const Vec3<Real> none = {zero, zero, zero};
  const int exponent = properties.size_exponent;
  bool clamped = false;
  if (!is_dynamic(properties) || is_isotropic(properties)) {
    angular_velocity = angular_velocity_of(properties, rotation, angular_momentum);
    if (!(angular_velocity == none)) rotation = turned(rotation, angular_velocity, exponent, time, clamped);
    return !clamped;
  }
  const Vec3<Real> local = rotate_inverse(rotation, angular_momentum);
  angular_velocity = rotate(rotation, gyrate(properties, local));
  if (angular_velocity == none) return true;
  const Vec3<Real> about_momentum = multiply(angular_momentum, free.common);
  const Real most = max(greatest(angular_velocity), greatest(about_momentum));
  if (most * time <= real_from_unit(Unit(1.0), exponent - k_slow_power)) {
    rotation = turned(rotation, angular_velocity, exponent, time, clamped);
    return !clamped;
  }
  const int a = free.odd, c = previous_of_three(a);
  BodyFrame frame = {rotation, {local.x, local.y, local.z}};
  // The rotation about the angular momentum commutes with the other two rotations, so it is applied once, at the end.
  if (free.rest == Scaled(0.0)) {
    rotate_about(a, free.odd_rate, exponent, time, frame, clamped);
  } else {
    const Real part = scale_by_power(time, -halvings), half = scale_by_power(part, -1);
    const int steps = 1 << halvings;
    for (int step = 0; step < steps; ++step) {
      rotate_about(c, free.rest, exponent, step == 0 ? half : part, frame, clamped);
      rotate_about(a, free.odd_rate, exponent, part, frame, clamped);
    }
    rotate_about(c, free.rest, exponent, half, frame, clamped);
  }
  rotation = turned(frame.rotation, about_momentum, exponent, time, clamped);
  return !clamped;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
