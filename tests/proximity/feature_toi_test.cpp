#include <detent/feature_toi.h>

#include "base/digest.h"
#include "tests/oracle/effort.h"
#include "tests/proximity/ccd_queries.h"
#include "tests/proximity/feature_pairs.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_oracle::rounds;
using detent_test::CcdQuery;

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

/// What may be early in gap, and what rounding of the reference's doubles takes.
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

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
