#include <detent/world.h>

#include "tests/unit/joint/joint_lab.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// The capacity that a heap of balls needs that falls into a pit of boxes, in a world of this capacity.
CapacityUse use_of_a_heap(Capacity capacity) {
  Lab lab(capacity);
  lab.add_ground();
  for (int i = 0; i < 27; ++i) add_shape(lab, sphere(Real(0.5)), 0.9 * (i % 3), 0.6 + 1.1 * (i / 9), 0.9 * (i / 3 % 3));
  CapacityUse use;
  for (int tick = 0; tick < 60; ++tick) note_use(lab.run(1), get_info(lab.world), use);
  return use;
}

DETENT_TEST(capacity_use, is_the_most_of_all_steps) {
  const CapacityUse use = use_of_a_heap({40, 400, 0});
  EXPECT_EQ(use.bodies, 28u);
  EXPECT_GT(use.contacts, 40u);
  EXPECT_GE(use.pairs, use.contacts);
  EXPECT_EQ(use.steps_full, 0u);
  EXPECT_EQ(use.impacts, 0u);
  EXPECT_EQ(use.joints, 0u);
  EXPECT_EQ(use.sensed, 0u);
}

DETENT_TEST(capacity_use, suggests_a_capacity_in_which_nothing_is_dropped) {
  const CapacityUse roomy = use_of_a_heap({40, 400, 0});
  const Capacity fit = suggest_capacity(roomy, {40, 400, 0});
  EXPECT_LT(fit.contacts, 400u);
  EXPECT_EQ(fit.bodies, 35u);
  const CapacityUse fitted = use_of_a_heap(fit);
  EXPECT_EQ(fitted.steps_full, 0u);
  EXPECT_EQ(fitted.contacts, roomy.contacts) << "the same motion";

  // From a capacity that is too small, a few rounds reach a sufficient one.
  Capacity capacity = {40, 8, 0};
  CapacityUse use = use_of_a_heap(capacity);
  EXPECT_GT(use.steps_full, 0u);
  for (int rotation_vector = 0; rotation_vector < 4 && use.steps_full != 0; ++rotation_vector) {
    capacity = suggest_capacity(use, capacity);
    use = use_of_a_heap(capacity);
  }
  EXPECT_EQ(use.steps_full, 0u);
}

DETENT_TEST(capacity_use, holds_numbers_to_their_range) {
  CapacityUse use;
  StepReport report;
  WorldInfo info;
  info.contacts = UINT32_MAX - 1;
  report.lost.contacts = 7;
  note_use(report, info, use);
  EXPECT_EQ(use.contacts, UINT32_MAX);
  EXPECT_EQ(suggest_capacity(use, {}).contacts, UINT32_MAX);
  EXPECT_EQ(world_bytes(suggest_capacity(use, {})), 0u) << "no world has it";
  EXPECT_EQ(suggest_capacity({}, {}).bodies, 1u);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
