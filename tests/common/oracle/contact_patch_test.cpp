#include "tests/common/oracle/contact_patch.h"

#include <gtest/gtest.h>

#include "tests/common/oracle/random_solids.h"

/// The oracle of contact patches against closed forms, and its polygons against the gaps, which are found another way.
namespace detent_oracle {
namespace {

using detent_queries::Kind;
using detent_queries::Solid;

constexpr Number k_pi = 3.141592653589793238462643383279502884L;
const Frame k_upright = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
const Arrow k_up = {0, 1, 0};

FacedSolid box_of(double x, double y, double z) {
  Solid solid;
  solid.kind = Kind::box;
  solid.half_extents = {x, y, z};
  return FacedSolid(solid_of(solid));
}
FacedSolid round_of(Kind kind, double radius, double half_length) {
  Solid solid;
  solid.kind = kind;
  solid.radius = radius;
  solid.half_length = half_length;
  return FacedSolid(solid_of(solid));
}

TEST(contact_patch, of_boxes_that_overhang_is_the_rectangle_where_they_overlap) {
  const FacedSolid a = box_of(2, 1, 1), b = box_of(1, 1, 3);
  const Placement placement = {k_upright, k_upright, {1.5L, 2 - 0.001L, 0}};
  const Patch patch = patch_of(a, b, placement, k_up, -0.001L + 1e-6L);
  EXPECT_NEAR(area_of(patch.outline), 1.5 * 2, 1e-12);
  for (const Spot& spot : patch.outline) {
    const Arrow at = patch.u * spot.u + patch.v * spot.v;
    EXPECT_TRUE(fabsl(at.x - 0.5L) < 1e-12L || fabsl(at.x - 2) < 1e-12L);
    EXPECT_NEAR(fabsl(at.z), 1, 1e-12);
  }
  EXPECT_TRUE(patch_of(a, b, placement, k_up, -0.0011L).outline.empty());
}

TEST(contact_patch, of_a_box_that_leans_is_a_strip_along_its_edge) {
  const Number lean = 1e-3L, tolerance = 1e-4L;
  const Frame leaning = {{{cosl(lean), sinl(lean), 0}, {-sinl(lean), cosl(lean), 0}, {0, 0, 1}}};
  const FacedSolid a = box_of(8, 1, 8), b = box_of(1, 1, 1);
  const Placement placement = {k_upright, leaning, {0, 1 + sinl(lean) + cosl(lean), 0}};  // the edge touches
  const Patch patch = patch_of(a, b, placement, k_up, tolerance);
  EXPECT_NEAR(area_of(patch.outline), 2 * tolerance * (1 / tanl(lean) + tanl(lean)), 1e-9);
}

TEST(contact_patch, of_what_is_round_is_a_disc_or_a_line_or_a_point) {
  const FacedSolid ground = box_of(8, 1, 8), cylinder = round_of(Kind::cylinder, 0.5, 2);
  const Patch disc = patch_of(ground, cylinder, {k_upright, k_upright, {0, 3, 0}}, k_up, 1e-6L);
  EXPECT_NEAR(area_of(disc.outline) / (k_pi * 0.25L), 1, 2e-3);
  const Frame lying = {{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}};
  const Patch line = patch_of(ground, cylinder, {k_upright, lying, {0, 1.5L, 0}}, k_up, 1e-6L);
  EXPECT_NEAR(area_of(line.outline), 4 * 2 * sqrtl(2 * 0.5L * 1e-6L), 1e-4);
  const FacedSolid capsule = round_of(Kind::capsule, 0.5, 2), sphere = round_of(Kind::sphere, 0.5, 0);
  const Patch rod = patch_of(ground, capsule, {k_upright, lying, {0, 1.5L, 0}}, k_up, 1e-5L);
  EXPECT_NEAR(reach_along(rod.outline, rod.spot({1, 0, 0})), 2, 1e-6);
  EXPECT_LT(area_of(rod.outline), 1e-5);
  const Patch ball = patch_of(ground, sphere, {k_upright, k_upright, {3, 1.5L, 0}}, k_up, 1e-5L);
  ASSERT_FALSE(ball.outline.empty());
  EXPECT_LT(distance_beyond(ball.outline, ball.spot({3, 0, 0})), 1e-6);
}

TEST(contact_patch, has_the_gap_of_balls_and_cones_in_closed_form) {
  Number gap = 0;
  const FacedSolid ball = round_of(Kind::sphere, 1, 0), cone = round_of(Kind::cone, 1, 1);
  ASSERT_TRUE(gap_over(ball, ball, {k_upright, k_upright, {0, 2.5L, 0}}, k_up, {0.5L, 7, 0}, gap));
  EXPECT_NEAR(gap, 2.5L - 2 * sqrtl(0.75L), 1e-15);
  // The cone's side falls by 2 over a radius of 1, from its apex at 1.5.
  const Placement placement = {k_upright, k_upright, {0, 4, 0}};
  ASSERT_TRUE(gap_over(cone, ball, placement, k_up, {0, 0, 0.25L}, gap));
  EXPECT_NEAR(gap, 4 - sqrtl(1 - 0.0625L) - 1, 1e-15);
  EXPECT_FALSE(gap_over(cone, ball, placement, k_up, {0, 0, 1.25L}, gap));
}

/// Just inside of a patch the line along the normal meets the solids no farther apart than the level; just outside
/// farther, or it misses one of them.
TEST(contact_patch, is_where_the_gap_is_no_more_than_the_level) {
  Dice dice(5);
  constexpr Kind k_kinds[] = {Kind::box, Kind::cylinder, Kind::cone, Kind::hull};
  int corners = 0;
  for (int i = 0; i < 400; ++i) {
    Solid solids[2];
    for (Solid& solid : solids) {
      solid = random_solid(dice, k_kinds[dice.below(4)], 1);
      solid.rounding = 0;
    }
    const FacedSolid a(solid_of(solids[0])), b(solid_of(solids[1]));
    const Arrow normal = dice.arrow(1);
    Placement placement = {frame_of(dice.rotation()), frame_of(dice.rotation()), dice.arrow(0.1)};
    const Number apart = support_value(a.solid(), to_local(placement.a, normal)) +
                         support_value(b.solid(), to_local(placement.b, -normal));
    placement.offset = placement.offset + normal * apart;
    const Number level = dice.between(0, 0.5);
    const Patch patch = patch_of(a, b, placement, normal, level);
    if (area_of(patch.outline) < 1e-4L) continue;
    Spot middle = {0, 0};
    for (const Spot& spot : patch.outline) {
      middle.u += spot.u / static_cast<Number>(patch.outline.size());
      middle.v += spot.v / static_cast<Number>(patch.outline.size());
    }
    for (const Spot& spot : patch.outline) {
      const auto gap_at = [&](Number part, Number& gap) {
        const Spot at = {middle.u + (spot.u - middle.u) * part, middle.v + (spot.v - middle.v) * part};
        return gap_over(a, b, placement, normal, patch.u * at.u + patch.v * at.v, gap);
      };
      Number gap = 0;
      // Tangents lie up to 0.2 % of the radius outside of a round side.
      const bool sharp = a.solid().core == CoreKind::points && b.solid().core == CoreKind::points;
      const bool meets = gap_at(0.97L, gap);
      EXPECT_TRUE(meets || !sharp) << i;
      if (meets) {
        EXPECT_LE(gap, level + (sharp ? 0 : 1e-2L)) << i;
      }
      if (gap_at(1.001L, gap)) {
        EXPECT_GT(gap, level) << i;
      }
      ++corners;
    }
  }
  EXPECT_GT(corners, 1000);
}

}  // namespace
}  // namespace detent_oracle
