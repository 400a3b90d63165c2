#include "tests/common/oracle/effort.h"
#include "tests/common/oracle/motions.h"
#include "tests/unit/toi/encounter.h"
#include "toi_methods/feature_pairs.h"

/// Times of impact of polytopes by their features (feature_pairs.h, redon.h, canny.h).
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_oracle::Placed;
using detent_oracle::PosesOfStep;
using detent_oracle::rounds;

KnownShape random_polytope(Samples& samples, double scale) {
  const auto number = [&] { return uniform(samples, 0.1, 1) * scale; };
  switch (samples.below(4)) {
    case 0: {
      const double x = number(), y = number(), z = number();
      return known(box({real(x), real(y), real(z)}));
    }
    case 1: {
      Vector corners[3];
      for (Vector& corner : corners) corner = random_direction(samples) * number();
      return known_triangle(corners, 0);
    }
    case 2:
      return known_hull(tetrahedron_bytes(), 0);
    default:
      return known_hull(prism_bytes(), 0);
  }
}

/// Two separated polytopes that move towards each other; `turn_max` is the largest rotation of each, rad.
Encounter random_polytopes(Samples& samples, double turn_max) {
  for (;;) {
    const double scale = samples.below(4) == 0 ? ldexp(1, static_cast<int>(samples.below(7)) - 3) : 1;
    const KnownShape a = random_polytope(samples, scale), b = random_polytope(samples, scale);
    const double near = a.distance_max() + b.distance_max();
    const Vector start = random_direction(samples) * (near * uniform(samples, 0.6, 2));
    const Vector aim = random_direction(samples) * (near * uniform(samples, 0, 0.8));
    const auto rotation_vector = [&] { return random_direction(samples) * uniform(samples, 0, turn_max); };
    const Vector place = random_direction(samples) * scale, displacement = random_direction(samples) * scale;
    const Quaternion rotation_a = random_quaternion(samples), rotation_b = random_quaternion(samples);
    const Vector turn_a = samples.below(3) == 0 ? Vector{{0, 0, 0}} : rotation_vector();
    const Vector turn_b = samples.below(3) == 0 ? Vector{{0, 0, 0}} : rotation_vector();
    const BodyAt body_a = {place, rotation_a, displacement, turn_a};
    const BodyAt body_b = {place + start, rotation_b, displacement + (aim - start) * uniform(samples, 0.3, 2), turn_b};
    const Encounter encounter = {a, body_a, b, body_b};
    if (encounter.gap(0) > 0.01 * scale) return encounter;
  }
}

/// Whether the poses are too coarse to decide if the bodies touch.
bool are_too_coarse(const Encounter& encounter) { return encounter.tolerance() / 5 <= encounter.slack(); }

/// A million with DETENT_FULL=1 (50,000 of them by default).
DETENT_TEST(feature_pairs, agree_with_conservative_advancement) {
  Samples samples{1};
  uint32_t hits = 0, clears = 0, intervals_most = 0;
  const uint32_t count = rounds(50000);
  double apart_most = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const Encounter encounter = random_polytopes(samples, i % 3 == 0 ? 8 : 1);
    const TimeOfImpact by_features = encounter.impact_by(ToiMethod::feature_pairs), by_axes = encounter.impact();
    SCOPED_TRACE(testing::Message() << "pair " << i);
    ASSERT_NE(by_features.outcome, ToiOutcome::undecided);
    const double time = fraction_to_host(by_features.time), other = fraction_to_host(by_axes.time);
    const double tolerance = encounter.tolerance() + encounter.slack();
    if (by_features.outcome == ToiOutcome::hit) {
      ++hits;
      ASSERT_LE(encounter.gap(time), tolerance);
    } else {
      ++clears;
    }
    intervals_most = std::max(intervals_most, by_features.passes);
    if (by_features.outcome == by_axes.outcome && time == other) continue;
    // A hit of either method is within the tolerance, and neither is late: the shapes are separated between the earlier
    // and the later time.
    const double first = std::min(time, other), last = std::max(time, other);
    apart_most = std::max(apart_most, last - first);
    ASSERT_LE(encounter.gap(first), tolerance) << time << " and " << other;
    if (are_too_coarse(encounter)) continue;
    for (int k = 0; k <= 16; ++k)
      ASSERT_TRUE(encounter.apart(first + ldexp(last - first, -k))) << time << " and " << other;
  }
  printf("%u pairs, %u hits, at most %u intervals; times apart by %.1e\n", count, hits, intervals_most, apart_most);
  EXPECT_GT(hits, count / 5);
  EXPECT_GT(clears, count / 10);
}

DETENT_TEST(feature_pairs, are_never_late) {
  Samples samples{2};
  for (uint32_t i = 0; i < rounds(1000); ++i) {
    const Encounter encounter = random_polytopes(samples, i % 3 == 0 ? 12 : 2);
    SCOPED_TRACE(testing::Message() << "pair " << i);
    expect_never_late(encounter, encounter.impact_by(ToiMethod::feature_pairs), 100);
    if (HasFailure()) return;
  }
}

DETENT_TEST(feature_pairs, tell_where_bodies_meet_as_conservative_advancement_does) {
  // A cube that falls on its corner, and a cube that rotates with an edge into a wall.
  const KnownShape cube = known(box({0.5, 0.5, 0.5})), slab = known(box({4.0, 0.5, 4.0}));
  const Quaternion leaning = rotation_by(Vector{{0.3, 0.4, 0.5}});
  const Encounter falling = {slab, {{{0, -0.5, 0}}}, cube, {{{0.25, 2, 0.5}}, leaning, {{0, -2, 0}}}};
  const Encounter turning = {slab, {{{0, -0.5, 0}}}, cube, {{{0, 0.625, 0}}, k_upright, {{0, 0, 0}}, {{0, 0, 0.75}}}};
  for (const Encounter& encounter : {falling, falling.swapped(), turning, turning.swapped()}) {
    const TimeOfImpact impact = encounter.impact_by(ToiMethod::feature_pairs), usual = encounter.impact();
    ASSERT_EQ(impact.outcome, ToiOutcome::hit);
    EXPECT_NEAR(fraction_to_host(impact.time), fraction_to_host(usual.time), 1e-5);
    EXPECT_LE(length(host_units(impact.normal) - host_units(usual.normal)), 1e-4);
    EXPECT_LE(length(host(impact.point) - host(usual.point)), 1e-4);
  }
  // (cos x + sin x) / 2 = 0.625
  EXPECT_NEAR(fraction_to_host(turning.impact_by(ToiMethod::feature_pairs).time),
              (k_pi / 4 - acos(0.625 * sqrt(2))) / 0.75, 1e-5);
}

DETENT_TEST(feature_pairs, of_what_starts_together_hit_at_once) {
  const KnownShape cube = known(box({0.5, 0.5, 0.5}));
  for (const double apart : {0.0, 0.5, 1.0}) {
    for (const ToiMethod method : {ToiMethod::feature_pairs, ToiMethod::redon, ToiMethod::canny}) {
      const Encounter encounter = {cube, {}, cube, {{{apart, 0, 0}}, k_upright, {{4, 0, 0}}, {{0, 0, 1}}}};
      const TimeOfImpact impact = encounter.impact_by(method);
      EXPECT_EQ(impact.outcome, ToiOutcome::hit);
      EXPECT_TRUE(impact.time == Fraction(0.0));
    }
  }
}

DETENT_TEST(feature_pairs, that_slide_along_each_other_are_answered) {
  // Face on face with a gap of 1e-7 and more: clear, or a hit within the tolerance; not undecided.
  const KnownShape cube = known(box({0.5, 0.5, 0.5}));
  for (const double gap : {1e-7, 1e-6, 1e-5, 1e-3}) {
    for (const double angular_velocity : {0.0, 1.0}) {
      const Encounter encounter = {
          cube, {}, cube, {{{-3, 1 + gap, 0.25}}, k_upright, {{6, 0, 0}}, {{0, angular_velocity, 0}}}};
      const TimeOfImpact impact = encounter.impact_by(ToiMethod::feature_pairs);
      expect_never_late(encounter, impact, 100);
      EXPECT_NE(impact.outcome, ToiOutcome::undecided);
      EXPECT_TRUE(gap < 1e-4 || impact.outcome == ToiOutcome::clear);
    }
  }
}

DETENT_TEST(feature_pairs, of_fast_spins_are_never_late_and_end) {
  const KnownShape rod = known(box({1.0, 0.03125, 0.03125})), cube = known(box({0.5, 0.5, 0.5}));
  for (const double angular_velocity : {20.0, 100.0, 300.0}) {
    const Encounter encounter = {rod,
                                 {{{0, 0, 0}}, k_upright, {{0, 0, 0}}, {{0, 0, angular_velocity}}},
                                 cube,
                                 {{{2, 0, 0}}, k_upright, {{-3, 0, 0}}, {{angular_velocity, 0, 0}}}};
    const TimeOfImpact impact = encounter.impact_by(ToiMethod::feature_pairs);
    EXPECT_EQ(impact.outcome, ToiOutcome::hit);
    expect_never_late(encounter, impact, 1000);
  }
  // This needs more parts of the step than the limit: undecided, with a safe time.
  const Encounter endless = {
      rod, {{{0, 0, 0}}, k_upright, {{0, 0, 0}}, {{0, 0, 0x1p16}}}, cube, {{{2, 0, 0}}, k_upright, {{-0.375, 0, 0}}}};
  const TimeOfImpact impact = endless.impact_by(ToiMethod::feature_pairs);
  EXPECT_EQ(impact.outcome, ToiOutcome::undecided);
  EXPECT_LT(fraction_to_host(impact.time), 1);
}

/// Both polytopes placed at a time in some motion, A first.
struct BothPlaced {
  Placed a, b;
};
double gap_of(const Encounter& encounter, const BothPlaced& placed) {
  BodyAt at_a = {{{0, 0, 0}}, placed.a.rotation}, at_b = {placed.b.position - placed.a.position, placed.b.rotation};
  Closest closest;
  EXPECT_OK(closest_points(encounter.a.convex, pose_of(at_a), encounter.b.convex, pose_of(at_b), closest));
  return closest.overlap ? 0 : host(closest.distance);
}
PosesOfStep poses_of(const BodyAt& body) {
  return {{body.position, body.rotation}, body.displacement, body.rotation_vector};
}

/// The first and the last pose of B in A's frame, and the rotation between them.
PosesOfStep relative_poses(const Encounter& encounter) {
  const auto seen = [&](double time) {
    const BodyAt a = encounter.body_a.at(time), b = encounter.body_b.at(time);
    return Placed{a.to_local(b.position), detent_oracle::conjugate(a.rotation) * b.rotation};
  };
  const Placed first = seen(0), last = seen(1);
  Quaternion rotation_vector = normalised(last.rotation * detent_oracle::conjugate(first.rotation));
  if (rotation_vector.w < 0)
    rotation_vector = {-rotation_vector.x, -rotation_vector.y, -rotation_vector.z, -rotation_vector.w};
  const Vector v = {{rotation_vector.x, rotation_vector.y, rotation_vector.z}};
  const double sine = length(v), angle = 2 * atan2(sine, rotation_vector.w);
  return {first, last.position - first.position, sine == 0 ? Vector{{0, 0, 0}} : v * (angle / sine)};
}

/// The counts of answers for a method's own motion.
struct OwnMotion {
  uint32_t asked = 0, refused = 0, hits = 0;
  uint32_t passed = 0;  ///< by samples they touch before the answer's time
  uint32_t late = 0;    ///< hits at whose time they overlap
};

/// Tests a method with random polytopes, of which some rotate by more than its limit `turn_limit`, rad.
/// `rotation_vector` and `placed` return the rotation, and the placement at a time, in the method's motion. A hit must
/// be within the tolerance.
template <class Turn, class PlacedAt>
OwnMotion ask_in_own_motion(ToiMethod method, Samples samples, double turn_limit, Turn rotation_vector,
                            PlacedAt placed) {
  constexpr int k_samples = 40;
  OwnMotion found;
  for (uint32_t i = 0; i < rounds(2000) && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE(testing::Message() << "pair " << i);
    const Encounter encounter = random_polytopes(samples, i % 4 == 0 ? 4 : 1);
    TimeOfImpact impact;
    const Status status = time_of_impact_by(method, encounter.a.convex, motion_of(encounter.body_a), encounter.b.convex,
                                            motion_of(encounter.body_b), impact);
    if (status == Status::out_of_range) {
      EXPECT_GT(rotation_vector(encounter), turn_limit - 1e-3);
      ++found.refused;
      continue;
    }
    EXPECT_EQ(status, Status::ok);
    EXPECT_LT(rotation_vector(encounter), turn_limit + 1e-3);
    EXPECT_NE(impact.outcome, ToiOutcome::undecided);
    ++found.asked;
    const double time = fraction_to_host(impact.time), slack = encounter.slack() + 1e-7 * encounter.distance_max();
    const auto gap_at = [&](double when) { return gap_of(encounter, placed(encounter, when)); };
    if (impact.outcome == ToiOutcome::hit) {
      ++found.hits;
      EXPECT_LE(gap_at(time), encounter.tolerance() + slack);
      if (time == 0) continue;
    }
    if (are_too_coarse(encounter)) continue;
    if (impact.outcome == ToiOutcome::hit && gap_at(time) == 0) ++found.late;
    bool apart = true;
    for (int k = 0; k < k_samples && apart; ++k) apart = gap_at(time * k / k_samples) > 0;
    found.passed += apart ? 0u : 1u;
  }
  EXPECT_GT(found.hits, found.asked / 5);
  EXPECT_LT(found.hits, found.asked * 9 / 10);
  EXPECT_GT(found.refused, 0u);
  return found;
}

DETENT_TEST(redon, is_never_late_in_the_screw_between_the_poses) {
  const OwnMotion found = ask_in_own_motion(
      ToiMethod::redon, Samples{3}, 2 * atan(4.0),
      [](const Encounter& encounter) { return length(relative_poses(encounter).rotation_vector); },
      [](const Encounter& encounter, double time) {
        return BothPlaced{{{{0, 0, 0}}, {0, 0, 0, 1}},
                          detent_oracle::tangent_screw_at(relative_poses(encounter), time)};
      });
  EXPECT_EQ(found.passed, 0u);
  EXPECT_EQ(found.late, 0u);
}

DETENT_TEST(canny, hits_within_the_tolerance_and_passes_hardly_any_contact_of_its_motion) {
  const OwnMotion found = ask_in_own_motion(
      ToiMethod::canny, Samples{4}, k_pi,
      [](const Encounter& encounter) {
        return std::max(length(encounter.body_a.rotation_vector), length(encounter.body_b.rotation_vector));
      },
      [](const Encounter& encounter, double time) {
        return BothPlaced{detent_oracle::normalised_lerp_at(poses_of(encounter.body_a), time),
                          detent_oracle::normalised_lerp_at(poses_of(encounter.body_b), time)};
      });
  printf("%u pairs, %u hits, %u passed, %u late\n", found.asked, found.hits, found.passed, found.late);
  EXPECT_LE(found.passed, found.asked / 200);
}

/// Two triangles in one plane, a corner against an edge: no volume changes its sign.
DETENT_TEST(canny, passes_what_is_coplanar_all_the_time) {
  const Vector corners[3] = {{{-0.5, 0, -0.5}}, {{0.5, 0, -0.5}}, {{0, 0, 0.5}}};
  const KnownShape triangle = known_triangle(corners, 0);
  const Encounter encounter = {triangle, {}, triangle, {{{3, 0, 0}}, k_upright, {{-4, 0, 0}}}};
  for (const ToiMethod method : {ToiMethod::constant_angular_velocity, ToiMethod::feature_pairs, ToiMethod::redon}) {
    const TimeOfImpact impact = encounter.impact_by(method);
    EXPECT_EQ(impact.outcome, ToiOutcome::hit);
    EXPECT_NEAR(fraction_to_host(impact.time), 0.5, 1e-6);
  }
  EXPECT_GT(fraction_to_host(encounter.impact_by(ToiMethod::canny).time), 0.501);  // seen where the next part begins
}

DETENT_TEST(feature_pairs, of_other_shapes_are_refused) {
  const KnownShape cube = known(box({0.5, 0.5, 0.5}));
  for (const KnownShape& other : {known(sphere(0.5)), known(capsule(0.5, 0.5)), known(cylinder(0.5, 0.5)),
                                  known(half_space()), known(rounded(box({0.5, 0.5, 0.5}), 0.125))}) {
    for (const ToiMethod method : {ToiMethod::feature_pairs, ToiMethod::redon, ToiMethod::canny}) {
      TimeOfImpact impact;
      EXPECT_EQ(time_of_impact_by(method, cube.convex, {}, other.convex, {}, impact), Status::bad_argument);
      EXPECT_EQ(time_of_impact_by(method, other.convex, {}, cube.convex, {}, impact), Status::bad_argument);
    }
  }
}

DETENT_TEST(redon, of_a_body_larger_than_its_range_is_refused_whichever_it_is) {
  const KnownShape small = known(box({0.5, 0.5, 0.5})), large = known(box({500, 500, 500})),
                   too_large = known(box({700, 700, 700}));
  Motion still;
  still.start.rotation = {0.0, 0.0, 0.0, 1.0};
  const auto ask = [&](const KnownShape& a, const KnownShape& b) {
    TimeOfImpact impact;
    return time_of_impact_by(ToiMethod::redon, a.convex, still, b.convex, still, impact);
  };
  EXPECT_OK(ask(small, large));
  EXPECT_OK(ask(large, small));
  EXPECT_EQ(ask(small, too_large), Status::out_of_range);
  EXPECT_EQ(ask(too_large, small), Status::out_of_range);
}

DETENT_TEST(feature_pairs, of_motions_without_a_turn_give_one_time_by_all_three) {
  Samples samples{5};
  for (uint32_t i = 0; i < rounds(500); ++i) {
    const Encounter encounter = random_polytopes(samples, 0);
    const TimeOfImpact features = encounter.impact_by(ToiMethod::feature_pairs);
    const double time = fraction_to_host(features.time), tolerance = encounter.tolerance() + encounter.slack();
    for (const ToiMethod method : {ToiMethod::redon, ToiMethod::canny}) {
      const TimeOfImpact other = encounter.impact_by(method);
      const double first = std::min(time, fraction_to_host(other.time));
      EXPECT_TRUE((other.outcome == features.outcome && fraction_to_host(other.time) == time) ||
                  encounter.gap(first) <= tolerance)
          << "pair " << i << ": " << time << " and " << fraction_to_host(other.time);
    }
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
