#include "shape/sweep.h"
#include "tests/common/oracle/bodies.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr double k_turn = 6.283185307179586476925;
const Vec3<Real> k_still = {Real(0.0), Real(0.0), Real(0.0)};

/// The largest difference of a component between q and the nearer of +-r.
double distance(const Quaternion& q, const Quaternion& r) {
  const double s = q.x * r.x + q.y * r.y + q.z * r.z + q.w * r.w < 0 ? -1 : 1;
  return fmax(fmax(fabs(q.x - s * r.x), fabs(q.y - s * r.y)), fmax(fabs(q.z - s * r.z), fabs(q.w - s * r.w)));
}

// The error that sweep.h states for sweep_end_rotation. It states nothing for floats: there, the steps of
// rotation_from_vector and of the product after it.
constexpr double k_end_error = DETENT_FIXED ? 4.0 : 8.0;

/// Steps within which sweep_end_rotation comes back to the end that the sweep was made from: the errors of
/// rotation_vector_from and back again, and the whole turns times the error of their axis' length; half of each, as
/// quaternions are half angles.
double goal_error(double angle) {
  const double back_and_forth = (k_rotation_vector_error + k_rotation_error * (DETENT_FIXED ? 1 : 1 + angle)) / 2 + 4;
  return back_and_forth + k_normalise_length_error * angle / 2;
}

/// The largest errors, in steps of a Unit; the value is at most 1 if it is within the expected bound.
struct Worst {
  double end = 0;   ///< sweep_end_rotation from the sweep's true end, over its bound
  double size = 0;  ///< its length from 1, over its bound
  double goal = 0;  ///< from the end that was asked for, over its bound
  uint32_t turns_wrong = 0;
};

/// Sweeps of `turns_low` to `turns_high` whole turns and a random rest.
Worst measure(uint64_t seed, uint32_t count, double turns_low, double turns_high) {
  Samples samples = {seed};
  Worst worst;
  for (uint32_t i = 0; i < count; ++i) {
    const Quat start = rotation_near(any_rotation(samples));
    // Close to a whole or a half turn, another axis can describe the same end as well.
    const double rest = uniform(samples, 0.02, 0.48) + (samples.below(2) == 0 ? 0.5 : 0.0);
    const double angle = k_turn * (floor(uniform(samples, turns_low, turns_high + 1)) + rest);
    const Vector rotation_vector = any_direction(samples) * angle;
    const Quat end = rotation_near(normalised(detent_oracle::rotation_by(rotation_vector) * normalised(host(start))));
    const Vec3<Real> estimate = reals_near(rotation_vector * (1 + uniform(samples, -0.4, 0.4) / (1 + angle)));
    const Sweep sweep = sweep_between(start, end, k_still, estimate);
    const Quaternion reached = host(sweep_end_rotation(start, sweep));
    const Quaternion right = detent_oracle::rotation_by(host(sweep.rotation_vector)) * normalised(host(start));
    const double size =
        sqrt(reached.x * reached.x + reached.y * reached.y + reached.z * reached.z + reached.w * reached.w);
    const double end_error = unit_steps(k_end_error) * (DETENT_FIXED ? 1 : 1 + angle);
    worst.end = fmax(worst.end, distance(reached, right) / end_error);
    worst.size = fmax(worst.size, fabs(size - 1) / unit_steps(DETENT_FIXED ? 2 : 4));
    worst.goal = fmax(worst.goal, distance(reached, host(end)) / unit_steps(goal_error(angle)));
    if (length(host(sweep.rotation_vector) - rotation_vector) > 0.01) ++worst.turns_wrong;
  }
  return worst;
}

void expect_within_bounds(const Worst& worst) {
  ::testing::Test::RecordProperty("end_over_bound", ::testing::PrintToString(worst.end));
  ::testing::Test::RecordProperty("goal_over_bound", ::testing::PrintToString(worst.goal));
  EXPECT_LE(worst.end, 1);
  EXPECT_LE(worst.size, 1);
  EXPECT_LE(worst.goal, 1);
  EXPECT_EQ(worst.turns_wrong, 0u);
}

DETENT_TEST(sweep, of_less_than_a_turn_ends_where_it_was_told_to) {
  expect_within_bounds(measure(5, detent_oracle::rounds(4000), 0, 0));
}

DETENT_TEST(sweep, of_up_to_a_thousand_turns_ends_where_it_was_told_to_and_counts_them) {
  expect_within_bounds(measure(6, detent_oracle::rounds(4000), 1, 1000));
}

DETENT_TEST(sweep, of_nearly_whole_turns_ends_where_it_was_told_to) {
  Samples samples = {7};
  for (uint32_t i = 0; i < detent_oracle::rounds(2000); ++i) {
    const Quat start = rotation_near(any_rotation(samples));
    const double rest = exp2(uniform(samples, -30, -6)) * (samples.below(2) == 0 ? 1 : -1);
    const double angle = k_turn * (samples.below(100) + 1) + (i % 4 == 0 ? 0 : rest);
    const Vector rotation_vector = any_direction(samples) * angle;
    const Quat end = rotation_near(normalised(detent_oracle::rotation_by(rotation_vector) * normalised(host(start))));
    const Sweep sweep = sweep_between(start, end, k_still, reals_near(rotation_vector));
    EXPECT_LE(distance(host(sweep_end_rotation(start, sweep)), host(end)), unit_steps(goal_error(angle))) << angle;
    // A remaining rotation that is too small to have an axis is added along its own direction, and the whole turns
    // along the direction of the estimate.
    EXPECT_LE(fabs(length(host(sweep.rotation_vector)) - angle), 0x1p-6) << angle;
  }
}

DETENT_TEST(sweep, of_a_body_at_rest_leaves_every_bit) {
  const Quat start = {0.5, -0.5, 0.5, 0.5};
  const Sweep sweep = sweep_between(start, start, k_still, k_still);
  EXPECT_EQ(sweep.rotation_vector, k_still);
  EXPECT_EQ(sweep_end_rotation(start, sweep), start);
  BodyPose pose{};
  pose.position = position_near({{1, -2, 3}});
  const Position before = pose.position;
  EXPECT_EQ(sweep_end_position(pose, sweep), 0u);
  EXPECT_EQ(pose.position, before);
}

/// The position of the body relative to `origin`, m, including the remainder that fx32 stores.
Vector travelled(const BodyPose& pose, const Position& origin) {
  Vector displacement = difference(pose.position, origin);
#if defined(DETENT_FX32)
  for (int i = 0; i < 3; ++i) displacement[i] += ldexp(pose.remainder[i], -32);
#endif
  return displacement;
}

DETENT_TEST(sweep, a_hundred_thousand_tiny_motions_add_up) {
  Samples samples = {8};
  BodyPose pose{};
  const Position origin = position_near({{100, -100, 3}});
  pose.position = origin;
  Vector sum = {{0, 0, 0}};
  for (int i = 0; i < 100000; ++i) {
    const Vec3<Real> step =
        reals_near({{uniform(samples, 0, 1e-6), uniform(samples, -1e-6, 0), uniform(samples, -1e-6, 1e-6)}});
    EXPECT_EQ(sweep_end_position(pose, {step, k_still}), 0u);
    sum = sum + host(step);
  }
  EXPECT_LT(length(travelled(pose, origin) - sum), 1e-7);
}

DETENT_TEST(sweep, one_tiny_motion_repeated_errs_by_half_a_step_a_time_at_most) {
  const Vec3<Real> step = reals_near({{1.1e-7, -3.3e-9, 4.9e-10}});
  BodyPose pose{};
  for (int i = 0; i < 100000; ++i) EXPECT_EQ(sweep_end_position(pose, {step, k_still}), 0u);
  const Vector error = travelled(pose, {Coord(0.0), Coord(0.0), Coord(0.0)}) - host(step) * 1e5;
  for (int i = 0; i < 3; ++i) EXPECT_LE(fabs(error[i]), 1e5 * 0x1p-33 * 1.0001);
}

DETENT_TEST(sweep, a_motion_beyond_the_range_of_positions_is_clamped_and_counted) {
  constexpr double k_end = sizeof(Coord) == 8 ? 2147483000.0 : 32767.0;
  for (const double side : {-1.0, 1.0}) {
    BodyPose pose{};
    pose.position = position_near({{side * k_end, side * k_end, 0}});
    const Vec3<Real> step = reals_near({{side * 2000, -side * 2000, side * 2000}});
    EXPECT_EQ(sweep_end_position(pose, {step, k_still}), 1u);
    EXPECT_GT(side * coord_to_host(pose.position.x), k_end);
    EXPECT_EQ(side * coord_to_host(pose.position.y), k_end - 2000);
    const Position held = pose.position;
    EXPECT_EQ(sweep_end_position(pose, {{step.x, Real(0.0), Real(0.0)}, k_still}), 1u);
    EXPECT_EQ(pose.position, held);
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
