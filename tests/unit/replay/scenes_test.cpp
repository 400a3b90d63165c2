#include "tests/unit/replay/match.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

DETENT_TEST(scenes, a_scene_is_found_by_its_name_alone) {
  uint32_t count = 0;
  const Scene* all = scenes(count);
  ASSERT_GT(count, 0u);
  for (uint32_t i = 0; i < count; ++i) EXPECT_EQ(find_scene(all[i].name), &all[i]) << all[i].name;
  EXPECT_EQ(find_scene(""), nullptr);
  EXPECT_EQ(find_scene("tin"), nullptr);
  EXPECT_EQ(find_scene("tiny1"), nullptr);
}

DETENT_TEST(scenes, a_scene_fits_its_capacity_and_loses_nothing) {
  uint32_t count = 0;
  const Scene* all = scenes(count);
  for (uint32_t i = 0; i < count; ++i) {
    const Scene& scene = all[i];
    Recording recording(scene.world(), false);
    scene.build(recording.recorder);
    const uint32_t ticks = scene.ticks < 300 ? scene.ticks : 300;
    for (uint32_t tick = 0; tick < ticks; ++tick) {
      if (scene.before_tick != nullptr) scene.before_tick(recording.recorder, tick);
      const StepReport report = recording.recorder.step();
      ASSERT_TRUE(report.complete()) << scene.name << ", tick " << report.tick << ": " << report.lost.pairs
                                     << " pairs, " << report.lost.contacts << " contacts, " << report.saturations
                                     << " saturations";
    }
  }
}

DETENT_TEST(scenes, the_bodies_come_in_slot_order_and_then_null) {
  Recording recording(OwnedWorld::def_of({3, 0, 0}), false);
  BodyId ids[3];
  for (BodyId& id : ids) EXPECT_EQ(recording.recorder.create_body({}, id), Status::ok);
  EXPECT_EQ(recording.recorder.destroy_body(ids[1]), Status::ok);
  EXPECT_TRUE(nth_body(recording.owned.world, 0) == ids[0]);
  EXPECT_TRUE(nth_body(recording.owned.world, 1) == ids[2]);
  EXPECT_TRUE(nth_body(recording.owned.world, 2) == BodyId{});
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
