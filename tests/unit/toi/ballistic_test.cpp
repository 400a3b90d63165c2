#include "tests/common/oracle/effort.h"
#include "tests/unit/toi/encounter.h"
#include "toi/conservative_advancement.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_oracle::rounds;

TimeOfImpact ballistic(const Encounter& encounter) { return encounter.impact_by(ToiMethod::mirtich); }

/// Expects a hit in either order of the shapes at `time`, within `early`, after at most `calls` calls of GJK.
void expect_hit(const Encounter& encounter, double time, double early, uint32_t calls) {
  for (const Encounter& either : {encounter, encounter.swapped()}) {
    const TimeOfImpact impact = ballistic(either);
    ASSERT_EQ(impact.outcome, ToiOutcome::hit);
    EXPECT_LE(fraction_to_host(impact.time), time + k_late);
    EXPECT_GE(fraction_to_host(impact.time), time - early);
    EXPECT_LE(impact.gjk_calls, calls);
    const TimeOfImpact usual = either.impact();
    if (usual.outcome == ToiOutcome::undecided) continue;  // of the fastest angular velocity, by horizons of 2 rad
    EXPECT_LE(length(host_units(impact.normal) - host_units(usual.normal)), 1e-3);
    EXPECT_LE(fabs(dot(host_units(impact.normal), host(impact.point) - host(usual.point))), 1e-3);
  }
}

DETENT_TEST(ballistic, bound_of_bodies_that_do_not_turn_leads_to_the_impact_at_once) {
  const KnownShape ball = known(sphere(0.5)), cube = known(box({0.5, 0.5, 0.5}));
  for (const KnownShape& a : {ball, cube, known(half_space()), known(cylinder(2.0, 0.5)), known(cone(0.5, 0.5))}) {
    const double top = a.type() == ShapeType::half_space ? 0 : a.type() == ShapeType::cone ? 0.75 : 0.5;
    for (const KnownShape& b : {ball, cube}) {
      expect_hit({a, {}, b, {{{0, 2.5 + top, 0}}, k_upright, {{0, -4, 0}}}}, 0.5, 1e-6, 1);
      EXPECT_EQ(ballistic({a, {}, b, {{{0, 2.5 + top, 0}}, k_upright, {{0, -1.875, 0}}}}).outcome, ToiOutcome::clear);
      EXPECT_EQ(ballistic({a, {}, b, {{{0, 2.5 + top, 0}}, k_upright, {{3, 4, 0}}}}).outcome, ToiOutcome::clear);
    }
  }
}

/// A rotation about the normal moves no point towards the other body, however fast it is.
DETENT_TEST(ballistic, bound_takes_nothing_for_a_angular_velocity_about_the_normal) {
  const KnownShape slab = known(box({4.0, 0.5, 4.0})), cube = known(box({0.5, 0.5, 0.5}));
  for (const double angular_velocity : {1.0, 30.0, 1000.0}) {
    const BodyAt falling = {{{0, 3, 0}}, k_upright, {{0, -4, 0}}, {{0, angular_velocity, 0}}};
    expect_hit({slab, {}, cube, falling}, 0.5, 1e-6, 3);
    expect_hit({known(half_space()), {{{0, 0.5, 0}}}, cube, falling}, 0.5, 1e-6, 3);
  }
}

DETENT_TEST(ballistic, bound_ends_with_half_a_turn) {
  // After half a turn the rotation of a body cannot add more displacement: a body that moves less than the rest of the
  // gap is clear.
  const KnownShape rod = known(capsule(0.0625, 1.0)), ball = known(sphere(0.25));
  const BodyAt spinning = {{{0, 0, 0}}, k_upright, {{0, 0, 0}}, {{0, 0, 3000}}};
  const Encounter encounter = {known(half_space()), {{{0, -3.25, 0}}}, rod, spinning};
  const TimeOfImpact impact = ballistic(encounter);
  EXPECT_EQ(impact.outcome, ToiOutcome::clear);
  EXPECT_EQ(impact.gjk_calls, 1u);
  expect_never_late({rod, spinning, ball, {{{3, 0, 0}}, k_upright, {{-1.5, 0, 0}}}},
                    ballistic({rod, spinning, ball, {{{3, 0, 0}}, k_upright, {{-1.5, 0, 0}}}}), 400);
}

DETENT_TEST(ballistic, bound_of_a_rod_that_turns_into_a_wall) {
  const Quaternion lying = {0, 0, sqrt(0.5), sqrt(0.5)};
  const double ball = 0.0625, height = 0.75;
  const KnownShape rod = known(capsule(real(ball), real(1))), slab = known(box({4.0, 0.5, 4.0}));
  for (const double angular_velocity : {0.9, 1.5, 3.0, 2 * k_pi, 12.0, -1.5, -12.0}) {
    SCOPED_TRACE(angular_velocity);
    const double time = asin(height - ball) / fabs(angular_velocity);
    expect_hit({known(half_space()), {}, rod, {{{5, height, 0}}, lying, {{0, 0, 0}}, {{0, 0, angular_velocity}}}}, time,
               4e-5, 60);
    expect_hit({slab, {{{5, -0.5, 0}}}, rod, {{{5, height, 0}}, lying, {{0, 0, 0}}, {{0, 0, angular_velocity}}}}, time,
               4e-5, 60);
    EXPECT_EQ(
        ballistic({slab, {{{5, -0.5, 0}}}, rod, {{{5, 1.125, 0}}, lying, {{0, 0, 0}}, {{0, 0, angular_velocity}}}})
            .outcome,
        ToiOutcome::clear);
  }
}

DETENT_TEST(ballistic, bound_is_never_late_however_fast_bodies_angular_velocity_and_agrees_with_the_default) {
  Samples samples{21};
  uint32_t decided = 0, hits = 0;
  const uint32_t count = rounds(400);
  for (uint32_t i = 0; i < count; ++i) {
    const double scale = i % 4 == 0 ? ldexp(1, static_cast<int>(samples.below(9)) - 3) : 1;
    const Encounter encounter = random_encounter(samples, scale, i % 2 == 0 ? 4 : 100);
    const TimeOfImpact impact = ballistic(encounter), usual = encounter.impact();
    SCOPED_TRACE(testing::Message() << "pair " << i << ", scale " << scale);
    expect_never_late(encounter, impact, 100);
    EXPECT_LE(impact.gjk_calls, static_cast<uint32_t>(k_toi_iterations_compared_max));
    if (impact.outcome != ToiOutcome::undecided && usual.outcome != ToiOutcome::undecided) {
      ++decided;
      EXPECT_EQ(impact.outcome, usual.outcome);
    }
    hits += impact.outcome == ToiOutcome::hit ? 1u : 0u;
    if (HasFailure()) return;
  }
  EXPECT_GE(decided, count * 9 / 10);
  EXPECT_GT(hits, count / 3);
}

DETENT_TEST(ballistic, bound_needs_no_more_axes_than_the_first_order_one) {
  Samples samples{22};
  uint32_t calls = 0, first_order = 0;
  for (uint32_t i = 0; i < rounds(400); ++i) {
    const Encounter encounter = random_encounter(samples, 1, 12);
    if (encounter.planar()) continue;  // the other goes on along the plane's normal
    const TimeOfImpact impact = ballistic(encounter), other = encounter.impact_by(ToiMethod::first_order);
    calls += impact.gjk_calls;
    first_order += other.gjk_calls;
  }
  printf("%u calls of GJK, by first_order %u\n", calls, first_order);
  EXPECT_LE(calls, first_order);
}

DETENT_TEST(ballistic, bound_that_needs_too_many_axes_is_undecided_and_not_late) {
  // The ball sinks into the disc that the rod sweeps 5,000 times.
  const Encounter encounter = {known(capsule(0.0625, 1.0)),
                               {{{0, 0, 0}}, k_upright, {{0, 0, 0}}, {{0, 0, 0x1p15}}},
                               known(sphere(0.125)),
                               {{{0.5, 0, 0.25}}, k_upright, {{0, 0, -0.125}}}};
  const TimeOfImpact impact = ballistic(encounter);
  EXPECT_EQ(impact.outcome, ToiOutcome::undecided);
  EXPECT_EQ(impact.gjk_calls, static_cast<uint32_t>(k_toi_iterations_compared_max));
  EXPECT_GT(fraction_to_host(impact.time), 0);
  EXPECT_LE(fraction_to_host(impact.time), 0.5 + k_pi / 0x1p15);
}

DETENT_TEST(ballistic, answers_are_the_same_in_every_configuration_and_on_every_target) {
  EXPECT_EQ(digest_of_answers(ToiMethod::mirtich, 23, 600), 0x92dd551a08c69684u);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
