#include "tests/oracle/effort.h"
#include "tests/oracle/feature_contact.h"
#include "tests/proximity/ccd_queries.h"
#include "tests/proximity/feature_pairs.h"

/// Features in linear motion against exact rationals.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_oracle::ExactAnswer;
using detent_oracle::ExactContact;
using detent_oracle::ExactFeatures;
using detent_oracle::rounds;

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

/// Never missed or late, and hits that are none are within the tolerance, exactly.
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
  for (uint32_t i = 0; i < rounds(3000); ++i) {
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
  for (uint32_t i = 0; i < rounds(2000); ++i) {
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
  EXPECT_GT(answers[1], 100u);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
