#include <detent/draw.h>
#include <math.h>

#include "tests/unit/world/lab.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

struct Drawing {
  uint32_t solids[8] = {}, lines[8] = {}, points[8] = {};
  uint32_t last_slot = 0;
  bool in_order = true;
  double lowest = 0, highest = 0;  ///< y of bounds

  static Drawing& of(void* user) { return *static_cast<Drawing*>(user); }
  static void solid(void* user, BodyId id, const Shape&, const Pose&, DrawKind kind) {
    Drawing& drawing = of(user);
    ++drawing.solids[static_cast<uint32_t>(kind)];
    drawing.in_order = drawing.in_order && id.slot > drawing.last_slot;
    drawing.last_slot = id.slot;
  }
  static void line(void* user, const Position& from, const Position& to, DrawKind kind) {
    Drawing& drawing = of(user);
    ++drawing.lines[static_cast<uint32_t>(kind)];
    if (kind != DrawKind::bounds) return;
    drawing.lowest = fmin(drawing.lowest, coord_to_host(from.y));
    drawing.highest = fmax(drawing.highest, coord_to_host(to.y));
  }
  static void point(void* user, const Position&, DrawKind kind) { ++of(user).points[static_cast<uint32_t>(kind)]; }
  DebugDraw callbacks() { return {this, solid, line, point}; }
  uint32_t count(const uint32_t (&kinds)[8], DrawKind kind) const { return kinds[static_cast<uint32_t>(kind)]; }
};

Lab make_scene() {
  Lab lab({6, 12, 0}, {}, true);
  lab.add_ground();
  lab.add_box(0.5, 0, 0.5, 0);
  lab.add_box(0.5, 0, 1.5, 0);
  lab.run(200);
  BodyDef def;
  def.position = position(9, 20, 0);
  def.linear_velocity = reals(1, 0, 0);
  lab.add(def);
  def.type = BodyType::kinematic;
  def.position = position(-9, 20, 0);
  lab.add(def);
  return lab;
}

DETENT_TEST(debug_draw, all_of_a_world_is_shown_and_nothing_changes) {
  Lab lab = make_scene();
  const uint64_t before = digest(lab.world);
  Drawing drawing;
  draw(lab.world, drawing.callbacks());
  EXPECT_EQ(digest(lab.world), before);
  EXPECT_TRUE(drawing.in_order);
  EXPECT_EQ(drawing.count(drawing.solids, DrawKind::fixed), 1u);
  EXPECT_EQ(drawing.count(drawing.solids, DrawKind::asleep), 2u);
  EXPECT_EQ(drawing.count(drawing.solids, DrawKind::awake), 1u);
  EXPECT_EQ(drawing.count(drawing.solids, DrawKind::kinematic), 1u);
  EXPECT_EQ(drawing.count(drawing.lines, DrawKind::bounds), 4u * 12);
  EXPECT_EQ(drawing.count(drawing.lines, DrawKind::linear_velocity), 2u);
  EXPECT_EQ(drawing.count(drawing.points, DrawKind::contact), 8u);
  EXPECT_EQ(drawing.count(drawing.lines, DrawKind::normal), 8u);
  EXPECT_NEAR(drawing.lowest, 0, 0.02);
  EXPECT_NEAR(drawing.highest, 20.5, 0.02);
}

DETENT_TEST(debug_draw, flags_and_null_functions_leave_out) {
  Lab lab = make_scene();
  Drawing drawing;
  draw(lab.world, drawing.callbacks(), DrawFlags::bounds | DrawFlags::contacts);
  EXPECT_EQ(drawing.last_slot, 0u);
  EXPECT_EQ(drawing.count(drawing.lines, DrawKind::linear_velocity), 0u);
  EXPECT_EQ(drawing.count(drawing.points, DrawKind::contact), 8u);
  draw(lab.world, {});
  Drawing points;
  draw(lab.world, {&points, nullptr, nullptr, Drawing::point});
  EXPECT_EQ(points.count(points.points, DrawKind::contact), 8u);
  Drawing lines;
  draw(lab.world, {&lines, nullptr, Drawing::line, nullptr});
  EXPECT_EQ(lines.count(lines.lines, DrawKind::normal), 8u);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
