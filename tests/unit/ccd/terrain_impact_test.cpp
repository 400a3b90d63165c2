#include "ccd/terrain_impact.h"

#include <algorithm>
#include <cmath>

#include "contact/body_convex.h"
#include "contact/terrain_distance.h"
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

/// The ground moves as well, and rotates in a third of the rounds. Before the impact, or in the whole tick if there is
/// none, no triangle touches.
DETENT_TEST(terrain_impact, is_never_late_over_ground_that_moves) {
  Samples samples = {9};
  const detent_terrains::Bytes bytes = detent_terrains::field_of(
      12, 1, [](double x, double z) { return sin(x) * cos(0.7 * z); }, false);
  const Asset asset = {bytes.data(), bytes.count()};
  const AssetTable assets = {&asset, 1};
  BodyProperties ground_properties{};
  ground_properties.type = static_cast<uint32_t>(BodyType::kinematic);
  const FeatureTable features = make_feature_table(Features::all);
  ASSERT_OK(set_shape_properties(terrain(0), ground_properties, assets, features));
  uint32_t met = 0, clear = 0;
  for (uint32_t round = 0; round < detent_oracle::rounds(300); ++round) {
    const auto some = [&] { return uniform(samples, 0.05, 0.4); };
    const double thin = round % 4 == 3 ? 0.1 : 1;
    const BodyProperties properties = round % 4 == 0   ? sphere_properties(some())
                                      : round % 4 == 1 ? capsule_properties(0.05, 2 * some())
                                                       : box_properties({{thin * some(), some() / thin, some()}});
    const auto swept = [&](double rotation, double displacement) {
      BodySweep sweep = {};
      sweep.rotation_vector = reals_near(any_direction(samples) * (rotation * uniform(samples, 0, 1)));
      sweep.displacement = reals_near(any_direction(samples) * (displacement * uniform(samples, 0, 1)));
      return sweep;
    };
    BodyPose ground_pose = {}, pose = {};
    ground_pose.rotation = rotation_near(any_rotation(samples));
    Vector from = {{uniform(samples, -5, 5), uniform(samples, -1, 3), uniform(samples, -5, 5)}};
    Vector at = {{0, 0, 0}};
    for (int i = 0; i < 3; ++i) at = at + detent_oracle::axis_of(host(ground_pose.rotation), i) * from[i];
    pose.position = position_near(at);
    pose.rotation = rotation_near(any_rotation(samples));
    const BodySweep ground_sweep = swept(round % 3 == 0 ? 0.3 : 0, 0.5), sweep = swept(1.5, 1);
    const SweptBody body = {properties, pose, sweep}, ground = {ground_properties, ground_pose, ground_sweep};
    Convex convex;
    ASSERT_TRUE(body_convex(properties, assets, convex));
    TimeOfImpact impact;
    ASSERT_TRUE(terrain_impact(assets, k_terrain_ops, body, ground, convex, Fraction(0.0), impact));
    ++(impact.outcome == ToiOutcome::clear ? clear : met);
    for (int part = 0; part < 32; ++part) {
      const Fraction time = Fraction::from_raw((k_whole_step.raw >> 5) * part);
      if (impact.outcome != ToiOutcome::clear && !(time < impact.time)) break;
      const BodyPose ground_at = pose_at(ground, time), body_at = pose_at(body, time);
      bool farther = false;
      ASSERT_TRUE(farther_than_terrain(assets, ground_properties, {ground_at.position, ground_at.rotation}, properties,
                                       convex, {body_at.position, body_at.rotation}, real_near(0), farther));
      ASSERT_TRUE(farther) << round << ", " << part;
    }
  }
  EXPECT_GT(met, detent_oracle::rounds(300) / 8);
  EXPECT_GT(clear, detent_oracle::rounds(300) / 8);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
