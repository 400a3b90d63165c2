#include <detent/body.h>
#include <detent/mover.h>
#include <detent/numbers.h>
#include <detent/world.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/unit/math/samples.h"
#include "tests/unit/shape/hull_bytes.h"
#include "tests/unit/world/lab.h"

/// Tests of a mover among bodies.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr double k_tick = 1.0 / 60, k_foot = 0.9 + 0.01;  ///< of the default mover: from its centre to its gap
constexpr double k_near = k_config == Config::fx32 ? 2e-4 : 2e-5;

/// A world and a mover in it.
struct Stage {
  Lab lab;
  MoverSettings settings;
  Mover mover;
  MoverReport report;
  double fall = 0;  ///< speed down, m/s

  explicit Stage(bool ground = true) : lab({64, 128}) {
    if (ground) lab.add_ground();
    put(0, k_foot, 0);
  }
  void put(double x, double y, double z) {
    mover = {};
    mover.position = position(x, y, z);
    fall = 0;
  }
  BodyId add_fixed(const Shape& shape, double x, double y, double z, double tilt = 0, BodyType type = BodyType::fixed) {
    BodyDef def;
    def.type = type;
    def.shape = shape;
    def.position = position(x, y, z);
    def.rotation = {unit(0), unit(0), unit(sin(tilt / 2)), unit(cos(tilt / 2))};
    return lab.add(def);
  }
  BodyId add_box(double x, double y, double z, double half_x, double half_y, double half_z, double tilt = 0,
                 BodyType type = BodyType::fixed) {
    return add_fixed(box(reals(half_x, half_y, half_z)), x, y, z, tilt, type);
  }
  void move(double x, double y, double z) { ASSERT_OK(move_mover(lab.world, settings, reals(x, y, z), mover, report)); }
  /// One tick of movement at a horizontal velocity, m/s, with gravity.
  void walk(double x, double z = 0) {
    fall += 9.81 * k_tick;
    move(x * k_tick, -fall * k_tick, z * k_tick);
    if (report.on_ground) fall = 0;
  }
  void walk_for(int ticks, double x, double z = 0) {
    for (int i = 0; i < ticks; ++i) walk(x, z);
  }
  double x() const { return coord_to_host(mover.position.x); }
  double y() const { return coord_to_host(mover.position.y); }
  double z() const { return coord_to_host(mover.position.z); }
  /// Whether the mover penetrates a body by more than this, m.
  bool overlaps(double tolerance) {
    OverlapQuery query;
    query.shape = capsule(settings.radius - real(tolerance), settings.half_length);
    query.position = mover.position;
    query.filter = settings.filter;
    QueryHit hit;
    QueryReport answer;
    EXPECT_OK(query_overlap(lab.world, query, {&hit, 1}, answer));
    return answer.hits != 0;
  }
};

bool same(const Mover& a, const Mover& b) { return memcmp(&a, &b, sizeof a) == 0; }

}  // namespace

DETENT_TEST(mover, walks_on_flat_ground_at_its_exact_speed) {
  Stage stage;
  stage.walk(0);
  ASSERT_TRUE(stage.report.on_ground);
  const Position start = stage.mover.position;
  const Vec3<Real> displacement = reals(0.0625, -0.0027, 0.03125);
  for (int i = 0; i < 600; ++i) {
    ASSERT_OK(move_mover(stage.lab.world, stage.settings, displacement, stage.mover, stage.report));
    ASSERT_TRUE(stage.report.on_ground);
    ASSERT_EQ(stage.report.contact_count, 0u);
    ASSERT_EQ(stage.report.queries, 3u);
  }
  EXPECT_EQ(coord_to_host(stage.mover.position.x) - coord_to_host(start.x), 600 * 0.0625);
  EXPECT_EQ(coord_to_host(stage.mover.position.z) - coord_to_host(start.z), 600 * 0.03125);
  EXPECT_NEAR(stage.y(), k_foot, k_near);
}

DETENT_TEST(mover, lands_from_a_fall_and_stays) {
  Stage stage;
  stage.put(0, 5, 0);
  stage.walk_for(90, 0);
  EXPECT_TRUE(stage.report.on_ground);
  EXPECT_NEAR(stage.y(), k_foot, 1e-3);
  const Mover rests = stage.mover;
  stage.walk_for(60, 0);
  EXPECT_TRUE(same(rests, stage.mover));
}

DETENT_TEST(mover, jumps_off_the_ground_and_under_a_ceiling) {
  Stage stage;
  stage.add_box(0, 2.5, 0, 4, 0.5, 4);
  stage.walk(0);
  stage.move(0, 0.05, 0);
  EXPECT_FALSE(stage.report.on_ground);
  EXPECT_NEAR(stage.y(), k_foot + 0.05, 1e-3);
  stage.move(0, 0.5, 0);
  EXPECT_NEAR(stage.y(), 2 - k_foot, 1e-3);
  EXPECT_EQ(stage.report.contact_count, 1u);
}

DETENT_TEST(mover, slides_along_a_wall) {
  Stage stage;
  stage.add_box(2, 2, 0, 0.5, 2, 40);
  stage.walk_for(120, 3, 3);
  EXPECT_NEAR(stage.x(), 1.5 - 0.31, k_near);
  EXPECT_NEAR(stage.z(), 6, 1e-3);
  ASSERT_EQ(stage.report.contact_count, 1u);
  EXPECT_NEAR(unit_to_host(stage.report.contacts[0].normal.x), -1, 1e-5);
}

DETENT_TEST(mover, stops_in_a_corner) {
  for (const double rotation_vector : {0.0, 0.4}) {
    Stage stage;
    stage.add_box(3, 2, 0, 0.5, 2, 40, 0);
    BodyDef side;
    side.type = BodyType::fixed;
    side.shape = box(reals(40, 2, 0.5));
    side.position = position(0, 2, 3);
    side.rotation = {unit(0), unit(sin(rotation_vector / 2)), unit(0), unit(cos(rotation_vector / 2))};
    stage.lab.add(side);
    stage.walk_for(150, 3, 3);
    const Mover there = stage.mover;
    stage.walk_for(30, 3, 3);
    EXPECT_NEAR(stage.x(), coord_to_host(there.position.x), 1e-3);
    EXPECT_NEAR(stage.z(), coord_to_host(there.position.z), 1e-3);
    EXPECT_FALSE(stage.overlaps(0.001));
    EXPECT_EQ(stage.report.contact_count, 2u);
    EXPECT_TRUE(stage.report.on_ground);
  }
}

DETENT_TEST(mover, climbs_and_descends_stairs) {
  for (const double height : {0.1, 0.2, 0.34}) {
    Stage stage;
    const int steps = 8;
    for (int i = 0; i < steps; ++i) {
      const double top = height * (i + 1);
      stage.add_box(2 + 0.4 * i + 10, top / 2, 0, 10, top / 2, 2);  // each reaches below those above it
    }
    stage.put(0, k_foot, 0);
    int climbed = 0;
    for (int i = 0; i < 180; ++i) {
      stage.walk(3);
      climbed += stage.report.stepped ? 1 : 0;
      ASSERT_TRUE(stage.report.on_ground) << height << " at " << stage.x();
      ASSERT_FALSE(stage.overlaps(0.001)) << height << " at " << stage.x();
    }
    EXPECT_GE(climbed, height > 0.15 ? steps : 0);
    EXPECT_NEAR(stage.y(), k_foot + steps * height, 1e-3) << height;
    EXPECT_GT(stage.x(), 7.5);
    for (int i = 0; i < 240; ++i) {
      stage.walk(-3);
      ASSERT_TRUE(stage.report.on_ground) << height << " down at " << stage.x();
    }
    EXPECT_NEAR(stage.y(), k_foot, 1e-3);
    EXPECT_LT(stage.x(), 1);
  }
}

DETENT_TEST(mover, climbs_a_step_however_slowly_it_walks) {
  Stage stage;
  stage.add_box(5, 0.15, 0, 4, 0.15, 2);
  stage.put(0.65, k_foot, 0);
  stage.walk_for(900, 0.05);
  EXPECT_NEAR(stage.y(), k_foot + 0.3, 1e-3);
}

DETENT_TEST(mover, does_not_climb_what_is_higher_than_a_step) {
  Stage stage;
  stage.add_box(5, 0.25, 0, 4, 0.25, 2);  // 0.5 m
  stage.walk_for(120, 3);
  EXPECT_NEAR(stage.y(), k_foot, 1e-3);
  EXPECT_LT(stage.x(), 1);
}

DETENT_TEST(mover, walks_on_slopes_within_its_limit_at_its_level_speed) {
  for (const double degrees : {10.0, 30.0, 44.0}) {
    Stage stage(false);
    const double angle = degrees * 3.14159265358979 / 180;
    stage.add_fixed(half_space(), 0, 0, 0, angle);
    stage.put(0, 0.6 + 0.31 / cos(angle), 0);
    stage.walk(0);
    ASSERT_TRUE(stage.report.on_ground) << degrees;
    const double x = stage.x(), y = stage.y();
    for (int i = 0; i < 60; ++i) {
      stage.walk(3);
      ASSERT_TRUE(stage.report.on_ground);
    }
    EXPECT_NEAR(stage.x() - x, 3, 1e-3) << degrees;
    EXPECT_NEAR(stage.y() - y, 3 * tan(angle), 1e-2) << degrees;
    for (int i = 0; i < 60; ++i) {
      stage.walk(-3);
      ASSERT_TRUE(stage.report.on_ground);
    }
    EXPECT_NEAR(stage.x(), x, 1e-3) << degrees;
    EXPECT_NEAR(stage.y(), y, 1e-2) << degrees;
    const Mover rests = stage.mover;
    stage.walk_for(60, 0);
    EXPECT_NEAR(stage.x(), coord_to_host(rests.position.x), k_near);  // it does not creep
  }
}

DETENT_TEST(mover, neither_climbs_nor_stands_on_what_is_steeper) {
  Stage stage;
  const double angle = 50 * 3.14159265358979 / 180;
  stage.add_fixed(half_space(), 2, 0, 0, angle);
  stage.walk_for(180, 3);
  EXPECT_LT(stage.y(), k_foot + 0.01);
  stage.put(6, 8, 0);
  int stood = 0;
  for (int i = 0; i < 120; ++i) {
    stage.walk(0);
    stood += stage.report.on_ground && stage.y() > k_foot + 0.1 ? 1 : 0;
  }
  EXPECT_EQ(stood, 0);
  EXPECT_TRUE(stage.report.on_ground);
  EXPECT_NEAR(stage.y(), k_foot, 0.01);
}

DETENT_TEST(mover, is_carried_by_a_platform_up_and_down_and_sideways) {
  Stage stage(false);
  BodyDef def;
  def.type = BodyType::kinematic;
  def.shape = box(reals(3, 0.5, 3));
  def.position = position(0, -0.5, 0);
  const BodyId platform = stage.lab.add(def);
  stage.put(1, k_foot, 0.5);
  stage.walk(0);
  ASSERT_TRUE(stage.report.on_ground);
  const double x = stage.x(), y = stage.y(), z = stage.z();
  const double speeds[][3] = {{0, 2, 0}, {0, -2, 0}, {4, 0, -3}, {1, 5, 2}};
  for (const auto& speed : speeds) {
    ASSERT_OK(set_velocity(stage.lab.world, platform, reals(speed[0], speed[1], speed[2]), reals(0, 0, 0)));
    for (int i = 0; i < 60; ++i) {
      stage.lab.run(1);
      stage.walk(0);
      ASSERT_TRUE(stage.report.on_ground);
      const Motion at = stage.lab.motion(platform);
      ASSERT_NEAR(stage.x() - at.position[0], x, 1e-4);
      ASSERT_NEAR(stage.y() - (at.position[1] + 0.5), y, 1e-3);
      ASSERT_NEAR(stage.z() - at.position[2], z, 1e-4);
    }
  }
}

DETENT_TEST(mover, is_carried_around_by_a_turning_platform) {
  Stage stage(false);
  BodyDef def;
  def.type = BodyType::kinematic;
  def.shape = cylinder(real(4), real(0.5));
  def.position = position(0, -0.5, 0);
  def.angular_velocity = reals(0, 1, 0);
  stage.lab.add(def);
  stage.put(3, k_foot, 0);
  stage.walk(0);
  for (int i = 1; i <= 300; ++i) {
    stage.lab.run(1);
    stage.walk(0);
    ASSERT_TRUE(stage.report.on_ground);
    ASSERT_NEAR(stage.x(), 3 * cos(i * k_tick), 2e-3);
    ASSERT_NEAR(stage.z(), -3 * sin(i * k_tick), 2e-3);
  }
}

DETENT_TEST(mover, is_stopped_by_a_wall_that_its_platform_passes) {
  Stage stage(false);
  const BodyId platform = stage.add_box(0, -0.5, 0, 10, 0.5, 3, 0, BodyType::kinematic);
  stage.add_box(3, 2, 0, 0.5, 1.9, 3);
  stage.walk(0);
  ASSERT_OK(set_velocity(stage.lab.world, platform, reals(2, 0, 0), reals(0, 0, 0)));
  for (int i = 0; i < 150; ++i) {
    stage.lab.run(1);
    stage.walk(0);
    ASSERT_FALSE(stage.overlaps(0.001));
  }
  EXPECT_NEAR(stage.x(), 2.5 - 0.31, 1e-3);
  EXPECT_TRUE(stage.report.on_ground);
}

DETENT_TEST(mover, passes_where_it_just_fits_and_says_where_it_is_squeezed) {
  Stage stage;
  stage.add_box(3, 2, 0.5 + 0.3105, 2, 2, 0.5);  // a millimetre more than it and its gaps
  stage.add_box(3, 2, -0.5 - 0.3105, 2, 2, 0.5);
  stage.walk_for(160, 3, 0.05);
  EXPECT_GT(stage.x(), 6);
  EXPECT_FALSE(stage.overlaps(0.001));

  Stage press;
  const BodyId left = press.add_box(-2, 2, 0, 0.5, 2, 3, 0, BodyType::kinematic);
  press.add_box(1, 2, 0, 0.5, 2, 3);
  ASSERT_OK(set_velocity(press.lab.world, left, reals(1, 0, 0), reals(0, 0, 0)));
  double deepest = 0;
  for (int i = 0; i < 100; ++i) {
    press.lab.run(1);
    press.walk(0);
    if (i < 70) {
      ASSERT_EQ(press.report.overlap, Real(0.0)) << i;
    }
    deepest = fmax(deepest, real_to_host(press.report.overlap));
  }
  EXPECT_GT(deepest, 0.01);
  // The walls leave a gap of 0.33 m after 100 ticks from -1.5, and the mover is between them.
  EXPECT_NEAR(press.x(), (0.5 + (-1.5 + 100 * k_tick)) / 2, 0.1);
}

DETENT_TEST(mover, does_not_pass_a_thin_wall_at_100_metres_a_second) {
  const int rounds = getenv("DETENT_EMULATED") != nullptr ? 10 : 40;
  for (int i = 0; i < rounds; ++i) {
    Stage stage;
    stage.add_box(3, 2, 0, 0.005, 3, 30);
    stage.put(0.05 * i, 1 + 0.02 * i, 0);
    for (int tick = 0; tick < 4; ++tick) {
      stage.move(100 * k_tick, 0, (i - 20) * 0.2 * k_tick);
      ASSERT_LT(stage.x(), 3 - 0.3) << i;
    }
  }
}

DETENT_TEST(mover, pushes_a_crate_by_no_more_than_its_force) {
  Stage stage;
  BodyDef def;
  def.shape = box(reals(0.5, 0.5, 0.5));
  def.position = position(1.5, 0.5, 0);
  def.mass = scaled(100);
  def.material.friction = real(0);
  const BodyId crate = stage.lab.add(def);
  double speed = 0;
  for (int i = 0; i < 60; ++i) {
    stage.walk(2);
    for (uint32_t k = 0; k < stage.report.contact_count; ++k) {
      const MoverContact& contact = stage.report.contacts[k];
      if (!(contact.body == crate)) continue;
      ASSERT_LE(scaled_to_host(contact.impulse.x), 500 * k_tick * 1.001);
      ASSERT_OK(apply_impulse_at_point(stage.lab.world, contact.body, contact.impulse, contact.point));
    }
    stage.lab.run(1);
    const double now = stage.lab.motion(crate).linear_velocity[0];
    ASSERT_LE(now - speed, 5 * k_tick * 1.01);
    speed = now;
  }
  EXPECT_NEAR(speed, 2, 0.1);
  EXPECT_FALSE(stage.overlaps(0.001));
}

DETENT_TEST(mover, gets_out_of_what_it_is_put_into) {
  for (const double depth : {0.05, 0.2, 0.45, 0.8}) {
    Stage stage;
    stage.add_box(2, 2, 0, 1, 2, 3);
    stage.put(1 - 0.3 + depth, k_foot, 0);
    for (int i = 0; i < 3; ++i) stage.walk(0);
    EXPECT_FALSE(stage.overlaps(0.001)) << depth;
    EXPECT_EQ(stage.report.overlap, Real(0.0));
    EXPECT_NEAR(stage.x(), 1 - 0.31, 0.01) << depth;
  }
}

DETENT_TEST(mover, stops_at_what_cannot_be_asked) {
  // A hull whose bytes the program no longer provides may lie anywhere in its bounds.
  const Asset asset = {detent_hulls::k_prism, sizeof detent_hulls::k_prism};
  constexpr Capacity k_capacity = {4, 8, 1};
  std::vector<uint64_t> block(world_bytes(k_capacity) / 8);
  WorldDef def;
  def.capacity = k_capacity;
  World world;
  ASSERT_OK(create_world(bytes_of(block), byte_count(block), def, {.assets = {&asset, 1}}, world));
  ASSERT_OK(bind_asset(world, 0));
  BodyDef rock;
  rock.type = BodyType::fixed;
  rock.shape = hull(0);
  BodyId id;
  ASSERT_OK(create_body(world, rock, id));
  world.hooks.assets = {};
  Mover mover;
  mover.position = position(-4, 0, 0);
  MoverReport report;
  uint32_t undecided = 0;
  for (int i = 0; i < 60; ++i) {
    ASSERT_OK(move_mover(world, {}, reals(0.2, 0, 0), mover, report));
    undecided += report.undecided;
  }
  EXPECT_GT(undecided, 60u);
  EXPECT_GT(coord_to_host(mover.position.x), -2);
  EXPECT_LT(coord_to_host(mover.position.x), -0.6);
}

DETENT_TEST(mover, refuses_what_is_out_of_range_and_changes_nothing) {
  Stage stage;
  stage.walk(0);
  const Mover mover = stage.mover;
  const MoverReport report = stage.report;
  const auto refused = [&](const MoverSettings& settings, const Vec3<Real>& displacement, Mover from) {
    const Mover was = from;
    const Status status = move_mover(stage.lab.world, settings, displacement, from, stage.report);
    EXPECT_TRUE(same(was, from));
    EXPECT_EQ(report.queries, stage.report.queries);
    return status;
  };
  const Vec3<Real> none = reals(0, 0, 0);
  EXPECT_EQ(refused({}, reals(0, 257, 0), mover), Status::out_of_range);
  const auto set = [](auto change) {
    MoverSettings settings;
    change(settings);
    return settings;
  };
  using S = MoverSettings;
  EXPECT_EQ(refused(set([](S& s) { s.radius = real(0); }), none, mover), Status::out_of_range);
  EXPECT_EQ(refused(set([](S& s) { s.radius = real(2000); }), none, mover), Status::out_of_range);
  EXPECT_EQ(refused(set([](S& s) { s.half_length = real(-1); }), none, mover), Status::out_of_range);
  EXPECT_EQ(refused(set([](S& s) { s.gap = real(0.2); }), none, mover), Status::out_of_range);
  EXPECT_EQ(refused(set([](S& s) { s.gap = real(0.001); }), none, mover), Status::out_of_range);
  EXPECT_EQ(refused(set([](S& s) { s.step_height = real(-1); }), none, mover), Status::out_of_range);
  EXPECT_EQ(refused(set([](S& s) { s.snap = real(300); }), none, mover), Status::out_of_range);
  EXPECT_EQ(refused(set([](S& s) { s.slope_cosine = unit(0.1); }), none, mover), Status::out_of_range);
  EXPECT_EQ(refused(set([](S& s) { s.push_force = scaled(-1); }), none, mover), Status::out_of_range);
  EXPECT_EQ(refused(set([](S& s) { s.rotation.x = unit(1); }), none, mover), Status::not_normalised);
  Mover wrong = mover;
  wrong.ground_pose.rotation.w = unit(0.5);
  EXPECT_EQ(refused({}, none, wrong), Status::not_normalised);
#if !DETENT_FIXED
  EXPECT_EQ(refused({}, {Real(NAN), Real(0), Real(0)}, mover), Status::out_of_range);
  EXPECT_EQ(refused(set([](S& s) { s.radius = Real(NAN); }), none, mover), Status::out_of_range);
#endif
  // A ground id that names no body is ignored.
  wrong = mover;
  wrong.ground = {77, 3};
  ASSERT_OK(move_mover(stage.lab.world, {}, none, wrong, stage.report));
  EXPECT_TRUE(same(wrong, mover));
}

DETENT_TEST(mover, takes_every_setting_in_range) {
  const double k_smallest = k_config == Config::fx32 ? 0.0625 : 0.001;
  for (const double radius : {k_smallest, 0.3, 1000.0}) {
    for (const double length : {0.0, radius, 1000.0}) {
      for (const double gap : {radius / 127, radius / 4}) {
        Stage stage;
        stage.add_box(radius + length + 3, 1, 0, 1, 2, 1);
        MoverSettings& settings = stage.settings;
        settings.radius = real(radius);
        settings.half_length = real(length);
        settings.gap = real(gap);
        if (radius * 1000 < length) continue;  // too thin
        stage.put(0, radius + length + gap, 0);
        for (int i = 0; i < 10; ++i) stage.move(i < 5 ? 256 : -1, -1, i == 3 ? 256 : 0);
        ASSERT_FALSE(stage.overlaps(radius / 300)) << radius << " " << length << " " << gap;
        EXPECT_TRUE(stage.report.on_ground);
      }
    }
  }
}

DETENT_TEST(mover, goes_up_another_up) {
  Stage stage(false);
  // The world lies on its side: up is -x.
  stage.add_box(0, 0, 0, 1, 30, 30);
  stage.settings.rotation = {unit(0), unit(0), unit(sqrt(0.5)), unit(sqrt(0.5))};  // a quarter turn about z: y to -x
  stage.put(-1 - 3, 0, 0);
  for (int i = 0; i < 60; ++i) stage.move(0.1, 0.05, 0);
  EXPECT_TRUE(stage.report.on_ground);
  EXPECT_NEAR(stage.x(), -1 - k_foot, 1e-3);
  EXPECT_NEAR(stage.y(), 3, 1e-3);
}

DETENT_TEST(mover, is_saved_and_read_back_byte_for_byte) {
  Stage stage;
  stage.walk_for(30, 2, 1);
  uint8_t bytes[k_mover_bytes], again[k_mover_bytes];
  save_mover(stage.mover, bytes);
  Mover read;
  ASSERT_OK(load_mover(bytes, read));
  EXPECT_TRUE(same(read, stage.mover));
  save_mover(read, again);
  EXPECT_EQ(memcmp(bytes, again, sizeof bytes), 0);
  memset(bytes, 0xff, sizeof bytes);
  EXPECT_NE(load_mover(bytes, read), Status::ok);
  EXPECT_TRUE(same(read, stage.mover));
}

namespace {

double between(Samples& samples, double low, double high) {
  return low + (high - low) * ldexp(static_cast<double>(samples.bits() >> 11), -53);
}

void furnish(Stage& stage, Samples& samples) {
  stage.add_box(5, 2, 0, 0.5, 3, 6);
  stage.add_box(-5, 2, 0, 0.5, 3, 6);
  stage.add_box(0, 2, 5, 6, 3, 0.5);
  stage.add_box(0, 2, -5, 6, 3, 0.5);
  for (int i = 0; i < 12; ++i) {
    BodyDef def;
    def.type = BodyType::fixed;
    const double a = between(samples, 0.1, 1), b = between(samples, 0.05, 1), c = between(samples, 0.1, 1);
    const double x = between(samples, -4, 4), y = between(samples, 0, 1.5), z = between(samples, -4, 4);
    if (fabs(x) < 1.6 && fabs(z) < 1.6) continue;  // where it begins
    const uint32_t kind = samples.below(4);
    def.shape = kind == 0   ? sphere(real(a))
                : kind == 1 ? cylinder(real(a), real(b))
                : kind == 2 ? capsule(real(a), real(b))
                            : box(reals(a, b, c));
    def.position = position(x, y, z);
    const double rotation_vector = between(samples, -1.5, 1.5),
                 tilt = samples.below(2) == 0 ? 0 : between(samples, -0.6, 0.6);
    def.rotation =
        rotated_by(rotated_by({unit(0), unit(0), unit(0), unit(1)}, reals(0, 0, tilt)), reals(0, rotation_vector, 0));
    stage.lab.add(def);
  }
}

/// Builds a room and moves through it. Returns the mover at the end.
Mover roam(uint64_t seed, int ticks, uint32_t& cut) {
  Stage stage;
  Samples samples = {seed};
  furnish(stage, samples);
  double x = 0, z = 0, up = 0;
  for (int tick = 0; tick < ticks; ++tick) {
    if (tick % 20 == 0) {
      const double speed = samples.below(8) == 0 ? 100 : 6;
      x = between(samples, -speed, speed);
      z = between(samples, -speed, speed);
      if (stage.report.on_ground && samples.below(3) == 0) up = 5;
    }
    up -= 9.81 * k_tick;
    const Mover before = stage.mover;
    stage.move(x * k_tick, up * k_tick, z * k_tick);
    cut += stage.report.slides_cut;
    if (stage.report.on_ground) up = 0;
    EXPECT_FALSE(stage.overlaps(0.001)) << "seed " << seed << " tick " << tick << " from "
                                        << coord_to_host(before.position.x) << " " << coord_to_host(before.position.y)
                                        << " " << coord_to_host(before.position.z);
    EXPECT_EQ(stage.report.undecided, 0u);
    EXPECT_LT(fabs(stage.x()), 4.5 - 0.29);
    EXPECT_LT(fabs(stage.z()), 4.5 - 0.29);
    EXPECT_GT(stage.y(), 0.89);
    if (::testing::Test::HasFailure()) break;
  }
  return stage.mover;
}

/// A room whose bodies are thrown about, also at the mover.
void be_thrown_at(uint64_t seed, uint32_t& pressed) {
  Stage stage;
  Samples samples = {seed};
  furnish(stage, samples);
  for (int i = 0; i < 8; ++i) {
    BodyDef def;
    const double size = between(samples, 0.1, 0.5);
    def.type = i < 3 ? BodyType::kinematic : BodyType::dynamic;
    def.shape = samples.below(2) == 0 ? box(reals(size, size, size)) : sphere(real(size));
    const double x = between(samples, 2, 4) * (samples.below(2) == 0 ? 1 : -1), y = between(samples, 0.5, 2);
    def.position = position(x, y, between(samples, -4, 4));
    const double speed = between(samples, 0.5, 5), side = between(samples, -1, 1);
    def.linear_velocity = reals(x > 0 ? -speed : speed, 0, side);
    stage.lab.add(def);
  }
  double x = 0, z = 0;
  for (int tick = 0; tick < 120; ++tick) {
    if (tick % 20 == 0) {
      x = between(samples, -6, 6);
      z = between(samples, -6, 6);
    }
    stage.lab.run(1);
    stage.walk(x, z);
    for (uint32_t i = 0; i < stage.report.contact_count; ++i) {
      const MoverContact& contact = stage.report.contacts[i];
      if (contact.impulse == scaleds(0, 0, 0)) continue;
      ASSERT_OK(apply_impulse_at_point(stage.lab.world, contact.body, contact.impulse, contact.point));
    }
    if (stage.report.overlap == Real(0.0)) {
      ASSERT_FALSE(stage.overlaps(0.001)) << "seed " << seed << " tick " << tick;
    } else {
      ++pressed;
    }
    ASSERT_LT(fabs(stage.x()), 4.5) << "seed " << seed << " tick " << tick;
    ASSERT_LT(fabs(stage.z()), 4.5) << "seed " << seed << " tick " << tick;
    ASSERT_GT(stage.y(), 0.6) << "seed " << seed << " tick " << tick;
  }
}

}  // namespace

DETENT_TEST(mover, says_where_it_is_pressed_and_is_never_pressed_through_a_wall) {
  const uint64_t rooms = getenv("DETENT_EMULATED") != nullptr ? 10 : 40;
  uint32_t pressed = 0;
  for (uint64_t seed = 1; seed <= rooms; ++seed) be_thrown_at(seed, pressed);
  EXPECT_LT(pressed, rooms * 6);
  if (rooms == 40) {
    EXPECT_GT(pressed, 0u);
  }
}

DETENT_TEST(mover, is_never_in_anything_in_200_rooms_and_ends_at_the_same_bits_again) {
  const uint64_t rooms = getenv("DETENT_EMULATED") != nullptr ? 50 : 200;
  uint32_t cut = 0, cut_again = 0;
  for (uint64_t seed = 1; seed <= rooms && !HasFailure(); ++seed) {
    const Mover first = roam(seed, 100, cut);
    if (seed % 4 == 0) {
      ASSERT_TRUE(same(first, roam(seed, 100, cut_again))) << seed;
    }
  }
  EXPECT_LE(cut, rooms / 2);
}

DETENT_TEST(mover, ends_its_walks_at_the_same_bits_on_every_target) {
  uint64_t sum = 0;
  uint32_t cut = 0;
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    uint8_t bytes[k_mover_bytes];
    save_mover(roam(seed, 100, cut), bytes);
    for (const uint8_t byte : bytes) sum = (sum ^ byte) * 0x100000001b3u;  // FNV-1a
  }
  const uint64_t expected = k_config == Config::fx64   ? 0x5f378c61701fcb3cu
                            : k_config == Config::fx32 ? 0x81f7af44ca1efe55u
                            : k_config == Config::f32  ? 0xa2a73a9f0f267442u
                                                       : 0xec7223ef38ef8da4u;
  EXPECT_EQ(sum, expected);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
