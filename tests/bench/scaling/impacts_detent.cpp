#include "tests/bench/scaling/impacts.h"

#include <detent/numbers.h>
#include <detent/recording.h>
#include <math.h>
#include <stdlib.h>

#include <algorithm>
#include <memory>

#include "tests/bench/scaling/recorded.h"
#include "tests/bench/scaling/settled.h"
#include "tests/campaigns/stress/scenes.h"
#include "tests/common/queries/random.h"
#include "tests/unit/shape/terrains.h"
#include "threads/thread_pool.h"
#include "world/step_probe.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

namespace {

using namespace detent_bench;

constexpr uint32_t k_impact_repetitions = 5;  ///< of each tick the fastest counts

void require_ok(Status status) {
  if (status != Status::ok) abort();
}
Real real_of(double value) {
  Real result{};
  require_ok(real_from_host(value, result));
  return result;
}
Vec3<Real> reals_of(double x, double y, double z) { return {real_of(x), real_of(y), real_of(z)}; }
Position position_of(double x, double y, double z) {
  Position at;
  require_ok(coord_from_host(x, at.x));
  require_ok(coord_from_host(y, at.y));
  require_ok(coord_from_host(z, at.z));
  return at;
}

/// A world with memory of its own.
struct ImpactWorld {
  World world;
  std::vector<uint64_t> words;

  explicit ImpactWorld(Capacity capacity, WorldDef def = {}) : words(world_bytes(capacity) / 8) {
    def.capacity = capacity;
    def.sleeping = false;
    require_ok(create_world(reinterpret_cast<uint8_t*>(words.data()), world_bytes(capacity), def, {}, world));
  }
  void add(const BodyDef& def) {
    BodyId id;
    require_ok(create_body(world, def, id));
  }
};

/// 5,000 boxes and balls with velocities of up to 60 m/s along each axis, between walls.
std::unique_ptr<ImpactWorld> fast_bodies(double spacing) {
  constexpr uint32_t k_count = 5000, k_side = 18;
  WorldDef def;
  def.gravity = {0.0, 0.0, 0.0};
  auto made = std::make_unique<ImpactWorld>(Capacity{k_count + 6, 8 * k_count, 0, true}, def);
  const double half = spacing * k_side / 2 + 1;
  for (uint32_t wall = 0; wall < 6; ++wall) {
    double size[3] = {half + 2, half + 2, half + 2}, at[3] = {0, 0, 0};
    size[wall / 2] = 1;
    at[wall / 2] = (wall % 2 == 0 ? 1 : -1) * (half + 1);
    BodyDef body;
    body.type = BodyType::fixed;
    body.shape = box(reals_of(size[0], size[1], size[2]));
    body.position = position_of(at[0], at[1], at[2]);
    body.material.restitution = real_of(0.9);
    made->add(body);
  }
  detent_queries::Random random(5);
  const auto place = [&](uint32_t i) { return (i - k_side / 2.0 + 0.5) * spacing; };
  const auto up_to = [&](double most) { return random.uniform(-most, most); };
  for (uint32_t i = 0; i < k_count; ++i) {
    BodyDef body;
    body.shape = i % 2 == 0 ? box(reals_of(0.2, 0.15, 0.18)) : sphere(real_of(0.2));
    body.position = position_of(place(i % k_side), place(i / k_side % k_side), place(i / k_side / k_side));
    body.linear_velocity = reals_of(up_to(60), up_to(60), up_to(60));
    body.angular_velocity = reals_of(up_to(5), up_to(5), up_to(5));
    body.material.restitution = real_of(0.8);
    made->add(body);
  }
  return made;
}

/// A triangle of 44 rows of balls with gaps of 0.5 mm, and a ball that hits it at 12 m/s.
std::unique_ptr<ImpactWorld> break_of_balls() {
  constexpr uint32_t k_rows = 44;
  auto made = std::make_unique<ImpactWorld>(Capacity{1000, 10000, 0, true});
  BodyDef ground;
  ground.type = BodyType::fixed;
  ground.shape = half_space();
  made->add(ground);
  const auto add_ball = [&](double x, double z, double speed) {
    BodyDef body;
    body.shape = sphere(real_of(0.03));
    body.position = position_of(x, 0.03, z);
    body.linear_velocity = reals_of(speed, 0, 0);
    body.material.restitution = real_of(0.95);
    body.material.friction = real_of(0.1);
    made->add(body);
  };
  add_ball(-0.5, 0, 12);
  for (uint32_t row = 0; row < k_rows; ++row) {
    for (uint32_t i = 0; i <= row; ++i) add_ball(0.0605 * 0.8661 * row, 0.0605 * (i - row / 2.0), 0);
  }
  return made;
}

/// 300 rocks thrown down the slope of a height field.
std::unique_ptr<ImpactWorld> avalanche() {
  static const detent_terrains::Bytes bytes = detent_terrains::field_of(
      128, 1.0, [](double x, double z) { return -0.7 * x + 0.6 * sin(0.9 * x) * cos(0.7 * z); }, false);
  static const Asset asset = {bytes.data(), bytes.count()};
  auto made = std::make_unique<ImpactWorld>(Capacity{301, 3000, 1, true});
  made->world.hooks.assets = {&asset, 1};
  require_ok(bind_asset(made->world, 0));
  BodyDef ground;
  ground.type = BodyType::fixed;
  ground.shape = terrain(0);
  made->add(ground);
  for (uint32_t i = 0; i < 300; ++i) {
    BodyDef body;
    body.shape = i % 2 == 0 ? box(reals_of(0.3, 0.25, 0.35)) : sphere(real_of(0.3));
    body.position = position_of(-55 + 0.8 * (i % 10), 42 + 0.8 * (i / 100), -4 + 0.8 * (i / 10 % 10));
    body.linear_velocity = reals_of(15 + i % 5, -10, i % 7 - 3.0);
    body.material.restitution = real_of(0.6);
    made->add(body);
  }
  return made;
}

/// The world of a scene, and what keeps it.
struct Subject {
  std::unique_ptr<ImpactWorld> own;
  std::unique_ptr<Settled> settled;
  uint32_t ticks = 20;

  explicit Subject(const std::string& scene) {
    if (scene == "fast-5000") own = fast_bodies(1.0);
    if (scene == "fast-5000-sparse") own = fast_bodies(3.0);
    if (scene == "break-1000") own = break_of_balls();
    if (scene == "rocks-300") own = avalanche();
    if (scene == "rocks-300") ticks = 120;
    if (scene == "impacts-S8")
      settled = std::make_unique<Settled>(ScalingScene{scene, [] { return detent_stress::dominoes(200); }, 60, 0});
    if (scene == "impacts-S8") ticks = 60;
  }
  World& world() { return own ? own->world : settled->world(); }
};

/// Measures the stage `advance` of each tick.
struct StageClock {
  StepObserver observer = {};
  Recorded* recorded = nullptr;
  uint64_t start = 0;
  double ns = 0;
  TickRecord tick;

  explicit StageClock(World& world) {
    observer.stage_ended = ended;
    observer.context = this;
    world.hooks.observer = &observer;
  }
  StageClock(const StageClock&) = delete;
  StageClock& operator=(const StageClock&) = delete;

 private:
  static void ended(void* context, const World&, StepStage stage, uint32_t) {
    StageClock& clock = *static_cast<StageClock*>(context);
    const uint64_t now = monotonic_ns();
    if (stage == StepStage::advance) {
      clock.ns = static_cast<double>(now - clock.start);
      if (clock.recorded != nullptr) clock.tick = clock.recorded->tick;
      clock.tick.ns = clock.ns;
    }
    if (stage == StepStage::raise_events && clock.recorded != nullptr) clock.recorded->tick = {};
    clock.start = monotonic_ns();
  }
};

/// One run of a scene: its ticks, and the last digest.
struct ImpactRun {
  std::vector<TickRecord> ticks;
  std::vector<uint32_t> impacts;
  WarpCount count;
  uint64_t last = 0;
};

ImpactRun run(const std::string& scene, ImpactOrder order, const Tasks& tasks, Recorded* recorded) {
  Subject subject(scene);
  World& world = subject.world();
  StageClock clock(world);
  clock.recorded = recorded;
  world.hooks.tasks = tasks;
  StepProbe probe;
  probe.order = order;
  ImpactRun result;
  for (uint32_t i = 0; i < subject.ticks; ++i) {
    const StepReport report = step_probed(world, probe);
    result.ticks.push_back(clock.tick);
    result.impacts.push_back(report.ccd.impacts);
  }
  world.hooks.observer = nullptr;
  result.count = probe.warp;
  result.last = digest(world);
  return result;
}

/// The mean time of the stage over the ticks with an impact; of each tick the least of several runs.
double mean_ns(const std::vector<ImpactRun>& runs) {
  double sum = 0;
  uint32_t count = 0;
  for (size_t i = 0; i < runs[0].ticks.size(); ++i) {
    double least = runs[0].ticks[i].ns;
    for (const ImpactRun& one : runs) least = std::min(least, one.ticks[i].ns);
    if (runs[0].impacts[i] == 0) continue;
    sum += least;
    ++count;
  }
  return count == 0 ? 0 : sum / count;
}

}  // namespace

std::vector<ImpactRow> measure_impacts(const std::string& scene, const std::vector<uint32_t>& threads) {
  constexpr struct {
    ImpactOrder order;
    const char* name;
  } k_orders[] = {{ImpactOrder::global, "global"},
                  {ImpactOrder::conservative, "conservative"},
                  {ImpactOrder::optimistic, "optimistic"},
                  {ImpactOrder::automatic, "automatic"}};
  std::vector<ImpactRow> rows;
  for (const auto& order : k_orders) {
    ImpactRow row;
    row.config = stress_engine().config;
    row.scene = scene;
    row.order = order.name;
    for (const uint32_t count : threads) {
      detent_host::ThreadPool pool(count);
      std::vector<ImpactRun> runs;
      for (uint32_t i = 0; i < k_impact_repetitions; ++i)
        runs.push_back(run(scene, order.order, count > 1 ? pool.tasks<Tasks>() : Tasks{}, nullptr));
      row.measured.push_back(mean_ns(runs));
      row.last = runs[0].last;
      row.same = rows.empty() || row.last == rows[0].last;
    }
    Recorded recorded;
    ImpactRun alone = run(scene, order.order, recorded.tasks(), &recorded);
    for (uint32_t i = 1; i < k_impact_repetitions; ++i) {
      const ImpactRun again = run(scene, order.order, recorded.tasks(), &recorded);
      for (size_t tick = 0; tick < alone.ticks.size(); ++tick) {
        if (again.ticks[tick].ns < alone.ticks[tick].ns) alone.ticks[tick] = again.ticks[tick];
      }
    }
    for (size_t i = 0; i < alone.ticks.size(); ++i) {
      row.impacts += alone.impacts[i];
      if (alone.impacts[i] != 0) row.ticks.push_back(alone.ticks[i]);
    }
    row.warp_ticks = alone.count.ticks;
    row.speculations = alone.count.speculations;
    row.rollbacks = alone.count.rollbacks;
    row.rounds = alone.count.rounds;
    row.returns = alone.count.returns;
    row.same = row.same && alone.last == row.last;
    rows.push_back(row);
  }
  return rows;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
