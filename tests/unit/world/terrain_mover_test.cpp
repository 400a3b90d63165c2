#include <detent/mover.h>
#include <math.h>

#include "tests/common/oracle/effort.h"
#include "tests/common/queries/random.h"
#include "tests/unit/world/terrain_lab.h"

/// A mover on meshes and height fields.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_terrains::Source;

constexpr double k_tick = 1.0 / 60, k_foot = 0.9 + 0.01;  ///< of the default mover: from its centre to its gap
constexpr double k_near = k_config == Config::fx32 ? 2e-4 : 2e-5;

struct Walker {
  TerrainLab lab;
  BodyId ground;
  MoverSettings settings = {};
  Mover mover = {};
  MoverReport report = {};
  double fall = 0;  ///< speed down, m/s

  explicit Walker(const Bytes& bytes, BodyType type = BodyType::fixed) : lab(bytes) {
    BodyDef def = lab.ground_def();
    def.type = type;
    ground = lab.add(def);
  }
  void put(double x, double y, double z) {
    mover = {};
    mover.position = position(x, y, z);
    fall = 0;
  }
  void move(double x, double y, double z) { ASSERT_OK(move_mover(lab.world, settings, reals(x, y, z), mover, report)); }
  /// One tick of movement at a horizontal velocity, m/s, with gravity.
  void walk(double x, double z = 0) {
    fall += 9.81 * k_tick;
    move(x * k_tick, -fall * k_tick, z * k_tick);
    if (report.on_ground) fall = 0;
  }
  double x() const { return coord_to_host(mover.position.x); }
  double y() const { return coord_to_host(mover.position.y); }
  double z() const { return coord_to_host(mover.position.z); }
  bool overlaps() {
    OverlapQuery query;
    query.shape = capsule(settings.radius - real(0.001), settings.half_length);
    query.position = mover.position;
    QueryHit hit;
    QueryReport answer;
    EXPECT_OK(query_overlap(lab.world, query, {&hit, 1}, answer));
    return answer.hits != 0;
  }
};

/// A mesh with steps, 4 m wide, that ascend along x from 2 m on, and with the floor in front of them.
Source stairs(uint32_t steps, double height, double depth) {
  Source source;
  double x = -4, y = 0;
  uint32_t a = detent_terrains::add_vertex(source, x, y, -2), b = detent_terrains::add_vertex(source, x, y, 2);
  const auto to = [&](double to_x, double to_y) {
    const uint32_t c = detent_terrains::add_vertex(source, to_x, to_y, -2);
    const uint32_t d = detent_terrains::add_vertex(source, to_x, to_y, 2);
    detent_terrains::add_triangle(source, a, b, d);
    detent_terrains::add_triangle(source, a, d, c);
    a = c;
    b = d;
    x = to_x;
    y = to_y;
  };
  to(2, 0);
  for (uint32_t i = 0; i < steps; ++i) {
    to(x, y + height);
    to(i + 1 < steps ? x + depth : x + 8, y);
  }
  return source;
}

DETENT_TEST(mover_on_terrains, walks_over_inner_edges_at_its_exact_speed) {
  const Bytes terrains[] = {detent_terrains::cooked(detent_terrains::plane(60, 0.31)),
                            field_of(
                                60, 0.31, [](double, double) { return 0.0; }, true)};
  for (const Bytes& bytes : terrains) {
    Walker walker(bytes);
    walker.put(-8, k_foot, -4);
    walker.walk(0);
    ASSERT_TRUE(walker.report.on_ground);
    const Position start = walker.mover.position;
    for (int i = 0; i < 240; ++i) {
      walker.move(0.0625, -0.0027, 0.03125);
      ASSERT_TRUE(walker.report.on_ground) << i;
      ASSERT_EQ(walker.report.contact_count, 0u) << i;
      ASSERT_EQ(walker.report.queries, 3u) << i;
    }
    EXPECT_EQ(coord_to_host(walker.mover.position.x) - coord_to_host(start.x), 240 * 0.0625);
    EXPECT_EQ(coord_to_host(walker.mover.position.z) - coord_to_host(start.z), 240 * 0.03125);
    EXPECT_NEAR(walker.y(), k_foot, k_near);
  }
}

DETENT_TEST(mover_on_terrains, walks_on_slopes_within_its_limit_alone) {
  for (const double degrees : {20.0, 44.0, 50.0, 65.0}) {
    const double slope = tan(degrees * 3.14159265358979 / 180);
    Walker walker(field_of(
        40, 0.5, [&](double x, double) { return x > 0 ? slope * x : 0; }, false));
    walker.put(-2, k_foot, 0.13);
    double level = 0;
    for (int i = 0; i < 120; ++i) {
      const double before = walker.x();
      walker.walk(3);
      ASSERT_TRUE(walker.report.on_ground) << degrees << ", " << i;
      if (i >= 70) level = fmax(level, fabs(walker.x() - before - 3 * k_tick));
    }
    if (degrees < 45) {
      EXPECT_LT(level, 1e-3) << degrees;
      EXPECT_NEAR(walker.x(), 4, 0.02) << degrees;
      EXPECT_GT(walker.y(), k_foot + 3.5 * slope) << degrees;
    } else {
      EXPECT_LT(walker.x(), 0.2) << degrees;
      EXPECT_LT(walker.y(), k_foot + 0.4) << degrees;
    }
  }
}

DETENT_TEST(mover_on_terrains, climbs_and_descends_stairs_of_a_mesh) {
  for (const bool one_sided : {false, true}) {
    Walker walker(detent_terrains::cooked(stairs(8, 0.2, 0.4), one_sided));
    walker.put(0, k_foot, 0.1);
    int climbed = 0;
    for (int i = 0; i < 180; ++i) {
      walker.walk(3);
      climbed += walker.report.stepped ? 1 : 0;
      ASSERT_TRUE(walker.report.on_ground) << walker.x();
      ASSERT_FALSE(walker.overlaps()) << walker.x();
    }
    EXPECT_GE(climbed, 8);
    EXPECT_NEAR(walker.y(), k_foot + 8 * 0.2, 1e-3);
    for (int i = 0; i < 200; ++i) {
      walker.walk(-3);
      ASSERT_TRUE(walker.report.on_ground) << "down at " << walker.x();
    }
    EXPECT_NEAR(walker.y(), k_foot, 1e-3);
  }
}

DETENT_TEST(mover_on_terrains, slides_along_the_walls_of_a_room_and_stops_in_its_corner) {
  Walker walker(detent_terrains::cooked(detent_terrains::box_terrain(4, 3, 5, 3)));
  walker.put(2, -3 + k_foot, 0);
  for (int i = 0; i < 60; ++i) {
    walker.walk(3, 2);
    ASSERT_TRUE(walker.report.on_ground) << i;
  }
  EXPECT_NEAR(walker.x(), 4 - 0.31, 1e-3);
  EXPECT_NEAR(walker.z(), 2, 1e-2);  // what slides loses no speed
  ASSERT_EQ(walker.report.contact_count, 1u);
  EXPECT_NEAR(unit_to_host(walker.report.contacts[0].normal.x), -1, 1e-4);
  for (int i = 0; i < 120; ++i) walker.walk(3, 2);
  EXPECT_NEAR(walker.z(), 5 - 0.31, 1e-3);
  EXPECT_EQ(walker.report.contact_count, 2u);
  EXPECT_TRUE(walker.report.on_ground);
  EXPECT_FALSE(walker.overlaps());
}

DETENT_TEST(mover_on_terrains, never_leaves_a_closed_room) {
  detent_queries::Random random(5);
  Walker walker(detent_terrains::cooked(detent_terrains::box_terrain(4, 3, 5, 3)));
  walker.put(0, 0, 0);
  const uint32_t rounds = detent_oracle::rounds(1500);
  for (uint32_t n = 0; n < rounds; ++n) {
    const double speed = n % 3 == 0 ? 5 : 100;
    const double x = random.uniform(-speed, speed), y = random.uniform(-speed, speed);
    const double z = random.uniform(-speed, speed);
    walker.move(x * k_tick, y * k_tick, z * k_tick);
    ASSERT_LT(fabs(walker.x()), 4 - 0.3) << n;
    ASSERT_LT(fabs(walker.y()), 3 - 0.9) << n;
    ASSERT_LT(fabs(walker.z()), 5 - 0.3) << n;
    ASSERT_EQ(walker.report.undecided, 0u) << n;
  }
}

DETENT_TEST(mover_on_terrains, walks_over_hills_and_is_never_in_them) {
  detent_queries::Random random(6);
  const auto hills = [](double x, double z) { return 0.8 * sin(0.9 * x) * sin(1.1 * z) + 0.15 * sin(3 * x + z); };
  const Bytes terrains[] = {detent_terrains::cooked(detent_terrains::ground(40, 0.5, hills), true),
                            field_of(40, 0.5, hills, false)};
  for (const Bytes& bytes : terrains) {
    Walker walker(bytes);
    const uint32_t rounds = detent_oracle::rounds(20);
    uint32_t grounded = 0;
    for (uint32_t n = 0; n < rounds; ++n) {
      walker.put(0, 3, 0);
      const double x = random.uniform(-4, 4), z = random.uniform(-4, 4);
      for (int tick = 0; tick < 90; ++tick) {
        walker.walk(x, z);
        grounded += walker.report.on_ground ? 1 : 0;
        ASSERT_FALSE(walker.overlaps()) << n << ", " << tick;
        ASSERT_EQ(walker.report.undecided, 0u);
        ASSERT_GT(walker.y(), hills(walker.x(), walker.z()) + 0.6) << n << ", " << tick;
      }
    }
    EXPECT_GT(grounded, rounds * 30);
  }
}

DETENT_TEST(mover_on_terrains, is_carried_by_a_mesh_that_moves) {
  Walker walker(detent_terrains::cooked(detent_terrains::plane(8, 1)), BodyType::kinematic);
  walker.put(0.2, k_foot, 0.1);
  walker.walk(0);
  ASSERT_OK(set_velocity(walker.lab.world, walker.ground, reals(1, 0.5, 0), reals(0, 0, 0)));
  for (int i = 0; i < 60; ++i) {
    walker.lab.run(1);
    walker.walk(0);
    ASSERT_TRUE(walker.report.on_ground) << i;
  }
  EXPECT_NEAR(walker.x(), 1.2, 1e-3);
  EXPECT_NEAR(walker.y(), k_foot + 0.5, 1e-3);
}

DETENT_TEST(mover_on_terrains, gets_out_of_a_wall_that_it_is_put_into) {
  for (const double depth : {0.05, 0.2, 0.28}) {
    Walker walker(detent_terrains::cooked(detent_terrains::box_terrain(4, 3, 5, 3)));
    walker.put(4 - 0.3 + depth, -3 + k_foot, 0.2);
    for (int i = 0; i < 4; ++i) walker.walk(0);
    EXPECT_FALSE(walker.overlaps()) << depth;
    EXPECT_EQ(walker.report.overlap, Real(0.0)) << depth;
    EXPECT_NEAR(walker.x(), 4 - 0.31, 0.01) << depth;
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
