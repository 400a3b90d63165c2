#include "solver/warm_start.h"

#include "motion/contact_motion.h"
#include "motion/inverse_inertia.h"
#include "tests/unit/world/lab.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// A cube of 1 m in an island: its mass, kg, its velocity before the warm start, and what the warm start adds, m/s.
/// `turning`, `turned`: the same of the angular momentum, about the same axis.
struct Moving {
  double mass, velocity, pushed, turning = 0, turned = 0;
};

struct WarmStarted {
  std::vector<BodyProperties> properties;
  std::vector<BodyMotion> motions;
  std::vector<BodyWork> work;
  std::vector<uint32_t> island;

  explicit WarmStarted(const std::vector<Moving>& bodies)
      : properties(bodies.size()), motions(bodies.size()), work(bodies.size()) {
    for (uint32_t i = 0; i < bodies.size(); ++i) {
      const Moving& body = bodies[i];
      properties[i].type = static_cast<uint32_t>(BodyType::dynamic);
      properties[i].mass = scaled(body.mass);
      for (Scaled& axis : properties[i].inverse_inertia) axis = 6.0;
      work[i].supports = 1;
      const Matrix3 axes = matrix_from({unit(0), unit(0), unit(0), unit(1)});
      work[i].inverse_inertia = world_inverse_inertia(properties[i], axes);
      set(body.velocity, body.pushed, motions[i].linear_velocity, work[i].contact_velocity);
      set(body.turning, body.turned, motions[i].angular_momentum, work[i].contact_angular_momentum);
      island.push_back(i);
    }
  }
  static void set(double before, double added, Vec3<Real>& motion, Vec3<Real>& kept) {
    const Vec3<Real> change = {real(0), real(added), real(0)};
    motion = {real(0), real(before), real(0)};
    kept = kept_at_start(motion, change);
    motion += change;
  }
  SolverBodies bodies() { return {span(properties), span(motions), span(work)}; }
  Span<const uint32_t> all() const { return {island.data(), static_cast<uint32_t>(island.size())}; }
  /// Limits the warm start. Returns the share that is kept.
  double share() {
    const bool limited = limit_warm_start(bodies(), all());
    const double share = scaled_to_host(work[0].carried);
    for (const BodyWork& each : work) EXPECT_EQ(scaled_to_host(each.carried), share);
    EXPECT_EQ(limited, share < 1);
    return share;
  }
  template <class T>
  static Span<T> span(std::vector<T>& of) {
    return {of.data(), static_cast<uint32_t>(of.size())};
  }
};

DETENT_TEST(warm_start, is_whole_for_bodies_at_rest) {
  const double fall = -9.81 / 480;
  EXPECT_EQ(WarmStarted({{1, fall, -fall}, {1000, fall, -fall}}).share(), 1);
  // Loads that have halved: the bodies leave their support at the speed of the fall.
  EXPECT_EQ(WarmStarted({{1, fall, -1.9 * fall}}).share(), 1);
  // Spinning bodies that friction brakes.
  EXPECT_EQ(WarmStarted({{1, fall, -fall, 5, -0.1}}).share(), 1);
}

DETENT_TEST(warm_start, falls_with_the_energy_that_it_adds) {
  // p M v = 0: half of p M p. p M v = p M p / 4: three quarters of it.
  EXPECT_NEAR(WarmStarted({{3, 0, 0.25}}).share(), 0.5, 1e-6);
  EXPECT_NEAR(WarmStarted({{3, 0.0625, 0.25}}).share(), 0.25, 1e-6);
  EXPECT_EQ(WarmStarted({{3, 1, 0.25}}).share(), 0);
  // A body that rolls up a slope: gravity has made it slip by 0.07 m/s, and friction stops that.
  EXPECT_EQ(WarmStarted({{1, 2, 0.01, 2.07 / 6, -0.01}}).share(), 1);
  // Three times as much friction.
  EXPECT_NEAR(WarmStarted({{1, 2, 0.03, 2.07 / 6, -0.03}}).share(), 5.0 / 6, 1e-4);
}

DETENT_TEST(warm_start, is_whole_in_other_islands) {
  WarmStarted bodies({{3, 1, 0.25}});
  bodies.work[0].supports = 0;
  EXPECT_FALSE(limit_warm_start(bodies.bodies(), bodies.all()));
  EXPECT_EQ(real_to_host(bodies.motions[0].linear_velocity.y), 1.25);
}

DETENT_TEST(warm_start, is_taken_back_from_motions) {
  WarmStarted bodies({{2, 0, 0.5, 0, 0.25}});
  EXPECT_NEAR(bodies.share(), 0.5, 1e-6);
  EXPECT_NEAR(real_to_host(bodies.motions[0].linear_velocity.y), 0.25, 1e-6);
  EXPECT_NEAR(real_to_host(bodies.motions[0].angular_momentum.y), 0.125, 1e-6);
  const Vec3<Real> left = added_by_contacts(bodies.motions[0].linear_velocity, bodies.work[0].contact_velocity);
  EXPECT_NEAR(real_to_host(left.y), 0.25, 1e-6);
  EXPECT_NEAR(real_to_host(bodies.work[0].angular_velocity.y) * double(1 << k_angular_velocity_power), 0.75, 1e-4);
}

/// How far a box rises again that falls 0.5 m onto three others, m. `density`: of the box that falls; the others
/// have 1.
double rebound_of(double density) {
  WorldDef def;
  def.tick = real(1.0 / 120);
  Lab lab({16, 64, 0}, def);
  lab.add_ground();
  BodyDef def_box;
  def_box.shape = box(reals(0.5, 0.5, 0.5));
  def_box.density = scaled(1);
  for (int i = 0; i < 3; ++i) {
    def_box.position = position(0, 0.5 + i, 0);
    lab.add(def_box);
  }
  def_box.position = position(0, 4, 0);
  def_box.density = scaled(density);
  const BodyId heavy = lab.add(def_box);
  double lowest = 4, highest = 0;
  for (int tick = 0; tick < 360; ++tick) {
    lab.run(1);
    const double height = lab.motion(heavy).position[1];
    if (height < lowest) lowest = highest = height;
    highest = std::max(highest, height);
  }
  return highest - lowest;
}

DETENT_TEST(warm_start, does_not_throw_a_heavy_body_back) {
  // With the whole warm start: 0.33 m, 0.24 m, 0.30 m.
  EXPECT_LT(rebound_of(100), 0.1);
  EXPECT_LT(rebound_of(300), 0.04);
  EXPECT_LT(rebound_of(1000), 0.02);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
