#include "tests/common/oracle/effort.h"
#include "tests/common/oracle/feature_contact.h"
#include "tests/unit/toi/ccd_queries.h"
#include "tests/unit/toi/feature_pairs.h"
#include "tests/unit/toi/plain_inclusion.h"
#include "tests/unit/toi/spread.h"

/// Features in linear motion against exact rationals.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_oracle::ExactAnswer;
using detent_oracle::ExactContact;
using detent_oracle::ExactFeatures;
using detent_oracle::rounds;
using detent_test::CcdQuery;
using detent_test::Spread;
using detent_test::spread_of;
using detent_test::time_of;

ExactFeatures exact(const LinearFeatures& features) {
  ExactFeatures result = {};
  result.edges = features.kind == FeatureKind::edge_edge;
  const auto set = [](long double(&to)[3], const Vec64& v) {
    to[0] = static_cast<long double>(v.x);
    to[1] = static_cast<long double>(v.y);
    to[2] = static_cast<long double>(v.z);
  };
  for (int i = 0; i < 4; ++i) {
    set(result.start[i], features.start[i]);
    set(result.end[i], features.end[i]);
  }
  return result;
}

/// Checks with exact numbers that no contact is missed or reported late, and that false hits are within the tolerance.
void expect_true(const LinearFeatures& features, uint32_t (&answers)[4]) {
  FeatureToi result;
  features.first_contact(result);
  const ExactFeatures question = exact(features);
  const ExactContact truth = first_contact(question);
  ++answers[static_cast<int>(truth.answer)];
  if (truth.answer == ExactAnswer::meet || truth.answer == ExactAnswer::touch) {
    EXPECT_NE(result.outcome, ToiOutcome::clear);
    EXPECT_LE(result.time.raw, truth.time);
  }
  if (truth.answer == ExactAnswer::clear) {
    EXPECT_NE(result.outcome, ToiOutcome::undecided);
  }
  if (result.outcome == ToiOutcome::hit) {
    EXPECT_LE(gap_at(question, result.time.raw), k_feature_tolerance * detent_oracle::size_of(question) + 32);
  }
}

DETENT_TEST(feature_oracle, features_between_points_of_a_small_grid) {
  Samples samples{81};
  uint32_t answers[4] = {0, 0, 0, 0};
  for (uint32_t i = 0; i < rounds(500); ++i) {
    LinearFeatures features;
    features.kind = samples.below(2) == 0 ? FeatureKind::vertex_face : FeatureKind::edge_edge;
    features.ball = 1;
    const uint32_t grid = 3 + samples.below(5);
    for (int corner = 0; corner < 4; ++corner) {
      for (const bool at_end : {false, true}) {
        const auto component = [&] { return static_cast<int64_t>(samples.below(grid)) << 50; };
        const int64_t x = component(), y = component(), z = component();
        (at_end ? features.end : features.start)[corner] = {x, y, z};
      }
    }
    SCOPED_TRACE(testing::Message() << "pair " << i);
    expect_true(features, answers);
    if (testing::Test::HasFailure()) return;
  }
  printf("%u clear, %u meet, %u touch, %u flat\n", answers[0], answers[1], answers[2], answers[3]);
  EXPECT_GT(answers[2], 0u);
}

DETENT_TEST(feature_oracle, features_anywhere) {
  Samples samples{82};
  uint32_t answers[4] = {0, 0, 0, 0};
  for (uint32_t i = 0; i < rounds(300); ++i) {
    LinearFeatures features;
    features.kind = samples.below(2) == 0 ? FeatureKind::vertex_face : FeatureKind::edge_edge;
    features.ball = 1;
    const int bits = 20 + static_cast<int>(samples.below(38)), speed = static_cast<int>(samples.below(59));
    for (int corner = 0; corner < 4; ++corner) {
      features.start[corner] = random_corner(samples, bits);
      features.end[corner] = add(features.start[corner], random_corner(samples, speed + 1));
    }
    SCOPED_TRACE(testing::Message() << "pair " << i);
    expect_true(features, answers);
    if (testing::Test::HasFailure()) return;
  }
  printf("%u clear, %u meet, %u touch, %u flat\n", answers[0], answers[1], answers[2], answers[3]);
  EXPECT_GT(answers[1], 5u);
}

LinearFeatures features_of(const CcdQuery& query) {
  LinearFeatures features;
  features.kind = query.edges ? FeatureKind::edge_edge : FeatureKind::vertex_face;
  features.ball = 1;  // a coordinate far smaller than the largest is rounded by up to a half
  const int scale = scale_of(query);
  const auto corner = [scale](const double(&v)[3]) {
    return Vec64{llround(ldexp(v[0], scale)), llround(ldexp(v[1], scale)), llround(ldexp(v[2], scale))};
  };
  for (int i = 0; i < 4; ++i) {
    features.start[i] = corner(query.start[i]);
    features.end[i] = corner(query.end[i]);
  }
  return features;
}
ExactFeatures exact(const CcdQuery& query) {
  ExactFeatures result = {};
  result.edges = query.edges;
  for (int i = 0; i < 4; ++i) {
    std::copy_n(query.start[i], 3, result.start[i]);
    std::copy_n(query.end[i], 3, result.end[i]);
  }
  return result;
}

/// The table of docs/feature_toi.md: a row for each file of the data.
DETENT_TEST(feature_oracle, published_queries_have_no_false_negative) {
  size_t total = 0;
  for (const char* set : detent_test::k_ccd_sets) {
    for (const bool edges : {false, true}) {
      uint32_t meet = 0, missed = 0, false_hits = 0, undecided = 0;
      double gap_max = 0, early_max = 0;
      std::vector<double> times, intervals, plain_times, boxes;
      for (const CcdQuery& query : detent_test::ccd_queries(set, edges)) {
        SCOPED_TRACE(testing::Message() << set << (edges ? " edge-edge " : " vertex-face ") << times.size());
        const LinearFeatures features = features_of(query);
        FeatureToi result;
        times.push_back(time_of(5, [&] { features.first_contact(result); }));
        intervals.push_back(result.intervals);
        meet += query.meets ? 1u : 0u;
        undecided += result.outcome == ToiOutcome::undecided ? 1u : 0u;
        missed += query.meets && result.outcome == ToiOutcome::clear ? 1u : 0u;
        const ExactFeatures question = exact(query);
        const double size = detent_oracle::size_of(question);
        detent_test::PlainInclusion plain(query, k_feature_tolerance * size);
        bool plain_meets = false;
        plain_times.push_back(time_of(1, [&] { plain_meets = plain.meets(); }));
        boxes.push_back(plain.boxes());
        EXPECT_TRUE(plain_meets || !query.meets);
        if (query.meets) {
          const ExactContact truth = first_contact(question);
          if (truth.answer != ExactAnswer::flat) {
            EXPECT_LE(result.time.raw, truth.time);
          }
        }
        if (result.outcome != ToiOutcome::hit) continue;
        early_max = std::max(early_max, gap_at(question, result.time.raw) / size);
        if (query.meets) continue;
        ++false_hits;
        gap_max = std::max(gap_max, least_gap_near(question, result.time.raw) / size);
      }
      if (times.empty()) continue;
      total += times.size();
      const Spread time = spread_of(times), looked = spread_of(intervals), plain_time = spread_of(plain_times),
                   plain_looked = spread_of(boxes);
      printf("| %s, %s | %zu | %u | %u | %u | %u | %.0e | %.0e | %.2f | %.2f | %.2f | %.1f | %.0f |", set,
             edges ? "edges" : "vertex and face", times.size(), meet, missed, undecided, false_hits, gap_max, early_max,
             time.mean, time.late, time.most, looked.mean, looked.most);
      printf(" %.2f | %.0f | %.0f | %.0f |\n", plain_time.mean, plain_time.most, plain_looked.mean, plain_looked.most);
      EXPECT_EQ(missed, 0u);
      EXPECT_EQ(undecided, 0u);
      EXPECT_LT(gap_max, k_feature_tolerance);
      EXPECT_LT(early_max, k_feature_tolerance);
    }
  }
  if (total == 0) GTEST_SKIP() << "no ccd-queries under DETENT_DATA";
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
