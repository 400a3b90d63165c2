#include "tests/campaigns/stress/measures.h"

#include <detent/asset.h>
#include <math.h>

#include "tests/campaigns/stress/icosahedron.h"
#include "tests/campaigns/stress/scenes.h"
#include "tests/common/queries/random.h"
#include "tests/unit/world/lab.h"

/// Tests of the measures of the scenes.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_stress::DepthMeter;
using detent_stress::Depths;
using detent_stress::Role;
using detent_stress::Solid;
using detent_stress::Stage;
using detent_stress::StageBody;
using detent_stress::States;

StageBody solid(Solid solid, double a, double b, double c) {
  StageBody body;
  body.solid = solid;
  body.size[0] = a;
  body.size[1] = b;
  body.size[2] = c;
  return body;
}

/// Whether a point in the body's frame is inside the body.
bool holds(const StageBody& body, const double (&p)[3]) {
  const double r = body.size[0];
  switch (body.solid) {
    case Solid::box:
      return fabs(p[0]) <= body.size[0] && fabs(p[1]) <= body.size[1] && fabs(p[2]) <= body.size[2];
    case Solid::capsule: {
      const double y = fmax(fabs(p[1]) - body.size[1], 0);
      return p[0] * p[0] + y * y + p[2] * p[2] <= r * r;
    }
    case Solid::sphere:
      return p[0] * p[0] + p[1] * p[1] + p[2] * p[2] <= r * r;
    case Solid::half_space:
      return p[1] <= 0;
    case Solid::icosahedron:
      break;
  }
  // Its faces are those of a cube's corners and of three golden rectangles: normals (1, 1, 1) and (0, 1/g, g).
  const double golden = (1 + sqrt(5.0)) / 2, inner = r * golden * golden / sqrt(3 * (1 + golden * golden));
  const double x = fabs(p[0]), y = fabs(p[1]), z = fabs(p[2]), limit = inner * sqrt(3.0);
  return x + y + z <= limit && z / golden + x * golden <= limit && x / golden + y * golden <= limit &&
         y / golden + z * golden <= limit;
}

const StageBody k_solids[] = {solid(Solid::box, 0.3, 0.5, 0.2), solid(Solid::sphere, 0.4, 0, 0),
                              solid(Solid::capsule, 0.2, 0.3, 0), solid(Solid::icosahedron, 0.5, 0, 0)};

DETENT_TEST(measures, mass_and_inverse_inertia_are_those_of_points_spread_over_the_body) {
  for (const StageBody& body : k_solids) {
    constexpr uint32_t k_points = 400000;
    detent_queries::Random random(2);
    const double radius = bounding_radius(body), cube = 8 * radius * radius * radius;
    double count = 0, squares[3] = {0, 0, 0};
    for (uint32_t i = 0; i < k_points; ++i) {
      double p[3];
      for (double& coordinate : p) coordinate = random.uniform(-radius, radius);
      if (!holds(body, p)) continue;
      ++count;
      for (int k = 0; k < 3; ++k) squares[k] += p[k] * p[k];
    }
    EXPECT_NEAR(count / k_points * cube * body.density / mass_of(body), 1, 0.015);
    const std::array<double, 3> inverse_inertia = inverse_inertia_of(body);
    for (size_t k = 0; k < 3; ++k)
      EXPECT_NEAR((squares[(k + 1) % 3] + squares[(k + 2) % 3]) / count / inverse_inertia[k], 1, 0.015);
  }
}

DETENT_TEST(measures, mass_is_the_librarys) {
  const detent_stress::CookedIcosahedron hull = detent_stress::cook_icosahedron(0.5);
  HullInfo info;
  ASSERT_OK(hull_info({reinterpret_cast<const uint8_t*>(hull.words.data()), hull.byte_count}, info));
  EXPECT_NEAR(ldexp(info.volume_mantissa, info.volume_exponent) * 1000 / mass_of(k_solids[3]), 1, 1e-6);
  Lab lab({3, 1, 0});
  const Shape shapes[] = {box(reals(0.3, 0.5, 0.2)), sphere(real(0.4)), capsule(real(0.2), real(0.3))};
  for (size_t i = 0; i < 3; ++i) {
    BodyDef def;
    def.shape = shapes[i];
    Scaled mass;
    ASSERT_OK(get_mass(lab.world, lab.add(def), mass));
    EXPECT_NEAR(scaled_to_host(mass) / mass_of(k_solids[i]), 1, 1e-5);
  }
}

/// A body of any rotation, at this depth in the ground of the scenes.
DETENT_TEST(measures, depth_is_how_far_a_body_is_in_the_ground) {
  detent_queries::Random random(1);
  for (const StageBody& body : k_solids) {
    for (int round = 0; round < 20; ++round) {
      Stage stage = detent_stress::sleep_stacks(0, 0, false);
      stage.bodies.push_back(body);
      States states = states_at_start(stage);
      const detent_queries::Rotation q = random.rotation();
      for (size_t i = 0; i < 4; ++i) states[1].rotation[i] = q[i];
      // The lowest point, from the body's vertices and radius.
      double low = 0;
      std::vector<std::array<double, 3>> points;
      if (body.solid == Solid::icosahedron) points = detent_stress::icosahedron_points(body.size[0]);
      for (int i = 0; i < 8 && body.solid == Solid::box; ++i)
        points.push_back({i % 2 ? body.size[0] : -body.size[0], i / 2 % 2 ? body.size[1] : -body.size[1],
                          i / 4 ? body.size[2] : -body.size[2]});
      if (body.solid == Solid::capsule) points = {{0, body.size[1], 0}, {0, -body.size[1], 0}};
      for (const auto& point : points) low = fmin(low, detent_stress::to_world(states[1].rotation, point)[1]);
      if (body.solid == Solid::capsule || body.solid == Solid::sphere) low -= body.size[0];
      const double depth = random.uniform(0.001, 0.05);
      states[1].position[1] = -low - depth;
      const DepthMeter meter(stage);
      const Depths depths = meter.measure(states);
      EXPECT_EQ(depths.pairs, 1u);
      EXPECT_NEAR(depths.max, depth, 1e-4);
      EXPECT_EQ(depths.mean, depths.max);
      states[1].position[1] = -low + depth;
      EXPECT_EQ(meter.measure(states).pairs, 0u);
    }
  }
}

DETENT_TEST(measures, sums_are_those_of_a_body_that_moves_and_turns) {
  Stage stage;
  StageBody body = k_solids[0];
  body.mass = 2;
  const double half = sqrt(0.5);
  const double rotation[4] = {half, 0, 0, half};  // its y is the world's z
  for (int i = 0; i < 4; ++i) body.rotation[i] = rotation[i];
  body.position[0] = 3;
  body.position[1] = 1;
  body.linear_velocity[1] = 4;
  body.angular_velocity[2] = 5;
  stage.bodies = {body};
  const detent_stress::Sums sums = sums_of(stage, states_at_start(stage));
  const double inertia = 2 * (0.3 * 0.3 + 0.2 * 0.2) / 3;
  EXPECT_NEAR(sums.linear[1], 8, 1e-12);
  EXPECT_NEAR(sums.angular[2], 3 * 8 + inertia * 5, 1e-12);
  EXPECT_NEAR(sums.energy, 16 + inertia * 25 / 2, 1e-12);
  EXPECT_NEAR(sums.potential, 2 * 9.81, 1e-12);
}

DETENT_TEST(measures, a_scaled_scene_is_the_same_in_its_own_units) {
  const Stage one = detent_stress::dominoes(3), large = scaled(one, 100);
  EXPECT_EQ(large.bodies[1].size[1], 50);
  EXPECT_NEAR(large.tick, one.tick * 10, 1e-12);
  EXPECT_NEAR(mass_of(large.bodies[1]) / mass_of(one.bodies[1]), 1e6, 1e-3);
  // Both scales have the same ratio of gravity's displacement in a tick to the unit.
  EXPECT_NEAR(large.tick * large.tick / (one.tick * one.tick), 100, 1e-9);
  EXPECT_EQ(drift(large, states_at_start(large)), 0);
  States states = states_at_start(large);
  states[2].position[2] += 30;
  states[2].position[1] -= 7;
  EXPECT_NEAR(drift(large, states), 30, 1e-9);
  EXPECT_NEAR(sag(large, states), 7, 1e-9);
}

DETENT_TEST(measures, a_varied_scene_has_the_same_bodies_at_the_same_distances) {
  const Stage stage = detent_stress::pyramid(6), other = varied(stage, 3);
  ASSERT_EQ(other.bodies.size(), stage.bodies.size());
  const auto distances = [](const Stage& of) {
    double sum = 0;
    for (const StageBody& body : of.bodies)
      sum += sqrt(body.position[0] * body.position[0] + body.position[2] * body.position[2]) + 7 * body.position[1];
    return sum;
  };
  EXPECT_NEAR(distances(other), distances(stage), 1e-9);
  EXPECT_EQ(other.bodies[0].role, Role::fixed);
  EXPECT_NE(other.bodies[1].position[1], other.bodies[2].position[1]) << "the order is another";
}

DETENT_TEST(measures, a_chain_begins_closed_scaled_and_varied_too) {
  for (const double scale : {1.0, 0.01, 100.0}) {
    for (const uint64_t seed : {0u, 1u, 2u}) {
      const Stage stage = scaled(varied(detent_stress::chain(5, 10), seed), scale);
      EXPECT_EQ(stage.joints.size(), 6u);
      EXPECT_NEAR(stretch(stage, states_at_start(stage)), 0, 1e-14) << seed;
    }
  }
}

DETENT_TEST(measures, stretch_is_the_sum_of_the_gaps_over_the_links) {
  const Stage stage = detent_stress::chain(4, 10);
  EXPECT_NEAR(mass_of(stage.bodies[5]) / mass_of(stage.bodies[1]), 10, 1e-12);
  States states = states_at_start(stage);
  states[5].position[1] -= 0.3;
  EXPECT_NEAR(stretch(stage, states), 0.15, 1e-12);
  states[2].position[2] += 0.1;
  EXPECT_NEAR(stretch(stage, states), 0.25, 1e-12);
}

DETENT_TEST(measures, late_is_the_last_third) {
  EXPECT_EQ(detent_stress::late_mean({9, 9, 9, 9, 1, 3}), 2);
  EXPECT_EQ(detent_stress::late_mean({9, 1, 3, 2}), 2.5);
  EXPECT_EQ(detent_stress::late_mean({4}), 4);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
