#include <functional>
#include <memory>

#include "state/step_scratch.h"
#include "state/view.h"
#include "tests/common/support/random.h"
#include "tests/common/support/scheduler.h"
#include "tests/unit/shape/terrains.h"
#include "tests/unit/world/lab.h"
#include "tests/unit/world/same_step.h"
#include "world/step_probe.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using Random = uint64_t;

/// In [-1, 1).
double signed_unit(Random& random) { return static_cast<double>(detent_test::split_mix(random) >> 11) * 0x1p-52 - 1; }

struct Arena : Lab {
  std::vector<ContactEvent> events = std::vector<ContactEvent>(2000);
  StepProbe probe;

  explicit Arena(Capacity capacity, WorldDef def = {}, bool sleeping = false) : Lab(capacity, def, sleeping) {
    world.hooks.contact_events = {events.data(), 2000};
  }
};

/// The same worlds, one of which processes its impacts in the global order, and the others in groups.
using Make = std::function<std::unique_ptr<Arena>()>;

WarpCount& operator+=(WarpCount& sum, const WarpCount& count) {
  sum.ticks += count.ticks;
  sum.speculations += count.speculations;
  sum.rollbacks += count.rollbacks;
  sum.rounds += count.rounds;
  sum.returns += count.returns;
  return sum;
}

/// Without the vector solver, what impacts share with the work space of the substeps leaves less memory than the scenes
/// of these tests need for groups.
bool has_memory_for_groups(const Make& make) {
  const std::unique_ptr<Arena> arena = make();
  const auto view = view_of(arena->world);
  const uint64_t bytes = 8 * uint64_t{impact_spare(arena->block(), view.layout, capacity_of(view.header)).count};
  const bool enough = bytes >= 1 << 19;
  EXPECT_TRUE(enough || arena->world.lanes == 1);
  return enough;
}

/// The hits of the last step, in their order. They stay in the work space of the block.
void expect_equal_hits(Arena& a, Arena& b, uint32_t count) {
  const Layout layout = view_of(a.world).layout;
  for (uint32_t i = 0; i < count; ++i) {
    const ImpactHit &hit_a = at_offset<ImpactHit>(a.block(), layout.impact_hits)[i],
                    &hit_b = at_offset<ImpactHit>(b.block(), layout.impact_hits)[i];
    ASSERT_TRUE(hit_a.key == hit_b.key && hit_a.time == hit_b.time && hit_a.approach == hit_b.approach) << "hit " << i;
  }
}

void expect_equal_ticks(const Make& make, uint32_t ticks, ImpactOrder order, const Tasks& tasks, WarpCount& count) {
  const std::unique_ptr<Arena> global = make(), grouped = make();
  global->probe.order = ImpactOrder::global;
  grouped->probe.order = order;
  grouped->world.hooks.tasks = tasks;
  for (uint32_t tick = 0; tick < ticks; ++tick) {
    const StepReport report = step_probed(grouped->world, grouped->probe);
    expect_equal(report, step_probed(global->world, global->probe));
    expect_equal(grouped->events, global->events, report.events.contact);
    const uint32_t contacts = get_info(global->world).capacity.contacts;
    expect_equal_hits(*grouped, *global, report.ccd.impacts < contacts ? report.ccd.impacts : contacts);
    ASSERT_EQ(digest(grouped->world), digest(global->world)) << "tick " << tick;
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_EQ(global->probe.warp.ticks, 0u);
  count += grouped->probe.warp;
}

/// In groups of both kinds, on one thread and under a scheduler. Returns the sums of the counts.
WarpCount expect_global_bits(const Make& make, uint32_t ticks, uint32_t seed = 0) {
  WarpCount count;
  expect_equal_ticks(make, ticks, ImpactOrder::optimistic, {}, count);
  expect_equal_ticks(make, ticks, ImpactOrder::conservative, {}, count);
  Scheduler scheduler = k_schedulers[seed % 11];
  expect_equal_ticks(make, ticks, ImpactOrder::automatic, scheduler.tasks(), count);
  return count;
}

Shape shape_of_kind(uint32_t kind) {
  switch (kind % 4) {
    case 0:
      return box(reals(0.2, 0.15, 0.25));
    case 1:
      return capsule(real(0.12), real(0.2));
    default:
      return sphere(real(0.2));
  }
}

/// Walls around a cube, and bodies on a grid in it with random velocities up to `speed`, m/s.
void fill_box(Arena& arena, uint32_t side, double spacing, double speed, Random random) {
  const double half = spacing * side / 2 + 0.5;
  for (int wall = 0; wall < 6; ++wall) {
    double size[3] = {half + 2, half + 2, half + 2}, at[3] = {0, 0, 0};
    size[wall / 2] = 1;
    at[wall / 2] = (wall % 2 == 0 ? 1 : -1) * (half + 1);
    BodyDef def;
    def.type = BodyType::fixed;
    def.shape = box(reals(size[0], size[1], size[2]));
    def.position = position(at[0], at[1], at[2]);
    arena.add(def);
  }
  const auto place = [&](uint32_t i) { return (i - side / 2.0 + 0.5) * spacing; };
  for (uint32_t i = 0; i < side * side * side; ++i) {
    BodyDef def;
    def.shape = shape_of_kind(i);
    def.position = position(place(i % side), place(i / side % side), place(i / side / side));
    def.linear_velocity = reals(speed * signed_unit(random), speed * signed_unit(random), speed * signed_unit(random));
    def.angular_velocity = reals(9 * signed_unit(random), 9 * signed_unit(random), 9 * signed_unit(random));
    def.material.restitution = real(i % 3 == 0 ? 0.2 : 0.9);
    arena.add(def);
  }
}

Make box_of_bodies(uint32_t side, double spacing, double speed, Random seed, uint32_t contacts = 2000) {
  return [=] {
    auto arena = std::make_unique<Arena>(Capacity{side * side * side + 6, contacts, 0, true}, weightless());
    fill_box(*arena, side, spacing, speed, seed);
    return arena;
  };
}

DETENT_TEST(time_warp, changes_no_bit_of_fast_bodies_in_a_box) {
  WarpCount count;
  for (uint32_t seed = 0; seed < 11; ++seed)
    count += expect_global_bits(box_of_bodies(5, 0.8 + 0.1 * (seed % 5), 20 + 10 * (seed % 9), seed), 4, seed);
  EXPECT_GT(count.ticks, 75u);
  if (!has_memory_for_groups(box_of_bodies(5, 0.8, 20, 0))) return;
  EXPECT_GT(count.speculations, 4 * count.ticks);
  EXPECT_GT(count.rollbacks, 50u);
  EXPECT_LT(count.returns, count.ticks / 2);
}

DETENT_TEST(time_warp, changes_no_bit_of_a_break) {
  const Make make = [] {
    auto arena = std::make_unique<Arena>(Capacity{80, 600, 0, true});
    arena->add_ground(0.2);
    const auto add_ball = [&](double x, double z, double speed) {
      BodyDef def;
      def.shape = sphere(real(0.03));
      def.position = position(x, 0.03, z);
      def.linear_velocity = reals(speed, 0, 0);
      def.material.restitution = real(0.95);
      arena->add(def);
    };
    for (int player = -1; player <= 1; player += 2) {  // two triangles, each with a player's ball
      add_ball(-0.2, player, 10);
      for (int row = 0; row < 7; ++row) {
        for (int i = 0; i <= row; ++i) add_ball(0.0524 * row, player + 0.0605 * (i - row / 2.0), 0);
      }
    }
    return arena;
  };
  const WarpCount count = expect_global_bits(make, 25, 5);
  EXPECT_GT(count.ticks, 3u);
}

DETENT_TEST(time_warp, changes_no_bit_of_rocks_that_fall_down_a_mountain) {
  const detent_terrains::Bytes bytes = detent_terrains::field_of(
      24, 1.0, [](double x, double z) { return -0.8 * x + 0.5 * ((static_cast<int>(x + z) & 1)); }, false);
  const Asset asset = {bytes.data(), bytes.count()};
  const Make make = [&] {
    auto arena = std::make_unique<Arena>(Capacity{70, 800, 1, true});
    arena->world.hooks.assets = {&asset, 1};
    EXPECT_OK(bind_asset(arena->world, 0));
    BodyDef ground;
    ground.type = BodyType::fixed;
    ground.shape = terrain(0);
    arena->add(ground);
    for (uint32_t i = 0; i < 60; ++i) {
      BodyDef def;
      def.shape = shape_of_kind(i);
      def.position = position(-8 + 0.7 * (i % 8), 11 + 0.7 * (i / 16), -4 + 0.9 * (i / 8));
      def.linear_velocity = reals(12, -14, i % 3 - 1.0);
      def.material.restitution = real(0.5);
      arena->add(def);
    }
    return arena;
  };
  const uint32_t groups = expect_global_bits(make, 40, 6).speculations;
  EXPECT_TRUE(groups > 30 || !has_memory_for_groups(make)) << groups;
}

/// A ball that rebounds without loss.
void add_ball(Arena& arena, double radius, const double (&at)[3], const Vec3<Real>& velocity, double density = 1000) {
  BodyDef def;
  def.shape = sphere(real(radius));
  def.position = position(at[0], at[1], at[2]);
  def.linear_velocity = velocity;
  def.material.restitution = real(1.0);
  def.material.friction = real(0.0);
  def.density = scaled(density);
  arena.add(def);
}

constexpr double k_thrown = 1200;  ///< m/s: 20 m in a tick

/// A ball from below sets another one, at `at`, in motion along x after 0.05 of the tick, and flies on upwards.
void throw_ball(Arena& arena, const double (&at)[3]) {
  add_ball(arena, 0.05, {at[0] - 1.1, at[1] - 1, at[2]}, reals(k_thrown, k_thrown, 0));
  add_ball(arena, 0.05, at, reals(0, 0, 0));
}

/// The way of a ball turns from x to z and back at fixed walls. Before each wall a gate closes it: a heavy ball that
/// another one knocks away before the first one comes.
struct Gates {
  Arena& arena;
  double row;  ///< z, m

  void add_wall(double x, double z) {
    BodyDef def;
    def.type = BodyType::fixed;
    def.shape = box(reals(0.4, 0.4, 0.05));
    def.position = position(x, 0, row + z);
    def.rotation = {unit(0.0), unit(-0.3826834323650898), unit(0.0), unit(0.9238795325112867)};  // by 45 degrees
    def.material.restitution = real(1.0);
    def.material.friction = real(0.0);
    arena.add(def);
  }
  void add(uint32_t count) {
    throw_ball(arena, {0, 0, row});
    double x = 0, z = 0;
    for (uint32_t i = 0; i < count; ++i) {
      const bool along_x = i % 2 == 0;
      const double beyond = along_x ? 0.0708 : -0.0708;  // the wall touches the ball at the corner
      const double gate_x = along_x ? x + 1 : x, gate_z = row + (along_x ? z : z + 1);
      add_ball(arena, 0.1, {gate_x, 0, gate_z}, reals(0, 0, 0), 1e6);
      add_ball(arena, 0.1, {gate_x, 1, gate_z}, reals(0, -k_thrown, 0), 1e6);
      (along_x ? x : z) += 2;
      add_wall(x + beyond, z - beyond);
    }
  }
};

Make rows_of_gates(uint32_t gates) {
  return [=] {
    auto arena = std::make_unique<Arena>(Capacity{200, 2000, 0, true}, weightless());
    for (uint32_t row = 0; row < 6; ++row) Gates{*arena, 80.0 * row}.add(gates);
    return arena;
  };
}

/// A group finds the next gate only after it was merged with the group of the one before.
DETENT_TEST(time_warp, of_a_cascade_merges_one_group_after_the_other) {
  for (const uint32_t gates : {1u, 2u, 3u}) {
    WarpCount count;
    expect_equal_ticks(rows_of_gates(gates), 1, ImpactOrder::optimistic, {}, count);
    expect_global_bits(rows_of_gates(gates), 3, 5 + gates);
    if (!has_memory_for_groups(rows_of_gates(gates))) continue;
    EXPECT_EQ(count.rounds, gates + 1);
    EXPECT_EQ(count.rollbacks, 6 * 2 * gates);
    EXPECT_EQ(count.speculations, 6 * (1 + gates) + 6 * gates);
    EXPECT_EQ(count.returns, 0u);
  }
}

DETENT_TEST(time_warp, of_a_long_cascade_returns_to_the_global_order) {
  WarpCount count;
  expect_equal_ticks(rows_of_gates(7), 1, ImpactOrder::optimistic, {}, count);
  expect_global_bits(rows_of_gates(7), 3, 8);
  if (!has_memory_for_groups(rows_of_gates(7))) return;
  EXPECT_EQ(count.rounds, 4u);
  EXPECT_EQ(count.returns, 1u);
}

DETENT_TEST(time_warp, runs_the_same_groups_for_any_number_of_threads) {
  WarpCount first;
  for (const uint32_t workers : {2u, 5u, 64u}) {
    Scheduler scheduler = {Calls::threads, Parts::shuffled, workers, workers == 5};
    WarpCount count;
    expect_equal_ticks(box_of_bodies(5, 0.9, 60, 3), 4, ImpactOrder::optimistic, scheduler.tasks(), count);
    if (workers == 2) first = count;
    EXPECT_TRUE(count.rollbacks > 0 || !has_memory_for_groups(box_of_bodies(5, 0.9, 60, 3)));
    EXPECT_EQ(count.speculations, first.speculations) << workers;
    EXPECT_EQ(count.rollbacks, first.rollbacks) << workers;
    EXPECT_EQ(count.rounds, first.rounds) << workers;
  }
}

/// Small rooms far apart, in each of which three balls fly to and fro.
Make rooms(uint32_t count, double speed, uint32_t contacts) {
  return [=] {
    auto arena = std::make_unique<Arena>(Capacity{9 * count, contacts, 0, true}, weightless());
    Random random = 3;
    for (uint32_t room = 0; room < count; ++room) {
      const double x = 400.0 * room;
      for (int wall = 0; wall < 6; ++wall) {
        double size[3] = {1.5, 1.5, 1.5}, at[3] = {x, 0, 0};
        size[wall / 2] = 0.5;
        at[wall / 2] += wall % 2 == 0 ? 1 : -1;
        BodyDef def;
        def.type = BodyType::fixed;
        def.shape = box(reals(size[0], size[1], size[2]));
        def.position = position(at[0], at[1], at[2]);
        def.material.restitution = real(1.0);
        arena->add(def);
      }
      for (int i = 0; i < 3; ++i)
        add_ball(*arena, 0.1, {x + 0.3 * (i - 1), 0.02 * signed_unit(random), 0},
                 reals(speed * signed_unit(random), speed * signed_unit(random), speed * signed_unit(random)));
    }
    return arena;
  };
}

DETENT_TEST(time_warp, drops_the_same_impacts_where_the_pool_is_full) {
  for (const uint32_t contacts : {20u, 60u, 110u})
    expect_global_bits(box_of_bodies(5, 0.8, 90, 4, contacts), 4, contacts);
  WarpCount count;
  for (uint32_t contacts = 60; contacts < 220; contacts += 20)
    count += expect_global_bits(rooms(20, 120, contacts), 3, contacts);
  EXPECT_GT(count.returns, 0u);
}

/// No room spends the work of all, but all rooms together do.
DETENT_TEST(time_warp, returns_to_the_global_order_where_the_work_is_spent) {
  const WarpCount count = expect_global_bits(rooms(12, 8000, 2000), 3, 2);
  EXPECT_GT(count.returns, 0u);
  if (!has_memory_for_groups(rooms(12, 8000, 2000))) return;
  EXPECT_GT(count.speculations, count.ticks);
}

/// Rows of balls that touch each other: a blow passes from pair to pair at one time, the same in each row.
DETENT_TEST(time_warp, keeps_the_order_of_hits_at_equal_times) {
  for (uint32_t seed = 0; seed < 8; ++seed) {
    const Make make = [seed] {
      auto arena = std::make_unique<Arena>(Capacity{64, 500, 0, true}, weightless());
      constexpr uint32_t k_rows = 8, k_balls = 5;
      for (uint32_t i = 0; i < k_rows * k_balls; ++i) {
        const uint32_t which = (i * 7 + seed * 11) % (k_rows * k_balls), ball = which % k_balls;  // in mixed slots
        add_ball(*arena, 0.25, {ball == 0 ? -1.0 : 0.5 * ball, 0, 30.0 * (which / k_balls)},
                 reals(ball == 0 ? 90.0 : 0.0, 0, 0));
      }
      return arena;
    };
    expect_global_bits(make, 2, seed);
  }
}

/// Fast bodies fly into sleeping ones. Waking is left to the global order.
DETENT_TEST(time_warp, wakes_the_same_bodies) {
  const Make make = [] {
    auto arena = std::make_unique<Arena>(Capacity{140, 1500, 0, true}, WorldDef{}, true);
    arena->add_ground();
    for (uint32_t i = 0; i < 64; ++i) arena->add_box(0.2, 0.9 * (i % 8), 0.2, 0.9 * (i / 8));
    arena->run(60);
    Random random = 5;
    for (uint32_t i = 0; i < 40; ++i) {
      BodyDef def;
      def.shape = sphere(real(0.15));
      def.position = position(0.9 * (i % 8) + 0.1 * signed_unit(random), 2.5 + 0.1 * (i % 5), 1.4 * (i / 8));
      def.linear_velocity = reals(50 * signed_unit(random), -60 - 10.0 * (i % 4), 50 * signed_unit(random));
      arena->add(def);
    }
    return arena;
  };
  expect_global_bits(make, 12, 4);
}

/// A ball that was awake is thrown at one that sleeps, in the same tick. Two of the sleepers sleep together.
DETENT_TEST(time_warp, leaves_a_later_waking_to_the_global_order) {
  const Make make = [] {
    auto arena = std::make_unique<Arena>(Capacity{40, 300, 0, true}, weightless(), true);
    for (uint32_t row = 0; row < 6; ++row) {
      add_ball(*arena, 0.1, {6.0, 0, 40.0 * row}, reals(0, 0, 0));
      if (row == 2) add_ball(*arena, 0.1, {6.2, 0, 40.0 * row}, reals(0, 0, 0));
    }
    EXPECT_EQ(arena->run(50).awake, 0u);
    for (uint32_t row = 0; row < 6; ++row) throw_ball(*arena, {0, 0, 40.0 * row});
    return arena;
  };
  WarpCount count;
  expect_equal_ticks(make, 1, ImpactOrder::optimistic, {}, count);
  EXPECT_EQ(count.returns, 1u);
  expect_global_bits(make, 3, 1);
}

DETENT_TEST(time_warp, is_not_used_with_sensors) {
  const Make make = [] {
    auto arena = std::make_unique<Arena>(Capacity{72, 600, 0, true, 0, 80}, weightless());
    fill_box(*arena, 4, 0.9, 60, 2);
    BodyDef def;
    def.type = BodyType::fixed;
    def.sensor = true;
    def.shape = sphere(real(0.5));
    arena->add(def);
    return arena;
  };
  EXPECT_EQ(expect_global_bits(make, 5, 3).ticks, 0u);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
