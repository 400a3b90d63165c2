#include "tests/unit/contact/pairs.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_oracle::Kind;

bool same_features(const ContactGeometry& a, const ContactGeometry& b) {
  if (a.count != b.count) return false;
  for (uint32_t i = 0; i < a.count; ++i) {
    bool found = false;
    for (uint32_t j = 0; j < b.count; ++j) found = found || a.point[i].feature == b.point[j].feature;
    if (!found) return false;
  }
  return true;
}

/// B rests with a face on top of A, rotated about the normal and moved over the face at random, with a penetration of
/// 1/500 of its size.
OraclePair resting_pair(Samples& samples, Form form_a, Form form_b) {
  OraclePair pair;
  pair.a.properties = random_properties(samples, form_a, 0.5);
  pair.b.properties = random_properties(samples, form_b, 0.5);
  if (form_a == Form::box) pair.a.properties = box_properties({{2, uniform(samples, 0.2, 1), uniform(samples, 1, 2)}});
  const Quaternion rotation_vector = detent_oracle::rotation_by({{0, uniform(samples, -3, 3), 0}});
  const double quarter = 1.57079632679489662;
  const Quaternion lie = form_b == Form::capsule ? detent_oracle::rotation_by({{quarter, 0, 0}})
                                                 : detent_oracle::rotation_by({{0, 0, quarter * samples.below(4)}});
  const Quaternion frame = any_rotation(samples);
  pair.a.pose.rotation = rotation_near(normalised(frame));
  pair.b.pose.rotation = rotation_near(normalised(frame * (rotation_vector * lie)));
  pair.a.pose.position = position_near({{10, -20, 30}});
  pair.b.pose.position = pair.a.pose.position;
  const Solid a = solid_of(pair.a, pair.a.pose.position), b = solid_of(pair.b, pair.a.pose.position);
  const double height =
      (a.kind == Kind::half_space ? 0 : a.size[1]) + extent_along(b, a.axis[1]) - extent_of(pair) / 500;
  const Vector aside = a.axis[0] * uniform(samples, -1, 1) + a.axis[2] * uniform(samples, -1, 1);
  pair.b.pose.position = position_near(Vector{{10, -20, 30}} + a.axis[1] * height + aside);
  return pair;
}

/// Moves and rotates a body by 1e-5 of its size.
OracleBody trembled(const OracleBody& body, Samples& samples) {
  OracleBody moved = body;
  const double size = unit_of(body.properties);
  const Vector at = {
      {coord_to_host(body.pose.position.x), coord_to_host(body.pose.position.y), coord_to_host(body.pose.position.z)}};
  moved.pose.position = position_near(at + any_direction(samples) * (1e-5 * size));
  const Quaternion rotation_vector = detent_oracle::rotation_by(any_direction(samples) * 1e-5);
  moved.pose.rotation = rotation_near(normalised(rotation_vector * normalised(host(body.pose.rotation))));
  return moved;
}

void expect_stable(Form form_a, Form form_b, uint64_t seed) {
  Samples samples = {seed};
  const uint32_t count = detent_oracle::rounds(1000);
  uint32_t changed = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const OraclePair pair = resting_pair(samples, form_a, form_b);
    const double distance_max = extent_of(pair) / 64;
    const ContactGeometry before = contact_of(pair.a, pair.b, distance_max);
    const ContactGeometry after = contact_of(pair.a, trembled(pair.b, samples), distance_max);
    ASSERT_GT(before.count, 0u);
    if (!same_features(before, after)) ++changed;
  }
  ::testing::Test::RecordProperty("changed", ::testing::PrintToString(changed));
  EXPECT_LE(changed, count / 100);
}

DETENT_TEST(stability, a_box_at_rest_on_a_plane_keeps_its_features) { expect_stable(Form::half_space, Form::box, 21); }
DETENT_TEST(stability, a_capsule_at_rest_on_a_plane_keeps_its_features) {
  expect_stable(Form::half_space, Form::capsule, 22);
}
DETENT_TEST(stability, a_box_at_rest_on_a_box_keeps_its_features) { expect_stable(Form::box, Form::box, 23); }
DETENT_TEST(stability, a_capsule_at_rest_on_a_box_keeps_its_features) { expect_stable(Form::box, Form::capsule, 24); }
DETENT_TEST(stability, a_sphere_at_rest_on_a_box_keeps_its_features) { expect_stable(Form::box, Form::sphere, 25); }

DETENT_TEST(stability, equal_boxes_stacked_flush_keep_their_features_whichever_way_they_tremble) {
  Samples samples = {26};
  OraclePair pair;
  pair.a.properties = pair.b.properties = box_properties({{0.5, 0.5, 0.5}});
  pair.a.pose.rotation = pair.b.pose.rotation = rotation_near({0, 0, 0, 1});
  pair.b.pose.position = position_near({{0, 0.999, 0}});
  const ContactGeometry before = contact_of(pair.a, pair.b, 1.0 / 64);
  EXPECT_EQ(before.count, 4u);
  for (uint32_t i = 0; i < detent_oracle::rounds(1000); ++i) {
    const ContactGeometry after = contact_of(trembled(pair.a, samples), trembled(pair.b, samples), 1.0 / 64);
    EXPECT_TRUE(same_features(before, after));
  }
}

DETENT_TEST(stability, the_deepest_point_of_two_boxes_is_kept_by_either_reduction) {
  Samples samples = {28};
  uint32_t reduced = 0;
  for (uint32_t i = 0; i < detent_oracle::rounds(3000); ++i) {
    OraclePair pair = resting_pair(samples, Form::box, Form::box);
    const Quaternion tilt = detent_oracle::rotation_by(any_direction(samples) * 0.02);
    pair.b.pose.rotation = rotation_near(normalised(tilt * normalised(host(pair.b.pose.rotation))));
    const Matrix3 rotation_a = matrix_from(pair.a.pose.rotation), rotation_b = matrix_from(pair.b.pose.rotation);
    double least[2] = {};
    uint32_t count[2] = {};
    for (const ManifoldReduction reduction : {ManifoldReduction::projected_extremes, ManifoldReduction::deepest_area}) {
      const int which = reduction == ManifoldReduction::deepest_area ? 1 : 0;
      ContactGeometry contact;
      collide({pair.a.pose, pair.a.properties, rotation_a}, {pair.b.pose, pair.b.properties, rotation_b},
              real_near(0.5), contact, {}, reduction);
      count[which] = contact.count;
      for (uint32_t k = 0; k < contact.count; ++k)
        least[which] = fmin(least[which], real_to_host(contact.point[k].separation));
    }
    EXPECT_NEAR(least[0], least[1], extent_of(pair) / 2048);
    EXPECT_EQ(count[0] >= 3, count[1] >= 3);
    reduced += count[0] == 4 ? 1u : 0u;
  }
  EXPECT_GT(reduced, 0u);
}

DETENT_TEST(stability, parallel_capsules_keep_their_features) {
  Samples samples = {27};
  OraclePair pair;
  pair.a.properties = pair.b.properties = capsule_properties(0.25, 0.5);
  pair.a.pose.rotation = pair.b.pose.rotation = rotation_near(any_rotation(samples));
  const Solid a = solid_of(pair.a, pair.a.pose.position);
  pair.b.pose.position = position_near(a.axis[0] * 0.499 + a.axis[1] * 0.3);
  const ContactGeometry before = contact_of(pair.a, pair.b, 1.0 / 64);
  EXPECT_EQ(before.count, 2u);
  for (uint32_t i = 0; i < detent_oracle::rounds(1000); ++i) {
    EXPECT_TRUE(same_features(before, contact_of(pair.a, trembled(pair.b, samples), 1.0 / 64)));
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
