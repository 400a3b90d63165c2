#include "contact/segments.h"
#include "tests/unit/contact/pairs.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr double k_quarter = 1.57079632679489662;
constexpr double k_reach = 0.01;

OracleBody body(const BodyProperties& properties, const Vector& at, const Vector& rotation_vector = {{0, 0, 0}}) {
  OracleBody result = {{}, properties};
  result.pose.position = position_near(at);
  result.pose.rotation = rotation_near(detent_oracle::rotation_by(rotation_vector));
  return result;
}

/// In both orders of the bodies the normal is a unit vector, the points lie within the bounds, and the depth is at
/// least `depth_min`, m.
ContactGeometry expect_sound(const OracleBody& a, const OracleBody& b, double depth_min) {
  for (const bool swapped : {true, false}) {
    const ContactGeometry contact = swapped ? contact_of(b, a, k_reach) : contact_of(a, b, k_reach);
    EXPECT_GT(contact.count, 0u);
    EXPECT_NEAR(length(host(contact.normal)), 1, unit_steps(12));
    double deepest = HUGE_VAL;
    for (uint32_t i = 0; i < contact.count; ++i) {
      expect_arms_held(contact.point[i]);
      deepest = fmin(deepest, real_to_host(contact.point[i].separation));
    }
    EXPECT_LE(deepest, -depth_min);
    EXPECT_GE(deepest, -4);
    if (!swapped) return contact;
  }
  return {};
}

/// Every pair of shape types at the same centre, with the same or another rotation.
DETENT_TEST(degenerate, concentric_shapes_of_every_kind_have_a_normal) {
  const BodyProperties kinds[] = {
      sphere_properties(0.5),      sphere_properties(0.25),           capsule_properties(0.25, 0.5),
      capsule_properties(0.25, 0), box_properties({{0.5, 0.5, 0.5}}), box_properties({{0.25, 0.5, 0.75}})};
  for (const BodyProperties& a : kinds) {
    for (const BodyProperties& b : kinds) {
      for (const Vector& rotation_vector : {Vector{{0, 0, 0}}, Vector{{k_quarter, 0, 0}}, Vector{{0.3, -0.2, 0.7}}}) {
        expect_sound(body(a, {{1, 2, 3}}), body(b, {{1, 2, 3}}, rotation_vector), 0.25);
        expect_sound(body(a, {{1, 2, 3}}, rotation_vector), body(b, {{1, 2, 3}}, rotation_vector), 0.25);
      }
    }
  }
}

DETENT_TEST(degenerate, centres_one_step_apart_have_a_normal) {
  const double step = sizeof(Coord) == 4 ? 0x1p-16 : 0x1p-32;
  const BodyProperties kinds[] = {sphere_properties(0.5), capsule_properties(0.25, 0.5),
                                  box_properties({{0.5, 0.5, 0.5}})};
  for (const BodyProperties& a : kinds) {
    for (const BodyProperties& b : kinds) expect_sound(body(a, {{0, 0, 0}}), body(b, {{step, 0, -step}}), 0.25);
  }
}

DETENT_TEST(degenerate, parallel_capsules_touch_along_a_line) {
  const BodyProperties pill = capsule_properties(0.25, 0.5);
  for (const double along : {0.0, 0.5, 0.999, -0.25}) {
    const ContactGeometry contact = expect_sound(body(pill, {{0, 0, 0}}), body(pill, {{0.4, along, 0}}), 0.09);
    EXPECT_EQ(contact.count, 2u) << along;
    EXPECT_NEAR(host(contact.normal)[0], 1, unit_steps(12)) << along;
  }
  const ContactGeometry opposite =
      expect_sound(body(pill, {{0, 0, 0}}), body(pill, {{0, 0, -0.4}}, {{2 * k_quarter, 0, 0}}), 0.09);
  EXPECT_EQ(opposite.count, 2u);
  const ContactGeometry ends = expect_sound(body(pill, {{0, 0, 0}}), body(pill, {{0, 1.4, 0}}), 0.09);
  EXPECT_EQ(ends.count, 1u);
  EXPECT_NEAR(host(ends.normal)[1], 1, unit_steps(12));
}

DETENT_TEST(degenerate, capsules_in_line_whose_cores_overlap_have_a_normal) {
  const BodyProperties pill = capsule_properties(0.25, 0.5);
  expect_sound(body(pill, {{0, 0, 0}}), body(pill, {{0, 0.5, 0}}), 0.25);
  expect_sound(body(pill, {{0, 0, 0}}), body(pill, {{0, 1.0, 0}}), 0.25);
}

DETENT_TEST(degenerate, crossed_capsules_that_meet_at_their_cores_part_across_both) {
  const BodyProperties pill = capsule_properties(0.25, 0.5);
  const ContactGeometry contact =
      expect_sound(body(pill, {{0, 0, 0}}), body(pill, {{0, 0.1, 0}}, {{k_quarter, 0, 0}}), 0.49);
  EXPECT_NEAR(fabs(host(contact.normal)[0]), 1, unit_steps(64));
}

DETENT_TEST(degenerate, a_capsule_without_length_is_a_sphere) {
  Samples samples = {31};
  for (uint32_t i = 0; i < detent_oracle::rounds(500); ++i) {
    const Vector at = any_direction(samples) * uniform(samples, 0.6, 0.8);
    const OracleBody ball = body(sphere_properties(0.25), at), pill = body(capsule_properties(0.25, 0), at);
    const OracleBody others[] = {body(box_properties({{0.5, 0.5, 0.5}}), {{0, 0, 0}}),
                                 body(sphere_properties(0.5), {{0, 0, 0}})};
    for (const OracleBody& other : others) {
      const ContactGeometry a = contact_of(other, ball, 0.1), b = contact_of(other, pill, 0.1);
      ASSERT_EQ(a.count, b.count);
      for (uint32_t k = 0; k < a.count; ++k) EXPECT_EQ(a.point[k].separation, b.point[k].separation);
      EXPECT_TRUE(a.count == 0 || a.normal == b.normal);
    }
  }
}

DETENT_TEST(degenerate, a_capsule_that_pierces_a_box_is_pushed_out_the_shorter_way) {
  const BodyProperties crate = box_properties({{1, 0.5, 1}}), pill = capsule_properties(0.125, 2);
  const ContactGeometry upright = expect_sound(body(crate, {{0, 0, 0}}), body(pill, {{0.75, 0, 0}}), 0.37);
  EXPECT_NEAR(host(upright.normal)[0], 1, unit_steps(12));
  const ContactGeometry flat =
      expect_sound(body(crate, {{0, 0, 0}}), body(pill, {{0, 0.25, 0}}, {{0, 0, k_quarter}}), 0.37);
  EXPECT_NEAR(host(flat.normal)[1], 1, unit_steps(12));
  expect_sound(body(crate, {{0, 0, 0}}), body(pill, {{0.1, 0.1, 0.1}}, {{0.4, 0.2, 0.7}}), 0.125);
}

DETENT_TEST(degenerate, flush_equal_boxes_touch_at_four_corners) {
  const BodyProperties cube = box_properties({{0.5, 0.5, 0.5}});
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      Vector at = {{0, 0, 0}};
      at[axis] = side;
      const ContactGeometry contact = expect_sound(body(cube, {{0, 0, 0}}), body(cube, at), -unit_steps(32));
      EXPECT_EQ(contact.count, 4u);
      EXPECT_NEAR(host(contact.normal)[axis], side, unit_steps(12));
      for (uint32_t i = 0; i < contact.count; ++i) {
        EXPECT_NEAR(real_to_host(contact.point[i].separation), 0, unit_steps(32));
        EXPECT_NEAR(length(host(contact.point[i].arm_a)), sqrt(0.75), unit_steps(64));
      }
    }
  }
}

DETENT_TEST(degenerate, crossed_edges_of_boxes_touch_at_one_point_across_both) {
  const BodyProperties cube = box_properties({{0.5, 0.5, 0.5}});
  // The upper edge of one points along z, the lower edge of the other along x. They cross above the common origin.
  const double height = 2 * sqrt(0.5) - 0.01;
  const ContactGeometry contact = expect_sound(body(cube, {{0, 0, 0}}, {{0, 0, k_quarter / 2}}),
                                               body(cube, {{0, height, 0}}, {{k_quarter / 2, 0, 0}}), 0.0099);
  EXPECT_EQ(contact.count, 1u);
  EXPECT_NEAR(host(contact.normal)[1], 1, unit_steps(64));
  EXPECT_NEAR(real_to_host(contact.point[0].separation), -0.01, unit_steps(64) + (sizeof(Coord) == 4 ? 0x1p-16 : 0));
}

/// Otherwise it would touch at one side in one tick and at the other side in the next.
DETENT_TEST(degenerate, a_capsule_that_leans_over_a_face_touches_at_both_of_its_sides) {
  const BodyProperties cube = box_properties({{0.5, 0.5, 0.5}}), rod = capsule_properties(0.1, 0.8);
  for (const double lean : {0.0, 1e-4, -1e-3, 0.004, -0.01}) {
    const ContactGeometry contact =
        expect_sound(body(cube, {{0, 0, 0}}), body(rod, {{0.05, 0.595, 0.1}}, {{0, 0, k_quarter + lean}}), 0.0049);
    ASSERT_EQ(contact.count, 2u) << lean;
    EXPECT_NEAR(host(contact.normal)[1], 1, unit_steps(12)) << lean;
    EXPECT_NE(contact.point[0].feature, contact.point[1].feature);
  }
  // Beyond 2^-3 rad the rod crosses only one side of the face.
  EXPECT_EQ(expect_sound(body(cube, {{0, 0, 0}}), body(rod, {{0.1, 0.66, 0.1}}, {{0, 0, k_quarter + 0.2}}), 0).count,
            1u);
}

DETENT_TEST(degenerate, a_corner_on_a_face_touches_at_one_point_along_the_faces_normal) {
  const BodyProperties cube = box_properties({{0.5, 0.5, 0.5}}), floor = box_properties({{3, 0.5, 3}});
  // The space diagonal of the cube is vertical.
  const Vector across = detent_oracle::normalised(detent_oracle::cross({{1, 1, 1}}, {{0, 1, 0}}));
  const ContactGeometry contact =
      expect_sound(body(floor, {{0, 0, 0}}),
                   body(cube, {{0.1, 0.5 + sqrt(0.75) - 0.01, 0.2}}, across * acos(sqrt(1.0 / 3))), 0.0099);
  EXPECT_NEAR(host(contact.normal)[1], 1, unit_steps(12));
  double deepest = HUGE_VAL;
  for (uint32_t i = 0; i < contact.count; ++i) deepest = fmin(deepest, real_to_host(contact.point[i].separation));
  EXPECT_NEAR(deepest, -0.01, unit_steps(128) + (sizeof(Coord) == 4 ? 0x1p-16 : 0));
}

DETENT_TEST(degenerate, bodies_far_apart_have_no_contact_and_bodies_deep_in_a_plane_have_one) {
  const double far = sizeof(Coord) == 4 ? 30000 : 1e7;
  const OracleBody ball = body(sphere_properties(0.5), {{-far, far, far}});
  EXPECT_EQ(contact_of(ball, body(box_properties({{0.5, 0.5, 0.5}}), {{far, -far, far}}), k_reach).count, 0u);
  const OracleBody plane = body(properties_of(half_space()), {{far, 0, 0}});
  EXPECT_EQ(contact_of(ball, plane, k_reach).count, 0u);
  const ContactGeometry deep = contact_of(plane, body(sphere_properties(0.5), {{0, -1000, 0}}), k_reach);
  EXPECT_EQ(deep.count, 1u);
  EXPECT_NEAR(real_to_host(deep.point[0].separation), -1000.5, 0.001);
  expect_arms_held(deep.point[0]);
}

DETENT_TEST(degenerate, parallel_segments_are_closest_at_the_middle_of_the_first_or_at_an_end) {
  const Vec3<Unit> along_x = {Unit(1.0), Unit(0.0), Unit(0.0)};
  const Segment first = {{Unit(0.0), Unit(0.0), Unit(0.0)}, along_x, Unit(0.25)};
  const auto closest_to = [&](Unit x, double on_first, double on_second) {
    const Segment second = {{x, Unit(0.5), Unit(0.0)}, along_x, Unit(0.125)};
    Unit a = 0.375, b = -0.375;  // to be overwritten
    closest_points(first, second, a, b);
    EXPECT_NEAR(unit_to_host(a), on_first, 1e-6);
    EXPECT_NEAR(unit_to_host(b), on_second, 1e-6);
  };
  closest_to(Unit(0.0625), 0, -0.0625);
  closest_to(Unit(-0.125), 0, 0.125);
  closest_to(Unit(0.25), 0.125, -0.125);
  closest_to(Unit(0.5), 0.25, -0.125);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
