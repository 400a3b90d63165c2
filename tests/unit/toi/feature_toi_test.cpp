#include <detent/feature_toi.h>

#include "base/digest.h"
#include "tests/common/oracle/effort.h"
#include "tests/unit/toi/feature_pairs.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_oracle::rounds;

constexpr double k_unit_slack = 32;  ///< of the integers' unit, beside k_feature_tolerance

FeatureToi answer_to(const LinearFeatures& features) {
  FeatureToi result;
  features.first_contact(result);
  EXPECT_LE(result.intervals, k_feature_intervals_max);
  EXPECT_EQ(result.outcome == ToiOutcome::clear,
            fraction_to_host(result.time) == 1 && result.outcome != ToiOutcome::hit);
  return result;
}

double tolerance_of(const LinearFeatures& features) {
  return k_feature_tolerance * feature_size(features) + k_unit_slack;
}

/// Checks that the gap at a hit is at most the tolerance plus the rounding of the reference in doubles.
void expect_near(const LinearFeatures& features, const FeatureToi& result) {
  double far = 0;
  for (int i = 0; i < 4; ++i) {
    far = std::max({far, length(vector_of(features.start[i])), length(vector_of(features.end[i]))});
  }
  EXPECT_LE(feature_gap_at(features, result.time), tolerance_of(features) + 1e-14 * far);
}

void expect_planted(Special special) {
  Samples samples{static_cast<uint64_t>(special) + 71};
  const uint32_t count = rounds(4000);
  uint32_t undecided = 0, intervals = 0, intervals_max = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const PlantedPair pair = planted_pair(samples, special);
    const FeatureToi result = answer_to(pair.features);
    SCOPED_TRACE(testing::Message() << "pair " << i);
    EXPECT_NE(result.outcome, ToiOutcome::clear);
    EXPECT_LE(result.time.raw, int64_t{pair.time} << (k_time_bits - 6));
    if (result.outcome == ToiOutcome::hit) {
      expect_near(pair.features, result);
    } else {
      ++undecided;
    }
    intervals += result.intervals;
    intervals_max = std::max(intervals_max, result.intervals);
    if (testing::Test::HasFailure()) return;
  }
  printf("%u pairs: %u undecided, %.1f intervals, at most %u\n", count, undecided,
         static_cast<double>(intervals) / count, intervals_max);
  EXPECT_LE(undecided, count / 100);
}

DETENT_TEST(feature_toi, contacts_are_never_missed_or_late) { expect_planted(Special::none); }
DETENT_TEST(feature_toi, tangent_contacts_are_never_missed_or_late) { expect_planted(Special::tangent); }
DETENT_TEST(feature_toi, contacts_in_one_plane_are_never_missed_or_late) { expect_planted(Special::flat); }
DETENT_TEST(feature_toi, contacts_of_lines_are_never_missed_or_late) { expect_planted(Special::line); }
DETENT_TEST(feature_toi, contacts_of_points_are_never_missed_or_late) { expect_planted(Special::point); }
DETENT_TEST(feature_toi, touching_all_the_time_is_a_contact_at_the_start) { expect_planted(Special::rigid); }

/// A vertex that falls past, or onto, the middle of an edge of 2 m of a triangle. It is `beside` m outside the edge.
FeatureToi fall(double beside) {
  const Vec3<Real> start[4] = {reals({{0, 1, -beside}}), reals({{-1, 0, 0}}), reals({{1, 0, 0}}), reals({{0, 0, 1}})};
  const Vec3<Real> end[4] = {reals({{0, -3, -beside}}), start[1], start[2], start[3]};
  FeatureToi result;
  EXPECT_OK(feature_toi_linear(FeatureKind::vertex_face, start, end, result));
  return result;
}

DETENT_TEST(feature_toi, a_vertex_falls_onto_a_face_or_past_it) {
  for (const double inside : {-0.5, -0.001, 0.0}) {
    const FeatureToi result = fall(inside);
    EXPECT_EQ(result.outcome, ToiOutcome::hit);
    EXPECT_LE(fraction_to_host(result.time), 0.25);
    EXPECT_GE(fraction_to_host(result.time), 0.25 - 1e-6);
  }
  for (const double outside : {0.5, 0.001, 2e-6}) EXPECT_EQ(fall(outside).outcome, ToiOutcome::clear);
}

/// At the end the features have the distance at which the cubic, minus its error, is 0, and only there. The last
/// interval has no length: the features must be near at its end, not at its beginning.
DETENT_TEST(feature_toi, features_that_come_near_at_the_very_end_meet_there) {
  LinearFeatures features = {FeatureKind::vertex_face, {}, {}, 1920274};
  features.start[1] = {-50025026403876, 27985549945424, -52413302105909};
  features.start[2] = {9667299480212, -27451661514954, 4744917919830};
  features.start[3] = {6455322060377, 71232581968391, 17179691577193};
  features.end[1] = {-50999197651066, 27437971105088, -52063537429587};
  features.end[2] = {8693128233022, -27999240355290, 5094682596152};
  features.end[3] = {5481150813187, 70685003128055, 17529456253515};
  const FeatureToi result = answer_to(features);
  EXPECT_GT(fraction_to_host(result.time), 0.99);
  expect_near(features, result);
}

DETENT_TEST(feature_toi, edges_cross_or_pass_each_other) {
  for (const double apart : {0.0, 0.5, 0.999, 1.001, 3.0}) {
    const Vec3<Real> start[4] = {reals({{-1, 1, 0}}), reals({{1, 1, 0}}), reals({{apart, 0, -1}}),
                                 reals({{apart, 0, 1}})};
    const Vec3<Real> end[4] = {reals({{-1, -1, 0}}), reals({{1, -1, 0}}), start[2], start[3]};
    FeatureToi result;
    EXPECT_OK(feature_toi_linear(FeatureKind::edge_edge, start, end, result));
    EXPECT_EQ(result.outcome, apart <= 1 ? ToiOutcome::hit : ToiOutcome::clear);
    EXPECT_LE(fraction_to_host(result.time), apart <= 1 ? 0.5 : 1.0);
    EXPECT_GE(fraction_to_host(result.time), 0.5 - 1e-6);
  }
}

DETENT_TEST(feature_toi, what_begins_near_and_flies_off_is_clear) {
  Samples samples{78};
  for (uint32_t i = 0; i < rounds(400); ++i) {
    // A unit triangle or edge, and a feature that starts 2e-6 above it and moves up and to any side.
    LinearFeatures f;
    f.kind = i % 2 == 0 ? FeatureKind::vertex_face : FeatureKind::edge_edge;
    f.ball = 1;
    const int64_t unit = int64_t{1} << 36, gap = unit / 500000;
    const Vec64 start[2][4] = {{{0, gap, 0}, {-unit, 0, -unit}, {unit, 0, -unit}, {0, 0, unit}},
                               {{-unit, gap, 0}, {unit, gap, 0}, {0, 0, -unit}, {0, 0, unit}}};
    const int speed = static_cast<int>(samples.below(23));
    const Vec64 displacement = random_corner(samples, 37 + speed);
    for (int k = 0; k < 4; ++k) {
      f.start[k] = start[i % 2][k];
      f.end[k] = k < first_of_b(f.kind)
                     ? add(f.start[k],
                           Vec64{displacement.x, displacement.y < 0 ? -displacement.y : displacement.y, displacement.z})
                     : f.start[k];
    }
    EXPECT_EQ(answer_to(f).outcome, ToiOutcome::clear) << "pair " << i;
  }
}

DETENT_TEST(feature_toi, bad_questions_are_refused_and_change_nothing) {
  const Vec3<Real> corners[4] = {reals({{0, 1, 0}}), reals({{-1, 0, -1}}), reals({{1, 0, -1}}), reals({{0, 0, 1}})};
  FeatureToi result;
  result.intervals = 77;
  EXPECT_EQ(feature_toi_linear(static_cast<FeatureKind>(0), corners, corners, result), Status::bad_argument);
  EXPECT_EQ(feature_toi_linear(static_cast<FeatureKind>(3), corners, corners, result), Status::bad_argument);
  for (int i = 0; i < 4; ++i) {
    Vec3<Real> far[4] = {corners[0], corners[1], corners[2], corners[3]};
    far[i].y = real(-16385);
    EXPECT_EQ(feature_toi_linear(FeatureKind::edge_edge, far, corners, result), Status::out_of_range);
    EXPECT_EQ(feature_toi_linear(FeatureKind::vertex_face, corners, far, result), Status::out_of_range);
    far[i].y = real(-16384);
    FeatureToi other;
    EXPECT_OK(feature_toi_linear(FeatureKind::vertex_face, corners, far, other));
#if !DETENT_FIXED
    far[i].y = static_cast<Real>(NAN);
    EXPECT_EQ(feature_toi_linear(FeatureKind::vertex_face, corners, far, result), Status::out_of_range);
#endif
  }
  EXPECT_EQ(result.intervals, 77u);
}

DETENT_TEST(feature_toi, answers_are_the_same_in_every_configuration_and_on_every_target) {
  Samples samples{79};
  uint64_t digest = 0;
  for (uint32_t i = 0; i < 1200; ++i) {
    PlantedPair pair = planted_pair(samples, static_cast<Special>(i % k_specials));
    if (i % 5 == 0) pair.features.end[0] = random_corner(samples, 48);
    const FeatureToi result = answer_to(pair.features);
    digest = digest_step(digest, static_cast<uint64_t>(result.time.raw));
    digest = digest_step(digest, static_cast<uint64_t>(result.outcome) << 32 | result.intervals);
  }
  EXPECT_EQ(digest_finish(digest), 0x2e56bac328092f17u);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
