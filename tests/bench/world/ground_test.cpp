#include "tests/common/support/ground.h"

#include <gtest/gtest.h>

#include "tests/campaigns/stress/scenes.h"

namespace detent_bench {

namespace {

using detent_stress::has_ground;
using detent_stress::on_ground;
using detent_stress::Solid;
using detent_stress::Stage;
using detent_stress::StageBody;
using detent_test::Ground;
using detent_test::grounds_of;

TEST(ground, becomes_a_half_space_at_its_top) {
  Stage stage = detent_stress::tower(2, 0);
  stage.bodies[0].position[1] = 4;  // its top is at 5
  stage.bodies[0].friction = 0.25;
  const Stage changed = on_ground(stage, Ground::half_space);
  EXPECT_EQ(changed.bodies[0].solid, Solid::half_space);
  EXPECT_EQ(changed.bodies[0].position[1], 5);
  EXPECT_EQ(changed.bodies[0].friction, 0.25);
  EXPECT_EQ(changed.bodies[1].solid, Solid::box);
  EXPECT_EQ(changed.bodies[1].size[0], 0.5);
}

TEST(ground, becomes_a_box_of_200_m_at_its_top) {
  const Stage stage = detent_stress::pit(64, 1);
  EXPECT_EQ(stage.bodies[0].size[0], 6);
  for (const Stage& from : {stage, on_ground(stage, Ground::half_space)}) {
    const StageBody& box = on_ground(from, Ground::box).bodies[0];
    EXPECT_EQ(box.solid, Solid::box);
    EXPECT_EQ(box.size[0], 100);
    EXPECT_EQ(box.size[2], 100);
    EXPECT_EQ(box.position[1] + box.size[1], 0);
  }
}

TEST(ground, that_is_wider_stays_as_wide) {
  Stage stage = detent_stress::tower(2, 0);
  stage.bodies[0].size[0] = 500;
  EXPECT_EQ(on_ground(stage, Ground::box).bodies[0].size[0], 500);
}

TEST(ground, is_level_wide_and_the_only_one) {
  EXPECT_TRUE(has_ground(detent_stress::pyramid(3)));
  EXPECT_FALSE(has_ground(detent_stress::chain(3, 1)));
  EXPECT_FALSE(has_ground(detent_stress::incline(0.5, 1)));  // a slope
  Stage two = detent_stress::pyramid(3);
  two.bodies.push_back(two.bodies[0]);
  EXPECT_FALSE(has_ground(two));
  Stage narrow = detent_stress::pyramid(3);
  narrow.bodies[0].size[2] = 2;
  EXPECT_FALSE(has_ground(narrow));
  EXPECT_EQ(on_ground(narrow, Ground::half_space).bodies[0].solid, Solid::box);
}

TEST(ground, names_stand_for_one_or_both) {
  EXPECT_EQ(grounds_of("both", true), (std::vector<Ground>{Ground::half_space, Ground::box}));
  EXPECT_EQ(grounds_of("box", true), std::vector<Ground>{Ground::box});
  EXPECT_EQ(grounds_of("half-space", true), std::vector<Ground>{Ground::half_space});
  EXPECT_EQ(grounds_of("both", false), std::vector<Ground>{Ground::own});
}

TEST(ground, of_the_growing_pit_is_as_wide_as_its_rows) {
  EXPECT_EQ(detent_stress::pit(64, 1).bodies[3].position[0], 5.5);
  EXPECT_EQ(detent_stress::pit(64, 1, 16).bodies[3].position[0], 10.5);
}

}  // namespace

}  // namespace detent_bench
