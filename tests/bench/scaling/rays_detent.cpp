#include <detent/numbers.h>
#include <detent/query.h>
#include <stdlib.h>

#include <memory>

#include "tests/bench/scaling/rays.h"
#include "tests/bench/scaling/settled.h"
#include "tests/bench/timer.h"
#include "tests/common/queries/random.h"
#include "threads/thread_pool.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

namespace {

using namespace detent_bench;

constexpr uint32_t k_repetitions = 51, k_ray_counts[] = {100, 1000};

void require(bool fact) {
  if (!fact) abort();
}

/// Rays of 10 m in random directions, from points in the pit and above it.
std::vector<RayQuery> make_rays(uint32_t count) {
  detent_queries::Random random(1);
  std::vector<RayQuery> rays(count);
  for (RayQuery& ray : rays) {
    const detent_queries::Triple way = random.direction();
    require(coord_from_host(random.uniform(-5, 5), ray.origin.x) == Status::ok &&
            coord_from_host(random.uniform(0, 12), ray.origin.y) == Status::ok &&
            coord_from_host(random.uniform(-5, 5), ray.origin.z) == Status::ok &&
            real_from_host(10 * way[0], ray.displacement.x) == Status::ok &&
            real_from_host(10 * way[1], ray.displacement.y) == Status::ok &&
            real_from_host(10 * way[2], ray.displacement.z) == Status::ok);
  }
  return rays;
}

void put_to_sleep(World& world) {
  WorldDef def = get_settings(world);
  def.sleeping = true;
  require(set_settings(world, def) == Status::ok);
  for (BodyId id = next_body(world, {}); !(id == BodyId{}); id = next_body(world, id)) {
    BodyDef body;
    require(get_body_def(world, id, body) == Status::ok);
    require(body.type != BodyType::dynamic || sleep_body(world, id) == Status::ok);
  }
  require(step(world).awake == 0);
}

/// The least time of a call that is made several times: the least affected by other load of the machine.
struct LeastTime {
  double ns = 0;

  template <class Call>
  void add(const Call& call) {
    const uint64_t start = monotonic_ns();
    call();
    const double now = static_cast<double>(monotonic_ns() - start);
    if (ns == 0 || now < ns) ns = now;
  }
};

RayRow measure(World& world, uint32_t count, const std::vector<uint32_t>& threads) {
  RayRow row;
  row.config = stress_engine().config;
  row.rays = count;
  const std::vector<RayQuery> rays = make_rays(count);
  std::vector<QueryHit> hits(count);
  std::vector<QueryReport> alone(count);
  std::vector<QueryAnswer> answers(count);
  std::vector<std::unique_ptr<detent_host::ThreadPool>> pools;
  for (const uint32_t workers : threads) pools.push_back(std::make_unique<detent_host::ThreadPool>(workers));
  LeastTime single;
  std::vector<LeastTime> batch(threads.size());
  // In turn, so that a change of the machine's load affects all of them.
  for (uint32_t repetition = 0; repetition < k_repetitions; ++repetition) {
    single.add([&] {
      for (uint32_t i = 0; i < count; ++i) require(query_ray(world, rays[i], {&hits[i], 1}, alone[i]) == Status::ok);
    });
    for (size_t i = 0; i < threads.size(); ++i) {
      world.hooks.tasks = pools[i]->tasks<Tasks>();
      batch[i].add(
          [&] { require(query_batch(world, rays.data(), count, hits.data(), 1, answers.data()) == Status::ok); });
      for (uint32_t k = 0; k < count; ++k) row.same = row.same && answers[k].report.digest == alone[k].digest;
    }
  }
  row.single_ns = single.ns;
  for (const LeastTime& time : batch) row.batch_ns.push_back(time.ns);
  world.hooks.tasks = {};
  return row;
}

}  // namespace

std::vector<RayRow> measure_rays(const ScalingScene& scene, const std::vector<uint32_t>& threads) {
  std::vector<RayRow> rows;
  Settled settled(scene);
  for (const bool asleep : {false, true}) {
    if (asleep) put_to_sleep(settled.world());
    for (const uint32_t count : k_ray_counts) {
      rows.push_back(measure(settled.world(), count, threads));
      rows.back().scene = scene.name;
      rows.back().asleep = asleep;
    }
  }
  return rows;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
