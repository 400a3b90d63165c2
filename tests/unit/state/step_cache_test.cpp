#include "state/step_cache.h"

#include "broad_phase/broadphase.h"
#include "motion/activity.h"
#include "motion/predict.h"
#include "tests/common/oracle/bodies.h"
#include "tests/common/support/spoil.h"
#include "tests/unit/world/lab.h"

/// The cache of a world changes no bit of its state, and saves the step the work on resting bodies.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

BodyDef any_body(Samples& samples) {
  BodyDef def;
  const double size = uniform(samples, 0.2, 0.5);
  const uint32_t kind = samples.below(4);
  if (kind == 0) def.shape = sphere(real_near(size));
  if (kind == 1) def.shape = capsule(real_near(size * 0.5), real_near(size));
  if (kind >= 2) def.shape = box(reals_near({{size, size * 0.75, size}}));
  def.position = position_near({{uniform(samples, -6, 6), uniform(samples, 0.5, 4), uniform(samples, -6, 6)}});
  def.type = samples.below(6) == 0 ? BodyType::fixed : samples.below(8) == 0 ? BodyType::kinematic : BodyType::dynamic;
  if (def.type != BodyType::fixed && samples.below(4) == 0)
    def.linear_velocity = reals_near(any_direction(samples) * uniform(samples, 1, 60));
  return def;
}

/// One call of a kind that can come between steps, the same for every world.
void change(Samples& samples, const std::vector<World*>& worlds, std::vector<BodyId>& ids) {
  const uint32_t what = samples.below(9);
  const size_t which = ids.empty() ? 0 : samples.below(static_cast<uint32_t>(ids.size()));
  const BodyDef def = any_body(samples);
  const Vector v = any_direction(samples) * 5;
  const double gravity = uniform(samples, -10, -5);
  if (what <= 2 || ids.size() < 5) {
    BodyId id;
    Status status = Status::ok;
    for (World* world : worlds) status = create_body(*world, def, id);
    if (status == Status::ok) ids.push_back(id);
    return;
  }
  const BodyId id = ids[which];
  for (World* world : worlds) {
    // Some calls return an error, the same in all worlds.
    Status status = Status::ok;
    if (what == 3) status = destroy_body(*world, id);
    if (what == 4) status = set_pose(*world, id, def.position, {0.0, 0.0, 0.0, 1.0});
    if (what == 5) status = sleep_body(*world, id);
    if (what == 6) status = wake_body(*world, id);
    if (what == 7) status = set_velocity(*world, id, reals_near(v), reals(0, 0, 0));
    if (what == 8) status = set_gravity(*world, reals_near({{0, gravity, 0}}));
    static_cast<void>(status);
  }
  if (what == 3) ids.erase(ids.begin() + static_cast<std::ptrdiff_t>(which));
}

/// The pairs that a step would find by testing all pairs, in the order of their keys.
std::vector<uint64_t> all_pairs(const StateView<uint8_t>& state) {
  const uint32_t used = state.world.slots_used;
  std::vector<Bounds> bounds(used);
  std::vector<BodyWork> work(used);
  std::vector<uint32_t> slots;
  for (uint32_t slot = 0; slot < used; ++slot) {
    if (state.properties[slot].type != 0) slots.push_back(slot);
  }
  bound(step_settings(state.world), state.poses, state.properties, state.motions,
        {slots.data(), static_cast<uint32_t>(slots.size())}, {work.data(), used}, {bounds.data(), used});
  const auto moves = [&](uint32_t slot) {
    return is_moving(state.properties[slot], state.motions[slot], state.activities[slot]);
  };
  std::vector<uint64_t> keys;
  for (const uint32_t a : slots) {
    for (const uint32_t b : slots) {
      if (a >= b || (!moves(a) && !moves(b)) || !overlap(bounds[a], bounds[b])) continue;
      if (is_dynamic(state.properties[a]) || is_dynamic(state.properties[b])) keys.push_back(pair_key(a, b));
    }
  }
  return keys;
}

/// The pairs that the next step finds first, before any body wakes.
std::vector<uint64_t> pairs_of_next_step(World world) {
  const Capacity capacity = get_info(world).capacity;
  std::vector<uint64_t> block(world_bytes(capacity) / 8);
  memcpy(block.data(), world.block, block.size() * 8);
  world.block = reinterpret_cast<uint8_t*>(block.data());
  const StateView<uint8_t> state = view_of(world);
  const StepCacheView cache = cache_of(world.block, state.layout, capacity);
  std::vector<BodyWork> work(capacity.bodies);
  std::vector<BodySweep> sweeps(capacity.bodies);
  std::vector<uint32_t> slots(capacity.bodies);
  std::vector<BoundsKey> keys(capacity.bodies), keys_spare(capacity.bodies);
  std::vector<uint64_t> pairs(20000), pairs_spare(20000);
  const Span<const uint32_t> moving =
      partition_bodies(cache, step_settings(state.world), state, {work.data(), capacity.bodies},
                       {sweeps.data(), capacity.bodies}, {slots.data(), capacity.bodies});
  PairPool pool = {state.poses, state.properties, cache.bounds, {pairs_spare.data(), 20000}, {pairs.data(), 20000}};
  add_moving_pairs(moving, cache.tree, {keys.data(), capacity.bodies}, {keys_spare.data(), capacity.bodies}, pool);
  pool.sort();
  return {pool.pairs().begin(), pool.pairs().end()};
}

DETENT_TEST(step_cache, alters_no_bit_and_no_pair_whatever_comes_and_goes) {
  const Capacity capacity = {60, 400, 0};
  uint64_t asleep = 0, pairs = 0;
  for (uint32_t round = 0; round < detent_oracle::rounds(3); ++round) {
    Samples samples = {70 + round};
    // One world keeps its cache, one loses it and all other work space before every step, and one is sometimes restored
    // into another block.
    Lab keeps(capacity, {}, true), forgets(capacity, {}, true), moved(capacity, {}, true), other(capacity, {}, true);
    std::vector<BodyId> ids;
    for (Lab* lab : {&keeps, &forgets, &moved}) lab->add_ground();
    for (int tick = 0; tick < 500; ++tick) {
      // Sometimes enough ticks without changes for islands to fall asleep.
      if (tick % 100 < 20) change(samples, {&keeps.world, &forgets.world, &moved.world}, ids);
      if (samples.below(40) == 0) {
        std::vector<uint64_t> snapshot = moved.snapshot();
        if (samples.below(2) == 0)
          ASSERT_OK(restore(other.world, bytes_of(snapshot), byte_count(snapshot)));
        else
          ASSERT_OK(load(other.world, bytes_of(snapshot), byte_count(snapshot)));
        std::swap(moved, other);
      }
      if (tick % 10 == 0) {
        const std::vector<uint64_t> right = all_pairs(view_of(keeps.world));
        EXPECT_EQ(pairs_of_next_step(keeps.world), right);
        EXPECT_EQ(pairs_of_next_step(moved.world), right);
        pairs += right.size();
      }
      spoil_work_space(forgets.world, static_cast<int>(samples.below(256)));
      forget_steps(forgets.world);
      const StepReport report = keeps.run(1);
      forgets.run(1);
      moved.run(1);
      asleep += report.bodies - report.awake;
      ASSERT_EQ(digest(keeps.world), digest(forgets.world)) << "tick " << tick;
      ASSERT_EQ(digest(keeps.world), digest(moved.world)) << "tick " << tick;
      ASSERT_EQ(report.lost.pairs, 0u);
    }
  }
  EXPECT_GT(asleep, 1500u * detent_oracle::rounds(3));
  EXPECT_GT(pairs, 150u * detent_oracle::rounds(3));
}

/// A floor with `side` by `side` sleeping stacks of two boxes, and a ball that rolls beside them.
struct Field {
  Lab lab;
  BodyId ball;

  explicit Field(uint32_t side) : lab({2 * side * side + 3, 3 * side * side + 8, 0}, {}, true) {
    BodyDef floor;
    floor.type = BodyType::fixed;
    floor.shape = box(reals(1000, 1, 1000));
    floor.position = position(0, -1, 0);
    lab.add(floor);
    for (uint32_t i = 0; i < side * side; ++i) {
      for (int level = 0; level < 2; ++level) lab.add_box(0.5, 3.0 * (i % side), 0.5 + level, 3.0 * (i / side));
    }
    while (lab.run(1).awake != 0) continue;
    BodyDef def;
    def.shape = sphere(real(0.25));
    def.position = position(0, 0.25, 1.5);
    def.linear_velocity = reals(2, 0, 0);
    ball = lab.add(def);
    lab.run(1);
  }
  /// Steps once. Returns the number of nodes and leaves at which a query of the tree with the ball's bounds looks.
  uint32_t visited() {
    const StepReport report = lab.run(1);
    EXPECT_EQ(report.awake, 1u);
    StateView<uint8_t> state = view_of(lab.world);
    const StepCacheView cache = cache_of(state);
    const Bounds& box = cache.bounds[ball.slot - 1];
    uint32_t count = 0;
    const auto meets = [&](const Bounds& bounds) {
      ++count;
      return overlap(bounds, box);
    };
    cache.tree.walk(
        meets, [](const Bounds&, const Bounds&) { return false; }, [](uint32_t) {});
    return count;
  }
};

DETENT_TEST(step_cache, a_step_with_one_body_awake_looks_at_few_of_those_that_sleep) {
  Field small(4), large(16);
  uint32_t most_small = 0, most_large = 0;
  for (int tick = 0; tick < 60; ++tick) {
    most_small = std::max(most_small, small.visited());
    most_large = std::max(most_large, large.visited());
  }
  EXPECT_GT(most_small, 0u);
  EXPECT_LE(most_large, 60u) << "of 512";
  EXPECT_LE(most_large, most_small + 40);
}

DETENT_TEST(step_cache, a_step_with_one_body_awake_reads_nothing_of_those_that_sleep_elsewhere) {
  Field field(8);
  // Overwrites state that no step may read: whole sleeping groups far from the ball.
  StateView<uint8_t> state = view_of(field.lab.world);
  const Capacity capacity = get_info(field.lab.world).capacity;
  Lab healthy(capacity, {}, true);
  std::vector<uint64_t> snapshot = field.lab.snapshot();
  ASSERT_OK(load(healthy.world, bytes_of(snapshot), byte_count(snapshot)));
  for (uint32_t slot = 65; slot < 129; ++slot) {
    memset(&state.properties[slot], 0x5a, sizeof(BodyProperties));
    memset(&state.poses[slot], 0x5a, sizeof(BodyPose));
    memset(&state.motions[slot], 0x5a, sizeof(BodyMotion));
  }
  for (int tick = 0; tick < 60; ++tick) {
    const StepReport with = field.lab.run(1), without = healthy.run(1);
    ASSERT_EQ(with.awake, 1u);
    ASSERT_EQ(with.contacts.count, without.contacts.count);
  }
  const uint32_t ball = field.ball.slot - 1;
  EXPECT_EQ(memcmp(&state.poses[ball], &view_of(healthy.world).poses[ball], sizeof(BodyPose)), 0);
  EXPECT_EQ(memcmp(&state.motions[ball], &view_of(healthy.world).motions[ball], sizeof(BodyMotion)), 0);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
