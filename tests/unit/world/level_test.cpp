#include <detent/contact.h>
#include <detent/mover.h>
#include <detent/world.h>
#include <math.h>

#include "tests/common/queries/random.h"
#include "tests/unit/contact/ground.h"
#include "tests/unit/shape/levels.h"

/// Bodies on real levels.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

double deepest_contact(const World& world) {
  double deepest = 0;
  for (uint32_t i = 0; i < get_info(world).contacts; ++i) {
    Contact contact;
    EXPECT_OK(get_contact(world, i, contact));
    for (uint32_t k = 0; k < contact.point_count; ++k)
      deepest = fmax(deepest, -real_to_host(contact.point[k].separation));
  }
  return deepest;
}

/// A world with a level.
struct LevelWorld {
  explicit LevelWorld(const Source& source, const WorldDef& def = {})
      : bytes(detent_terrains::cooked(source)), asset{bytes.data(), bytes.count()} {
    EXPECT_OK(storage.create(def, {.assets = {&asset, 1}}, world));
    EXPECT_OK(bind_asset(world, 0));
    BodyDef ground;
    ground.type = BodyType::fixed;
    ground.shape = terrain(0);
    BodyId id;
    EXPECT_OK(create_body(world, ground, id));
    level = terrain_view(asset.bytes);
    size = level.exponent() > 8 ? 50 : 0.5;
  }
  LevelWorld(const LevelWorld&) = delete;
  LevelWorld& operator=(const LevelWorld&) = delete;

  TerrainTriangle any_triangle(detent_queries::Random& random) const {
    return level.triangle(random.below(level.mesh.triangle_count));
  }
  double middle(const TerrainTriangle& t, int32_t Vec32::*c) const {
    return ldexp(1.0, level.exponent() - 30) * (t.corner[0].*c / 3.0 + t.corner[1].*c / 3.0 + t.corner[2].*c / 3.0);
  }

  const detent_terrains::Bytes bytes;
  const Asset asset;
  WorldStorage<Capacity{2, 8, 1}> storage;
  World world;
  Terrain level;
  double size = 0;  ///< of what is put into it, twice, m
};

/// Bodies are shot at the triangles of game levels from near them: the centre of a body never passes to the back of a
/// triangle.
DETENT_TEST(levels, are_stood_rolled_and_shot_at) {
  uint32_t levels = 0, hit = 0;
  for (const char* name : detent_terrains::k_levels) {
    Source source;
    if (!detent_terrains::read_level(name, source)) continue;
    ++levels;
    WorldDef def;
    def.tick = real_near(1.0 / 240);
    LevelWorld level(source, def);
    World& world = level.world;
    const double size = level.size;
    BodyId id;
    detent_queries::Random random(5);
    for (uint32_t n = 0; n < detent_oracle::rounds(40); ++n) {
      const TerrainTriangle t = level.any_triangle(random);
      const Vec32 normal = normal_of(t.corner[0], t.corner[1], t.corner[2]);
      const double side = random.sign(), away = random.uniform(1, 3) * size, speed = random.uniform(0, 200) * size;
      const double n_x = side * normal.x / 0x1p30, n_y = side * normal.y / 0x1p30, n_z = side * normal.z / 0x1p30;
      const auto at = [&](int32_t Vec32::*c, double along) { return level.middle(t, c) + along * away; };
      BodyDef body;
      body.shape = n % 3 == 0   ? sphere(real_near(0.4 * size))
                   : n % 3 == 1 ? box(reals_near(Vector{{0.4 * size, 0.25 * size, 0.3 * size}}))
                                : capsule(real_near(0.25 * size), real_near(0.4 * size));
      body.position = position_near(Vector{{at(&Vec32::x, n_x), at(&Vec32::y, n_y), at(&Vec32::z, n_z)}});
      body.linear_velocity = reals_near(Vector{{-speed * n_x, -speed * n_y, -speed * n_z}});
      body.gravity_scale = real_near(size);
      ASSERT_OK(create_body(world, body, id));
      const Pose origin = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}};
      Pose before;
      EXPECT_OK(get_pose(world, id, before));
      for (int tick = 0; tick < 240; ++tick) {
        const StepReport report = step(world);
        hit += report.ccd.impacts != 0 || report.contacts.count != 0 ? 1 : 0;
        if (tick == 0 && (report.ccd.overlaps_left != 0 || deepest_contact(world) > 0.05 * size))
          break;  // made within the level
        Pose now;
        EXPECT_OK(get_pose(world, id, now));
        const auto displacement = [](Coord from, Coord to) {
          return real_near(coord_to_host(to) - coord_to_host(from));
        };
        const Position &p = before.position, &q = now.position, &o = origin.position;
        TerrainHit found;
        ASSERT_OK(cast_ray_on_terrain(level.level, origin,
                                      {displacement(o.x, p.x), displacement(o.y, p.y), displacement(o.z, p.z)},
                                      {displacement(p.x, q.x), displacement(p.y, q.y), displacement(p.z, q.z)}, found));
        EXPECT_FALSE(found.hit) << name << ", body " << n << ", tick " << tick;
        if (found.hit) break;
        before = now;
      }
      EXPECT_OK(destroy_body(world, id));
    }
  }
  if (levels == 0) GTEST_SKIP() << "no meshes under DETENT_DATA";
  EXPECT_GT(hit, 1000u);
}

/// Movers that move at random through the levels never overlap a wall, and are on the ground after more than a quarter
/// of the moves.
DETENT_TEST(levels, are_walked_through) {
  uint32_t levels = 0, grounded = 0, moves = 0;
  for (const char* name : detent_terrains::k_levels) {
    Source source;
    if (!detent_terrains::read_level(name, source)) continue;
    ++levels;
    LevelWorld level(source);
    World& world = level.world;
    const double size = level.size;
    MoverSettings settings;
    settings.radius = real_near(0.3 * size);
    settings.half_length = real_near(0.6 * size);
    settings.gap = real_near(0.01 * size);
    settings.step_height = settings.snap = real_near(0.35 * size);
    detent_queries::Random random(7);
    for (uint32_t n = 0; n < detent_oracle::rounds(16); ++n) {
      const TerrainTriangle t = level.any_triangle(random);
      Mover mover;
      mover.position = position_near(
          Vector{{level.middle(t, &Vec32::x), level.middle(t, &Vec32::y) + 1.2 * size, level.middle(t, &Vec32::z)}});
      double fall = 0, x = 0, z = 0;
      for (int tick = 0; tick < 120; ++tick) {
        if (tick % 15 == 0) {
          const double speed = (n % 4 == 0 ? 1.6 : 0.1) * size;
          x = random.uniform(-speed, speed);
          z = random.uniform(-speed, speed);
        }
        fall += 0.002 * size;
        MoverReport report;
        ASSERT_OK(move_mover(world, settings, reals_near(Vector{{x, -fall, z}}), mover, report));
        ++moves;
        if (report.on_ground) fall = 0;
        grounded += report.on_ground ? 1 : 0;
        EXPECT_EQ(report.undecided, 0u) << name << ", " << n << ", " << tick;
        if (report.overlap != Real(0.0)) break;  // it was put into the level
        OverlapQuery query;
        query.shape = capsule(settings.radius - real_near(0.001 * size), settings.half_length);
        query.position = mover.position;
        QueryHit hit;
        QueryReport answer;
        ASSERT_OK(query_overlap(world, query, {&hit, 1}, answer));
        ASSERT_EQ(answer.hits, 0u) << name << ", " << n << ", " << tick;
      }
    }
  }
  if (levels == 0) GTEST_SKIP() << "no meshes under DETENT_DATA";
  EXPECT_GT(moves, levels * detent_oracle::rounds(1000));
  EXPECT_GT(grounded, moves / 4);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
