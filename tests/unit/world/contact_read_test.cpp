#include <detent/body.h>
#include <detent/contact.h>
#include <detent/world.h>
#include <math.h>

#include "tests/unit/world/lab.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

Contact read(const World& world, uint32_t index) {
  Contact contact;
  EXPECT_OK(get_contact(world, index, contact));
  return contact;
}

DETENT_TEST(contacts, those_of_a_resting_box_carry_its_weight_at_its_corners) {
  Lab lab({3, 4, 0});
  const BodyId ground = lab.add_ground();
  BodyDef def;
  def.shape = box(reals(0.5, 0.25, 0.75));
  def.position = position(100, 0.25, -50);
  def.mass = scaled(40);
  const BodyId id = lab.add(def);
  lab.run(60);
  const uint64_t before = digest(lab.world);
  ASSERT_EQ(get_info(lab.world).contacts, 1u);
  const Contact contact = read(lab.world, 0);
  EXPECT_TRUE(contact.a == ground);
  EXPECT_TRUE(contact.b == id);
  EXPECT_TRUE(contact.touching);
  EXPECT_GE(contact.age, 50u);
  EXPECT_NEAR(unit_to_host(contact.normal.y), 1, 1e-6);
  EXPECT_NEAR(scaled_to_host(contact.normal_force), 40 * 9.81, 0.5);
  EXPECT_NEAR(scaled_to_host(contact.normal_impulse), 40 * 9.81 / 60, 0.01);
  ASSERT_EQ(contact.point_count, 4u);
  double sum = 0;
  for (uint32_t i = 0; i < 4; ++i) {
    const ContactPoint& point = contact.point[i];
    EXPECT_NEAR(fabs(coord_to_host(point.position.x) - 100), 0.5, 1e-3);
    EXPECT_NEAR(fabs(coord_to_host(point.position.z) + 50), 0.75, 1e-3);
    EXPECT_NEAR(coord_to_host(point.position.y), 0, 5e-3);
    EXPECT_NEAR(real_to_host(point.separation), 0, 1e-2);
    EXPECT_NE(point.feature, 0u);
    sum += scaled_to_host(point.normal_impulse);
  }
  EXPECT_NEAR(sum, scaled_to_host(contact.normal_impulse), 1e-6);
  EXPECT_EQ(digest(lab.world), before);
}

DETENT_TEST(contacts, friction_holds_a_box_on_a_slope) {
  WorldDef slope;
  slope.gravity = reals(3, -9.81, 0);
  Lab lab({2, 4, 0}, slope);
  lab.add_ground();
  BodyDef def;
  def.shape = box(reals(0.5, 0.5, 0.5));
  def.position = position(0, 0.5, 0);
  def.mass = scaled(10);
  lab.add(def);
  lab.run(120);
  const Contact contact = read(lab.world, 0);
  EXPECT_NEAR(scaled_to_host(contact.friction_impulse.x), -10 * 3 / 60.0, 0.02);
  EXPECT_NEAR(scaled_to_host(contact.normal_force), 98.1, 0.5);
}

DETENT_TEST(contacts, of_a_stack_carry_what_lies_above_whatever_the_substeps_and_also_asleep) {
  for (const uint32_t substeps : {0u, 4u, 16u}) {
    WorldDef def;
    def.substeps = substeps;
    Lab lab({5, 8, 0}, def, true);
    lab.add_ground();
    BodyId id;
    for (int i = 0; i < 3; ++i) id = lab.add_box(0.5, 0, 0.5 + i, 0);
    lab.run(300);
    bool awake = true;
    ASSERT_OK(is_awake(lab.world, id, awake));
    EXPECT_FALSE(awake);
    ASSERT_EQ(get_info(lab.world).contacts, 3u);
    for (uint32_t i = 0; i < 3; ++i)
      EXPECT_NEAR(scaled_to_host(read(lab.world, i).normal_force) / 9810, 3 - i, 0.05) << substeps;
  }
}

DETENT_TEST(contacts, of_unequal_bodies_carry_the_weight_of_the_upper_one) {
  for (const bool heavy_below : {true, false}) {
    Lab lab({3, 4, 0});
    lab.add_ground();
    const double mass[] = {heavy_below ? 1000.0 : 50.0, heavy_below ? 50.0 : 1000.0};
    for (int i = 0; i < 2; ++i) {
      BodyDef def;
      def.shape = box(reals(0.5, 0.5, 0.5));
      def.position = position(0, 0.5 + i, 0);
      def.mass = scaled(mass[i]);
      lab.add(def);
    }
    lab.run(240);
    ASSERT_EQ(get_info(lab.world).contacts, 2u);
    EXPECT_NEAR(scaled_to_host(read(lab.world, 0).normal_force), 1050 * 9.81, 105);
    EXPECT_NEAR(scaled_to_host(read(lab.world, 1).normal_force) / (mass[1] * 9.81), 1, 0.01);
  }
}

DETENT_TEST(contacts, of_one_body_are_found_in_order) {
  Lab lab = make_pile();
  const uint32_t count = get_info(lab.world).contacts;
  ASSERT_GE(count, 4u);
  uint32_t sum = 0;
  for (BodyId id = next_body(lab.world, {}); !(id == BodyId{}); id = next_body(lab.world, id)) {
    uint32_t after = 0;
    for (uint32_t i = next_contact(lab.world, id, 0); i < count; i = next_contact(lab.world, id, i + 1)) {
      EXPECT_GE(i, after);
      after = i + 1;
      const Contact contact = read(lab.world, i);
      EXPECT_TRUE(contact.a == id || contact.b == id);
      EXPECT_LT(contact.a.slot, contact.b.slot);
      ++sum;
    }
  }
  EXPECT_EQ(sum, 2 * count);
  EXPECT_EQ(next_contact(lab.world, {}, 0), count);
  EXPECT_EQ(next_contact(lab.world, next_body(lab.world, {}), UINT32_MAX), count);
}

DETENT_TEST(contacts, of_bodies_that_are_far_apart_by_now_can_be_read) {
  const Shape shapes[] = {sphere(real(0.5)), box(reals(0.5, 0.5, 0.5)), cylinder(real(0.5), real(0.5)),
                          rounded(cone(real(0.5), real(0.5)), real(0.1))};
  for (const Shape& shape : shapes) {
    Lab lab({3, 6, 0});
    lab.add_ground();
    BodyDef def;
    def.shape = shape;
    BodyId id;
    for (int i = 0; i < 2; ++i) {
      def.position = position(0, 0.4 + 0.6 * i, 0);
      id = lab.add(def);
    }
    lab.run(2);
    ASSERT_LT(next_contact(lab.world, id, 0), get_info(lab.world).contacts);
    ASSERT_OK(set_pose(lab.world, id, position(-30000, 30000, 30000), {0.0, 0.0, 0.0, 1.0}));
    for (uint32_t i = next_contact(lab.world, id, 0); i < get_info(lab.world).contacts;
         i = next_contact(lab.world, id, i + 1))
      EXPECT_EQ(read(lab.world, i).point_count, 0u);
  }
}

DETENT_TEST(contacts, of_bodies_that_have_parted_since_have_no_points) {
  Lab lab({2, 4, 0});
  lab.add_ground();
  const BodyId id = lab.add_box(0.5, 0, 0.5, 0);
  lab.run(5);
  ASSERT_OK(set_pose(lab.world, id, position(0, 50, 0), {0.0, 0.0, 0.0, 1.0}));
  const Contact contact = read(lab.world, 0);
  EXPECT_EQ(contact.point_count, 0u);
  EXPECT_EQ(unit_to_host(contact.normal.y), 0);
  Contact untouched;
  untouched.age = 99;
  EXPECT_EQ(get_contact(lab.world, 1, untouched), Status::out_of_range);
  EXPECT_EQ(untouched.age, 99u);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
