#include <math.h>

#include "tests/unit/contact/pairs.h"

/// Bodies that slide over the seam between two bodies while they penetrate slightly: lib/contact/contact_seam.h.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

OracleBody placed(const BodyProperties& properties, const Vector& at, const Quaternion& turned = {0, 0, 0, 1}) {
  OracleBody body = {{}, properties};
  body.pose.position = position_near(at);
  body.pose.rotation = rotation_near(turned);
  return body;
}

constexpr double k_reach = 0.05, k_sunk = 7e-4, k_sag = 2e-4;

/// A floor with its edge at x = 0 and its top at y = 0, and another body whose lowest point is `sag` below the top and
/// whose foremost point has the given x.
struct Meeting {
  OracleBody floor, body;

  ContactGeometry contact(const ContactMargins& distance_max) const {
    const Matrix3 axes_floor = matrix_from(floor.pose.rotation), axes = matrix_from(body.pose.rotation);
    ContactGeometry contact;
    collide({floor.pose, floor.properties, axes_floor}, {body.pose, body.properties, axes}, distance_max, contact, {});
    return contact;
  }
  ContactGeometry smooth() const { return contact({real_near(k_reach), real_near(k_sunk)}); }
  ContactGeometry plain() const { return contact(real_near(k_reach)); }
};

Meeting meeting(const BodyProperties& floor, const BodyProperties& properties, double foremost, double lowest,
                double front, double bottom, double rotation_vector = 0) {
  const Quaternion turned = {0, sin(rotation_vector / 2), 0, cos(rotation_vector / 2)};
  return {placed(floor, {4, -0.5, 0}), placed(properties, {foremost - front, lowest + bottom, 0.1}, turned)};
}

BodyProperties floor_box() { return box_properties({{4, 0.5, 4}}); }

DETENT_TEST(seams, of_boxes_have_no_side_where_no_more_than_a_sliver_is_met) {
  // Without the seam rule, a body that penetrates by less than it extends over the edge collides with the side.
  for (const double over : {-0.04, -1e-3, 1e-4}) {
    const Meeting met = meeting(floor_box(), box_properties({{0.3, 0.3, 0.3}}), over, -k_sag, 0.3, 0.3);
    const ContactGeometry plain = met.plain(), smooth = met.smooth();
    ASSERT_GT(plain.count, 0u) << over;
    EXPECT_LT(host(plain.normal)[0], -0.99) << over;
    EXPECT_EQ(smooth.count, 0u) << over;
    EXPECT_TRUE(smooth.seam) << over;
  }
  const ContactGeometry carried =
      meeting(floor_box(), box_properties({{0.3, 0.3, 0.3}}), 0.05, -k_sag, 0.3, 0.3).smooth();
  ASSERT_GT(carried.count, 0u);
  EXPECT_GT(host(carried.normal)[1], 0.99);
  EXPECT_FALSE(carried.seam);
}

DETENT_TEST(seams, are_not_where_a_step_is_higher) {
  for (const double rotation_vector : {0.0, 0.3, 0.78}) {
    const double front = 0.3 * (fabs(cos(rotation_vector)) + fabs(sin(rotation_vector)));
    const ContactGeometry step =
        meeting(floor_box(), box_properties({{0.3, 0.3, 0.3}}), 1e-3, -0.015, front, 0.3, rotation_vector).smooth();
    ASSERT_GT(step.count, 0u) << rotation_vector;
    EXPECT_LT(host(step.normal)[0], -0.9) << rotation_vector;
    EXPECT_FALSE(step.seam) << rotation_vector;
  }
}

DETENT_TEST(seams, let_nothing_meet_a_side_that_lies_askew) {
  for (const double rotation_vector : {0.1, 0.3, 0.5, 0.78}) {
    const double front = 0.3 * (cos(rotation_vector) + sin(rotation_vector));
    for (const double over : {-0.01, 1e-4, 1e-3, 0.01, 0.05}) {
      const ContactGeometry contact =
          meeting(floor_box(), box_properties({{0.3, 0.3, 0.3}}), over, -k_sag, front, 0.3, rotation_vector).smooth();
      if (contact.count == 0) continue;
      EXPECT_GT(host(contact.normal)[1], 0.99) << rotation_vector << " " << over;
    }
  }
}

DETENT_TEST(seams, of_other_shapes_have_no_side_either) {
  struct Case {
    const char* name;
    BodyProperties properties;
    double front, bottom;
  };
  const Case cases[] = {
      {"rounded box", properties_of(rounded(box(reals_near({{0.3, 0.3, 0.3}})), real_near(0.001))), 0.301, 0.301},
      {"cylinder", properties_of(cylinder(real_near(0.3), real_near(0.2))), 0.3, 0.2},
      {"cone", properties_of(cone(real_near(0.3), real_near(0.2))), 0.3, 0.1},
  };
  for (const Case& of : cases) {
    for (const double over : {-0.02, 1e-4}) {
      const Meeting met = meeting(floor_box(), of.properties, over, -k_sag, of.front, of.bottom);
      const ContactGeometry smooth = met.smooth();
      EXPECT_GT(met.plain().count, 0u) << of.name << over;
      EXPECT_EQ(smooth.count, 0u) << of.name << over;
      EXPECT_TRUE(smooth.seam) << of.name << over;
    }
    const ContactGeometry step = meeting(floor_box(), of.properties, 1e-3, -0.03, of.front, of.bottom).smooth();
    ASSERT_GT(step.count, 0u) << of.name;
    EXPECT_LT(host(step.normal)[0], -0.9) << of.name;
  }
}

/// A ball that penetrates touches the edge before it is over the face.
DETENT_TEST(seams, that_are_level_carry_a_ball_as_the_face_does) {
  // The floor is a sharp or a rounded box, which use different collision functions.
  const BodyProperties floors[] = {floor_box(),
                                   properties_of(rounded(box(reals_near({{4, 0.5, 4}})), real_near(0.004)))};
  const BodyProperties shapes[] = {sphere_properties(0.3), properties_of(capsule(real_near(0.3), real_near(0.2)))};
  for (int i = 0; i < 4; ++i) {
    const BodyProperties &floor = floors[i / 2], &properties = shapes[i % 2];
    const double edge = i < 2 ? 0 : 0.004;  // about the core, whose own is at 0
    const double bottom = edge + (properties.shape == static_cast<uint8_t>(ShapeType::sphere) ? 0.3 : 0.5);
    const Meeting met = meeting(floor, properties, -5e-3, -k_sag, 0, bottom);
    const ContactGeometry plain = met.plain(), smooth = met.smooth();
    ASSERT_EQ(plain.count, 1u);
    EXPECT_LT(host(plain.normal)[0], -0.01);
    EXPECT_TRUE(plain.turns);
    ASSERT_EQ(smooth.count, 1u);
    EXPECT_NEAR(host(smooth.normal)[1], 1, 1e-6);
    EXPECT_NEAR(real_to_host(smooth.point[0].separation), -k_sag, 2e-5);
    EXPECT_NEAR(host(smooth.point[0].arm_b)[0], 0, 1e-4) << "beside the middle it would turn the ball";
    EXPECT_TRUE(smooth.seam);
    EXPECT_FALSE(smooth.turns);
    // Farther out, the ball rolls over the edge, as it should.
    const ContactGeometry off = meeting(floor, properties, -0.03, -1.5e-3, 0, bottom).smooth();
    ASSERT_EQ(off.count, 1u);
    EXPECT_LT(host(off.normal)[0], -0.05);
  }
}

/// Over a face the normal is constant; at an edge, and between two balls, it rotates.
DETENT_TEST(seams, aside_a_normal_turns_as_what_is_round_slides_past) {
  const OracleBody ball = placed(sphere_properties(0.3), {0, 0, 0});
  EXPECT_FALSE(meeting(floor_box(), sphere_properties(0.3), 1, 0, 0, 0.3).plain().turns);
  EXPECT_TRUE(meeting(floor_box(), sphere_properties(0.3), -0.1, -0.02, 0, 0.3).plain().turns);
  EXPECT_TRUE(contact_of(ball, placed(sphere_properties(0.2), {0.3, 0.4, 0}), 0.1).turns);
  // A rod that crosses an edge, or another rod, slides along it with a constant normal.
  const double h = sqrt(0.5);
  const Quaternion along_z = {h, 0, 0, h}, over_edge = {0, 0, -0.4226182617, 0.9063077870};
  const OracleBody floor = placed(floor_box(), {4, -0.5, 0});
  const Vector beside = {-0.0707, 0.0843, 0};
  EXPECT_FALSE(contact_of(floor, placed(capsule_properties(0.1, 2), beside, over_edge), 0.1).turns);
  EXPECT_TRUE(contact_of(floor, placed(capsule_properties(0.1, 2), beside, along_z), 0.1).turns);
  const OracleBody rod = placed(capsule_properties(0.1, 1), {0, 0, 0}, along_z);
  EXPECT_FALSE(contact_of(rod, placed(capsule_properties(0.1, 1), {0, 0.21, 0}, {0, 0, h, h}), 0.1).turns);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
