#include "dynamics/spin.h"

#include "math/trig.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

struct BodyFrame {
  Quat rotation;
  Real momentum[3];  ///< in the body's axes
};

/// The exact motion for `time` of a body that has a moment of inertia about one axis alone.
void turn_about(int axis, const BodyTraits& traits, Real time, BodyFrame& frame, bool& clamped) {
  const Real spin = multiply(frame.momentum[axis], traits.gyration[axis]);
  const Real angle = angle_of(spin * time, traits.size_exponent, clamped);
  Unit sine = 0.0, cosine = 1.0;
  sine_cosine_of_half_radians(angle, sine, cosine);
  Unit part[3] = {0.0, 0.0, 0.0};
  part[axis] = sine;
  frame.rotation = multiply(frame.rotation, Quat{part[0], part[1], part[2], cosine});
  const Unit sine_whole = scale_by_power(sine * cosine, 1);
  const Unit cosine_whole = cosine * cosine - sine * sine;
  Real& next = frame.momentum[(axis + 1) % 3];
  Real& after = frame.momentum[(axis + 2) % 3];
  const Real turned = next * cosine_whole + after * sine_whole;
  after = after * cosine_whole - next * sine_whole;
  next = turned;
}

}  // namespace

bool turn_freely(const BodyTraits& traits, const Vec3<Real>& momentum, const Vec3<Real>& spin, Real time,
                 Quat& rotation) {
  const Real zero = 0.0;
  bool clamped = false;
  if (spin == Vec3<Real>{zero, zero, zero}) return true;
  if (!is_dynamic(traits) || is_isotropic(traits)) {
    const Vec3<Real> angle = {angle_of(spin.x * time, traits.size_exponent, clamped),
                              angle_of(spin.y * time, traits.size_exponent, clamped),
                              angle_of(spin.z * time, traits.size_exponent, clamped)};
    rotation = normalise(multiply(rotation_from_vector(angle), rotation));
    return !clamped;
  }
  const Vec3<Real> local = rotate_inverse(rotation, momentum);
  BodyFrame frame = {rotation, {local.x, local.y, local.z}};
  const Real half = scale_by_power(time, -1);
  turn_about(0, traits, half, frame, clamped);
  turn_about(1, traits, half, frame, clamped);
  turn_about(2, traits, time, frame, clamped);
  turn_about(1, traits, half, frame, clamped);
  turn_about(0, traits, half, frame, clamped);
  rotation = normalise(frame.rotation);
  return !clamped;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
