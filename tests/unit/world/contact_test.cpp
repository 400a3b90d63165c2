#include <math.h>

#include "state/view.h"
#include "tests/unit/world/lab.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

DETENT_TEST(contact, a_resting_box_keeps_its_four_points_and_its_age_counts) {
  Lab lab({2, 2, 0});
  lab.add_ground();
  lab.add_box(0.5, 0, 0.5, 0);
  lab.run(60);
  ContactState& contact = view_of(lab.world).contacts[0];
  const ContactState before = contact;
  EXPECT_EQ(before.point_count, 4u);
  EXPECT_EQ(before.age, 59u);
  lab.run(1);
  for (uint32_t i = 0; i < 4; ++i) {
    EXPECT_EQ(contact.feature[i], before.feature[i]);
    const double substeps = view_of(lab.world).activities[1].substeps;
    EXPECT_NEAR(real_to_host(contact.normal_impulse[i]), 9.81 / 60 / substeps / 4, 1e-4);  // of a substep and a corner
  }
}

DETENT_TEST(contact, a_box_slides_with_less_friction_and_stays_with_more) {
  for (const double friction : {0.2, 0.8}) {
    Lab lab({2, 2, 0});
    lab.add_ground(friction);
    BodyDef def;
    def.position = position(0, 0.5, 0);
    def.shape = box(reals(0.5, 0.5, 0.5));
    def.material.friction = real(friction);
    def.linear_velocity = reals(2, 0, 0);
    const BodyId id = lab.add(def);
    lab.run(120);
    EXPECT_NEAR(lab.motion(id).position[0], 4 / (2 * friction * 9.81), 0.02);
    EXPECT_NEAR(lab.motion(id).linear_velocity[0], 0, 1e-4);
  }
}

DETENT_TEST(contact, a_hit_rebounds_by_the_larger_restitution) {
  Lab lab({2, 2, 0});
  lab.add_ground();
  BodyDef def;
  def.shape = sphere(real(0.5));
  def.position = position(0, 0.52, 0);
  def.linear_velocity = reals(0, -4, 0);
  def.material.restitution = real(0.5);
  const BodyId id = lab.add(def);
  lab.run(1);
  EXPECT_NEAR(lab.motion(id).linear_velocity[1], sqrt(16 + 2 * 9.81 * 0.02) / 2,
              1e-3);  // it falls through the gap first
}

/// The four corners share the impact: it does not rotate the box, and adds no energy.
DETENT_TEST(contact, a_box_that_falls_flat_rebounds_flat) {
  for (const double half : {3.0, 0.375}) {
    Lab lab({2, 4, 0});
    BodyDef post;
    post.type = BodyType::fixed;
    post.shape = box(reals(half, 0.25, half));
    post.position = position(0, -0.25, 0);
    lab.add(post);
    BodyDef def;
    def.shape = box(reals(0.5, 0.5, 0.5));
    def.position = position(0, 10, 0);
    def.material.restitution = real(1);
    const BodyId id = lab.add(def);
    double speed = -1, height = 0;
    for (int tick = 0; tick < 120 && speed < 0; ++tick) {
      lab.run(1);
      speed = lab.motion(id).linear_velocity[1];
      height = lab.motion(id).position[1];
    }
    EXPECT_GT(speed, 0) << half;
    EXPECT_NEAR(speed * speed / 2 + 9.81 * height, 98.1, 1) << half;
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(lab.motion(id).angular_velocity[k], 0, 1e-3) << half;
  }
}

DETENT_TEST(contact, the_same_calls_give_the_same_bits_and_another_order_of_creation_stands_as_well) {
  const auto run = [](bool reversed) {
    Lab lab({12, 40, 0});
    lab.add_ground();
    for (int i = 0; i < 10; ++i) {
      const int k = reversed ? 9 - i : i;
      lab.add_box(0.5, k % 2 * 0.125, 0.5 + k, 0);
    }
    const StepReport report = lab.run(240);
    EXPECT_TRUE(report.complete());
    EXPECT_EQ(report.contacts.count, 10u);
    return digest(lab.world);
  };
  EXPECT_EQ(run(false), run(false));
  run(true);
}

DETENT_TEST(contact, nothing_escapes_a_closed_box_of_mixed_shapes) {
  Lab lab({70, 600, 0});
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      BodyDef wall;
      wall.type = BodyType::fixed;
      double half[3] = {4, 4, 4}, at[3] = {0, 0, 0};
      half[axis] = 0.5;
      at[axis] = side * 3.5;
      wall.shape = box(reals(half[0], half[1], half[2]));
      wall.position = position(at[0], at[1], at[2]);
      lab.add(wall);
    }
  }
  std::vector<BodyId> ids;
  for (int i = 0; i < 60; ++i) {
    BodyDef def;
    if (i % 3 == 0)
      def.shape = box(reals(0.3, 0.2, 0.25));
    else if (i % 3 == 1)
      def.shape = sphere(real(0.25));
    else
      def.shape = capsule(real(0.15), real(0.2));
    def.position = position(i % 5 - 2, i / 25 - 1, i / 5 % 5 - 2);
    def.linear_velocity = reals(i % 7 - 3, i % 5 - 2, i % 3 - 1);
    def.angular_velocity = reals(i % 4, -i % 3, 1);
    ids.push_back(lab.add(def));
  }
  for (int tick = 0; tick < 300; ++tick) EXPECT_TRUE(lab.run(1).complete());
  for (const BodyId id : ids) {
    for (const double p : lab.motion(id).position) EXPECT_LT(fabs(p), 3.0);
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
