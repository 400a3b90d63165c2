#include <detent/query.h>
#include <string.h>

#include <thread>

#include "examples/scenes/scene.h"
#include "tests/campaigns/sequences/draw.h"
#include "tests/common/support/scheduler.h"
#include "tests/unit/replay/match.h"
#include "tests/unit/shape/hull_bytes.h"

/// Batches of queries, compared with single calls.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// As Draw names them.
AssetTable assets() {
  static const Asset table[] = {scene_assets().assets[k_asset_valley],
                                scene_assets().assets[k_asset_hills],
                                scene_assets().assets[k_asset_round],
                                {detent_hulls::k_tetrahedron, sizeof detent_hulls::k_tetrahedron},
                                scene_assets().assets[k_asset_dumbbell]};
  return {table, 5};
}

/// Bodies of all shapes; some sleep, some move, some were created or moved after the last step.
OwnedWorld make_world(uint64_t seed) {
  constexpr Capacity k_capacity = {60, 400, 5, true, 0, 20};
  OwnedWorld owned(OwnedWorld::def_of(k_capacity), assets());
  World& world = owned.world;
  for (uint32_t i = 0; i < k_capacity.assets; ++i) EXPECT_OK(bind_asset(world, i));
  const Shape shapes[] = {half_space(),
                          terrain(0),
                          terrain(1),
                          sphere(Real(0.5)),
                          capsule(Real(0.25), Real(0.5)),
                          box({Real(0.5), Real(0.25), Real(0.75)}),
                          cylinder(Real(0.5), Real(0.25)),
                          cone(Real(0.5), Real(0.5)),
                          hull(2),
                          rounded(hull(3), Real(0.125)),
                          rounded(box({Real(0.5), Real(0.25), Real(0.25)}), Real(0.125)),
                          compound(4)};
  Draw draw(seed, false);
  std::vector<BodyId> ids;
  const auto add = [&](uint32_t i) {
    BodyDef def;
    def.shape = shapes[i % 12];
    def.type = i < 3 || draw.chance(0.3) ? BodyType::fixed : BodyType::dynamic;
    // Terrains and the half-space occur once.
    if (i >= 12 && i % 12 < 3) def.shape = sphere(Real(0.25));
    if (i >= 3) def.position = draw.place();
    def.filter.category = 1u << draw.below(3);
    if (def.type == BodyType::dynamic) def.linear_velocity = reals(draw.uniform(-2, 2), 0, 1);
    def.sensor = i >= 12 && draw.chance(0.1);
    ids.push_back({});
    EXPECT_OK(create_body(world, def, ids.back()));
  };
  for (uint32_t i = 0; i < 50; ++i) add(i);
  step(world);
  uint32_t slept = 0;
  for (uint32_t i = 3; i < 50; i += 2) slept += sleep_body(world, ids[i]) == Status::ok ? 1u : 0u;  // else it is fixed
  EXPECT_GT(slept, 5u);
  step(world);
  for (uint32_t i = 50; i < 60; ++i) add(i);
  for (uint32_t i = 3; i < 50; i += 9) EXPECT_OK(set_pose(world, ids[i], draw.place(), {0.0, 0.0, 0.0, 1.0}));
  return owned;
}

QueryFilter draw_filter(Draw& draw) {
  QueryFilter filter;
  if (draw.chance(0.3)) filter.mask = draw.below(8);
  if (draw.chance(0.2)) filter.ignore = {4, 1};
  return filter;
}

/// Some of the queries are invalid, in one of several ways.
void draw_query(Draw& draw, RayQuery& query) {
  bool wrong = false;
  query = {draw.place(), draw.vector(8, wrong), draw_filter(draw), draw.chance(0.5)};
}
void draw_query(Draw& draw, CastQuery& query) {
  bool wrong = false;
  query.shape = draw.asked_shape(wrong);
  query.position = draw.place();
  query.rotation = draw.rotation(wrong);
  query.displacement = draw.vector(8, wrong);
  // Fast rotation makes the search reach its caps.
  query.rotation_vector = draw.vector(draw.chance(0.05) ? 20000 : 3, wrong);
  query.filter = draw_filter(draw);
  query.all = draw.chance(0.5);
}
void draw_query(Draw& draw, OverlapQuery& query) {
  bool wrong = false;
  query.shape = draw.asked_shape(wrong);
  query.position = draw.place();
  query.rotation = draw.rotation(wrong);
  query.filter = draw_filter(draw);
  query.all = draw.chance(0.7);
}
void draw_query(Draw& draw, BoundsQuery& query) {
  query.lower = draw.place();
  query.upper = draw.place();
  if (!draw.bad()) {
    const auto sort = [](Coord& a, Coord& b) {
      if (b < a) std::swap(a, b);
    };
    sort(query.lower.x, query.upper.x);
    sort(query.lower.y, query.upper.y);
    sort(query.lower.z, query.upper.z);
  }
  query.filter = draw_filter(draw);
  query.all = draw.chance(0.7);
}
void draw_query(Draw& draw, ClosestQuery& query) {
  bool wrong = false;
  query.shape = draw.asked_shape(wrong);
  query.position = draw.place();
  query.rotation = draw.rotation(wrong);
  query.distance_max = draw.number(0, 4, wrong);
  query.filter = draw_filter(draw);
  query.all = draw.chance(0.5);
}

/// What no query writes.
QueryHit marked_hit() {
  QueryHit hit;
  hit.body = {77, 78};
  hit.fraction = Fraction(0.25);
  hit.distance = Real(3.0);
  hit.point = {1.0, 2.0, 3.0};
  hit.triangle = 79;
  hit.material = 80;
  return hit;
}

/// The answers of a batch, or of single calls, in arrays with one element more than are used.
struct Answers {
  std::vector<QueryHit> hits;
  std::vector<QueryAnswer> answers;
  Status status = Status::ok;

  Answers(size_t count, uint32_t hits_each)
      : hits(count * hits_each + 1, marked_hit()), answers(count + 1, {Status::waiting, {81, 82, 83, 84}}) {}
};

bool same(const QueryHit& a, const QueryHit& b) {
  return a.body == b.body && a.undecided == b.undecided && a.fraction == b.fraction && a.distance == b.distance &&
         a.point == b.point && a.normal == b.normal && a.triangle == b.triangle && a.material == b.material;
}
bool same(const QueryAnswer& a, const QueryAnswer& b) {
  return a.status == b.status && a.report.hits == b.report.hits && a.report.dropped == b.report.dropped &&
         a.report.undecided == b.report.undecided && a.report.digest == b.report.digest;
}
void expect_same(const Answers& found, const Answers& expected) {
  EXPECT_EQ(found.status, expected.status);
  ASSERT_EQ(found.answers.size(), expected.answers.size());
  ASSERT_EQ(found.hits.size(), expected.hits.size());
  for (size_t i = 0; i < found.answers.size(); ++i) ASSERT_TRUE(same(found.answers[i], expected.answers[i])) << i;
  for (size_t i = 0; i < found.hits.size(); ++i) ASSERT_TRUE(same(found.hits[i], expected.hits[i])) << i;
}

template <class Query>
Answers ask_one_by_one(Status (*call)(const World&, const Query&, QueryHits, QueryReport&), const World& world,
                       const std::vector<Query>& queries, uint32_t hits_each) {
  Answers expected(queries.size(), hits_each);
  for (size_t i = 0; i < queries.size(); ++i) {
    QueryAnswer& answer = expected.answers[i];
    answer.status = call(world, queries[i], {&expected.hits[i * hits_each], hits_each}, answer.report);
    if (expected.status == Status::ok) expected.status = answer.status;
  }
  return expected;
}
template <class Query>
Answers ask_together(const World& world, const std::vector<Query>& queries, uint32_t hits_each) {
  Answers found(queries.size(), hits_each);
  found.status = query_batch(world, queries.data(), static_cast<uint32_t>(queries.size()), found.hits.data(), hits_each,
                             found.answers.data());
  return found;
}

/// What the queries of a test met.
struct Met {
  uint32_t hits = 0, dropped = 0, undecided = 0, refused = 0, answered = 0;

  void add(const Answers& answers) {
    for (size_t i = 0; i + 1 < answers.answers.size(); ++i) {
      const QueryAnswer& answer = answers.answers[i];
      (answer.status == Status::ok ? answered : refused) += 1;
      if (answer.status != Status::ok) continue;
      hits += answer.report.hits;
      dropped += answer.report.dropped;
      undecided += answer.report.undecided;
    }
  }
};

/// Asks one batch with every scheduler. Returns what the batch met.
template <class Query>
Met expect_batches(Status (*call)(const World&, const Query&, QueryHits, QueryReport&)) {
  Met met;
  uint32_t shared = 0;
  for (uint64_t seed = 1; seed <= 2; ++seed) {
    OwnedWorld owned = make_world(seed);
    World& world = owned.world;
    Draw draw(100 + seed, false);
    std::vector<Query> queries(150);
    for (Query& query : queries) draw_query(draw, query);
    const std::vector<uint64_t> block(owned.block.get(), owned.block.get() + world_bytes(get_info(world).capacity) / 8);
    for (const uint32_t hits_each : {0u, 1u, 5u}) {
      const Answers expected = ask_one_by_one(call, world, queries, hits_each);
      met.add(expected);
      world.hooks.tasks = {};
      expect_same(ask_together(world, queries, hits_each), expected);
      for (Scheduler scheduler : k_schedulers) {
        const uint64_t calls = scheduler.seed;
        world.hooks.tasks = scheduler.tasks();
        expect_same(ask_together(world, queries, hits_each), expected);
        shared += static_cast<uint32_t>(scheduler.seed - calls);
        if (testing::Test::HasFailure()) return met;
      }
    }
    EXPECT_EQ(memcmp(block.data(), owned.block.get(), block.size() * 8), 0) << "a query has changed the world";
  }
  EXPECT_EQ(shared, 2 * 3 * std::size(k_schedulers));
  EXPECT_GT(met.hits, 100u);
  EXPECT_GT(met.dropped, 20u);
  EXPECT_GT(met.refused, 20u);
  EXPECT_GT(met.answered, 200u);
  return met;
}

DETENT_TEST(batch, of_rays_answers_as_single_calls_do_on_any_threads) { expect_batches(query_ray); }
DETENT_TEST(batch, of_casts_answers_as_single_calls_do_on_any_threads) {
  EXPECT_GT(expect_batches(query_cast).undecided, 0u);
}
DETENT_TEST(batch, of_overlaps_answers_as_single_calls_do_on_any_threads) { expect_batches(query_overlap); }
DETENT_TEST(batch, of_bounds_answers_as_single_calls_do_on_any_threads) { expect_batches(query_bounds); }
DETENT_TEST(batch, of_closest_answers_as_single_calls_do_on_any_threads) { expect_batches(query_closest); }

DETENT_TEST(batch, returns_the_status_of_the_first_query_that_is_not_ok) {
  OwnedWorld owned = make_world(1);
  Scheduler scheduler = {Calls::threads, Parts::backwards, 3};
  owned.world.hooks.tasks = scheduler.tasks();
  std::vector<OverlapQuery> queries(20);
  EXPECT_EQ(ask_together(owned.world, queries, 1).status, Status::ok);
  queries[17].shape = half_space();
  EXPECT_EQ(ask_together(owned.world, queries, 1).status, Status::bad_argument);
  queries[5].rotation = {0.0, 0.0, 0.0, 0.5};
  const Answers answers = ask_together(owned.world, queries, 1);
  EXPECT_EQ(answers.status, Status::not_normalised);
  EXPECT_EQ(answers.answers[17].status, Status::bad_argument);
  EXPECT_EQ(answers.answers[18].status, Status::ok);
}

DETENT_TEST(batch, of_no_query_or_without_room_for_hits_needs_no_buffers) {
  OwnedWorld owned = make_world(1);
  EXPECT_OK(query_batch(owned.world, static_cast<const RayQuery*>(nullptr), 0, nullptr, 8, nullptr));
  RayQuery ray;
  ray.origin = position(0, 10, 0);
  ray.displacement = reals(0, -20, 0);
  QueryAnswer answer;
  EXPECT_OK(query_batch(owned.world, &ray, 1, nullptr, 0, &answer));
  EXPECT_EQ(answer.report.hits, 0u);
  EXPECT_EQ(answer.report.dropped, 1u);
}

DETENT_TEST(batch, of_few_queries_runs_on_the_thread_that_calls) {
  OwnedWorld owned = make_world(1);
  Scheduler scheduler = {Calls::threads, Parts::in_order, 2, false, 0};
  owned.world.hooks.tasks = scheduler.tasks();
  for (const uint32_t count : {1u, 95u, 96u, 200u}) {
    const uint64_t calls = scheduler.seed;
    ask_together(owned.world, std::vector<RayQuery>(count), 1);
    EXPECT_EQ(scheduler.seed - calls, count < 96 ? 0u : 1u) << count;
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
