#include "tests/common/oracle/bodies.h"
#include "tests/common/oracle/step_motion.h"

/// Compares the motion of a step with other motions between the same poses. The differences are compared with closed
/// forms.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using namespace detent_oracle;

constexpr double k_radius = 1;  ///< m
/// The error of a pose that the library computes, m and rad: of the sweep's rotation, and of a position some metres
/// away.
constexpr double k_pose_error = k_config == Config::f64    ? 1e-13
                                : k_config == Config::fx64 ? 0x1p-25
                                : k_config == Config::fx32 ? 0x1p-15
                                                           : 0x1p-19;
constexpr double k_angle_error = k_config == Config::f64 ? 1e-13 : k_config == Config::f32 ? 0x1p-20 : 0x1p-26;
/// The largest of the sampled values is less than the true maximum by up to this fraction.
constexpr double k_sampling = 1e-4;

void expect_near(double measured, double right, double error) {
  EXPECT_NEAR(measured, right, error + right * k_sampling);
}

/// A body that rotates by `angle` about an axis at the distance `lever`, and moves along that axis.
PosesOfStep random_poses(Samples& samples, double angle, double lever) {
  PosesOfStep poses;
  const Vector axis = any_direction(samples), other = any_direction(samples);
  const Vector across = normalised(cross(axis, other));
  const double along = uniform(samples, -1, 1);
  poses.start.position = {{uniform(samples, -1, 1), 0, 1}};
  poses.start.rotation = any_rotation(samples);
  poses.displacement = axis * along + across * (2 * lever * sin(angle / 2));
  poses.rotation_vector = axis * angle;
  return poses;
}

/// Calls `ask` for each of these angles and three levers.
template <class Ask>
void at_all_angles(uint64_t seed, const Ask& ask) {
  Samples samples = {seed};
  const double angles[] = {0.01, 0.1, 0.5, 1, 2, 2.6, 3.1}, levers[] = {0, 1, 8};
  for (const double angle : angles) {
    for (const double lever : levers) ask(random_poses(samples, angle, lever), angle, lever);
  }
}

DETENT_TEST(motions, of_a_step_and_of_the_screw_are_the_sagitta_of_the_arc_apart_and_turn_alike) {
  at_all_angles(1, [](const PosesOfStep& poses, double angle, double lever) {
    const Apart apart = farthest_apart([&](double t) { return step_motion_at(poses, t); },
                                       [&](double t) { return even_screw_at(poses, t); }, k_radius, 256);
    expect_near(apart.distance, lever * (1 - cos(angle / 2)), k_pose_error + k_angle_error);
    expect_near(apart.distance, sagitta(lever, angle), k_pose_error + k_angle_error);
    EXPECT_LE(apart.angle, k_angle_error);
  });
}

DETENT_TEST(motions, of_a_step_and_of_normalised_lerp_are_apart_by_an_angle_of_closed_form_alone) {
  at_all_angles(2, [](const PosesOfStep& poses, double angle, double) {
    const Apart apart = farthest_apart([&](double t) { return step_motion_at(poses, t); },
                                       [&](double t) { return normalised_lerp_at(poses, t); }, k_radius, 256);
    const double error = normalised_lerp_error(angle);
    expect_near(apart.angle, error, k_angle_error);
    expect_near(apart.distance, 2 * k_radius * sin(error / 2), k_pose_error + k_angle_error);
  });
}

DETENT_TEST(motions, of_a_step_and_of_the_tangents_screw_are_apart_by_an_angle_of_closed_form) {
  at_all_angles(3, [](const PosesOfStep& poses, double angle, double lever) {
    const Apart apart = farthest_apart([&](double t) { return step_motion_at(poses, t); },
                                       [&](double t) { return tangent_screw_at(poses, t); }, k_radius, 1024);
    const double error = tangent_error(angle);
    expect_near(apart.angle, error, k_angle_error);
    if (lever == 0) {
      expect_near(apart.distance, 2 * k_radius * sin(error / 2), k_pose_error + k_angle_error);
    }
    const Apart clocks = farthest_apart([&](double t) { return even_screw_at(poses, t); },
                                        [&](double t) { return tangent_screw_at(poses, t); }, k_radius, 1024);
    expect_near(clocks.distance, 2 * (lever + k_radius) * sin(error / 2), 1e-12);
  });
}

DETENT_TEST(motions, of_pieces_come_near_the_screw_by_the_square_of_their_number_and_are_one_step_if_one) {
  at_all_angles(4, [](const PosesOfStep& poses, double angle, double lever) {
    const Apart one = farthest_apart([&](double t) { return step_motion_at(poses, t); },
                                     [&](double t) { return pieces_at(poses, 1, t); }, k_radius, 64);
    EXPECT_LE(one.distance, k_pose_error + k_angle_error);
    const int counts[] = {2, 4, 8};
    for (const int count : counts) {
      const auto pieces = [&](double t) { return pieces_at(poses, count, t); };
      const Apart screw = farthest_apart([&](double t) { return even_screw_at(poses, t); }, pieces, k_radius, 256);
      expect_near(screw.distance, sagitta(lever, angle / count), 1e-12);
      EXPECT_LE(screw.angle, 1e-12);
      const Apart step = farthest_apart([&](double t) { return step_motion_at(poses, t); }, pieces, k_radius, 256);
      expect_near(step.distance, sagitta(lever, angle), k_pose_error + k_angle_error);
    }
  });
}

DETENT_TEST(motions, that_differ_are_as_far_apart_as_the_farthest_point_within_the_radius) {
  Samples samples = {5};
  for (uint32_t i = 0; i < rounds(100); ++i) {
    const double size = uniform(samples, 0, 2);
    const Vector displacement = any_direction(samples) * size;
    const Quaternion p = any_rotation(samples), q = any_rotation(samples);
    const double radius = uniform(samples, 0.1, 2);
    const double told = apart({displacement, p}, {{{0, 0, 0}}, q}, radius).distance;
    double greatest = 0;
    for (int point = 0; point < 3000; ++point) {
      const Vector r = any_direction(samples) * radius;
      Vector moved = displacement;
      for (int axis = 0; axis < 3; ++axis) moved = moved + (axis_of(p, axis) - axis_of(q, axis)) * r[axis];
      greatest = fmax(greatest, length(moved));
    }
    EXPECT_LE(greatest, told + 1e-12);
    EXPECT_GE(greatest, told * 0.99);
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
