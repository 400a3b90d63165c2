#include <detent/distance.h>
#include <detent/query.h>
#include <detent/toi.h>
#include <math.h>

#include "contact/body_convex.h"
#include "contact/terrain_ops.h"
#include "query/query_hits.h"
#include "shape/sweep.h"
#include "state/view.h"
#include "tests/common/oracle/bodies.h"
#include "tests/unit/shape/terrains.h"

/// Queries on bodies that are meshes or height fields, compared with a test of all their triangles.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_terrains::Bytes;
using detent_terrains::field_of;
using detent_terrains::Source;

constexpr Vec3<Real> k_none = {Real(0.0), Real(0.0), Real(0.0)};

constexpr double k_place_error = 5e-5;  ///< m, of a coordinate of fx32

Vector turned(const Quaternion& q, const Vector& v) {
  return detent_oracle::axis_of(q, 0) * v[0] + detent_oracle::axis_of(q, 1) * v[1] +
         detent_oracle::axis_of(q, 2) * v[2];
}
Vector turned_back(const Quaternion& q, const Vector& v) {
  return {{dot(detent_oracle::axis_of(q, 0), v), dot(detent_oracle::axis_of(q, 1), v),
           dot(detent_oracle::axis_of(q, 2), v)}};
}

double bump(double x, double z) { return 0.4 * sin(2 * x) * sin(3 * z); }

/// Random triangles of every size and direction, with three materials.
Source soup(Samples& samples, uint32_t count) {
  Source source;
  for (uint32_t i = 0; i < count; ++i) {
    const double x = uniform(samples, -3, 3), y = uniform(samples, -3, 3), z = uniform(samples, -3, 3);
    const double size = uniform(samples, 0.05, 1.5);
    const auto corner = [&] {
      const double u = uniform(samples, -size, size), v = uniform(samples, -size, size);
      const double w = uniform(samples, -size, size);
      return detent_terrains::add_vertex(source, x + u, y + v, z + w);
    };
    const uint32_t a = corner(), b = corner(), c = corner();
    detent_terrains::add_triangle(source, a, b, c, static_cast<uint8_t>(i % 3));
  }
  return source;
}

/// A world whose asset 0 is a terrain.
class Place {
 public:
  explicit Place(const Bytes& bytes)
      : bytes_(bytes), asset_{bytes_.data(), bytes_.count()}, words_(world_bytes(k_capacity) / 8) {
    WorldDef def;
    def.capacity = k_capacity;
    EXPECT_OK(create_world(reinterpret_cast<uint8_t*>(words_.data()), world_bytes(k_capacity), def,
                           {.assets = {&asset_, 1}}, world));
    EXPECT_OK(bind_asset(world, 0));
  }
  Place(const Place&) = delete;
  BodyId add_fixed(const Shape& shape, const Position& at, const Quat& rotation = {0.0, 0.0, 0.0, 1.0}) {
    BodyDef def;
    def.type = BodyType::fixed;
    def.shape = shape;
    def.position = at;
    def.rotation = rotation;
    BodyId id;
    EXPECT_OK(create_body(world, def, id));
    return id;
  }
  BodyId add_terrain() { return add_fixed(terrain(0), {0.0, 0.0, 0.0}); }

  World world;

 private:
  static constexpr Capacity k_capacity = {4, 4, 1};
  Bytes bytes_;
  Asset asset_;
  std::vector<uint64_t> words_;
};

/// A terrain in any pose, and its parsed bytes.
struct Ground {
  Place in;
  Pose pose;
  BodyId id;
  Terrain terrain;
  uint32_t triangle_count;

  Ground(const Bytes& bytes, Samples& samples) : in(bytes) {
    const Position at = position_near(any_direction(samples) * 40);
    id = in.add_fixed(detent::terrain(0), at, rotation_near(any_rotation(samples)));
    EXPECT_OK(get_pose(in.world, id, pose));
    terrain = terrain_view(in.world.hooks.assets.assets[0].bytes);
    triangle_count = terrain.is_mesh ? terrain.mesh.triangle_count : terrain.field.triangle_count();
  }
  Position place(const Vector& v) const { return moved(pose.position, reals_near(v)); }
};

Shape any_shape(Samples& samples) {
  const double size = uniform(samples, 0.05, 0.6), other = uniform(samples, 0.05, 0.6);
  const Shape shapes[] = {sphere(real_near(size)), capsule(real_near(size), real_near(other)),
                          box(reals_near({{size, other, size}})), cylinder(real_near(size), real_near(other)),
                          rounded(cone(real_near(size), real_near(other)), real_near(0.1))};
  return shapes[samples.below(5)];
}

Convex convex_of(const Shape& shape) {
  BodyProperties properties{};
  Convex convex;
  EXPECT_OK(set_shape_properties(shape, properties, {}));
  EXPECT_TRUE(body_convex(properties, {}, convex));
  return convex;
}

/// Whether a hit with this normal, or without a normal at the position `at`, is on the back of the triangle.
bool from_behind(const Ground& ground, const TerrainTriangle& t, const Vec3<Unit>& normal, const Position& at) {
  const Quaternion q = host(ground.pose.rotation);
  const Vector front = turned(q, host(units_from_raw(normal_of(t.corner[0], t.corner[1], t.corner[2]))));
  if (!(normal == Vec3<Unit>{Unit(0.0), Unit(0.0), Unit(0.0)})) return dot(front, host(normal)) < 0;
  const int power = ground.terrain.exponent() - 30;
  const Vector corner = {{ldexp(t.corner[0].x, power), ldexp(t.corner[0].y, power), ldexp(t.corner[0].z, power)}};
  return dot(front, difference(at, ground.pose.position) - turned(q, corner)) < 0;
}

/// The first hit of all triangles, as `hit_of(convex, placed, hit)` finds it.
template <class HitOf>
bool first_of_all(const Ground& ground, const Position& at, const HitOf& hit_of, QueryHit& first) {
  bool found = false;
  for (uint32_t i = 0; i < ground.triangle_count; ++i) {
    const TerrainTriangle t = ground.terrain.triangle(i);
    Convex convex;
    Pose placed;
    EXPECT_OK(terrain_convex(ground.terrain, ground.pose, i, placed, convex));
    QueryHit hit;
    hit.body = ground.id;
    hit.triangle = i;
    hit.material = t.material;
    if (!hit_of(convex, placed, hit)) continue;
    if (ground.terrain.one_sided() && from_behind(ground, t, hit.normal, at)) continue;
    if (found && !HitOrder{}(hit, first)) continue;
    found = true;
    first = hit;
  }
  return found;
}

bool same(const QueryHit& a, const QueryHit& b) {
  return a.body == b.body && a.undecided == b.undecided && a.fraction == b.fraction && a.distance == b.distance &&
         a.point == b.point && a.normal == b.normal && a.triangle == b.triangle && a.material == b.material;
}

struct Counts {
  uint32_t cast = 0, closest = 0, overlap = 0;
};

void expect_cast(const Ground& ground, const CastQuery& query, Counts& counts) {
  const Convex moving = convex_of(query.shape);
  const Motion motion = {{query.position, query.rotation}, query.displacement, query.rotation_vector};
  QueryHit expected, hit;
  QueryReport report;
  const bool found = first_of_all(
      ground, query.position,
      [&](const Convex& convex, const Pose& placed, QueryHit& at) {
        TimeOfImpact impact;
        EXPECT_OK(time_of_impact(convex, {placed, k_none, k_none}, moving, motion, impact));
        EXPECT_NE(impact.outcome, ToiOutcome::undecided);
        at.fraction = impact.time;
        at.point = moved(placed.position, impact.point);
        at.normal = impact.normal;
        return impact.outcome == ToiOutcome::hit;
      },
      expected);
  ASSERT_OK(query_cast(ground.in.world, query, {&hit, 1}, report));
  ASSERT_EQ(report.hits, found ? 1u : 0u);
  ASSERT_TRUE(!found || same(hit, expected)) << hit.triangle << " for " << expected.triangle;
  counts.cast += report.hits;
}

void expect_near(const Ground& ground, const ClosestQuery& query, Counts& counts) {
  const Convex shape = convex_of(query.shape);
  const Pose at = {query.position, query.rotation};
  for (const bool overlaps : {false, true}) {
    QueryHit expected, hit;
    QueryReport report;
    const Real distance_max = overlaps ? Real(0.0) : query.distance_max;
    const bool found = first_of_all(
        ground, query.position,
        [&](const Convex& convex, const Pose& placed, QueryHit& there) {
          Closest closest;
          EXPECT_OK(closest_points(convex, placed, shape, at, closest));
          EXPECT_FALSE(closest.capped);
          there.distance = closest.distance;
          there.point = moved(placed.position, closest.point_a);
          there.normal = closest.normal;
          return closest.distance <= distance_max;
        },
        expected);
    if (overlaps) {
      ASSERT_OK(
          query_overlap(ground.in.world, {query.shape, query.position, query.rotation, {}, false}, {&hit, 1}, report));
    } else {
      ASSERT_OK(query_closest(ground.in.world, query, {&hit, 1}, report));
    }
    ASSERT_EQ(report.hits, found ? 1u : 0u);
    ASSERT_TRUE(!found || same(hit, expected)) << hit.triangle << " for " << expected.triangle;
    (overlaps ? counts.overlap : counts.closest) += report.hits;
  }
}

DETENT_TEST(terrain_queries, answer_what_asking_all_triangles_answers) {
  Samples samples = {31};
  Counts counts;
  const uint32_t rounds = detent_oracle::rounds(80);
  for (uint32_t kind = 0; kind < 5; ++kind) {
    const Bytes bytes = kind == 0   ? field_of(10, 0.6, bump, false)
                        : kind == 1 ? field_of(10, 0.6, bump, true)
                        : kind == 2 ? detent_terrains::cooked(detent_terrains::box_terrain(2, 1, 3, 4), true)
                                    : detent_terrains::cooked(soup(samples, 120), kind == 3);
    const Ground ground(bytes, samples);
    for (uint32_t n = 0; n < rounds; ++n) {
      const Vector from = any_direction(samples) * uniform(samples, 0, 7);
      const Vector to = any_direction(samples) * uniform(samples, 0, 3);
      CastQuery cast;
      cast.shape = any_shape(samples);
      cast.position = ground.place(from);
      cast.rotation = rotation_near(any_rotation(samples));
      cast.displacement = reals_near((to - from) * uniform(samples, 0.5, 3));
      if (n % 2 == 0) cast.rotation_vector = reals_near(any_direction(samples) * uniform(samples, 0, 4));
      expect_cast(ground, cast, counts);
      ClosestQuery closest;
      closest.shape = cast.shape;
      closest.position = cast.position;
      closest.rotation = cast.rotation;
      closest.distance_max = real_near(uniform(samples, 0, 4));
      expect_near(ground, closest, counts);
      if (testing::Test::HasFatalFailure()) FAIL() << kind << ", " << n;
    }
  }
  const uint32_t part = detent_oracle::rounds(80);
  EXPECT_GT(counts.cast, 2 * part);
  EXPECT_GT(counts.closest, 2 * part);
  EXPECT_GT(counts.overlap, part / 2);
}

/// Rays from inside a closed room to its edges and corners, for any pose of the room.
DETENT_TEST(terrain_queries, no_ray_leaves_a_closed_room) {
  Samples samples = {32};
  const Ground ground(detent_terrains::cooked(detent_terrains::box_terrain(1, 1, 1, 4)), samples);
  const Quaternion q = host(ground.pose.rotation);
  const uint32_t rounds = detent_oracle::rounds(2000);
  for (uint32_t n = 0; n < rounds; ++n) {
    const auto grid = [&] { return 0.5 * static_cast<double>(samples.below(5)) - 1; };
    Vector target = {{grid(), grid(), grid()}};
    // A target on a wall, an edge or a corner; every second target has a random x coordinate.
    const int axis = static_cast<int>(n % 2 == 0 ? 1 + samples.below(2) : samples.below(3));
    target[axis] = samples.below(2) == 0 ? -1 : 1;
    if (n % 2 == 0) target[0] = uniform(samples, -1, 1);
    const double far = uniform(samples, 0, 0.9);
    const Vector from = any_direction(samples) * far;
    RayQuery ray;
    ray.origin = ground.place(turned(q, from));
    ray.displacement = reals_near(turned(q, (target - from) * 8));
    QueryHit hit;
    QueryReport report;
    ASSERT_OK(query_ray(ground.in.world, ray, {&hit, 1}, report));
    ASSERT_EQ(report.hits, 1u) << n;
    ASSERT_EQ(report.undecided, 0u);
    const TerrainTriangle t = ground.terrain.triangle(hit.triangle);
    EXPECT_EQ(hit.material, t.material);
    const Vector at = turned_back(q, difference(hit.point, ground.pose.position));
    double farthest = 0;
    for (int k = 0; k < 3; ++k) farthest = fmax(farthest, fabs(at[k]));
    ASSERT_NEAR(farthest, 1, k_place_error) << n;
    ASSERT_LT(dot(host(hit.normal), turned(q, target - from)), 0);
  }
}

DETENT_TEST(terrain_queries, of_one_side_let_through_what_comes_from_behind) {
  for (const bool one_sided : {false, true}) {
    Place lab(detent_terrains::cooked(detent_terrains::plane(8, 1), one_sided));
    lab.add_terrain();
    for (const bool up : {false, true}) {
      const uint32_t expected = up && one_sided ? 0 : 1;
      QueryHit hit;
      QueryReport report;
      RayQuery ray;
      ray.origin = position_near({{0.3, up ? -2.0 : 2.0, 0.2}});
      ray.displacement = reals_near({{0.1, up ? 4.0 : -4.0, 0.1}});
      ASSERT_OK(query_ray(lab.world, ray, {&hit, 1}, report));
      EXPECT_EQ(report.hits, expected);
      CastQuery cast;
      cast.shape = sphere(real_near(0.2));
      cast.position = ray.origin;
      cast.displacement = ray.displacement;
      ASSERT_OK(query_cast(lab.world, cast, {&hit, 1}, report));
      EXPECT_EQ(report.hits, expected);
      ClosestQuery closest;
      closest.shape = cast.shape;
      closest.position = ray.origin;
      ASSERT_OK(query_closest(lab.world, closest, {&hit, 1}, report));
      EXPECT_EQ(report.hits, expected);
    }
  }
}

/// Without the bytes the terrain cannot be tested: the hit is reported where its bounds begin.
DETENT_TEST(terrain_queries, never_say_no_hit_for_what_cannot_be_asked) {
  Place lab(detent_terrains::cooked(detent_terrains::plane(8, 1)));
  const BodyId id = lab.add_terrain();
  lab.world.hooks.assets = {};
  RayQuery ray;
  ray.origin = position_near({{-8, -1, 0}});
  ray.displacement = reals_near({{8, 2, 0}});
  QueryHit hit;
  QueryReport report;
  ASSERT_OK(query_ray(lab.world, ray, {&hit, 1}, report));
  ASSERT_EQ(report.undecided, 1u);
  EXPECT_TRUE(hit.body == id && hit.undecided && hit.triangle == UINT32_MAX);
  EXPECT_NEAR(fraction_to_host(hit.fraction), 0.5, 0.02);
  ClosestQuery closest;
  closest.shape = sphere(real_near(0.5));
  closest.position = position_near({{-8, 0, 0}});
  ASSERT_OK(query_closest(lab.world, closest, {&hit, 1}, report));
  ASSERT_EQ(report.undecided, 1u);
  EXPECT_NEAR(real_to_host(hit.distance), 3.5, 0.02);
}

/// A body beside the terrain keeps its place in the order, and the digest shows which triangle was hit.
DETENT_TEST(terrain_queries, sort_terrains_among_other_bodies) {
  Place lab(detent_terrains::cooked(detent_terrains::plane(8, 1)));
  const BodyId ground = lab.add_terrain();
  const BodyId above = lab.add_fixed(sphere(real_near(0.25)), position_near({{0.3, 1, 0.2}}));
  const BodyId below = lab.add_fixed(sphere(real_near(0.25)), position_near({{0.3, -1, 0.2}}));
  RayQuery ray;
  ray.origin = position_near({{0.3, 3, 0.2}});
  ray.displacement = reals_near({{0, -6, 0}});
  ray.all = true;
  QueryHit hits[3];
  QueryReport report, moved_report;
  ASSERT_OK(query_ray(lab.world, ray, {hits, 3}, report));
  ASSERT_EQ(report.hits, 3u);
  EXPECT_TRUE(hits[0].body == above && hits[1].body == ground && hits[2].body == below);
  EXPECT_EQ(hits[0].triangle, UINT32_MAX);
  EXPECT_NE(hits[1].triangle, UINT32_MAX);
  EXPECT_NEAR(fraction_to_host(hits[1].fraction), 0.5, 1e-6);
  ray.filter.ignore = ground;
  ASSERT_OK(query_ray(lab.world, ray, {hits, 3}, moved_report));
  EXPECT_EQ(moved_report.hits, 2u);
  EXPECT_NE(moved_report.digest, report.digest);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
