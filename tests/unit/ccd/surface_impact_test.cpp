#include "ccd/surface_impact.h"

#include <algorithm>
#include <cmath>

#include "contact/body_convex.h"
#include "tests/oracle/bodies.h"
#include "tests/unit/shape/surfaces.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// The first triangle that a body meets, asked one by one, all of them.
TimeOfImpact first_of_all(const Surface& surface, const Motion& ground, const Convex& convex, const Motion& motion) {
  TimeOfImpact first;
  first.outcome = ToiOutcome::clear;
  first.time = k_whole_step;
  const uint32_t count = surface.field.triangle_count();
  for (uint32_t i = 0; i < count; ++i) {
    Pose placed = ground.start;
    Convex made;
    EXPECT_OK(k_surface_ops.convex(surface, ground.start, i, placed, made));
    TimeOfImpact found;
    EXPECT_OK(time_of_impact(convex, motion, made, {placed, ground.displacement, ground.turn}, found));
    if (found.outcome == ToiOutcome::clear) continue;
    if (first.outcome == ToiOutcome::clear || found.time < first.time) first = found;
  }
  return first;
}

/// A long way is looked along part by part, which must leave out nothing.
DETENT_TEST(surface_impact, is_that_of_the_first_of_all_triangles_however_long_the_way) {
  Samples samples = {5};
  const detent_surfaces::Bytes bytes = detent_surfaces::field_of(
      24, 1, [](double x, double z) { return sin(x) * cos(0.7 * z); }, false);
  const Asset asset = {bytes.data(), bytes.count()};
  const AssetTable assets = {&asset, 1};
  BodyTraits ground_traits{};
  ground_traits.type = static_cast<uint32_t>(BodyType::fixed);
  const FeatureTable features = make_feature_table(Features::all);
  ASSERT_OK(set_shape_traits(surface(0), ground_traits, assets, features));
  BodyPose ground_pose = {};
  ground_pose.rotation = {0.0, 0.0, 0.0, 1.0};
  BodySweep rest = {};
  uint32_t met = 0;
  for (uint32_t round = 0; round < detent_oracle::rounds(200); ++round) {
    const double size = uniform(samples, 0.05, 0.4), length_of_way = std::exp2(uniform(samples, -2, 8));
    const BodyTraits traits = round % 2 == 0 ? sphere_traits(size) : box_traits({{size, 0.5 * size, 0.7 * size}});
    const Vector target = {{uniform(samples, -10, 10), 0, uniform(samples, -10, 10)}}, along = any_direction(samples);
    BodyPose pose = {};
    pose.position = position_near(target + along * (-uniform(samples, 0, 1) * length_of_way));
    pose.rotation = rotation_near(any_rotation(samples));
    BodySweep sweep = {};
    sweep.displacement = reals_near(along * length_of_way);
    if (round % 3 == 0) sweep.turn = reals_near(any_direction(samples) * 0.5);
    const SweptBody body = {traits, pose, sweep}, ground = {ground_traits, ground_pose, rest};
    Convex convex;
    ASSERT_TRUE(body_convex(traits, assets, convex));
    TimeOfImpact impact;
    ASSERT_TRUE(surface_impact(assets, k_surface_ops, body, ground, convex, Fraction(0.0), impact));
    const TimeOfImpact expected = first_of_all(surface_of(ground_traits, assets), motion_from(ground, Fraction(0.0)),
                                               convex, motion_from(body, Fraction(0.0)));
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
