#include <math.h>

#include "tests/common/queries/random.h"
#include "tests/unit/world/lab.h"

/// Bodies that slide, roll or fly past edges on which they could catch, and bodies that stand on several points.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

BodyDef slippery(const Shape& shape, double x, double y, double z) {
  BodyDef def;
  def.shape = shape;
  def.position = position(x, y, z);
  def.material.friction = real(0);
  return def;
}

/// Tiles of 1 m with their tops at y = 0, from x = -1 to 7 and z = -2 to 2.
void add_tiles(Lab& lab) {
  for (int i = 0; i < 8; ++i) {
    for (int k = 0; k < 4; ++k) {
      BodyDef tile = slippery(box(reals(0.5, 0.2, 0.5)), i - 0.5, -0.2, k - 1.5);
      tile.type = BodyType::fixed;
      lab.add(tile);
    }
  }
}

DETENT_TEST(seam, between_tiles_takes_no_speed_from_a_box_that_lies_askew) {
  detent_queries::Random random(5);
  int behind = 0;  // ticks in which the box stayed behind, as it met too many edges at once
  for (int round = 0; round < 100; ++round) {
    Lab lab({40, 64, 1});
    add_tiles(lab);
    const double rotation_vector = random.uniform(0, 1.6), length = random.uniform(0.1, 0.6),
                 height = random.uniform(0.05, 0.3), width = random.uniform(0.1, 0.6), speed = random.uniform(1, 12),
                 aside = random.uniform(-0.3, 0.3);
    BodyDef def = slippery(box(reals(length, height, width)), random.uniform(0, 1), height, random.uniform(-0.5, 0.5));
    def.rotation = {Unit(0.0), unit(sin(rotation_vector / 2)), Unit(0.0), unit(cos(rotation_vector / 2))};
    def.linear_velocity = reals(speed, 0, aside);
    const BodyId id = lab.add(def);
    while (lab.motion(id).position[0] < 5.5) {
      behind += lab.run(1).complete() ? 0 : 1;
      const Motion motion = lab.motion(id);
      ASSERT_NEAR(motion.linear_velocity[0], speed, 1e-3 * speed) << round;
      ASSERT_NEAR(motion.linear_velocity[1], 0, 1e-3 * speed) << round;
      ASSERT_NEAR(motion.linear_velocity[2], aside, 1e-3 * speed) << round;
      ASSERT_NEAR(motion.position[1], height, 1e-3) << round;
    }
  }
  EXPECT_EQ(behind, 0);
}

/// At the start of these contacts the best axis is the one of two edges.
DETENT_TEST(seam, whose_side_is_met_with_an_edge_first_takes_no_speed) {
  Lab lab({40, 64, 1});
  add_tiles(lab);
  BodyDef def = slippery(box(reals(0.3, 0.1, 0.15)), 0, 0.1, 0.1);
  def.rotation = {Unit(0.0), unit(sin(0.35)), Unit(0.0), unit(cos(0.35))};
  def.linear_velocity = reals(5, 0, 0.3);
  const BodyId id = lab.add(def);
  lab.run(60);
  EXPECT_NEAR(lab.motion(id).linear_velocity[0], 5, 1e-3);
}

/// Each body crosses many seams in a tick.
DETENT_TEST(seam, of_many_in_a_tick_keeps_nothing_behind) {
  Lab lab({170, 256, 1});
  for (int i = 0; i < 160; ++i) {
    BodyDef tile = slippery(box(reals(0.05, 0.2, 2)), 0.1 * i, -0.2, 0);
    tile.type = BodyType::fixed;
    lab.add(tile);
  }
  BodyDef def = slippery(box(reals(0.3, 0.1, 0.2)), 0.5, 0.1, 0.1);
  def.rotation = {Unit(0.0), unit(sin(0.2)), Unit(0.0), unit(cos(0.2))};
  def.linear_velocity = reals(60, 0, 0);
  const BodyId id = lab.add(def);
  for (int tick = 0; tick < 14; ++tick) {
    const StepReport report = lab.run(1);
    EXPECT_TRUE(report.complete()) << tick;
    EXPECT_LE(report.ccd.tests, 200u) << tick;
  }
  EXPECT_NEAR(lab.motion(id).linear_velocity[0], 60, 0.06);
}

DETENT_TEST(seam, between_tiles_takes_no_speed_from_what_is_round) {
  const struct {
    Shape shape;
    double height;
  } bodies[] = {{sphere(real(0.2)), 0.2}, {cylinder(real(0.3), real(0.1)), 0.1}, {cone(real(0.3), real(0.2)), 0.1}};
  for (const auto& body : bodies) {
    Lab lab({40, 64, 1});
    add_tiles(lab);
    BodyDef def = slippery(body.shape, 0, body.height, 0.1);
    def.linear_velocity = reals(5, 0, 0.3);
    const BodyId id = lab.add(def);
    for (int tick = 0; tick < 60; ++tick) {
      lab.run(1);
      EXPECT_NEAR(lab.motion(id).linear_velocity[0], 5, 5e-3) << body.height << " " << tick;
      EXPECT_NEAR(lab.motion(id).linear_velocity[1], 0, 5e-3) << body.height << " " << tick;
    }
  }
}

/// A step that is higher than the permitted penetration of a box stops the box.
DETENT_TEST(seam, is_not_where_a_tile_stands_out) {
  Lab lab({40, 64, 1});
  add_tiles(lab);
  BodyDef step = slippery(box(reals(0.5, 0.2, 2)), 3.5, -0.185, 0);
  step.type = BodyType::fixed;
  lab.add(step);
  BodyDef def = slippery(box(reals(0.3, 0.3, 0.3)), 0, 0.3, 0.1);
  def.linear_velocity = reals(5, 0, 0);
  const BodyId id = lab.add(def);
  lab.run(60);
  EXPECT_LT(lab.motion(id).linear_velocity[0], 3);
}

/// The distance of their surfaces is always at least half a millimetre.
DETENT_TEST(passing, balls_do_not_touch) {
  for (const double speed : {1.0, 5.0, 20.0}) {
    for (int start = 0; start < 7; ++start) {
      WorldDef still;
      still.gravity = reals(0, 0, 0);
      Lab lab({4, 8, 1}, still);
      const BodyId other = lab.add(slippery(sphere(real(0.3)), 0, 0, 0));
      BodyDef def = slippery(sphere(real(0.2)), -1 - speed / 60 * start / 7, 0.5005, 0);
      def.linear_velocity = reals(speed, 0, 0);
      const BodyId id = lab.add(def);
      for (int tick = 0; tick < 120 && lab.motion(id).position[0] < 1; ++tick) lab.run(1);
      EXPECT_NEAR(lab.motion(id).linear_velocity[0], speed, 1e-6) << speed << " " << start;
      EXPECT_NEAR(lab.motion(id).linear_velocity[1], 0, 1e-6) << speed << " " << start;
      EXPECT_EQ(lab.motion(other).linear_velocity[1], 0) << speed << " " << start;
    }
  }
}

/// A single pass over its four points would rotate it, and it would rock for a long time.
DETENT_TEST(standing, of_a_slender_pillar_is_still) {
  for (const double height : {0.5, 1.0, 2.0}) {
    Lab lab({4, 8, 1}, {}, true);
    BodyDef def;
    def.type = BodyType::fixed;
    def.shape = box(reals(5, 0.5, 5));
    def.position = position(0, -0.5, 0);
    lab.add(def);
    def.type = BodyType::dynamic;
    def.shape = box(reals(0.05, height, 0.05));
    def.position = position(0.1, height, 0.2);
    const BodyId id = lab.add(def);
    for (int tick = 0; tick < 120; ++tick) {
      lab.run(1);
      const Motion motion = lab.motion(id);
      EXPECT_LT(hypot(motion.angular_velocity[0], motion.angular_velocity[2]) * height, 0.012) << height << " " << tick;
    }
    bool awake = true;
    EXPECT_OK(is_awake(lab.world, id, awake));
    EXPECT_FALSE(awake) << height;
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
