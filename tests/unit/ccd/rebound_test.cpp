#include <algorithm>

#include "tests/unit/ccd/impact_shots.h"

/// Bodies that rebound from each other: impacts are resolved at their times, one after the other.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

struct Sums {
  Vector momentum = {{0, 0, 0}}, angular = {{0, 0, 0}};
  double energy = 0;
  double size = 0;  ///< of the bodies' momenta
};

Sums sums_of(Lab& lab) {
  Sums sums;
  const auto state = view_of(lab.world);
  for (uint32_t i = 0; i < state.world.slots_used; ++i) {
    const double mass = scaled_to_host(state.properties[i].mass),
                 unit = std::ldexp(1.0, state.properties[i].size_exponent);
    const Vector linear_velocity = host(state.motions[i].linear_velocity),
                 turning = host(state.motions[i].angular_momentum) * unit;
    const Motion motion = lab.motion({i + 1, state.properties[i].generation});
    const Vector at = {{motion.position[0], motion.position[1], motion.position[2]}};
    const Vector angular_velocity = {
        {motion.angular_velocity[0], motion.angular_velocity[1], motion.angular_velocity[2]}};
    sums.momentum = sums.momentum + linear_velocity * mass;
    sums.angular = sums.angular + (cross(at, linear_velocity) + turning) * mass;
    sums.energy += 0.5 * mass * (dot(linear_velocity, linear_velocity) + dot(turning, angular_velocity));
    sums.size += mass * length(linear_velocity);
  }
  return sums;
}

/// The first ball moves against four others that stand in a row with gaps between them.
DETENT_TEST(rebound, a_row_of_balls_passes_a_blow_on_to_the_last) {
  for (const double gap : {0.0, 1e-4, 5e-4, 1e-3, 3e-3, 0.02}) {
    for (const double start : {-3.0, -3.01, -3.03, -3.05}) {
      Lab lab({5, 20, 0}, weightless());
      for (int i = 0; i < 5; ++i) {
        BodyDef def;
        def.shape = sphere(real(0.5));
        def.position = position(i == 0 ? start : (1 + gap) * (i - 1), 0, 0);
        if (i == 0) def.linear_velocity = reals(4, 0, 0);
        def.material.restitution = real(1);
        lab.add(def);
      }
      lab.run(60);
      for (uint32_t i = 0; i < 5; ++i)
        EXPECT_NEAR(lab.motion({i + 1, 1}).linear_velocity[0], i == 4 ? 4 : 0, 1e-3)
            << gap << ", " << start << ", ball " << i;
    }
  }
}

/// Slow contacts and contacts in a heap are left to the solver: in a heap, each rebound would cause many more.
DETENT_TEST(rebound, is_left_to_the_solver_where_it_is_slow_or_in_a_heap) {
  Lab slow({2, 4, 0}, weightless());
  Lab heap({65, 500, 0});
  BodyDef def;
  def.shape = sphere(real(0.25));
  def.material.restitution = real(0.8);
  for (int i = 0; i < 2; ++i) {
    def.position = position(0.502 * i, 0, 0);
    def.linear_velocity = reals(0.1 - 0.1 * i, 0, 0);
    slow.add(def);
  }
  EXPECT_EQ(slow.run(1).ccd.impacts + slow.run(1).ccd.impacts, 0u);
  EXPECT_NEAR(slow.motion({1, 1}).linear_velocity[0], slow.motion({2, 1}).linear_velocity[0], 1e-6);
  heap.add_ground();
  def.linear_velocity = reals(0, 0, 0);
  uint32_t impacts = 0;
  for (int i = 0; i < 64; ++i) {
    def.position = position(0.51 * (i % 4) + 0.01 * (i / 16), 0.3 + 0.6 * (i / 16), 0.51 * (i / 4 % 4));
    heap.add(def);
  }
  for (int tick = 0; tick < 120; ++tick) {
    const StepReport report = heap.run(1);
    EXPECT_EQ(report.ccd.bodies_stopped, 0u);
    impacts += report.ccd.impacts;
  }
  ::testing::Test::RecordProperty("impacts", std::to_string(impacts));
  EXPECT_LT(impacts, 64 * 7u);
}

struct Overflow {
  std::vector<double> angular;  ///< over the sizes of the momenta, times a metre; ascending
  double energy = 0;            ///< the most
};

/// Throws balls, or balls and boxes, at each other from a circle around the origin.
Overflow throw_together(uint32_t count, bool boxes, int throws) {
  Samples samples = {count};
  Overflow overflow;
  for (int i = 0; i < throws; ++i) {
    Lab lab({count, 40, 0}, weightless());
    for (uint32_t k = 0; k < count; ++k) {
      const double angle = 6.283185 * k / count, size = uniform(samples, 0.3, 0.5);
      const Vector out = {{cos(angle), uniform(samples, -0.15, 0.15), sin(angle)}};
      BodyDef def;
      def.shape = !boxes || k % 2 == 0
                      ? sphere(real(size))
                      : box(reals(size, size * uniform(samples, 0.4, 1), size * uniform(samples, 0.4, 1)));
      def.position = position_near(out * uniform(samples, 2, 2.8));
      def.linear_velocity = reals_near(out * -5 + any_direction(samples) * 0.5);
      def.rotation = rotation_near(any_rotation(samples));
      def.angular_velocity = reals_near(any_direction(samples) * 3);
      def.material.restitution = real(1);
      def.material.friction = real(0);
      lab.add(def);
    }
    const Sums start = sums_of(lab);
    lab.run(60);
    const Sums end = sums_of(lab);
    EXPECT_LT(length(end.momentum - start.momentum) / start.size, 1e-6);
    overflow.angular.push_back(length(end.angular - start.angular) / start.size);
    overflow.energy = std::max(overflow.energy, fabs(end.energy / start.energy - 1));
  }
  std::sort(overflow.angular.begin(), overflow.angular.end());
  return overflow;
}

DETENT_TEST(rebound, balls_keep_their_energy_and_angular_momentum) {
  for (const uint32_t count : {2u, 5u}) {
    const Overflow overflow = throw_together(count, false, 40);
    EXPECT_LT(overflow.angular.back(), 1e-4) << count;
    EXPECT_LT(overflow.energy, 1e-3) << count;
  }
}

/// A box does not rotate along its sweep as in free flight. The difference is subtracted from its momentum.
DETENT_TEST(rebound, boxes_and_balls_nearly_keep_them) {
  for (const uint32_t count : {2u, 5u}) {
    const Overflow overflow = throw_together(count, true, 40);
    EXPECT_LT(overflow.angular[20], 5e-4) << count;
    EXPECT_LT(overflow.angular.back(), 0.02) << count;
    EXPECT_LT(overflow.energy, 0.02) << count;
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
