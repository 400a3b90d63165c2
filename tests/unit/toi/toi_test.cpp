#include <string.h>

#include "tests/common/oracle/effort.h"
#include "tests/unit/toi/encounter.h"
#include "toi/advance.h"
#include "toi/conservative_advancement.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_oracle::rounds;

/// Expects a hit at `time` of the step, early by at most `early`, and not late.
void expect_hit(const Encounter& encounter, double time, double early, double late = 1e-12) {
  for (const Encounter& either : {encounter, encounter.swapped()}) {
    const TimeOfImpact impact = either.impact();
    ASSERT_EQ(impact.outcome, ToiOutcome::hit);
    const double found = fraction_to_host(impact.time);
    EXPECT_LE(found, time + late);
    EXPECT_GE(found, time - early);
  }
}
void expect_clear(const Encounter& encounter) {
  for (const Encounter& either : {encounter, encounter.swapped()}) {
    const TimeOfImpact impact = either.impact();
    EXPECT_EQ(impact.outcome, ToiOutcome::clear);
    EXPECT_TRUE(impact.time == Fraction(1.0));
  }
}

DETENT_TEST(toi, of_spheres_is_the_root_of_a_quadratic) {
  Samples samples{1};
  uint32_t hits = 0;
  const uint32_t count = rounds(2000);
  for (uint32_t i = 0; i < count; ++i) {
    const double scale = ldexp(1, static_cast<int>(samples.below(16)) - 9);
    const KnownShape a = random_shape(samples, 0, scale), b = random_shape(samples, 0, scale);
    const Vector start = random_direction(samples) * (scale * uniform(samples, 1, 8));
    const Vector aim = random_direction(samples) * (uniform(samples, 0, 1.3) * (a.ball + b.ball));
    const BodyAt body_a = {random_direction(samples) * scale, random_quaternion(samples),
                           random_direction(samples) * scale, random_direction(samples)};
    const BodyAt body_b = {body_a.position + start, random_quaternion(samples),
                           body_a.displacement + (aim - start) * uniform(samples, 0.3, 3), random_direction(samples)};
    const Encounter encounter(a, body_a, b, body_b);
    const Vector c = encounter.body_b.position - encounter.body_a.position;
    const Vector d = encounter.body_b.displacement - encounter.body_a.displacement;
    const double r = a.ball + b.ball, tolerance = encounter.tolerance();
    if (length(c) <= r + tolerance) continue;
    const auto gap = [&](double time) { return length(c + d * time) - r; };
    const double nearest = clamped(-dot(c, d) / dot(d, d), 0, 1);
    const TimeOfImpact impact = encounter.impact();
    const double time = fraction_to_host(impact.time);
    SCOPED_TRACE(testing::Message() << "pair " << i << ", scale " << scale);
    if (impact.outcome == ToiOutcome::hit) {
      ++hits;
      EXPECT_GT(gap(time), 0);
      EXPECT_LE(gap(time), tolerance);
      EXPECT_LT(dot(c + d * time, d), tolerance * length(d));
      EXPECT_NEAR(dot(host_units(impact.normal), c + d * time), length(c + d * time), tolerance);
      EXPECT_LE(length(host(impact.point) - host_units(impact.normal) * a.ball), k_number_error * r);
    } else {
      ASSERT_EQ(impact.outcome, ToiOutcome::clear);
      EXPECT_GT(gap(nearest), 0);
      EXPECT_EQ(time, 1);
    }
    EXPECT_LE(impact.gjk_calls, 24u);
    if (HasFailure()) return;
  }
  EXPECT_GT(hits, count / 4);
  EXPECT_LT(hits, count * 3 / 4);
}

DETENT_TEST(toi, of_a_sphere_and_a_plane_either_of_which_moves) {
  const KnownShape ball = known(sphere(0.5)), ground = known(half_space());
  const Vector down = {{3, -4, 1}};
  expect_hit({ground, {}, ball, {{{10, 2.5, 7}}, k_upright, down}}, 0.5, 1e-6);
  expect_hit({ground, {{{0, 0, 0}}, k_upright, {{0, 4, 0}}}, ball, {{{10, 2.5, 7}}}}, 0.5, 1e-6);
  expect_hit({ground, {{{0, 0, 0}}, k_upright, {{7, 2, 0}}}, ball, {{{10, 2.5, 7}}, k_upright, {{0, -2, 0}}}}, 0.5,
             1e-6);
  expect_clear({ground, {}, ball, {{{10, 2.5, 7}}, k_upright, {{30, -1.875, 1}}}});
  expect_clear({ground, {}, ball, {{{10, 2.5, 7}}, k_upright, {{30, 1, 1}}}});
  // The plane turns about its position: its height above the ball's centre is -x sin + y cos.
  const double angular_velocity = 1.5, x = 3, y = 2.5;
  const double time = (acos(0.5 / hypot(x, y)) - atan2(x, y)) / angular_velocity;
  expect_hit({ground, {{{0, 0, 0}}, k_upright, {{0, 0, 0}}, {{0, 0, angular_velocity}}}, ball, {{{x, y, 4}}}}, time,
             1e-6, k_late);
  expect_clear({ground, {{{0, 0, 0}}, k_upright, {{0, 0, 0}}, {{0, 0, -1}}}, ball, {{{x, y, 4}}}});
}

DETENT_TEST(toi, of_a_turning_rod_whose_tip_meets_a_plane) {
  const KnownShape ground = known(half_space());
  const Quaternion lying = {0, 0, sqrt(0.5), sqrt(0.5)};
  const double ball = 0.0625, height = 0.75;
  const KnownShape rods[] = {known(capsule(real(ball), real(1))),
                             known(rounded(box({real(0x1p-12), real(1), real(0x1p-12)}), real(ball)))};
  for (const KnownShape& rod : rods) {
    for (const double angular_velocity : {0.9, 1.5, 3.0, 2 * k_pi, 12.0, -1.5, -12.0}) {
      SCOPED_TRACE(angular_velocity);
      const double time = asin((height - ball) / 1) / fabs(angular_velocity);
      expect_hit({ground, {}, rod, {{{5, height, 0}}, lying, {{0, 0, 0}}, {{0, 0, angular_velocity}}}}, time, 1e-3,
                 k_late);
      // The same test against a large flat box.
      const KnownShape slab = known(box({4.0, 0.5, 4.0}));
      expect_hit({slab, {{{5, -0.5, 0}}}, rod, {{{5, height, 0}}, lying, {{0, 0, 0}}, {{0, 0, angular_velocity}}}},
                 time, 1e-3, k_late);
      const Encounter high = {ground, {}, rod, {{{5, 1.125, 0}}, lying, {{0, 0, 0}}, {{0, 0, angular_velocity}}}};
      expect_clear(high);
      expect_clear({slab, {{{5, -0.5, 0}}}, rod, high.body_b});
    }
  }
}

DETENT_TEST(toi, of_a_turning_rod_that_sweeps_a_ball) {
  const double ball = 0.125, far = 0.75, thick = 0.0625;
  const KnownShape rod = known(capsule(real(thick), real(1))), target = known(sphere(real(ball)));
  // The rod points along y and sweeps towards -x; the ball lies `angle` ahead.
  for (const double angular_velocity : {1.0, 3.0, 2 * k_pi, 12.0}) {
    for (const double angle : {0.5, 1.0, 2.5}) {
      if (angle > angular_velocity) continue;
      SCOPED_TRACE(testing::Message() << angular_velocity << " rad, ball at " << angle);
      const Vector at = {{-far * sin(angle), far * cos(angle), 0}};
      const BodyAt turning = {{{0, 0, 0}}, k_upright, {{0, 0, 0}}, {{0, 0, angular_velocity}}};
      const double first = angle > k_pi / 2 ? angle - k_pi : angle;  // its other end may come first
      const double lead = asin((ball + thick) / far);
      const double ahead = first - lead > 0 ? first : first + k_pi;
      const double time = (ahead - lead) / angular_velocity;
      if (time <= 1) {
        expect_hit({rod, turning, target, {at}}, time, 4e-6, k_late + 4 * k_position_step);
      }
      expect_clear({rod, turning, target, {at * 2}});
    }
  }
  // One whole turn next to a wall that the rod never touches.
  expect_clear({rod,
                {{{0, 0, 0}}, k_upright, {{0, 0, 0}}, {{0, 0, 2 * k_pi}}},
                known(box({0.25, 4.0, 4.0})),
                {{{1.375, 0, 0}}}});
}

DETENT_TEST(toi, of_a_box_that_falls_flat) {
  const KnownShape cube = known(box({0.5, 0.5, 0.5})), round = known(rounded(box({0.25, 0.25, 0.25}), real(0.25)));
  for (const KnownShape& falling : {cube, round}) {
    for (const KnownShape& below : {cube, known(half_space()), known(cylinder(4.0, 0.5)), round}) {
      const double top = below.type() == ShapeType::half_space ? 0 : 0.5;
      expect_hit({below, {{{0.125, 0, 0}}}, falling, {{{0, 2.5 + top, 0}}, k_upright, {{0, -4, 0}}}}, 0.5, 1e-6);
      expect_clear({below, {{{0.125, 0, 0}}}, falling, {{{0, 2.5 + top, 0}}, k_upright, {{0, -1.875, 0}}}});
      // Sliding over it.
      if (below.type() != ShapeType::half_space) {
        expect_clear({below, {{{0.125, 0, 0}}}, falling, {{{-2, 0.5625 + top, 0}}, k_upright, {{4, 0, 0}}}});
      }
    }
  }
}

/// Two shapes whose cores overlap at the start, with or without a ball around them.
Encounter random_overlap(Samples& samples, bool round) {
  const auto shape = [&] {
    const auto size = [&] { return real(uniform(samples, 0.1, 1)); };
    const Real ball = real(round ? uniform(samples, 0.05, 0.5) : 0);
    switch (samples.below(3)) {
      case 0:
        return known(rounded(box({size(), size(), size()}), ball));
      case 1:
        return known(rounded(cylinder(size(), size()), ball));
      default:
        return known(rounded(cone(size(), size()), ball));
    }
  };
  const BodyAt body_a = {{{1, 2, 3}}, random_quaternion(samples), random_direction(samples), random_direction(samples)};
  const BodyAt body_b = {body_a.position + random_direction(samples) * 0.02, random_quaternion(samples),
                         random_direction(samples) * 5, random_direction(samples)};
  const KnownShape a = shape();
  return {a, body_a, shape(), body_b};
}

/// The number of answers that have a normal.
uint32_t count_normals(bool round, uint32_t count) {
  Samples samples{2};
  uint32_t with_normal = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const TimeOfImpact impact = random_overlap(samples, round).impact();
    EXPECT_EQ(impact.outcome, ToiOutcome::hit);
    EXPECT_TRUE(impact.time == Fraction(0.0));
    EXPECT_LE(impact.gjk_calls, 1u);
    with_normal += impact.normal == Vec3<Unit>{Unit(0.0), Unit(0.0), Unit(0.0)} ? 0u : 1u;
  }
  return with_normal;
}

DETENT_TEST(toi, of_cores_that_meet_at_the_start_is_0_without_a_normal) {
  // In one of some thousand cases the search reports a hit within the tolerance before it finds the overlap.
  const uint32_t count = rounds(200);
  EXPECT_LE(count_normals(false, count), count / 1000);
}

DETENT_TEST(toi, of_rounded_cores_that_meet_at_the_start_is_0) { count_normals(true, rounds(200)); }

DETENT_TEST(toi, of_rounded_cores_that_meet_at_the_start_has_no_normal) {
  EXPECT_EQ(count_normals(true, rounds(200)), 0u);
}

DETENT_TEST(toi, of_shapes_that_touch_at_the_start_is_0_whether_they_part_or_not) {
  const KnownShape ball = known(sphere(0.5)), cube = known(box({0.5, 0.5, 0.5})), rod = known(capsule(0.25, 0.25));
  for (const KnownShape& a : {ball, cube, rod}) {
    for (const KnownShape& b : {ball, cube, rod}) {
      for (const double displacement : {-1.0, 0.0, 1.0}) {
        for (const double angular_velocity : {0.0, 1.0}) {
          const Encounter encounter = {
              a, {}, b, {{{0, 1, 0}}, k_upright, {{0, displacement, 0}}, {{0, angular_velocity, 0}}}};
          const TimeOfImpact impact = encounter.impact();
          EXPECT_EQ(impact.outcome, ToiOutcome::hit);
          EXPECT_TRUE(impact.time == Fraction(0.0));
        }
      }
    }
  }
}

DETENT_TEST(toi, of_bodies_a_little_apart_that_separate_or_slide_is_clear) {
  const KnownShape ball = known(sphere(0.5)), cube = known(box({0.5, 0.5, 0.5})), rod = known(capsule(0.25, 0.25));
  for (const KnownShape& a : {ball, cube, rod, known(half_space())}) {
    for (const KnownShape& b : {ball, cube, rod}) {
      const double apart = (a.type() == ShapeType::half_space ? 0.5 : 1) + 0x1p-14;
      expect_clear({a, {}, b, {{{0, apart, 0}}, k_upright, {{0, 1, 0}}}});
      expect_clear({a, {}, b, {{{0, apart, 0}}, k_upright, {{3, 0, 0}}}});
      expect_clear({a, {}, b, {{{0, apart, 0}}, k_upright, {{3, 1, 0}}, {{0, 2, 0}}}});
      expect_clear({a, {}, b, {{{0, apart, 0}}}});
      expect_hit({a, {}, b, {{{0, apart, 0}}, k_upright, {{0, -0x1p-13, 0}}}}, 0.5, 0.05);
    }
  }
}

DETENT_TEST(toi, of_bodies_without_motion_is_0_or_clear) {
  Samples samples{3};
  for (uint32_t i = 0; i < rounds(500); ++i) {
    const KnownShape a = random_shape(samples, samples.below(10), 1), b = random_shape(samples, samples.below(11), 1);
    const BodyAt body_a = {random_direction(samples), random_quaternion(samples)};
    const BodyAt body_b = {random_direction(samples) * 2, random_quaternion(samples)};
    const Encounter encounter = {a, body_a, b, body_b};
    const TimeOfImpact impact = encounter.impact();
    const double gap = encounter.gap(0);
    if (gap > encounter.tolerance() + encounter.slack()) {
      EXPECT_EQ(impact.outcome, ToiOutcome::clear);
    } else if (gap == 0) {
      EXPECT_EQ(impact.outcome, ToiOutcome::hit);
      EXPECT_TRUE(impact.time == Fraction(0.0));
    }
  }
}

DETENT_TEST(toi, of_tiny_bodies_at_250_m_a_step) {
  for (const double size : {0x1p-10, 0x1p-11}) {
    for (const KnownShape& tiny : {known(sphere(real(size))), known(box({real(size), real(size), real(size)}))}) {
      const KnownShape wall = known(box({real(size), real(1), real(1)}));
      for (const KnownShape& target : {tiny, wall}) {
        const double time = (125 - 2 * size) / 250;
        expect_hit({target, {{{125, 0, 0}}}, tiny, {{{0, 0, 0}}, k_upright, {{250, 0, 0}}}}, time, 1e-8);
        expect_hit({target, {{{125, 0, 0}}, k_upright, {{-125, 0, 0}}}, tiny, {{{0, 0, 0}}, k_upright, {{125, 0, 0}}}},
                   time, 1e-8);
      }
      expect_clear({tiny, {{{125, 0, 0}}}, tiny, {{{0, 2.25 * size, 0}}, k_upright, {{250, 0, 0}}}});
      // Through the wall's thickness of 2 size in 2 millionths of the step, while rotating.
      expect_hit(
          {wall, {{{125, 0, 0}}}, known(sphere(real(size))), {{{0, 0.5, 0.25}}, k_upright, {{250, 0, 0}}, {{9, 9, 9}}}},
          (125 - 2 * size) / 250, 1e-8);
    }
  }
}

DETENT_TEST(toi, of_a_turning_needle_of_1_to_1000) {
  const double half = 1, thick = 0x1p-10, far = 0.875, ball = 0x1p-9;
  const KnownShape needle = known(box({real(half), real(thick), real(thick)})), target = known(sphere(real(ball)));
  for (const double angular_velocity : {0.75, 3.0, 12.0}) {
    for (const double angle : {0.25, 0.5}) {
      const double lead = asin((ball + thick) / far);
      const Vector at = {{far * cos(angle), far * sin(angle), 0}};
      const Encounter encounter = {
          needle, {{{0, 0, 0}}, k_upright, {{0, 0, 0}}, {{0, 0, angular_velocity}}}, target, {at}};
      const double time = (angle - lead) / angular_velocity;
      expect_hit(encounter, time, 3e-6 + 4 * k_position_step, k_late + 4 * k_position_step);
    }
  }
}

DETENT_TEST(toi, of_the_fastest_spins_is_never_late) {
  const KnownShape rod = known(capsule(0.0625, 1.0)), ball = known(sphere(0.125));
  const KnownShape cube = known(box({0.5, 0.5, 0.5}));
  for (const double angular_velocity : {100.0, 1e3, 1e4, 0x1p15, 0x1p16}) {
    for (const Vector& axis : {Vector{{0, 0, 1}}, Vector{{0, 0, -1}}, Vector{{0, 1, 0}}}) {
      for (const bool both : {false, true}) {
        SCOPED_TRACE(testing::Message() << angular_velocity << " rad about " << axis[0] << axis[1] << axis[2]
                                        << (both ? ", both" : ""));
        const Vector rotation_vector = axis * angular_velocity;
        if (both && angular_velocity == 0x1p16) continue;  // has a test of its own
        // A ball approaches along x. The rod sweeps a disc of 1.0625 m, so they touch at most half a turn after the
        // ball reaches this disc.
        const BodyAt turning = {{{0, 0, 0}}, k_upright, {{0, 0, 0}}, rotation_vector};
        const BodyAt coming = {{{2, 0, 0}}, k_upright, {{-3, 0, 0}}, both ? rotation_vector : Vector{{0, 0, 0}}};
        for (const KnownShape& other : {ball, cube}) {
          const Encounter encounter = {rod, turning, other, coming};
          for (const Encounter& either : {encounter, encounter.swapped()}) {
            const TimeOfImpact impact = either.impact();
            EXPECT_NE(impact.outcome, ToiOutcome::clear);
            if (axis[1] == 0) {
              // At the latest half a turn after the ball is inside the disc by its own radius.
              const double in_reach = 1.0 / 3 + k_pi / angular_velocity, time = fraction_to_host(impact.time);
              EXPECT_LE(time, in_reach);
            } else {
              const double met = (other.type() == ShapeType::sphere ? 2 - 0.1875 : 2 - 0.5 - 0.0625) / 3;
              EXPECT_LE(fraction_to_host(impact.time), met);
            }
          }
        }
        expect_never_late(
            {rod, turning, ball, {{{2, 0, 0}}, k_upright, {{0, 1, 0}}, both ? rotation_vector : Vector{{0, 0, 0}}}},
            Encounter(rod, turning, ball, {{{2, 0, 0}}, k_upright, {{0, 1, 0}}}).impact(), 10);
      }
    }
  }
}

DETENT_TEST(toi, of_two_bodies_that_both_angular_velocity_as_fast_as_may_be_is_not_late) {
  const KnownShape rod = known(capsule(0.0625, 1.0));
  const Vector rotation_vector = {{0, 0, 0x1p16}};
  for (const KnownShape& other : {known(capsule(0.0625, 0.0625)), known(box({0.5, 0.5, 0.5}))}) {
    const Encounter encounter = {rod,
                                 {{{0, 0, 0}}, k_upright, {{0, 0, 0}}, rotation_vector},
                                 other,
                                 {{{2, 0, 0}}, k_upright, {{-3, 0, 0}}, rotation_vector}};
    EXPECT_LE(fraction_to_host(encounter.impact().time), 1.0 / 3 + k_pi / rotation_vector[2]);
    EXPECT_LE(fraction_to_host(encounter.swapped().impact().time), 1.0 / 3 + k_pi / rotation_vector[2]);
  }
}

DETENT_TEST(toi, is_never_late_and_hits_within_the_tolerance) {
  Samples samples{4};
  uint32_t hits = 0, gjk_calls = 0, passes = 0, undecided = 0;
  const uint32_t count = rounds(600);
  for (uint32_t i = 0; i < count; ++i) {
    const double scale = i % 4 == 0 ? ldexp(1, static_cast<int>(samples.below(9)) - 3) : 1;
    const Encounter encounter = random_encounter(samples, scale, i % 3 == 0 ? 12 : 2);
    const TimeOfImpact impact = encounter.impact();
    SCOPED_TRACE(testing::Message() << "pair " << i << ", scale " << scale);
    expect_never_late(encounter, impact, 100);
    hits += impact.outcome == ToiOutcome::hit ? 1u : 0u;
    undecided += impact.outcome == ToiOutcome::undecided ? 1u : 0u;
    gjk_calls = std::max(gjk_calls, impact.gjk_calls);
    passes = std::max(passes, impact.passes);
    if (HasFailure()) return;
  }
  printf("%u pairs, %u hits, %u undecided, at most %u GJK calls and %u passes\n", count, hits, undecided, gjk_calls,
         passes);
  EXPECT_EQ(undecided, 0u);
  EXPECT_GT(hits, count / 4);
  EXPECT_LT(hits, count * 9 / 10);
  // One call for each axis, and at most six more where a rim is tracked.
  EXPECT_LE(gjk_calls, 7u * k_toi_iterations_max);
  EXPECT_LE(passes, static_cast<uint32_t>(3 * k_horizons_max * k_passes_max * k_toi_iterations_max));
}

constexpr ToiMethod k_methods[] = {ToiMethod::paper,      ToiMethod::first_order, ToiMethod::second_order,
                                   ToiMethod::corotating, ToiMethod::world_space, ToiMethod::constant_angular_velocity,
                                   ToiMethod::mirtich};
static_assert(sizeof k_methods / sizeof *k_methods == k_axis_methods + 1);

DETENT_TEST(toi, is_never_late_by_any_method) {
  for (const ToiMethod method : k_methods) {
    Samples samples{5};
    uint32_t decided = 0;
    const uint32_t count = rounds(300);
    for (uint32_t i = 0; i < count; ++i) {
      const Encounter encounter = random_encounter(samples, 1, i % 3 == 0 ? 12 : 2);
      const Vector& turn_a = encounter.body_a.rotation_vector;
      const Vector& turn_b = encounter.body_b.rotation_vector;
      if (encounter.planar() && length(encounter.b.type() == ShapeType::half_space ? turn_b : turn_a) != 0) continue;
      const TimeOfImpact impact = encounter.impact_by(method), best = encounter.impact();
      SCOPED_TRACE(testing::Message() << "pair " << i << ", method " << static_cast<int>(method));
      expect_never_late(encounter, impact, 20);
      EXPECT_LE(impact.gjk_calls, 7u * k_toi_iterations_compared_max);
      if (impact.outcome != ToiOutcome::undecided) {
        ++decided;
        EXPECT_EQ(impact.outcome, best.outcome);
      }
      if (HasFailure()) return;
    }
    EXPECT_GT(decided, count / 3);
  }
}

DETENT_TEST(toi, of_a_turning_plane_is_not_late_by_any_method) {
  // n(t) = (-sin, cos, 0): the ball at (x, y) touches the plane when -x sin + y cos equals its radius.
  const double angular_velocity = 1.5, x = 3, y = 2.5,
               time = (acos(0.5 / hypot(x, y)) - atan2(x, y)) / angular_velocity;
  const Encounter encounter = {known(half_space()),
                               {{{0, 0, 0}}, k_upright, {{0, 0, 0}}, {{0, 0, angular_velocity}}},
                               known(sphere(0.5)),
                               {{{x, y, 4}}}};
  for (const ToiMethod method : k_methods) {
    EXPECT_LE(fraction_to_host(encounter.impact_by(method).time), time + k_late) << static_cast<int>(method);
    EXPECT_LE(fraction_to_host(encounter.swapped().impact_by(method).time), time + k_late) << static_cast<int>(method);
  }
}

DETENT_TEST(toi, has_the_same_outcome_with_the_bodies_swapped) {
  Samples samples{6};
  for (uint32_t i = 0; i < rounds(600); ++i) {
    const Encounter encounter = random_encounter(samples, 1, i % 3 == 0 ? 12 : 2);
    const TimeOfImpact impact = encounter.impact(), swapped = encounter.swapped().impact();
    SCOPED_TRACE(testing::Message() << "pair " << i);
    EXPECT_EQ(impact.outcome, swapped.outcome);
    const double time = fraction_to_host(impact.time), other = fraction_to_host(swapped.time);
    const double tolerance = encounter.tolerance() + encounter.slack();
    if (impact.outcome == ToiOutcome::hit) {
      EXPECT_LE(encounter.gap(other), tolerance);
    }
    if (fabs(time - other) < 1e-4 && impact.outcome == ToiOutcome::hit && encounter.a.points.size() == 1) {
      EXPECT_LE(length(host_units(impact.normal) + host_units(swapped.normal)), 1e-2);
    }
    if (HasFailure()) return;
  }
}

#if !defined(DETENT_FX32)
DETENT_TEST(toi, of_a_ball_far_above_or_below_a_plane_is_not_taken_for_the_other) {
  const KnownShape ball = known(sphere(1.0)), ground = known(half_space());
  Samples samples{9};
  for (uint32_t i = 0; i < rounds(200); ++i) {
    const BodyAt plane = held({{{0, 0, 0}}, random_quaternion(samples)});
    const double height = pow(2, uniform(samples, 15, 28));
    const Vector up = axis_of(plane.rotation, 1);
    for (const double sign : {1.0, -1.0}) {
      TimeOfImpact impact;
      const Status status =
          time_of_impact(ground.convex, motion_of(plane), ball.convex, motion_of({up * (sign * height)}), impact);
      if (status == Status::out_of_range) continue;
      EXPECT_EQ(status, Status::ok);
      EXPECT_EQ(impact.outcome, sign > 0 ? ToiOutcome::clear : ToiOutcome::hit) << sign * height;
    }
    if (HasFailure()) return;
  }
}
/// At a distance at which sums of lengths reach the largest number.
DETENT_TEST(toi, of_a_turning_plane_and_a_ball_as_far_as_may_be_is_not_late) {
  const double angular_velocity = 1.5, x = 65000, y = 60000,
               time = (acos(0.5 / hypot(x, y)) - atan2(x, y)) / angular_velocity;
  const Encounter encounter = {known(half_space()),
                               {{{0, 0, 0}}, k_upright, {{0, 0, -16000}}, {{0, 0, angular_velocity}}},
                               known(sphere(0.5)),
                               {{{x, y, 65000}}, k_upright, {{0, 0, 16000}}}};
  for (const ToiMethod method : k_methods) {
    EXPECT_LE(fraction_to_host(encounter.impact_by(method).time), time + k_late) << static_cast<int>(method);
    EXPECT_LE(fraction_to_host(encounter.swapped().impact_by(method).time), time + k_late) << static_cast<int>(method);
  }
}
#endif

#if !defined(DETENT_F64)
DETENT_TEST(toi, is_the_same_to_the_bit_wherever_the_pair_is) {
  Samples samples{7};
  for (uint32_t i = 0; i < rounds(300); ++i) {
    const Encounter encounter = random_encounter(samples, 1, 3);
    Motion motion_a = motion_of(encounter.body_a), motion_b = motion_of(encounter.body_b);
    const auto moved = [&] {
      const double displacement = uniform(samples, -1, 1) * (k_config == Config::fx32 ? 32e3 : 1e7);
      return static_cast<Coord::Raw>(ldexp(displacement, Coord::k_frac));
    };
    const Position by = {Coord::from_raw(moved()), Coord::from_raw(moved()), Coord::from_raw(moved())};
    for (Position* p : {&motion_a.start.position, &motion_b.start.position})
      *p = {p->x + by.x, p->y + by.y, p->z + by.z};
    TimeOfImpact there;
    EXPECT_OK(time_of_impact(encounter.a.convex, motion_a, encounter.b.convex, motion_b, there));
    ASSERT_TRUE(there == encounter.impact()) << "pair " << i;
  }
}
#endif

/// Leaves a pattern on the stack, where the variables of the next call will be.
[[gnu::noinline]] void scribble(uint8_t pattern) {
  volatile uint8_t waste[4096];
  for (size_t i = 0; i < sizeof waste; ++i) waste[i] = static_cast<uint8_t>(pattern + i % 7);
}

DETENT_TEST(toi, does_not_depend_on_what_the_stack_held) {
  Samples samples{8};
  for (uint32_t i = 0; i < rounds(300); ++i) {
    const Encounter encounter = random_encounter(samples, 1, i % 3 == 0 ? 12 : 2);
    const Motion motion_a = motion_of(encounter.body_a), motion_b = motion_of(encounter.body_b);
    TimeOfImpact results[3];
    constexpr uint8_t k_patterns[] = {0x00, 0xff, 0x5a};
    for (int k = 0; k < 3; ++k) {
      scribble(k_patterns[k]);
      EXPECT_OK(time_of_impact(encounter.a.convex, motion_a, encounter.b.convex, motion_b, results[k]));
    }
    ASSERT_TRUE(results[0] == results[1] && results[0] == results[2]) << "pair " << i;
    Closest closest[2];
    for (int k = 0; k < 2; ++k) {
      scribble(k_patterns[k]);
      EXPECT_OK(closest_points(encounter.a.convex, motion_a.start, encounter.b.convex, motion_b.start, closest[k]));
    }
    ASSERT_TRUE(closest[0].distance == closest[1].distance && closest[0].point_a == closest[1].point_a &&
                closest[0].normal == closest[1].normal && closest[0].iterations == closest[1].iterations);
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
