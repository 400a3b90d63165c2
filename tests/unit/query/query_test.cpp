#include <detent/distance.h>
#include <detent/query.h>
#include <detent/toi.h>
#include <math.h>

#include <algorithm>
#include <vector>

#include "broad_phase/swept_box.h"
#include "contact/body_convex.h"
#include "query/query_hits.h"
#include "shape/bounds.h"
#include "shape/sweep.h"
#include "state/step_cache.h"
#include "tests/common/oracle/bodies.h"
#include "tests/unit/shape/hull_bytes.h"

/// Compares queries with a test of every body, one by one.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

const Asset k_assets[] = {{detent_hulls::k_tetrahedron, sizeof detent_hulls::k_tetrahedron},
                          {detent_hulls::k_prism, sizeof detent_hulls::k_prism}};
const AssetTable k_table = {k_assets, 2};
constexpr Vec3<Real> k_none = {Real(0.0), Real(0.0), Real(0.0)};

/// A world in memory of its own.
struct Place {
  std::vector<uint64_t> words;
  World world;

  explicit Place(Capacity capacity, WorldDef def = {}) : words(world_bytes(capacity) / 8) {
    def.capacity = capacity;
    EXPECT_OK(
        create_world(reinterpret_cast<uint8_t*>(words.data()), world_bytes(capacity), def, {.assets = k_table}, world));
    for (uint32_t i = 0; i < capacity.assets; ++i) EXPECT_OK(bind_asset(world, i));
  }
  BodyId add(const BodyDef& def) {
    BodyId id;
    EXPECT_OK(create_body(world, def, id));
    return id;
  }
  BodyId add_fixed(const Shape& shape, double x, double y, double z) {
    BodyDef def;
    def.type = BodyType::fixed;
    def.shape = shape;
    def.position = position_near({{x, y, z}});
    return add(def);
  }
};

Shape any_shape(Samples& samples) {
  const double size = uniform(samples, 0.1, 0.6), other = uniform(samples, 0.1, 0.6);
  const Real a = real_near(size), b = real_near(other), rounding = real_near(0.05);
  switch (samples.below(9)) {
    case 0:
      return sphere(a);
    case 1:
      return capsule(a, b);
    case 2:
      return box({a, b, a});
    case 3:
      return cylinder(a, b);
    case 4:
      return cone(a, b);
    case 5:
      return hull(0);
    case 6:
      return rounded(hull(1), rounding);
    case 7:
      return rounded(box({a, a, b}), rounding);
    default:
      return box({real_near(2), b, real_near(0.1)});
  }
}

Position any_position(Samples& samples, double room) {
  const double x = uniform(samples, -room, room), y = uniform(samples, 0, room), z = uniform(samples, -room, room);
  return position_near({{x, y, z}});
}

BodyDef any_body(Samples& samples) {
  BodyDef def;
  def.shape = any_shape(samples);
  def.position = any_position(samples, 5);
  def.rotation = rotation_near(any_rotation(samples));
  const uint32_t kind = samples.below(6);
  def.type = kind < 2 ? BodyType::fixed : kind == 2 ? BodyType::kinematic : BodyType::dynamic;
  if (def.type != BodyType::fixed && samples.below(2) == 0)
    def.linear_velocity = reals_near(any_direction(samples) * uniform(samples, 1, 20));
  if (samples.below(3) == 0) def.filter.category = 2;
  return def;
}

QueryFilter any_filter(Samples& samples, const World& world) {
  QueryFilter filter;
  if (samples.below(3) == 0) filter.mask = 1 + samples.below(3);
  if (samples.below(3) == 0) filter.ignore = next_body(world, {});
  return filter;
}

struct Answer {
  std::vector<QueryHit> hits;
  QueryReport report;
};

template <class Query>
Answer ask(Status (*call)(const World&, const Query&, QueryHits, QueryReport&), const World& world, Query query,
           bool all = true, uint32_t room = 100) {
  Answer answer;
  answer.hits.resize(room);
  query.all = all;
  EXPECT_OK(call(world, query, {answer.hits.data(), room}, answer.report));
  answer.hits.resize(answer.report.hits);
  return answer;
}

/// The hits of all bodies that the filter allows, as `hit_of(convex, pose, hit)` finds them, sorted.
template <class HitOf>
std::vector<QueryHit> ask_all(const World& world, const QueryFilter& filter, const HitOf& hit_of) {
  const StateView<const uint8_t> state = view_of(world);
  std::vector<QueryHit> hits;
  for (BodyId id = next_body(world, {}); id.slot != 0; id = next_body(world, id)) {
    const BodyProperties& properties = state.properties[id.slot - 1];
    if ((properties.category & filter.mask) == 0 || (filter.category & properties.mask) == 0 || id == filter.ignore)
      continue;
    Convex convex;
    EXPECT_TRUE(body_convex(properties, world.hooks.assets, convex));
    QueryHit hit;
    hit.body = id;
    Pose pose;
    EXPECT_OK(get_pose(world, id, pose));
    if (hit_of(convex, pose, hit)) hits.push_back(hit);
  }
  std::stable_sort(hits.begin(), hits.end(), [](const QueryHit& a, const QueryHit& b) {
    return a.fraction < b.fraction || (a.fraction == b.fraction && a.distance < b.distance);
  });
  return hits;
}

Convex convex_of(const Shape& shape) {
  Convex convex;
  if (shape.type == ShapeType::sphere && shape.radius == Real(0.0)) {
    convex.type = ShapeType::sphere;
    return convex;
  }
  BodyProperties properties{};
  EXPECT_OK(set_shape_properties(shape, properties, k_table));
  EXPECT_TRUE(body_convex(properties, k_table, convex));
  return convex;
}

std::vector<QueryHit> ask_all(const World& world, const CastQuery& query) {
  const Convex moving = convex_of(query.shape);
  return ask_all(world, query.filter, [&](const Convex& convex, const Pose& pose, QueryHit& hit) {
    TimeOfImpact impact;
    EXPECT_OK(time_of_impact(convex, {pose, k_none, k_none}, moving,
                             {{query.position, query.rotation}, query.displacement, query.rotation_vector}, impact));
    EXPECT_NE(impact.outcome, ToiOutcome::undecided);
    hit.fraction = impact.time;
    hit.point = moved(pose.position, impact.point);
    hit.normal = impact.normal;
    return impact.outcome == ToiOutcome::hit;
  });
}

std::vector<QueryHit> ask_all(const World& world, const ClosestQuery& query) {
  const Convex shape = convex_of(query.shape);
  return ask_all(world, query.filter, [&](const Convex& convex, const Pose& pose, QueryHit& hit) {
    Closest closest;
    EXPECT_OK(closest_points(convex, pose, shape, {query.position, query.rotation}, closest));
    EXPECT_FALSE(closest.capped);
    hit.distance = closest.distance;
    hit.point = moved(pose.position, closest.point_a);
    hit.normal = closest.normal;
    return closest.distance <= query.distance_max;
  });
}

std::vector<QueryHit> ask_all(const World& world, const BoundsQuery& query) {
  const StateView<const uint8_t> state = view_of(world);
  return ask_all(world, query.filter, [&](const Convex& convex, const Pose& pose, QueryHit& hit) {
    if (convex.type == ShapeType::half_space) return true;
    const Vec3<Real> half = half_bounds(state.properties[hit.body.slot - 1], matrix_from(pose.rotation));
    return overlap({moved(pose.position, -half), moved(pose.position, half)}, {query.lower, query.upper});
  });
}

bool same(const QueryHit& a, const QueryHit& b) {
  return a.body == b.body && a.undecided == b.undecided && a.fraction == b.fraction && a.distance == b.distance &&
         a.point == b.point && a.normal == b.normal;
}

void expect_same(const std::vector<QueryHit>& found, const std::vector<QueryHit>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (size_t i = 0; i < found.size(); ++i) ASSERT_TRUE(same(found[i], expected[i])) << "hit " << i;
}

/// Compares all hits and the first hit in every world; the worlds have the same state. Returns the number of hits.
template <class Query>
size_t expect_answers(const std::vector<const World*>& worlds,
                      Status (*call)(const World&, const Query&, QueryHits, QueryReport&), const Query& query,
                      const std::vector<QueryHit>& expected) {
  const QueryReport all = ask(call, *worlds[0], query).report, first = ask(call, *worlds[0], query, false).report;
  for (const World* world : worlds) {
    const Answer whole = ask(call, *world, query), nearest = ask(call, *world, query, false);
    expect_same(whole.hits, expected);
    EXPECT_EQ(whole.report.digest, all.digest);
    EXPECT_EQ(nearest.report.digest, first.digest);
    EXPECT_EQ(whole.report.undecided, 0u);
    EXPECT_EQ(nearest.hits.size(), expected.empty() ? 0u : 1u);
    if (!expected.empty() && !nearest.hits.empty()) {
      EXPECT_TRUE(same(nearest.hits[0], expected[0]));
    }
  }
  return expected.size();
}

struct Counts {
  size_t ray = 0, cast = 0, closest = 0, overlap = 0, bounds = 0;
};

/// One query of each kind.
void expect_all_answers(Samples& samples, const std::vector<const World*>& worlds, Counts& counts) {
  const World& world = *worlds[0];
  const QueryFilter filter = any_filter(samples, world);
  CastQuery cast;
  cast.shape = any_shape(samples);
  cast.position = any_position(samples, 8);
  cast.rotation = rotation_near(any_rotation(samples));
  cast.displacement = reals_near(any_direction(samples) * uniform(samples, 0, 16));
  cast.filter = filter;
  counts.cast += expect_answers(worlds, query_cast, cast, ask_all(world, cast));
  cast.rotation_vector = reals_near(any_direction(samples) * uniform(samples, 0.5, 5));
  counts.cast += expect_answers(worlds, query_cast, cast, ask_all(world, cast));

  const RayQuery ray = {any_position(samples, 8), cast.displacement, filter};
  CastQuery point;
  point.shape = sphere(Real(0.0));
  point.position = ray.origin;
  point.displacement = ray.displacement;
  point.filter = filter;
  counts.ray += expect_answers(worlds, query_ray, ray, ask_all(world, point));
  counts.ray += expect_answers(worlds, query_cast, point, ask_all(world, point));

  ClosestQuery closest;
  closest.shape = samples.below(3) == 0 ? sphere(Real(0.0)) : cast.shape;
  closest.position = any_position(samples, 4);
  closest.rotation = cast.rotation;
  closest.distance_max = real_near(uniform(samples, 0, 4));
  closest.filter = filter;
  counts.closest += expect_answers(worlds, query_closest, closest, ask_all(world, closest));
  closest.distance_max = Real(0.0);
  const OverlapQuery overlapping = {closest.shape, closest.position, closest.rotation, filter};
  counts.overlap += expect_answers(worlds, query_overlap, overlapping, ask_all(world, closest));

  const Vec3<Real> half = reals_near({{uniform(samples, 0, 2), 1, 0.5}});
  const BoundsQuery bounds = {moved(cast.position, -half), moved(cast.position, half), filter};
  counts.bounds += expect_answers(worlds, query_bounds, bounds, ask_all(world, bounds));
}

/// One call that moves, creates, changes or destroys a body.
void change(Samples& samples, Place& place, std::vector<BodyId>& ids) {
  const uint32_t what = samples.below(6);
  const BodyDef def = any_body(samples);
  const size_t which = ids.empty() ? 0 : samples.below(static_cast<uint32_t>(ids.size()));
  if (what == 0 || ids.size() < 20) {
    BodyId id;
    if (create_body(place.world, def, id) == Status::ok) ids.push_back(id);
  } else if (what == 1) {
    EXPECT_OK(destroy_body(place.world, ids[which]));
    ids.erase(ids.begin() + static_cast<std::ptrdiff_t>(which));
  } else if (what == 2) {
    EXPECT_OK(set_pose(place.world, ids[which], def.position, def.rotation));
  } else {
    // These calls return an error if the body is not dynamic.
    Status status = what == 3 ? wake_body(place.world, ids[which]) : sleep_body(place.world, ids[which]);
    if (what == 5) status = set_gravity(place.world, reals_near({{0, uniform(samples, -12, -6), 0}}));
    static_cast<void>(status);
  }
}

DETENT_TEST(query, answers_as_asking_every_body_does_whatever_the_world_keeps_of_its_steps) {
  const Capacity capacity = {60, 300, 2};
  Counts counts;
  uint32_t asleep = 0;
  for (uint32_t round = 0; round < detent_oracle::rounds(12); ++round) {
    Samples samples = {500 + round};
    Place live(capacity), restored(capacity), loaded(capacity), forgets(capacity);
    live.add_fixed(half_space(), 0, 0, 0);
    std::vector<BodyId> ids;
    for (int i = 0; i < 40; ++i) ids.push_back(live.add(any_body(samples)));
    for (int tick = 0; tick < 40; ++tick) {
      for (uint32_t i = samples.below(4); i > 0; --i) change(samples, live, ids);
      std::vector<uint64_t> snapshot(snapshot_bytes(capacity) / 8);
      uint8_t* bytes = reinterpret_cast<uint8_t*>(snapshot.data());
      ASSERT_OK(save(live.world, bytes, snapshot_bytes(capacity)));
      ASSERT_OK(restore(restored.world, bytes, snapshot_bytes(capacity)));
      ASSERT_OK(load(loaded.world, bytes, snapshot_bytes(capacity)));
      forgets.words = live.words;
      forget_steps(forgets.world);
      const std::vector<uint64_t> before = live.words;
      expect_all_answers(samples, {&live.world, &restored.world, &loaded.world, &forgets.world}, counts);
      ASSERT_TRUE(before == live.words) << "a query has changed the world";
      // Sometimes enough ticks for bodies at rest to fall asleep.
      for (uint32_t i = samples.below(8) == 0 ? 60 : 1; i > 0; --i) {
        const StepReport report = step(live.world);
        asleep += report.bodies - report.awake;
      }
    }
  }
  const size_t least = 5 * detent_oracle::rounds(12);
  EXPECT_GT(counts.ray, least);
  EXPECT_GT(counts.cast, least);
  EXPECT_GT(counts.closest, least);
  EXPECT_GT(counts.overlap, least);
  EXPECT_GT(counts.bounds, least);
  EXPECT_GT(asleep, 0u);
}

DETENT_TEST(query, what_is_grazed_within_the_tolerance_is_never_ruled_out_by_its_bounds) {
  Samples samples = {77};
  size_t hits = 0, misses = 0;
  for (uint32_t round = 0; round < detent_oracle::rounds(600); ++round) {
    Place place({2, 1, 2});
    // Thin and long shapes have the largest tolerance of their bounds.
    const double size = exp2(uniform(samples, -3, 3)), thin = size * exp2(uniform(samples, -10, 0));
    const Shape shape =
        samples.below(2) == 0 ? box(reals_near({{size, thin, size}})) : cylinder(real_near(thin), real_near(size));
    place.add_fixed(shape, 0, 0, 0);
    if (samples.below(2) == 0) step(place.world);
    const double top = samples.below(2) == 0 ? 0 : uniform(samples, 0, 1);
    CastQuery query;
    query.shape = top == 0 ? sphere(Real(0.0)) : box(reals_near({{top, top * exp2(uniform(samples, -8, 0)), top}}));
    const double half = top == 0 ? 0 : real_to_host(query.shape.half_extents.y);
    const double height = (shape.type == ShapeType::box ? thin : size) + half;
    const double offset = uniform(samples, -2, 4) * 1e-6 * (size + top);
    query.position = position_near({{-20, height + offset, uniform(samples, -0.5, 0.5) * thin}});
    query.displacement = reals_near({{uniform(samples, 10, 40), 0, 0}});
    const std::vector<QueryHit> expected = ask_all(place.world, query);
    expect_answers({&place.world}, query_cast, query, expected);
    (expected.empty() ? misses : hits) += 1;
  }
  EXPECT_GT(hits, 50u * detent_oracle::rounds(600) / 600);
  EXPECT_GT(misses, 50u * detent_oracle::rounds(600) / 600);
}

DETENT_TEST(query, an_undecided_answer_does_not_depend_on_what_the_world_keeps_either) {
  const Capacity capacity = {40, 1, 0};
  uint32_t undecided = 0, decided = 0;
  for (uint32_t round = 0; round < detent_oracle::rounds(12); ++round) {
    Samples samples = {900 + round};
    Place kept(capacity), forgets(capacity);
    for (int i = 0; i < 30; ++i) {
      BodyDef def;
      def.type = BodyType::fixed;
      def.shape = box(reals_near({{0.01, 2, 0.01}}));
      def.position = any_position(samples, 5);
      def.rotation = rotation_near(any_rotation(samples));
      kept.add(def);
    }
    step(kept.world);
    forgets.words = kept.words;
    forget_steps(forgets.world);
    for (int i = 0; i < 20; ++i) {
      // Rods that rotate hundreds of times during the cast reach the iteration caps.
      CastQuery cast;
      cast.shape = box(reals_near({{0.01, 1, 0.01}}));
      cast.position = any_position(samples, 8);
      cast.rotation = rotation_near(any_rotation(samples));
      cast.displacement = reals_near(any_direction(samples) * uniform(samples, 0, 16));
      cast.rotation_vector = reals_near(any_direction(samples) * uniform(samples, 1000, 30000));
      const Answer all = ask(query_cast, kept.world, cast), first = ask(query_cast, kept.world, cast, false);
      EXPECT_EQ(all.report.digest, ask(query_cast, forgets.world, cast).report.digest);
      EXPECT_EQ(first.report.digest, ask(query_cast, forgets.world, cast, false).report.digest);
      ASSERT_EQ(first.hits.empty(), all.hits.empty());
      if (all.hits.empty()) continue;
      EXPECT_TRUE(same(first.hits[0], all.hits[0]));
      undecided += first.report.undecided;
      decided += 1 - first.report.undecided;
    }
  }
  EXPECT_GT(undecided, 3 * detent_oracle::rounds(12));
  EXPECT_GT(decided, 0u);
}

/// Draws without a libm.
uint64_t digest_of_fixed_answers() {
  Samples samples = {4711};
  const Quat rotations[] = {{Unit(0.0), Unit(0.0), Unit(0.0), Unit(1.0)},
                            {Unit(0.6), Unit(0.0), Unit(0.8), Unit(0.0)},
                            {Unit(0.48), Unit(0.6), Unit(0.0), Unit(0.64)},
                            {Unit(-0.5), Unit(0.5), Unit(0.5), Unit(0.5)}};
  const Shape shapes[] = {sphere(Real(0.375)),
                          capsule(Real(0.25), Real(0.5)),
                          box({Real(0.5), Real(0.25), Real(0.75)}),
                          cylinder(Real(0.5), Real(0.25)),
                          cone(Real(0.5), Real(0.5)),
                          hull(0),
                          rounded(hull(1), Real(0.125))};
  const auto place = [&] {
    const double x = samples.below(320) / 32.0, y = samples.below(320) / 32.0, z = samples.below(320) / 32.0;
    return Vector{{x, y, z}};
  };
  Place world({60, 1, 2});
  BodyDef def;
  def.type = BodyType::fixed;
  for (int i = 0; i < 60; ++i) {
    def.shape = shapes[samples.below(7)];
    def.rotation = rotations[samples.below(4)];
    def.position = position_near(place());
    world.add(def);
  }
  uint64_t sum = 0;
  for (int i = 0; i < 60; ++i) {
    CastQuery cast;
    cast.shape = shapes[samples.below(7)];
    cast.rotation = rotations[samples.below(4)];
    const Vector from = place(), to = place();
    cast.position = position_near(from);
    cast.displacement = reals_near(to - from);
    if (i % 2 == 0) cast.rotation_vector = reals_near(place() * 0.25);
    sum = sum * 31 + ask(query_cast, world.world, cast).report.digest;
    sum = sum * 31 + ask(query_ray, world.world, RayQuery{cast.position, cast.displacement}, i % 4 != 0).report.digest;
    sum = sum * 31 +
          ask(query_overlap, world.world, OverlapQuery{cast.shape, cast.position, cast.rotation}).report.digest;
    sum = sum * 31 + ask(query_closest, world.world, ClosestQuery{cast.shape, cast.position, cast.rotation, Real(2.5)})
                         .report.digest;
  }
  return sum;
}

DETENT_TEST(query, answers_are_the_same_on_every_target) {
#if defined(DETENT_FX64)
  EXPECT_EQ(digest_of_fixed_answers(), 15236061650496314801u);
#elif defined(DETENT_FX32)
  EXPECT_EQ(digest_of_fixed_answers(), 7790901128523916244u);
#elif defined(DETENT_F32)
  EXPECT_EQ(digest_of_fixed_answers(), 4576010274177957606u);
#else
  EXPECT_EQ(digest_of_fixed_answers(), 17868160669179240485u);
#endif
}

/// Boxes in a row along x, at 2, 4, 6 and so on.
Place make_row(uint32_t count) {
  Place place({count, 1, 2});
  for (uint32_t i = count; i-- > 0;) place.add_fixed(box(reals_near({{0.5, 0.5, 0.5}})), 2.0 * (i + 1), 0, 0);
  return place;
}
RayQuery ray_along(double length) {
  RayQuery ray;
  ray.displacement = reals_near({{length, 0, 0}});
  return ray;
}

DETENT_TEST(query, hits_beyond_the_room_are_the_last_and_are_counted) {
  Place place = make_row(10);
  for (int i = 0; i < 2; ++i) {
    const QueryReport whole = ask(query_ray, place.world, ray_along(100)).report;
    EXPECT_EQ(whole.hits, 10u);
    for (uint32_t room = 0; room < 10; ++room) {
      const Answer answer = ask(query_ray, place.world, ray_along(100), true, room);
      EXPECT_EQ(answer.report.hits, room);
      EXPECT_EQ(answer.report.dropped, 10 - room);
      EXPECT_EQ(answer.report.digest, whole.digest);
      for (uint32_t k = 0; k < room; ++k) {
        EXPECT_EQ(answer.hits[k].body.slot, 10 - k);
        EXPECT_NEAR(coord_to_host(answer.hits[k].point.x), 2.0 * (k + 1) - 0.5, 1e-4);
        EXPECT_NEAR(unit_to_host(answer.hits[k].normal.x), -1, 1e-6);
      }
    }
    EXPECT_EQ(ask(query_ray, place.world, ray_along(100), false, 0).report.dropped, 1u);
    step(place.world);
  }
}

DETENT_TEST(query, bodies_as_near_as_each_other_come_by_their_slots) {
  Place place({8, 1, 2});
  for (int i = 0; i < 8; ++i) place.add_fixed(sphere(Real(0.5)), 3, 0, 0);
  for (int i = 0; i < 2; ++i) {
    const Answer answer = ask(query_ray, place.world, ray_along(10));
    ASSERT_EQ(answer.hits.size(), 8u);
    for (uint32_t k = 0; k < 8; ++k) EXPECT_EQ(answer.hits[k].body.slot, k + 1);
    ClosestQuery closest;
    EXPECT_EQ(ask(query_closest, place.world, closest, false).hits.at(0).body.slot, 1u);
    OverlapQuery within;
    within.position = position_near({{3, 0, 0}});
    EXPECT_EQ(ask(query_overlap, place.world, within, false).hits.at(0).body.slot, 1u);
    closest.filter.ignore = {1, 1};
    EXPECT_EQ(ask(query_closest, place.world, closest, false).hits.at(0).body.slot, 2u);
    step(place.world);
  }
}

DETENT_TEST(query, hits_are_in_the_order_of_place_then_decision_then_slot_then_triangle) {
  QueryHit hit;
  hit.fraction = Fraction(0.5);
  hit.distance = Real(2.0);
  hit.body = {3, 1};
  hit.triangle = 7;
  const auto altered = [&](auto alter) {
    QueryHit other = hit;
    alter(other);
    return other;
  };
  // Each altered hit comes after `hit` in the order, because of the first field that differs, although all later fields
  // are smaller.
  const auto later = [&](auto alter) {
    QueryHit first = hit, second = hit;
    alter(first, second);
    EXPECT_TRUE(HitOrder{}(first, second));
    EXPECT_FALSE(HitOrder{}(second, first));
  };
  EXPECT_FALSE(HitOrder{}(hit, hit));
  const QueryHit small = altered([](QueryHit& h) {
    h.distance = Real(1.0);
    h.body = {2, 1};
    h.triangle = 1;
  });
  later([&](QueryHit& first, QueryHit& second) {
    second = small;
    first.undecided = true;
    second.fraction = Fraction(0.75);
  });
  later([&](QueryHit& first, QueryHit& second) {
    second = small;
    first.undecided = true;
    second.distance = Real(3.0);
  });
  later([&](QueryHit&, QueryHit& second) {
    second.body = small.body;
    second.triangle = small.triangle;
    second.undecided = true;
  });
  later([&](QueryHit& first, QueryHit& second) {
    first.undecided = second.undecided = true;
    second.body = {4, 1};
    second.triangle = small.triangle;
  });
  later([&](QueryHit&, QueryHit& second) { second.triangle = 8; });
}

DETENT_TEST(query, of_hits_as_near_the_decided_one_is_first_in_whatever_order_they_are_found) {
  QueryHit decided, undecided;
  decided.body = {5, 1};
  undecided.body = {2, 1};
  undecided.undecided = true;
  decided.distance = undecided.distance = Real(1.0);
  for (const bool all : {false, true}) {
    for (const bool swapped : {false, true}) {
      QueryHit hits[2];
      QueryReport report;
      HitCollector collector(all, {hits, 2}, Fraction(1.0), Real(16.0));
      collector.add(swapped ? undecided : decided);
      collector.add(swapped ? decided : undecided);
      collector.finish(report);
      ASSERT_EQ(report.hits, all ? 2u : 1u);
      EXPECT_EQ(report.undecided, all ? 1u : 0u);
      EXPECT_EQ(hits[0].body, decided.body);
      if (all) {
        EXPECT_EQ(hits[1].body, undecided.body);
      }
    }
  }
}

DETENT_TEST(query, a_body_that_cannot_be_asked_is_an_undecided_hit_where_its_bounds_begin) {
  Place place({3, 4, 2});
  BodyDef def;
  def.type = BodyType::fixed;
  def.shape = hull(0);
  def.position = position_near({{5, 0, 0}});
  const BodyId unknown = place.add(def);
  const BodyId behind = place.add_fixed(sphere(Real(0.5)), 8, 0, 0);
  const BodyId before = place.add_fixed(sphere(Real(0.5)), 2, 0, 0);
  place.world.hooks.assets = {};
  for (int i = 0; i < 2; ++i) {
    Answer answer = ask(query_ray, place.world, ray_along(10));
    ASSERT_EQ(answer.hits.size(), 3u);
    EXPECT_EQ(answer.report.undecided, 1u);
    EXPECT_EQ(answer.hits[0].body, before);
    EXPECT_EQ(answer.hits[1].body, unknown);
    EXPECT_TRUE(answer.hits[1].undecided);
    EXPECT_GT(fraction_to_host(answer.hits[1].fraction), 0.3);
    EXPECT_LT(fraction_to_host(answer.hits[1].fraction), 0.5);
    EXPECT_EQ(answer.hits[2].body, behind);
    EXPECT_EQ(ask(query_ray, place.world, ray_along(10), false).hits.at(0).body, before);
    EXPECT_TRUE(ask(query_ray, place.world, ray_along(4), true).hits.size() == 1);
    RayQuery ray = ray_along(10);
    ray.filter.ignore = before;
    answer = ask(query_ray, place.world, ray, false);
    EXPECT_EQ(answer.hits.at(0).body, unknown);
    EXPECT_EQ(answer.report.undecided, 1u);
    ClosestQuery closest;
    closest.position = position_near({{6.5, 0, 0}});
    answer = ask(query_closest, place.world, closest);
    ASSERT_EQ(answer.hits.size(), 3u);
    EXPECT_TRUE(answer.hits[0].body == behind || answer.hits[0].undecided);
    EXPECT_EQ(answer.report.undecided, 1u);
    step(place.world);
  }
}

#if !defined(DETENT_FX32)  // whose world ends before
DETENT_TEST(query, a_plane_is_hit_however_far_its_position_is) {
  Place place({1, 1, 2});
  place.add_fixed(half_space(), 0, 0, 0);
  for (const double far : {1e3, 5e4, 1e5, 1e8}) {
    RayQuery ray;
    ray.origin = position_near({{far, 10, -far}});
    ray.displacement = reals_near({{5, -20, 0}});
    const Answer answer = ask(query_ray, place.world, ray);
    ASSERT_EQ(answer.hits.size(), 1u) << far;
    EXPECT_FALSE(answer.hits[0].undecided);
    EXPECT_NEAR(fraction_to_host(answer.hits[0].fraction), 0.5, 1e-4);
    EXPECT_NEAR(coord_to_host(answer.hits[0].point.x), far + 2.5, 1e-2);
    EXPECT_NEAR(coord_to_host(answer.hits[0].point.y), 0, 1e-3);
  }
}
#endif

#if !defined(DETENT_FX32)
/// A ball of 16 km, 30 to 60 km above a plane that leans in all directions, moves 28 km towards it: nearly as far as is
/// legal. From 60 km it does not reach the plane.
DETENT_TEST(query, a_large_ball_hits_a_plane_from_high_above) {
  Place place({1, 1, 2});
  const double part = 16383, way = part * sqrt(3.0), angle = acos(1 / sqrt(3.0));
  BodyDef ground;
  ground.type = BodyType::fixed;
  ground.shape = half_space();
  // Rotates the y axis to (1, 1, 1) / sqrt(3).
  const double sine = sin(angle / 2) / sqrt(2.0);
  ground.rotation = rotation_near({sine, 0, -sine, cos(angle / 2)});
  place.add(ground);
  for (const double height : {30e3, 40e3, 60e3}) {
    CastQuery cast;
    cast.shape = sphere(Real(16000.0));
    const double at = height / sqrt(3.0);
    cast.position = position_near({{at, at, at}});
    cast.displacement = reals_near({{-part, -part, -part}});
    const Answer answer = ask(query_cast, place.world, cast);
    const double fraction = (height - 16000) / way;
    const bool reaches = fraction < 1;
    ASSERT_EQ(answer.hits.size(), reaches ? 1u : 0u) << height;
    if (reaches) {
      EXPECT_NEAR(fraction_to_host(answer.hits[0].fraction), fraction, 1e-4) << height;
    }
  }
}
#endif

DETENT_TEST(query, what_is_out_of_range_is_refused_and_writes_nothing) {
  Place place = make_row(2);
  QueryHit hit;
  QueryReport report;
  hit.body = {77, 77};
  report.hits = 77;
  const QueryHits out = {&hit, 1};
  RayQuery ray;
  ray.displacement.x = Real(16384.0);
  EXPECT_EQ(query_ray(place.world, ray, out, report), Status::out_of_range);
  CastQuery cast;
  cast.shape = half_space();
  EXPECT_EQ(query_cast(place.world, cast, out, report), Status::bad_argument);
  cast.shape = sphere(Real(-1.0));
  EXPECT_EQ(query_cast(place.world, cast, out, report), Status::out_of_range);
  cast.shape = hull(2);
  EXPECT_EQ(query_cast(place.world, cast, out, report), Status::out_of_range);
  cast.shape = sphere(Real(1.0));
  cast.rotation.w = Unit(0.5);
  EXPECT_EQ(query_cast(place.world, cast, out, report), Status::not_normalised);
  cast.rotation.w = Unit(1.0);
  cast.rotation_vector = {Real(60000.0), Real(60000.0), Real(0.0)};
  EXPECT_EQ(query_cast(place.world, cast, out, report), Status::out_of_range);
  ClosestQuery closest;
  closest.distance_max = Real(-1.0);
  EXPECT_EQ(query_closest(place.world, closest, out, report), Status::out_of_range);
  closest.distance_max = Real(16385.0);
  EXPECT_EQ(query_closest(place.world, closest, out, report), Status::out_of_range);
  OverlapQuery within;
  within.rotation = {Unit(0.0), Unit(0.0), Unit(0.0), Unit(0.0)};
  EXPECT_EQ(query_overlap(place.world, within, out, report), Status::not_normalised);
  BoundsQuery bounds;
  bounds.lower.x = Coord(1.0);
  EXPECT_EQ(query_bounds(place.world, bounds, out, report), Status::out_of_range);
#if !DETENT_FIXED
  ray.displacement.x = Real(NAN);
  EXPECT_EQ(query_ray(place.world, ray, out, report), Status::out_of_range);
  cast.rotation_vector = k_none;
  cast.displacement.y = Real(NAN);
  EXPECT_EQ(query_cast(place.world, cast, out, report), Status::out_of_range);
#endif
  EXPECT_EQ(hit.body.slot, 77u);
  EXPECT_EQ(report.hits, 77u);
}

DETENT_TEST(query, a_ray_over_a_thousand_resting_bodies_looks_at_few_of_them) {
  Place place({1025, 8, 2});
  for (uint32_t i = 0; i < 1024; ++i)
    place.add_fixed(box(reals_near({{0.5, 0.5, 0.5}})), 3.0 * (i % 32), 0.5, 3.0 * (i / 32));
  step(place.world);
  const StateView<uint8_t> state = view_of(place.world);
  const StepCacheView cache = cache_of(place.world.block, state.layout, {1025, 8, 2});
  uint32_t looks = 0, found = 0;
  const Vec64 none = {0, 0, 0}, displacement = {int64_t{90} << 46, 0, int64_t{80} << 46};
  const SweptBox box_there(position_near({{-1, 0.5, -1}}), none, displacement, 0);
  cache.tree.walk(
      [&](const Bounds& bounds) {
        ++looks;
        return box_there.meets(box_there.place_of(bounds));
      },
      [&](const Bounds& a, const Bounds& b) { return box_there.is_ahead(a, b); }, [&](uint32_t) { ++found; });
  EXPECT_LT(looks, 400u);
  EXPECT_GT(found, 2u);
  EXPECT_LT(found, 40u);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
