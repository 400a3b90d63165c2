#include "tests/common/oracle/bodies.h"
#include "tests/common/oracle/step_motion.h"

/// The motion of one body in the frame of another, both in a step. Tests what DESIGN.md proves about it with the
/// library's own poses.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using namespace detent_oracle;

constexpr int k_parts = 16;  ///< of the step
/// The error, rad and m over the step, of an angular velocity and a velocity computed from two poses that are one part
/// of the step apart.
constexpr double k_angular_velocity_error = k_parts * (k_config == Config::f64   ? 1e-13
                                                       : k_config == Config::f32 ? 0x1p-20
                                                                                 : 0x1p-26);
constexpr double k_velocity_error = k_angular_velocity_error * 4 + k_parts * (k_config == Config::fx32 ? 0x1p-14 : 0);
/// A quantity that is not constant changes by more than this in the random pairs.
constexpr double k_least_change = 0.03;

/// Two bodies with constant velocities in the world, over a step.
struct Pair {
  PosesOfStep a, b;
};

Vector to_axes(const Quaternion& q, const Vector& v) {
  return {{dot(axis_of(q, 0), v), dot(axis_of(q, 1), v), dot(axis_of(q, 2), v)}};
}
Vector rotation_vector_from(const Quaternion& q) {
  const Vector v = {{q.x, q.y, q.z}};
  const double sine = length(v);
  if (sine == 0) return v;
  return v * (2 * atan2(sine, fabs(q.w)) / (q.w < 0 ? -sine : sine));
}

/// B in A's frame.
Placed relative_at(const Pair& pair, double time) {
  const Placed a = step_motion_at(pair.a, time), b = step_motion_at(pair.b, time);
  return {to_axes(a.rotation, b.position - a.position), normalised(conjugate(a.rotation) * b.rotation)};
}

/// Velocities in A's frame over one part of the step, scaled to the whole step.
struct Velocities {
  Vector angular_velocity, linear;
};
Velocities velocities_in(const Pair& pair, int part) {
  const Placed from = relative_at(pair, static_cast<double>(part) / k_parts);
  const Placed to = relative_at(pair, static_cast<double>(part + 1) / k_parts);
  return {rotation_vector_from(to.rotation * conjugate(from.rotation)) * k_parts,
          (to.position - from.position) * k_parts};
}

/// The greatest changes since the first part.
struct Change {
  double angular_velocity = 0, linear = 0;
};
Change change_of(const Pair& pair) {
  const Velocities first = velocities_in(pair, 0);
  Change change;
  for (int part = 1; part < k_parts; ++part) {
    const Velocities now = velocities_in(pair, part);
    change = {fmax(change.angular_velocity, length(now.angular_velocity - first.angular_velocity)),
              fmax(change.linear, length(now.linear - first.linear))};
  }
  return change;
}

/// The largest distance between the motion and the screw from its first pose to its last.
double off_screw(const Pair& pair) {
  const Placed first = relative_at(pair, 0), last = relative_at(pair, 1);
  const PosesOfStep poses = {first, last.position - first.position,
                             rotation_vector_from(last.rotation * conjugate(first.rotation))};
  return farthest_apart([&](double t) { return relative_at(pair, t); },
                        [&](double t) { return even_screw_at(poses, t); }, 1, k_parts)
      .distance;
}

Vector any_vector(Samples& samples, double low, double high) {
  const double size = uniform(samples, low, high);
  return any_direction(samples) * size;
}
/// A random vector of length 0.5 to 1.2, at an angle of at least 0.5 rad to `other`.
Vector any_vector_beside(Samples& samples, const Vector& other) {
  for (;;) {
    const Vector v = any_vector(samples, 0.5, 1.2);
    if (length(cross(v, other)) > 0.48 * length(v) * length(other)) return v;
  }
}
/// Either way along `axis`.
Vector any_along(Samples& samples, const Vector& axis) {
  const double size = uniform(samples, 0.5, 1.2), sign = samples.below(2) == 0 ? 1 : -1;
  return normalised(axis) * (sign * size);
}

const Vector k_none = {{0, 0, 0}};

/// A pair with these angular velocities, this vector from A to B and this difference of velocities.
Pair pair_of(Samples& samples, const Vector& angular_velocity_a, const Vector& angular_velocity_b,
             const Vector& displacement, const Vector& linear_velocity) {
  Pair pair;
  pair.a.start = {any_vector(samples, 0, 1), any_rotation(samples)};
  pair.b.start = {pair.a.start.position + displacement, any_rotation(samples)};
  pair.a.displacement = any_vector(samples, 0, 1);
  pair.b.displacement = pair.a.displacement + linear_velocity;
  pair.a.rotation_vector = angular_velocity_a;
  pair.b.rotation_vector = angular_velocity_b;
  return pair;
}

DETENT_TEST(relative_motion, has_the_difference_of_the_spins_turned_back_and_the_velocity_of_a_turning_frame) {
  Samples samples = {1};
  for (uint32_t i = 0; i < rounds(200); ++i) {
    const Vector angular_velocity_a = any_vector(samples, 0, 1.2), angular_velocity_b = any_vector(samples, 0, 1.2);
    const Vector displacement = any_vector(samples, 0, 2), linear_velocity = any_vector(samples, 0, 2);
    const Pair pair = pair_of(samples, angular_velocity_a, angular_velocity_b, displacement, linear_velocity);
    for (int part = 0; part < k_parts; ++part) {
      const double middle = (part + 0.5) / k_parts;
      const Quaternion frame = rotation_by(angular_velocity_a * middle) * pair.a.start.rotation;
      const Velocities found = velocities_in(pair, part);
      const double curvature = 0.3 / (k_parts * k_parts);  // third derivatives up to 7, over 24
      EXPECT_LE(length(found.angular_velocity - to_axes(frame, angular_velocity_b - angular_velocity_a)),
                k_angular_velocity_error + curvature);
      EXPECT_LE(length(found.linear - to_axes(frame, linear_velocity - cross(angular_velocity_a,
                                                                             displacement + linear_velocity * middle))),
                k_velocity_error + curvature * 3);
    }
  }
}

DETENT_TEST(relative_motion, has_constant_angular_velocity_if_the_spins_are_parallel_and_only_then) {
  Samples samples = {2};
  for (uint32_t i = 0; i < rounds(100); ++i) {
    const Vector angular_velocity = any_vector(samples, 0.5, 1.2), along = any_along(samples, angular_velocity);
    const Vector beside = any_vector_beside(samples, angular_velocity);
    const Vector displacement = any_vector(samples, 0.5, 1.5), linear_velocity = any_vector(samples, 0.5, 1.5);
    EXPECT_LE(change_of(pair_of(samples, angular_velocity, along, displacement, linear_velocity)).angular_velocity,
              k_angular_velocity_error);
    EXPECT_LE(change_of(pair_of(samples, angular_velocity, k_none, displacement, linear_velocity)).angular_velocity,
              k_angular_velocity_error);
    EXPECT_LE(change_of(pair_of(samples, k_none, angular_velocity, displacement, linear_velocity)).angular_velocity,
              k_angular_velocity_error);
    // In A's frame the relative angular velocity rotates back by A's angle, so the difference of the first and the last
    // is a chord.
    const double change =
        change_of(pair_of(samples, angular_velocity, beside, displacement, linear_velocity)).angular_velocity;
    const double rate = length(cross(angular_velocity, beside)),
                 angle = length(angular_velocity) * (k_parts - 1) / k_parts;
    EXPECT_NEAR(change, 2 * rate / length(angular_velocity) * sin(angle / 2), k_angular_velocity_error + 0.01 * rate);
    EXPECT_GT(change, k_least_change);
  }
}

DETENT_TEST(relative_motion, has_constant_velocity_if_its_frame_does_not_turn_or_all_lies_on_its_axis_and_only_then) {
  Samples samples = {3};
  for (uint32_t i = 0; i < rounds(100); ++i) {
    const Vector angular_velocity = any_vector(samples, 0.5, 1.2), other = any_vector(samples, 0.5, 1.2);
    const Vector displacement = any_vector_beside(samples, angular_velocity),
                 linear_velocity = any_vector_beside(samples, angular_velocity);
    const Vector displacement_along = any_along(samples, angular_velocity),
                 velocity_along = any_along(samples, angular_velocity);
    const auto change = [&](const Vector& angular_velocity_a, const Vector& from, const Vector& speed) {
      return change_of(pair_of(samples, angular_velocity_a, other, from, speed)).linear;
    };
    EXPECT_LE(change(k_none, displacement, linear_velocity), k_velocity_error);
    EXPECT_LE(change(angular_velocity, displacement_along, velocity_along), k_velocity_error);
    EXPECT_LE(change(angular_velocity, displacement_along, k_none), k_velocity_error);
    EXPECT_LE(change(angular_velocity, k_none, velocity_along), k_velocity_error);
    EXPECT_GT(change(angular_velocity, displacement, velocity_along), k_least_change);
    EXPECT_GT(change(angular_velocity, displacement, k_none), k_least_change);
    EXPECT_GT(change(angular_velocity, displacement_along, linear_velocity), k_least_change);
    EXPECT_GT(change(angular_velocity, k_none, linear_velocity), k_least_change);
    EXPECT_GT(change(angular_velocity, displacement, linear_velocity), k_least_change);
  }
}

DETENT_TEST(relative_motion, is_a_screw_in_the_cases_that_are_proven_and_in_no_others) {
  Samples samples = {4};
  const double same = k_velocity_error / 2, apart = 0.005;
  for (uint32_t i = 0; i < rounds(100); ++i) {
    const Vector angular_velocity = any_vector(samples, 0.5, 1.2), parallel = any_along(samples, angular_velocity);
    const Vector beside = any_vector_beside(samples, angular_velocity);
    const Vector displacement = any_vector_beside(samples, angular_velocity),
                 linear_velocity = any_vector_beside(samples, angular_velocity);
    const Vector displacement_along = any_along(samples, angular_velocity),
                 velocity_along = any_along(samples, angular_velocity);
    const auto off = [&](const Vector& angular_velocity_a, const Vector& angular_velocity_b, const Vector& from,
                         const Vector& speed) {
      return off_screw(pair_of(samples, angular_velocity_a, angular_velocity_b, from, speed));
    };
    EXPECT_LE(off(k_none, k_none, displacement, linear_velocity), same);  // neither turns
    EXPECT_LE(off(angular_velocity, k_none, displacement, velocity_along),
              same);  // one turns, and they part along its angular velocity
    EXPECT_LE(off(k_none, angular_velocity, displacement, velocity_along), same);
    EXPECT_LE(off(angular_velocity, parallel, displacement_along, velocity_along), same);  // both, on one axis
    EXPECT_GT(off(angular_velocity, k_none, displacement, linear_velocity), apart);
    EXPECT_GT(off(k_none, angular_velocity, displacement, linear_velocity), apart);
    EXPECT_GT(off(angular_velocity, parallel, displacement, velocity_along), apart);
    EXPECT_GT(off(angular_velocity, parallel, displacement_along, linear_velocity), apart);
    EXPECT_GT(off(angular_velocity, beside, displacement_along, velocity_along), apart);
    EXPECT_GT(off(angular_velocity, beside, displacement, linear_velocity), apart);
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
