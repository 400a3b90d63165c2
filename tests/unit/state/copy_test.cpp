#include <detent/rollback.h>

#include "tests/common/oracle/effort.h"
#include "tests/unit/world/turmoil.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr Capacity k_roomy = {20, 60, 4, true, 10, 9};

DETENT_TEST(copy, a_world_copied_into_a_larger_one_and_back_has_the_same_digest_and_future) {
  for (uint64_t seed = 1; seed <= detent_oracle::rounds(40); ++seed) {
    OwnedWorld small = make_turmoiled(seed, 30);
    OwnedWorld large = make_turmoiled(seed + 1, 40, k_roomy);  // with another state, which must go
    ASSERT_OK(copy_world(small.world, large.world));
    ASSERT_EQ(digest(large.world), digest(small.world)) << seed;
    OwnedWorld again = make_turmoiled(seed + 2, 20);
    ASSERT_OK(copy_world(large.world, again.world));
    ASSERT_EQ(save_all(again.world), save_all(small.world)) << seed;
    for (uint32_t tick = 0; tick < 5; ++tick) {
      const StepReport report = step(small.world);
      step(again.world);
      ASSERT_EQ(digest(again.world), digest(small.world)) << seed;
      step(large.world);
      if (!report.complete()) break;  // the large one has room where the small one has not
      ASSERT_EQ(digest(large.world), digest(small.world)) << seed;
    }
  }
}

DETENT_TEST(copy, what_does_not_fit_is_refused_and_changes_nothing) {
  OwnedWorld from(OwnedWorld::def_of({6, 20, 3, true, 2, 4}));
  ASSERT_OK(bind_asset(from.world, 1));
  BodyId ids[4];
  for (uint32_t i = 0; i < 4; ++i) {
    BodyDef def;
    def.shape = i == 0 ? half_space() : i == 3 ? sphere(1.0) : box({0.5, 0.5, 0.5});
    def.type = i == 0 ? BodyType::fixed : BodyType::dynamic;
    def.position = {0.0, i == 2 ? Coord(1.45) : Coord(0.45), 0.0};
    def.sensor = i == 3;
    ASSERT_OK(create_body(from.world, def, ids[i]));
  }
  JointDef joint;
  joint.type = JointType::ball;
  joint.a = ids[1];
  joint.b = ids[2];
  JointId joint_id;
  ASSERT_OK(create_joint(from.world, joint, joint_id));
  step(from.world);
  const WorldInfo info = get_info(from.world);
  ASSERT_EQ(info.contacts, 1u);  // what a joint holds does not collide
  ASSERT_EQ(info.sensed, 3u);
  const Capacity least = {4, 1, 2, true, 1, 3};
  const auto copied = [&](Capacity capacity) {
    OwnedWorld to(OwnedWorld::def_of(capacity));
    step(to.world);
    const uint64_t before = digest(to.world);
    const Status status = copy_world(from.world, to.world);
    EXPECT_EQ(digest(to.world), status == Status::ok ? digest(from.world) : before);
    return status;
  };
  EXPECT_OK(copied(least));
  EXPECT_OK(copy_world(from.world, from.world));
  for (uint32_t i = 0; i < 6; ++i) {
    Capacity less = least;
    if (i == 0) less.bodies = 3;
    if (i == 1) less.contacts = 0;
    if (i == 2) less.assets = 1;
    if (i == 3) less.manifolds = false;
    if (i == 4) less.joints = 0;
    if (i == 5) less.sensed = 2;
    EXPECT_EQ(copied(less), Status::pool_full) << i;
  }
}

DETENT_TEST(copy, a_world_without_what_the_state_needs_is_refused) {
  static constexpr FeatureTable k_few = feature_table<Features::sphere | Features::half_space>;
  OwnedWorld from(OwnedWorld::def_of({4, 4, 2, true, 0, 0}));
  ASSERT_OK(bind_asset(from.world, 0));
  const auto refused = [&](World& to, Status expected) {
    const uint64_t before = digest(to);
    EXPECT_EQ(copy_world(from.world, to), expected);
    EXPECT_EQ(digest(to), before);
  };
  WorldDef def = OwnedWorld::def_of({4, 4, 2, true, 0, 0});
  OwnedWorld other_assets(def, {scene_assets().assets + 1, 2});
  refused(other_assets.world, Status::asset_mismatch);
  OwnedWorld no_assets(def, {});
  refused(no_assets.world, Status::asset_missing);
  def.continuous = def.sleeping = false;
  std::vector<uint64_t> block(world_bytes(def.capacity) / 8);
  World few;
  ASSERT_OK(create_world(bytes_of(block), byte_count(block), def, {.assets = scene_assets()}, k_few, few));
  refused(few, Status::feature_missing);

  OwnedWorld ruled(OwnedWorld::def_of({4, 4, 2, true, 0, 0}));
  const FilterRule rule = [](const FilterBody&, const FilterBody&) { return true; };
  from.world.hooks.filter_rules = {&rule, 1};
  BodyDef body;
  body.filter.rule = 1;
  BodyId id;
  ASSERT_OK(create_body(from.world, body, id));
  refused(ruled.world, Status::rule_missing);
  ruled.world.hooks.filter_rules = {&rule, 1};
  EXPECT_OK(copy_world(from.world, ruled.world));
}

DETENT_TEST(copy, the_checksum_is_the_digest_folded) {
  const OwnedWorld owned = make_turmoiled(7, 12);
  const uint64_t whole = digest(owned.world);
  EXPECT_EQ(checksum32(owned.world), static_cast<uint32_t>(whole ^ (whole >> 32)));
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
