#include "ccd/terrain_impact.h"

#include <algorithm>
#include <cmath>

#include "contact/body_convex.h"
#include "tests/common/oracle/bodies.h"
#include "tests/unit/shape/terrains.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// The first impact of a body with a terrain, from a test of every triangle.
TimeOfImpact first_of_all(const Terrain& terrain, const Motion& ground, const Convex& convex, const Motion& motion) {
  TimeOfImpact first;
  first.outcome = ToiOutcome::clear;
  first.time = k_whole_step;
  const uint32_t count = terrain.field.triangle_count();
  for (uint32_t i = 0; i < count; ++i) {
    Pose placed = ground.start;
    Convex made;
    EXPECT_OK(k_terrain_ops.convex(terrain, ground.start, i, placed, made));
    TimeOfImpact found;
    EXPECT_OK(time_of_impact(convex, motion, made, {placed, ground.displacement, ground.rotation_vector}, found));
    if (found.outcome == ToiOutcome::clear) continue;
    if (first.outcome == ToiOutcome::clear || found.time < first.time) first = found;
  }
  return first;
}

/// A long displacement is tested in parts. No triangle must be left out.
DETENT_TEST(terrain_impact, is_that_of_the_first_of_all_triangles_however_long_the_way) {
  Samples samples = {5};
  const detent_terrains::Bytes bytes = detent_terrains::field_of(
      24, 1, [](double x, double z) { return sin(x) * cos(0.7 * z); }, false);
  const Asset asset = {bytes.data(), bytes.count()};
  const AssetTable assets = {&asset, 1};
  BodyProperties ground_properties{};
  ground_properties.type = static_cast<uint32_t>(BodyType::fixed);
  const FeatureTable features = make_feature_table(Features::all);
  ASSERT_OK(set_shape_properties(terrain(0), ground_properties, assets, features));
  BodyPose ground_pose = {};
  ground_pose.rotation = {0.0, 0.0, 0.0, 1.0};
  BodySweep rest = {};
  uint32_t met = 0;
  for (uint32_t round = 0; round < detent_oracle::rounds(200); ++round) {
    const double size = uniform(samples, 0.05, 0.4), length_of_way = std::exp2(uniform(samples, -2, 8));
    const BodyProperties properties =
        round % 2 == 0 ? sphere_properties(size) : box_properties({{size, 0.5 * size, 0.7 * size}});
    const Vector target = {{uniform(samples, -10, 10), 0, uniform(samples, -10, 10)}}, along = any_direction(samples);
    BodyPose pose = {};
    pose.position = position_near(target + along * (-uniform(samples, 0, 1) * length_of_way));
    pose.rotation = rotation_near(any_rotation(samples));
    BodySweep sweep = {};
    sweep.displacement = reals_near(along * length_of_way);
    if (round % 3 == 0) sweep.rotation_vector = reals_near(any_direction(samples) * 0.5);
    const SweptBody body = {properties, pose, sweep}, ground = {ground_properties, ground_pose, rest};
    Convex convex;
    ASSERT_TRUE(body_convex(properties, assets, convex));
    TimeOfImpact impact;
    ASSERT_TRUE(terrain_impact(assets, k_terrain_ops, body, ground, convex, Fraction(0.0), impact));
    const TimeOfImpact expected =
        first_of_all(terrain_of(ground_properties, assets), motion_from(ground, Fraction(0.0)), convex,
                     motion_from(body, Fraction(0.0)));
    ASSERT_EQ(impact.outcome, expected.outcome) << round;
    ASSERT_EQ(impact.time.raw, expected.time.raw) << round;
    if (impact.outcome == ToiOutcome::clear) continue;
    ++met;
    ASSERT_TRUE(impact.normal == expected.normal) << round;
  }
  EXPECT_GT(met, detent_oracle::rounds(200) / 4);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
