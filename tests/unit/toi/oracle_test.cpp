#include <detent/distance.h>
#include <detent/toi.h>

#include "tests/common/oracle/convex_toi.h"
#include "tests/common/oracle/effort.h"
#include "tests/common/queries/sets.h"
#include "tests/common/queries/solids.h"
#include "tests/unit/toi/query_bodies.h"

/// Compares the query sets with the oracle (tests/common/oracle). Only on x86-64, because the oracle needs its long
/// double.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_oracle::rounds;
using detent_queries::Query;

constexpr double k_error = k_distance_error + k_number_error;
constexpr double k_resolution = 1e-12;  ///< of the size: what the oracle decides
/// m: in addition to 1e-6 of the size, a hit may be early by the ulps of a position.
constexpr double k_early_slack = k_config == Config::f64 ? 0 : 4 * 0x1p-32;

/// Calls check(query) for `count` queries of a set and two seeds.
template <class Check>
void for_each_query(const char* name, uint32_t count, const Check& check) {
  const detent_queries::Set* set = detent_queries::find_set(name);
  ASSERT_NE(set, nullptr) << name;
  for (const uint64_t seed : {11u, 12u}) {
    for (uint32_t i = 0; i < rounds(count); ++i) {
      const Query query = on_grid(detent_queries::make_query(*set, seed, i, {}));
      SCOPED_TRACE(testing::Message() << "set " << name << ", seed " << seed << ", query " << i);
      check(query);
      if (testing::Test::HasFailure()) return;
    }
    detent_bench::forget_cooked();
  }
}

void check_distance(const Query& query) {
  const Convex a = convex_of(query.a), b = convex_of(query.b);
  const Pose pose_a = pose_of(body_of(query.path_a)), pose_b = pose_of(body_of(query.path_b));
  const detent_oracle::Separation truth = detent_oracle::separation_of(query);
  const double extent = 2 * (detent_queries::core_bound_of(query.a) + detent_queries::core_bound_of(query.b)) +
                        length(body_of(query.path_b).position - body_of(query.path_a).position);
  const double gap = static_cast<double>(truth.gap), slack = k_error * extent;
  Closest closest;
  EXPECT_OK(closest_points(a, pose_a, b, pose_b, closest));
  const double distance = host(closest.distance);
  EXPECT_LE(distance, std::max(gap, 0.0) + slack);
  if (!closest.capped) {
    EXPECT_GE(distance, std::max(gap, 0.0) - slack);
  }
  if (gap < -slack) {
    EXPECT_TRUE(closest.overlap);
  }
  if (gap > slack) {
    bool overlaps = true;
    EXPECT_OK(overlap(a, pose_a, b, pose_b, overlaps));
    EXPECT_FALSE(overlaps);
    const Vector normal = host_units(closest.normal);
    const detent_oracle::Placement placement = detent_oracle::placement_at(detent_oracle::encounter_of(query), 0);
    const double along = static_cast<double>(
        detent_oracle::separation_along(detent_oracle::solid_of(query.a), detent_oracle::solid_of(query.b), placement,
                                        detent_oracle::Arrow{normal[0], normal[1], normal[2]}));
    // The separation along the reported normal is as large as the reported distance.
    EXPECT_NEAR(along - static_cast<double>(detent_oracle::solid_of(query.a).rounding +
                                            detent_oracle::solid_of(query.b).rounding),
                distance, closest.capped ? extent : 2 * slack);
  }
  for (const double distance_max : {0.0, gap - 2 * slack, gap - slack / 2, gap, gap + slack, 2 * gap}) {
    if (distance_max < 0) continue;
    bool farther = false;
    EXPECT_OK(farther_than(a, pose_a, b, pose_b, real(distance_max), farther));
    // True is certain, except for the rounding of the numbers.
    if (farther) {
      EXPECT_GE(gap, host(real(distance_max)) - k_number_error * extent);
    }
  }
}

DETENT_TEST(oracle, distances_of_set_1) { for_each_query("1", 300, check_distance); }
DETENT_TEST(oracle, distances_of_set_1c) { for_each_query("1c", 300, check_distance); }
DETENT_TEST(oracle, distances_of_set_1r) { for_each_query("1r", 200, check_distance); }
DETENT_TEST(oracle, distances_of_set_6) { for_each_query("6", 300, check_distance); }
DETENT_TEST(oracle, distances_of_set_8) { for_each_query("8", 300, check_distance); }
DETENT_TEST(oracle, distances_of_set_10) { for_each_query("10", 300, check_distance); }
DETENT_TEST(oracle, distances_of_set_10c) { for_each_query("10c", 300, check_distance); }
DETENT_TEST(oracle, distances_of_set_11) { for_each_query("11", 300, check_distance); }

/// A cylinder or a cone, of 0.1 to 1 m, half of them rounded.
detent_queries::Solid random_rim(Samples& samples) {
  const auto size = [&] { return host(real(uniform(samples, 0.1, 1))); };
  const detent_queries::Solid solid =
      samples.below(2) == 0 ? detent_queries::cylinder(size(), size()) : detent_queries::cone(size(), size());
  return samples.below(2) == 0 ? solid : detent_queries::rounded(solid, size() / 4);
}

/// A random query with two of them and a gap of about `gap`, m; less than 0: they overlap.
Query random_rims(Samples& samples, double gap) {
  for (;;) {
    Query query;
    query.a = random_rim(samples);
    query.b = random_rim(samples);
    const Quaternion p = random_quaternion(samples), q = random_quaternion(samples);
    query.path_a.rotation = {p.x, p.y, p.z, p.w};
    query.path_b.rotation = {q.x, q.y, q.z, q.w};
    const Vector displacement = random_direction(samples);
    const auto set = [&](double distance) {
      for (size_t i = 0; i < 3; ++i) query.path_b.position[i] = displacement[static_cast<int>(i)] * distance;
    };
    double low = 0, high = 6;
    for (int i = 0; i < 26; ++i) {
      const double middle = (low + high) / 2;
      set(middle);
      (static_cast<double>(detent_oracle::separation_of(query).gap) < gap ? low : high) = middle;
    }
    set(high);
    // Both the library and the oracle get the values that the configuration stores.
    for (detent_queries::Path* path : {&query.path_a, &query.path_b}) {
      const BodyAt body = held(body_of(*path));
      for (size_t i = 0; i < 3; ++i) path->position[i] = body.position[static_cast<int>(i)];
      path->rotation = {body.rotation.x, body.rotation.y, body.rotation.z, body.rotation.w};
    }
    if (fabs(static_cast<double>(detent_oracle::separation_of(query).gap) - gap) < fabs(gap) / 2 + k_position_step)
      return query;
  }
}

DETENT_TEST(oracle, distances_of_rims_that_all_but_touch) {
  Samples samples{21};
  uint32_t capped = 0, wrong = 0;
  double error_max = 0, capped_error_max = 0;
  const uint32_t count = rounds(200);
  for (uint32_t i = 0; i < count; ++i) {
    const double size = pow(10, -uniform(samples, 2, 6.5));
    const Query query = random_rims(samples, samples.below(3) == 0 ? -size : size);
    const Convex a = convex_of(query.a), b = convex_of(query.b);
    const Pose pose_a = pose_of(body_of(query.path_a)), pose_b = pose_of(body_of(query.path_b));
    const double gap = static_cast<double>(detent_oracle::separation_of(query).gap);
    const double extent = 2 * (detent_queries::core_bound_of(query.a) + detent_queries::core_bound_of(query.b)) +
                          length(vector_of(query.path_b.position));
    const double slack = k_error * extent;
    Closest closest;
    EXPECT_OK(closest_points(a, pose_a, b, pose_b, closest));
    bool overlaps = false;
    EXPECT_OK(overlap(a, pose_a, b, pose_b, overlaps));
    const double error = fabs(host(closest.distance) - std::max(gap, 0.0)) / extent;
    capped += closest.capped ? 1u : 0u;
    (closest.capped ? capped_error_max : error_max) = std::max(closest.capped ? capped_error_max : error_max, error);
    EXPECT_LE(host(closest.distance), std::max(gap, 0.0) + slack) << "pair " << i;
    if (closest.capped) continue;  // then neither tells (distance_test.cpp has two such pairs)
    wrong += closest.overlap != overlaps && fabs(gap) > slack ? 1u : 0u;
    wrong += overlaps != (gap < 0) && fabs(gap) > slack ? 1u : 0u;
  }
  printf("%u pairs of rims: %u capped, errors at most %.2g of the extent, capped %.2g\n", count, capped, error_max,
         capped_error_max);
  EXPECT_LE(error_max, k_error);
  EXPECT_EQ(wrong, 0u);
  EXPECT_LE(capped, count / 4);
}

/// The largest penetration up to `end`, m, at the samples: the effect of a late answer.
double depth_between(const detent_oracle::Encounter& encounter, double start, double end) {
  double depth = 0;
  for (int i = 1; i <= 16; ++i) {
    const double gap = static_cast<double>(detent_oracle::signed_gap_at(encounter, start + (end - start) * i / 16));
    depth = std::max(depth, -gap);
  }
  return depth;
}

void check_impact(const Query& query) {
  const Convex a = convex_of(query.a), b = convex_of(query.b);
  const Motion motion_a = motion_of(body_of(query.path_a)), motion_b = motion_of(body_of(query.path_b));
  TimeOfImpact impact;
  EXPECT_OK(time_of_impact(a, motion_a, b, motion_b, impact));
  const detent_oracle::Encounter encounter = detent_oracle::encounter_of(query);
  const detent_oracle::Verdict truth = detent_oracle::judge(encounter);
  const double size = static_cast<double>(truth.size), gap_min = static_cast<double>(truth.gap_min);
  const double tolerance = k_toi_tolerance * size + k_early_slack;
  const double time = fraction_to_host(impact.time);
  EXPECT_NE(impact.outcome, ToiOutcome::undecided);
  EXPECT_LE(impact.gjk_calls, 3 * 24u);
  if (impact.outcome == ToiOutcome::clear) {
    EXPECT_EQ(time, 1);
    if (truth.hit) {
      EXPECT_LE(-gap_min, k_resolution * size) << "a hit at " << static_cast<double>(truth.time) << " was missed";
    }
  }
  if (impact.outcome == ToiOutcome::hit) {
    if (truth.hit && time > static_cast<double>(truth.time)) {
      EXPECT_LE(depth_between(encounter, static_cast<double>(truth.time), time), k_resolution * size) << "late";
    }
    if (!truth.hit) {
      EXPECT_LE(gap_min, tolerance) << "no hit";
    }
    EXPECT_LE(static_cast<double>(detent_oracle::signed_gap_at(encounter, time)), tolerance) << "early";
  }
}

DETENT_TEST(oracle, impacts_of_set_1) { for_each_query("1", 150, check_impact); }
DETENT_TEST(oracle, impacts_of_set_1c) { for_each_query("1c", 150, check_impact); }
DETENT_TEST(oracle, impacts_of_set_1r) { for_each_query("1r", 75, check_impact); }
DETENT_TEST(oracle, impacts_of_set_2) { for_each_query("2", 150, check_impact); }
DETENT_TEST(oracle, impacts_of_set_3) { for_each_query("3", 150, check_impact); }
DETENT_TEST(oracle, impacts_of_set_3c) { for_each_query("3c", 150, check_impact); }
DETENT_TEST(oracle, impacts_of_set_4) { for_each_query("4", 75, check_impact); }
DETENT_TEST(oracle, impacts_of_set_5) {
  if (k_config != Config::fx32) for_each_query("5", 75, check_impact);  // else its range allows 10 km alone
}
DETENT_TEST(oracle, impacts_of_set_6) { for_each_query("6", 150, check_impact); }
DETENT_TEST(oracle, impacts_of_set_7) { for_each_query("7", 150, check_impact); }
DETENT_TEST(oracle, impacts_of_set_8) { for_each_query("8", 150, check_impact); }
DETENT_TEST(oracle, impacts_of_set_9) { for_each_query("9", 150, check_impact); }
DETENT_TEST(oracle, impacts_of_set_11) { for_each_query("11", 150, check_impact); }

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
