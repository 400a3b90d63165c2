#include <math.h>

#include "state/view.h"
#include "tests/unit/world/lab.h"

/// Tests the ranges of a configuration at their limits.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr double k_momentum_error = 1e-6;  ///< of the sum of the magnitudes of the momenta before

double mass_of(Lab& lab, BodyId id) {
  Scaled mass{};
  EXPECT_OK(get_mass(lab.world, id, mass));
  return scaled_to_host(mass);
}

BodyDef ball(double radius, double mass, double x, double speed, double restitution) {
  BodyDef def;
  def.shape = sphere(real(radius));
  def.mass = scaled(mass);
  def.position = position(x, 0, 0);
  def.linear_velocity = reals(speed, 0, 0);
  def.material.restitution = real(restitution);
  return def;
}

/// Error of the momentum after a head-on hit over the momenta before, at 1 kHz without gravity.
double hit(double mass_a, double speed_a, double mass_b, double speed_b, double restitution, uint32_t& saturations) {
  WorldDef def;
  def.gravity = {0.0, 0.0, 0.0};
  def.tick = real(1e-3);
  Lab lab({2, 2, 0}, def);
  const double travel = fabs(speed_a - speed_b) * 1e-3;
  const double radius = fmax(0.5, travel);  // as big as a tick's way: no continuous collision is needed
  const BodyId a = lab.add(ball(radius, mass_a, -radius - travel, speed_a, restitution));
  const BodyId b = lab.add(ball(radius, mass_b, radius + travel * 1.5, speed_b, restitution));
  const double m_a = mass_of(lab, a), m_b = mass_of(lab, b);
  const double before = m_a * speed_a + m_b * speed_b;
  const double size = m_a * fabs(speed_a) + m_b * fabs(speed_b);
  bool touched = false;
  saturations = 0;
  for (int tick = 0; tick < 30; ++tick) {
    const StepReport report = lab.run(1);
    saturations += report.saturations;
    touched = touched || report.contacts.count != 0;
  }
  const double v_a = lab.motion(a).linear_velocity[0], v_b = lab.motion(b).linear_velocity[0];
  EXPECT_TRUE(touched);
  EXPECT_TRUE(v_a != speed_a || v_b != speed_b);
  return fabs(m_a * v_a + m_b * v_b - before) / size;
}

DETENT_TEST(range, momentum_is_kept_for_mass_ratios_of_one_to_a_hundred_million) {
  double worst = 0;
  for (const double heavy : {1e-3, 1.0, 1e3, 1e5}) {
    for (const double speed : {1.0, 30.0, 1000.0, 16000.0}) {
      for (const double restitution : {0.0, 0.5}) {
        uint32_t saturations = 0;
        worst = fmax(worst, hit(1e-3, speed, heavy, 0, restitution, saturations));
        EXPECT_EQ(saturations, 0u) << heavy << " kg at rest, " << speed << " m/s";
        worst = fmax(worst, hit(heavy, speed / 2, 1e-3, -speed / 2, 0, saturations));
        EXPECT_EQ(saturations, 0u) << heavy << " kg moving, " << speed << " m/s";
      }
    }
  }
  EXPECT_LE(worst, k_momentum_error);
  RecordProperty("momentum_error", std::to_string(worst));
}

DETENT_TEST(range, a_world_moved_far_away_does_what_it_does_at_the_origin) {
  // Beyond this distance the configuration's coordinates are coarser, or out of range.
#if defined(DETENT_FX32)
  const double k_far = 30000;
#else
  const double k_far = 1e7;
#endif
  const auto run = [](double offset) {
    Lab lab({8, 16, 0});
    BodyDef ground;
    ground.type = BodyType::fixed;
    ground.shape = half_space();
    ground.position = position(offset, offset, offset);
    lab.add(ground);
    std::vector<BodyId> ids;
    for (int i = 0; i < 5; ++i) ids.push_back(lab.add_box(0.5, offset + i / 16.0, offset + 0.5 + i, offset));
    lab.run(120);
    std::vector<double> result;
    for (const BodyId id : ids) {
      const Motion motion = lab.motion(id);
      for (const double v : motion.linear_velocity) result.push_back(v);
      Pose pose;
      EXPECT_OK(get_pose(lab.world, id, pose));
      for (const Coord p : {pose.position.x, pose.position.y, pose.position.z}) {
        result.push_back(coord_to_host(p - coord(offset)));
      }
    }
    return result;
  };
  const std::vector<double> here = run(0), there = run(k_far);
  for (size_t i = 0; i < here.size(); ++i) {
#if defined(DETENT_F64)
    EXPECT_NEAR(here[i], there[i], 1e-2);  // doubles at 10,000 km step by 2 nm, and a stack amplifies that
#else
    EXPECT_EQ(here[i], there[i]);
#endif
  }
}

DETENT_TEST(range, a_position_that_leaves_its_range_is_held_and_counted) {
#if !defined(DETENT_F64)
  Lab lab({1, 1, 0});
  BodyDef def;
  def.position.x = Coord::from_raw(static_cast<Coord::Raw>(sizeof(Coord) == 8 ? INT64_MAX : INT32_MAX));
  def.linear_velocity = reals(100, 0, 0);
  lab.add(def);
  EXPECT_GT(lab.run(1).saturations, 0u);
  EXPECT_FALSE(lab.run(1).complete());
#endif
}

DETENT_TEST(range, a_speed_that_leaves_its_range_is_held_and_counted) {
  Lab lab({1, 1, 0});
  BodyDef def;
  def.linear_velocity = reals(0, -16384, 0);
  def.gravity_scale = real(1000);
  const BodyId id = lab.add(def);
  EXPECT_GT(lab.run(1).saturations, 0u);
  EXPECT_EQ(lab.motion(id).linear_velocity[1], -16384);
}

DETENT_TEST(range, a_turn_that_leaves_its_range_is_counted_by_the_integrator_and_by_the_sweep) {
  WorldDef world;
  world.tick = real(0.25);
  for (const BodyType type : {BodyType::kinematic, BodyType::dynamic}) {
    Lab lab({2, 1, 0}, world);
    for (uint32_t i = 0; i < 2; ++i) {
      BodyDef def;
      def.type = type;
      def.shape = sphere(real(0.05));
      def.position = position(10 * i, 0, 0);
      lab.add(def);
      // A rotation of more than 2^15 rad in the tick, which a loaded state may contain.
      const Real momentum = type == BodyType::dynamic ? Real(3000.0) : Real(10000.0);
      for (uint32_t slot = 0; slot <= i; ++slot) view_of(lab.world).motions[slot].angular_momentum.y = momentum;
      EXPECT_EQ(lab.run(1).saturations, 2 * (i + 1));
    }
  }
}

DETENT_TEST(range, angular_velocity_of_sixteen_kilometres_a_second_at_the_rim_is_kept) {
  for (const double radius : {0.125, 0.5, 40.0}) {
    Lab lab({1, 1, 0});
    BodyDef def;
    def.shape = sphere(real(radius));
    def.angular_velocity = reals(0, 16000 / radius, 0);
    const BodyId id = lab.add(def);
    EXPECT_EQ(lab.run(60).saturations, 0u);
    EXPECT_NEAR(lab.motion(id).angular_velocity[1] * radius, 16000, 0.01);
  }
}

DETENT_TEST(range, a_millimetre_and_a_hundred_metres_stand_alike) {
#if !defined(DETENT_FX32)  // its smallest body is 10 cm (SPEC.md, "Numbers")
  for (const double half : {0.0005, 0.5, 50.0}) {
    WorldDef def;
    def.tick = real(sqrt(half / 0.5) / 60);  // so that a fall by its own size takes as many ticks
    Lab lab({5, 16, 0}, def);
    lab.add_ground();
    std::vector<BodyId> ids;
    for (int i = 0; i < 4; ++i) ids.push_back(lab.add_box(half, 0, half * (1 + 2 * i), 0));
    lab.run(300);
    const Motion top = lab.motion(ids.back());
    EXPECT_NEAR(top.position[1] / half, 7, 0.1) << half;
    EXPECT_NEAR(top.position[0] / half, 0, 0.02) << half;
  }
#endif
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
