#include "motion/spin.h"

#include "math/trig.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

struct BodyFrame {
  Quat rotation;
  Real momentum[3];  ///< in the body's axes
};

/// Rotates the frame about one of its axes for `time`, at `rate` times the angular momentum about that axis. The
/// angular momentum stays constant in the world.
void turn_about(int axis, Scaled rate, int exponent, Real time, BodyFrame& frame, bool& clamped) {
  bool saturated = false;
  const Real spin = multiply(frame.momentum[axis], rate, saturated);
  const Real angle = angle_of(spin * time, exponent, clamped);
  clamped = clamped || saturated;
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

Scaled difference(Scaled a, Scaled b) { return a == b ? Scaled(0.0) : add(a, negate(b)); }
Scaled distance(Scaled a, Scaled b) { return less(a, b) ? difference(b, a) : difference(a, b); }

/// The axis whose inverse inertia differs most from the other two.
int odd_axis(const Scaled (&gyration)[3]) {
  if (gyration[1] == gyration[2]) return 0;
  if (gyration[2] == gyration[0]) return 1;
  if (gyration[0] == gyration[1]) return 2;
  const Scaled apart[3] = {distance(gyration[1], gyration[2]), distance(gyration[2], gyration[0]),
                           distance(gyration[0], gyration[1])};
  const int least = less(apart[1], apart[0]) ? 1 : 0;
  return less(apart[2], apart[least]) ? 2 : least;
}

/// Rotates for `time` about a world axis by the angular velocity `spin`, m/s at the radius 2^exponent m.
Quat turned(const Quat& rotation, const Vec3<Real>& spin, int exponent, Real time, bool& clamped) {
  const Vec3<Real> angle = {angle_of(spin.x * time, exponent, clamped), angle_of(spin.y * time, exponent, clamped),
                            angle_of(spin.z * time, exponent, clamped)};
  return normalise(multiply(rotation_from_vector(angle), rotation));
}

}  // namespace

FreeTurn free_turn_of(const BodyTraits& traits) {
  FreeTurn free = {Scaled(0.0), Scaled(0.0), Scaled(0.0), 0};
  if (!is_dynamic(traits) || is_isotropic(traits)) return free;
  free.odd = odd_axis(traits.gyration);
  free.common = traits.gyration[(free.odd + 1) % 3];
  free.odd_rate = difference(traits.gyration[free.odd], free.common);
  free.rest = difference(traits.gyration[(free.odd + 2) % 3], free.common);
  return free;
}

bool turn_freely(const BodyTraits& traits, const FreeTurn& free, const Vec3<Real>& momentum, Real time, int halvings,
                 Quat& rotation, Vec3<Real>& spin) {
  const Real zero = 0.0;
  const Vec3<Real> none = {zero, zero, zero};
  const int exponent = traits.size_exponent;
  bool clamped = false;
  if (!is_dynamic(traits) || is_isotropic(traits)) {
    spin = spin_of(traits, rotation, momentum);
    if (!(spin == none)) rotation = turned(rotation, spin, exponent, time, clamped);
    return !clamped;
  }
  const Vec3<Real> local = rotate_inverse(rotation, momentum);
  spin = rotate(rotation, gyrate(traits, local));
  if (spin == none) return true;
  const int a = free.odd, c = (a + 2) % 3;
  BodyFrame frame = {rotation, {local.x, local.y, local.z}};
  // The rotation about the angular momentum commutes with the other two: it is applied once, at the end.
  if (free.rest == Scaled(0.0)) {
    turn_about(a, free.odd_rate, exponent, time, frame, clamped);
  } else {
    const Real part = scale_by_power(time, -halvings), half = scale_by_power(part, -1);
    const int steps = 1 << halvings;
    for (int step = 0; step < steps; ++step) {
      turn_about(c, free.rest, exponent, step == 0 ? half : part, frame, clamped);
      turn_about(a, free.odd_rate, exponent, part, frame, clamped);
    }
    turn_about(c, free.rest, exponent, half, frame, clamped);
  }
  rotation = turned(frame.rotation, multiply(momentum, free.common), exponent, time, clamped);
  return !clamped;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
