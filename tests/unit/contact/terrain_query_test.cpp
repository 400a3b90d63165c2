#include "contact/terrain_query.h"

#include <detent/toi.h>
#include <math.h>

#include "tests/common/oracle/bodies.h"
#include "tests/unit/shape/terrains.h"

/// Rays, sweeps and times of impact against meshes and height fields.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using namespace detent_terrains;

constexpr double k_length_error = sizeof(Unit) == 4 && !DETENT_FIXED ? 0x1p-18 : 0x1p-24;

double bump(double x, double z) { return 0.4 * sin(2 * x) * sin(3 * z); }

Terrain terrain_of(const Bytes& bytes) {
  Terrain terrain;
  EXPECT_OK(read_terrain({bytes.data(), bytes.count()}, terrain));
  return terrain;
}

Vector corner_of(const Terrain& terrain, const TerrainTriangle& t, int k) {
  const int power = terrain.exponent() - 30;
  return {{ldexp(t.corner[k].x, power), ldexp(t.corner[k].y, power), ldexp(t.corner[k].z, power)}};
}

/// The time of the first hit of a ray, by Cramer's rule; 2 if there is none. `sure` is false near an edge.
double first_hit(const Terrain& terrain, uint32_t count, const Vector& from, const Vector& displacement, bool& sure) {
  double best = 2;
  for (uint32_t i = 0; i < count; ++i) {
    const TerrainTriangle t = terrain.triangle(i);
    const Vector a = corner_of(terrain, t, 0), u = corner_of(terrain, t, 1) - a, v = corner_of(terrain, t, 2) - a;
    const Vector n = cross(u, v);
    const double whole = dot(n, displacement);
    if (fabs(whole) < 1e-9) continue;
    const double time = dot(n, a - from) / whole;
    const Vector at = from + displacement * time - a;
    const double p = dot(cross(at, v), n) / dot(n, n), q = dot(cross(u, at), n) / dot(n, n);
    const double inside = fmin(fmin(p, q), 1 - p - q);
    if (inside < -1e-5 || time < 0 || time > 1) continue;
    if (inside < 1e-5) sure = false;
    best = fmin(best, time);
  }
  return best;
}

DETENT_TEST(terrain_query, rays_hit_what_a_search_through_all_triangles_finds_first) {
  const Bytes bytes = cooked(ground(24, 0.25, bump));
  const Terrain terrain = terrain_of(bytes);
  Samples samples = {21};
  Pose pose = {position_near({{5, -3, 2}}), {0.0, 0.0, 0.0, 1.0}};
  uint32_t hits = 0;
  for (uint32_t n = 0; n < detent_oracle::rounds(600); ++n) {
    const Vector from = any_direction(samples) * uniform(samples, 0, 8),
                 to = any_direction(samples) * uniform(samples, 0, 8);
    const Vec3<Real> origin = reals_near(from), displacement = reals_near(to - from);
    TerrainHit hit;
    ASSERT_OK(cast_ray_on_terrain(terrain, pose, origin, displacement, hit));
    bool sure = true;
    const double right = first_hit(terrain, terrain.mesh.triangle_count, from, to - from, sure);
    if (!sure) continue;
    ASSERT_EQ(hit.hit, right <= 1) << n;
    if (!hit.hit) continue;
    ++hits;
    EXPECT_NEAR(fraction_to_host(hit.time), right, 64 * k_length_error) << n;
    EXPECT_LT(dot(host(hit.normal), to - from), 0);
  }
  EXPECT_GT(hits, 100u / (getenv("DETENT_EMULATED") != nullptr ? 4 : 1));
}

DETENT_TEST(terrain_query, no_ray_gets_through_an_edge_or_a_corner) {
  const Bytes bytes = cooked(plane(16, 0.25), true);
  const Terrain terrain = terrain_of(bytes);
  const Pose pose = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}};
  for (int i = -16; i <= 16; ++i) {
    for (int j = -16; j <= 16; ++j) {
      const Vector at = {{i * 0.1171875, 0, j * 0.0625}};  // corners, edges and what is between
      const Vec3<Real> origin = reals_near(at + Vector{{0, 1, 0}});
      TerrainHit hit;
      ASSERT_OK(cast_ray_on_terrain(terrain, pose, origin, {0.0, -2.0, 0.0}, hit));
      ASSERT_TRUE(hit.hit) << i << " " << j;
      EXPECT_NEAR(fraction_to_host(hit.time), 0.5, k_length_error);
      EXPECT_NEAR(host(hit.normal.y), 1, 1e-6);
      ASSERT_OK(cast_ray_on_terrain(terrain, pose, reals_near(at + Vector{{0, -1, 0}}), {0.0, 2.0, 0.0}, hit));
      EXPECT_FALSE(hit.hit);
    }
  }
}

DETENT_TEST(terrain_query, rays_meet_a_turned_height_field_and_pass_its_holes) {
  detent_cook::HeightFieldSource source;
  source.columns = source.rows = 30;
  source.heights.assign(31 * 31, 0.25);
  source.cells.assign(900, 3);
  source.cells[31 * 5] = 0x80;  // column 5, row 5
  source.origin = {-15, 0, -15};
  const Bytes bytes(detent_cook::cook_height_field(source).bytes);
  const Terrain terrain = terrain_of(bytes);
  const Quat turned = rotation_near({0.6, 0, 0, 0.8});
  const Pose pose = {{0.0, 0.0, 0.0}, turned};
  const Vector x = detent_oracle::axis_of(host(turned), 0), y = detent_oracle::axis_of(host(turned), 1),
               z = detent_oracle::axis_of(host(turned), 2);
  for (int i = 0; i < 30; ++i) {
    const Vector at = x * (i - 14.7) + z * (-15 + 5.3) + y * 2.25;
    TerrainHit hit;
    ASSERT_OK(cast_ray_on_terrain(terrain, pose, reals_near(at), reals_near(y * -4), hit));
    EXPECT_EQ(hit.hit, i != 5);
    if (!hit.hit) continue;
    EXPECT_NEAR(fraction_to_host(hit.time), 0.5, 1e-4);
    EXPECT_EQ(hit.material, 3);
    EXPECT_NEAR(length(host(hit.normal) - y), 0, 1e-6);
  }
}

DETENT_TEST(terrain_query, what_may_be_out_of_range_is_refused) {
  const Bytes bytes = cooked(plane(2, 1));
  const Terrain terrain = terrain_of(bytes);
  const Pose pose = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}}, bent = {{0.0, 0.0, 0.0}, {0.0, 0.5, 0.0, 1.0}};
  TerrainHit hit;
  hit.triangle = 77;
  EXPECT_EQ(cast_ray_on_terrain(terrain, bent, {0.0, 1.0, 0.0}, {0.0, -2.0, 0.0}, hit), Status::not_normalised);
  EXPECT_EQ(cast_ray_on_terrain(terrain, pose, {0.0, 1.0, 0.0}, {0.0, -60000.0, 0.0}, hit), Status::out_of_range);
  EXPECT_EQ(hit.triangle, 77u);
  ASSERT_OK(cast_ray_on_terrain(terrain, pose, {0.25, 30000.0, 0.125}, {0.0, -32000.0, 0.0}, hit));
  EXPECT_TRUE(hit.hit);
  EXPECT_NEAR(fraction_to_host(hit.time), 30000.0 / 32000, 1e-6);
}

DETENT_TEST(terrain_query, triangles_that_a_swept_box_meets_give_the_time_of_impact) {
  const Bytes bytes = cooked(plane(16, 0.25));
  const Terrain terrain = terrain_of(bytes);
  Convex ball;
  ASSERT_OK(make_convex(sphere(0.125), ball));
  Samples samples = {23};
  for (uint32_t n = 0; n < detent_oracle::rounds(50); ++n) {
    const Pose pose = {position_near({{1, 2, 3}}), rotation_near(any_rotation(samples))};
    const Vector x = detent_oracle::axis_of(host(pose.rotation), 0), y = detent_oracle::axis_of(host(pose.rotation), 1);
    const Vector start = Vector{{1, 2, 3}} + y * 1.125 + x * uniform(samples, -1, 1);
    Motion falls;
    falls.start.position = position_near(start);
    falls.displacement = reals_near(y * -4);
    struct Context {
      const Terrain& terrain;
      const Pose& pose;
      const Convex& ball;
      const Motion& falls;
      double first;
      uint32_t count;
    } context = {terrain, pose, ball, falls, 2, 0};
    // The box of the sweep in the surface's axes, 2^-46 m.
    const int64_t metre = int64_t{1} << 46;
    const Vec64 low = {-2 * metre, -4 * metre, -metre / 4}, high = {2 * metre, 2 * metre, metre / 4};
    visit_terrain(
        terrain, low, high,
        [](void* opaque, uint32_t triangle) {
          Context& c = *static_cast<Context*>(opaque);
          Motion still;
          Convex convex;
          TimeOfImpact impact;
          ASSERT_OK(terrain_convex(c.terrain, c.pose, triangle, still.start, convex));
          ASSERT_OK(time_of_impact(convex, still, c.ball, c.falls, impact));
          ++c.count;
          if (impact.outcome == ToiOutcome::hit) c.first = fmin(c.first, fraction_to_host(impact.time));
        },
        &context);
    EXPECT_GE(context.count, 32u);
    EXPECT_LT(context.count, 200u);
    EXPECT_NEAR(context.first, 0.25, sizeof(Coord) == 4 ? 3e-5 : 3e-6);
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
