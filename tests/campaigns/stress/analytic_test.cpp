#include <math.h>

#include "tests/campaigns/stress/bounds.h"
#include "tests/campaigns/stress/measures.h"
#include "tests/campaigns/stress/run_detent.h"
#include "tests/campaigns/stress/scenes.h"
#include "tests/common/oracle/effort.h"
#include "tests/unit/world/lab.h"

/// Motions with a closed formula.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using detent_stress::BodyState;
using detent_stress::Role;
using detent_stress::Run;
using detent_stress::Solid;
using detent_stress::Stage;
using detent_stress::StageBody;
using detent_stress::States;
using detent_stress::operator-;
using Triple = std::array<double, 3>;

constexpr double k_gravity = 9.81;
/// Relative error of displacement and speed that a configuration's numbers allow in a motion of some seconds.
constexpr double k_exact = k_config == Config::f32 ? 1e-4 : k_config == Config::fx32 ? 1e-5 : 1e-6;

std::unique_ptr<Run> made(const Stage& stage) {
  std::string problem;
  std::unique_ptr<Run> run = stress_engine().make(stage, {}, problem);
  EXPECT_NE(run, nullptr) << problem;
  return run;
}

States after(const Stage& stage, uint32_t ticks) {
  const auto run = made(stage);
  for (uint32_t i = 0; i < ticks; ++i) {
    const detent_stress::Counts counts = run->step();
    EXPECT_EQ(counts.lost + counts.saturations, 0u);
  }
  return run->states();
}

/// Uses the same bounds as the cases: the target, or the regression bound of bounds.h.
void expect_reached(const char* scene, const char* measure, double value) {
  const auto* wanted = detent_stress::find_wanted(scene, measure);
  const auto* gap = detent_stress::find_gap(scene, stress_engine().config, 1, measure);
  ASSERT_NE(wanted, nullptr);
  EXPECT_LE(value, gap != nullptr ? gap->held : wanted->bound) << "wanted " << wanted->bound;
}

StageBody ball(double mass, const Triple& position, const Triple& linear_velocity) {
  StageBody body;
  body.solid = Solid::sphere;
  body.mass = mass;
  for (size_t i = 0; i < 3; ++i) {
    body.position[i] = position[i];
    body.linear_velocity[i] = linear_velocity[i];
  }
  return body;
}

DETENT_TEST(analytic, a_falling_ball_is_where_galilei_says) {
  Stage stage;
  stage.bodies = {ball(1, {3, 100, -7}, {0, 0, 0})};
  const auto run = made(stage);
  for (uint32_t tick = 1; tick <= 240; ++tick) {
    run->step();
    const BodyState now = run->states()[0];
    const double time = tick / 60.0, displacement = k_gravity * time * time / 2;
    ASSERT_NEAR(now.position[1], 100 - displacement, 100 * k_exact) << tick;
    ASSERT_NEAR(now.linear_velocity[1], -k_gravity * time, 40 * k_exact) << tick;
    ASSERT_EQ(now.position[0], 3);
  }
}

DETENT_TEST(analytic, a_projectile_comes_down_as_fast_as_it_rose_and_as_far_as_its_range) {
  const double rise = 2 * k_gravity;  // back at its first height after 4 s
  Stage stage;
  stage.bodies = {ball(1, {0, 1, 0}, {30, rise, -5})};
  const BodyState top = after(stage, 120)[0], end = after(stage, 240)[0];
  EXPECT_NEAR(top.position[1], 1 + rise * rise / (2 * k_gravity), 20 * k_exact);
  EXPECT_NEAR(end.position[0], 120, 120 * k_exact);
  EXPECT_NEAR(end.position[1], 1, 20 * k_exact);
  EXPECT_NEAR(end.position[2], -20, 20 * k_exact);
  EXPECT_NEAR(end.linear_velocity[1], -rise, rise * k_exact);
}

/// A slope that descends towards +x, with a body on it whose centre is half a metre above.
Stage slope(double tangent, double friction, Solid solid) {
  Stage stage = detent_stress::incline(1, tangent);
  for (StageBody& body : stage.bodies) body.friction = friction;
  stage.bodies[1].solid = solid;
  return stage;
}

/// The distance and speed of a body down a slope.
struct Down {
  double displacement = 0, speed = 0, angular_velocity = 0;
};
Down down(const Stage& stage, const States& states) {
  const Triple along = detent_stress::to_world(stage.bodies[0].rotation, {1, 0, 0});
  Down result;
  for (size_t i = 0; i < 3; ++i) {
    result.displacement += along[i] * (states[1].position[i] - stage.bodies[1].position[i]);
    result.speed += along[i] * states[1].linear_velocity[i];
  }
  result.angular_velocity = -states[1].angular_velocity[2];
  return result;
}

DETENT_TEST(analytic, a_box_slides_down_a_slope_at_what_friction_leaves_of_its_pull) {
  for (const double tangent : {0.3, 0.6, 1.0}) {
    for (const double part : {0.2, 0.8}) {
      const double friction = part * tangent, cosine = 1 / sqrt(1 + tangent * tangent);
      const double pull = k_gravity * cosine * (tangent - friction);
      const Stage stage = slope(tangent, friction, Solid::box);
      const Down first = down(stage, after(stage, 30)), last = down(stage, after(stage, 210));
      EXPECT_NEAR((last.speed - first.speed) / (3 * pull), 1, 2e-3) << tangent << " " << friction;
      // The speed gained in a substep moves the box for the whole substep: half a substep's gain too far.
      EXPECT_NEAR((last.displacement - first.displacement) / (3 * first.speed + 4.5 * pull), 1, 3e-3)
          << tangent << " " << friction;
    }
  }
}

DETENT_TEST(analytic, a_ball_rolls_down_a_slope_at_five_sevenths_of_its_pull) {
  for (const double tangent : {0.1, 0.5, 1.0}) {
    const double pull = 5.0 / 7 * k_gravity * tangent / sqrt(1 + tangent * tangent);
    const Stage stage = slope(tangent, 0.6, Solid::sphere);
    const Down first = down(stage, after(stage, 30)), last = down(stage, after(stage, 210));
    EXPECT_NEAR((last.speed - first.speed) / (3 * pull), 1, 2e-3) << tangent;
    EXPECT_NEAR(last.angular_velocity * 0.5 / last.speed, 1, 1e-3) << tangent;
  }
}

DETENT_TEST(analytic, on_a_steep_slope_a_ball_slips_and_its_angular_velocity_is_what_friction_gives) {
  const double tangent = 1.5, friction = 0.2, cosine = 1 / sqrt(1 + tangent * tangent);
  const Stage stage = slope(tangent, friction, Solid::sphere);
  const Down first = down(stage, after(stage, 30)), last = down(stage, after(stage, 150));
  EXPECT_NEAR((last.speed - first.speed) / (2 * k_gravity * cosine * (tangent - friction)), 1, 2e-3);
  EXPECT_NEAR((last.angular_velocity - first.angular_velocity) * 0.5 / (2 * 2.5 * friction * k_gravity * cosine), 1,
              2e-3);
}

Stage pair_of(const StageBody& a, const StageBody& b) {
  Stage stage;
  stage.gravity = 0;
  stage.bodies = {a, b};
  for (StageBody& body : stage.bodies) {
    body.restitution = 1;
    body.friction = 0;
  }
  return stage;
}

DETENT_TEST(analytic, balls_that_meet_head_on_keep_momentum_and_energy) {
  for (const double ratio : {1.0, 2.0, 50.0, 1e4, 1e-4}) {
    const Stage stage = pair_of(ball(1, {-1.5, 0, 0}, {3, 0, 0}), ball(ratio, {1.5, 0, 0}, {-1, 0, 0}));
    const States end = after(stage, 90);
    const double mean = (3 - ratio) / (1 + ratio);  // both speeds are mirrored at it
    EXPECT_NEAR(end[0].linear_velocity[0], 2 * mean - 3, 4e-5) << ratio;
    EXPECT_NEAR(end[1].linear_velocity[0], 2 * mean + 1, 4e-5) << ratio;
    for (const BodyState& state : end) {
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(state.angular_velocity[i], 0, 1e-5);
    }
  }
}

DETENT_TEST(analytic, balls_that_meet_off_centre_exchange_what_lies_along_the_line_of_their_centres) {
  constexpr double k_speed = 0.5;
  double error = 0;
  for (const double offset : {0.2, 0.5, 0.8}) {
    for (const double ratio : {1.0, 4.0}) {
      const Stage stage = pair_of(ball(1, {-2, offset, 0}, {k_speed, 0, 0}), ball(ratio, {0, 0, 0}, {0, 0, 0}));
      const States end = after(stage, 240);
      // The line of centres at contact, with centres a metre apart.
      const Triple line = {sqrt(1 - offset * offset), -offset, 0};
      const double exchanged = 2 * ratio / (1 + ratio) * k_speed * line[0];  // of the first ball's speed
      for (size_t i = 0; i < 2; ++i) {
        const double first = (i == 0 ? k_speed : 0) - exchanged * line[i], second = exchanged * line[i] / ratio;
        // Contact may be detected up to a tick late, which rotates the line.
        error = fmax(error, fabs(end[0].linear_velocity[i] - first) / k_speed);
        error = fmax(error, fabs(end[1].linear_velocity[i] - second) / k_speed);
      }
      const detent_stress::Sums before = sums_of(stage, states_at_start(stage)), now = sums_of(stage, end);
      EXPECT_NEAR(now.energy / before.energy, 1, 1e-3) << offset << " " << ratio;
      EXPECT_LT(detent_stress::length(now.linear - before.linear), 1e-5) << offset << " " << ratio;
    }
  }
  expect_reached("collision", "oblique", error);
}

/// Rotates v about an axis of length 1.
Triple turned(const Triple& v, const Triple& axis, double angle) {
  const double q[4] = {axis[0] * sin(angle / 2), axis[1] * sin(angle / 2), axis[2] * sin(angle / 2), cos(angle / 2)};
  return detent_stress::to_world(q, v);
}

DETENT_TEST(analytic, a_free_symmetric_top_goes_round_its_angular_momentum) {
  Stage stage;
  stage.gravity = 0;
  StageBody top;
  top.size[0] = top.size[2] = 0.2;
  const Triple angular_velocity = {2, 10, 1};
  for (size_t i = 0; i < 3; ++i) top.angular_velocity[i] = angular_velocity[i];
  stage.bodies = {top};
  const Triple inverse_inertia = detent_stress::inverse_inertia_of(top);
  const Triple momentum = {inverse_inertia[0] * angular_velocity[0], inverse_inertia[1] * angular_velocity[1],
                           inverse_inertia[2] * angular_velocity[2]};
  const double size = detent_stress::length(momentum), rate = size / inverse_inertia[0];
  const Triple axis = {momentum[0] / size, momentum[1] / size, momentum[2] / size};
  const auto run = made(stage);
  double error = 0;
  for (uint32_t tick = 1; tick <= 600; ++tick) {
    run->step();
    const Triple now = detent_stress::to_world(run->states()[0].rotation, {0, 1, 0});
    error = fmax(error, detent_stress::angle_between(now, turned({0, 1, 0}, axis, rate * tick / 60)));
  }
  ::testing::Test::RecordProperty("error", ::testing::PrintToString(error));
  EXPECT_LT(error, 0.05) << "of " << rate * 10 << " rad that it goes round";
}

DETENT_TEST(analytic, a_free_rod_that_turns_end_over_end_keeps_its_energy) {
  for (const double speed : {1.0, 40.0, 200.0}) {
    for (const double angle : {0.0, 0.3, 1.0}) {
      Stage stage;
      stage.gravity = 0;
      StageBody rod;
      rod.size[0] = rod.size[2] = 0.01;
      rod.angular_velocity[0] = speed * cos(angle);
      rod.angular_velocity[2] = speed * sin(angle);
      stage.bodies = {rod};
      const double before = sums_of(stage, states_at_start(stage)).energy;
      const auto run = made(stage);
      double error = 0;
      for (uint32_t tick = 0; tick < 120; ++tick) {
        run->step();
        error = fmax(error, fabs(sums_of(stage, run->states()).energy / before - 1));
      }
      SCOPED_TRACE(::testing::PrintToString(speed) + " rad/s");
      expect_reached("rod", "energy", error);
    }
  }
}

DETENT_TEST(analytic, a_gyroscope_precesses_at_the_torque_over_its_angular_momentum) {
  // A fast rotating ball with a horizontal axis, whose weight acts at an arm from its support. The test applies the
  // torque of the weight; the support's force cancels the weight.
  WorldDef world;
  world.gravity = {0.0, 0.0, 0.0};
  Lab lab({1, 1, 0}, world);
  const double mass = 2, arm = 0.1, angular_velocity = 200, radius = 0.1;
  BodyDef def;
  def.shape = sphere(real(radius));
  def.mass = scaled(mass);
  def.angular_velocity = reals(angular_velocity, 0, 0);
  const BodyId id = lab.add(def);
  const double torque = arm * mass * k_gravity, given = torque / 60;
  double angle = 0, right = 0, axis[3] = {1, 0, 0}, momentum = 0.4 * mass * radius * radius * angular_velocity;
  const double rate = torque / momentum;
  for (uint32_t tick = 0; tick < 600; ++tick) {
    // The torque of the weight, -y, at `arm` along the axis.
    EXPECT_OK(apply_torque(lab.world, id, scaleds(torque * axis[2], 0, -torque * axis[0])));
    lab.run(1);
    const Motion motion = lab.motion(id);
    const double size = sqrt(motion.angular_velocity[0] * motion.angular_velocity[0] +
                             motion.angular_velocity[2] * motion.angular_velocity[2]);
    const double before[3] = {axis[0], 0, axis[2]};
    axis[0] = motion.angular_velocity[0] / size;
    axis[2] = motion.angular_velocity[2] / size;
    angle += asin(before[0] * axis[2] - before[2] * axis[0]);
    // Applied for a tick across the angular momentum, the torque rotates it and increases it.
    right += atan(given / momentum);
    momentum = sqrt(momentum * momentum + given * given);
  }
  EXPECT_NEAR(fabs(angle) / right, 1, 1e-3);
  EXPECT_NEAR(right / (rate * 10), 1, 0.1) << "of steady precession";
  EXPECT_NEAR(lab.motion(id).angular_velocity[1], 0, 1e-3);
}

DETENT_TEST(analytic, a_wave_of_dominoes_runs_at_one_speed) {
  const uint32_t third = detent_oracle::rounds(20) < 20 ? 8 : 20, count = 3 * third;
  const Stage stage = detent_stress::dominoes(count);
  const auto run = made(stage);
  std::vector<uint32_t> struck(count, 0);
  for (uint32_t tick = 1; tick <= 15 * count; ++tick) {
    run->step();
    const States states = run->states();
    for (uint32_t i = 0; i < count; ++i) {
      if (struck[i] == 0 && detent_stress::to_world(states[i + 1].rotation, {0, 1, 0})[1] < 0.995) struck[i] = tick;
    }
  }
  for (uint32_t i = 1; i < count; ++i) ASSERT_GT(struck[i], struck[i - 1]) << i;
  const auto interval = [&](uint32_t from, uint32_t to) { return (struck[to] - struck[from]) / double(to - from); };
  const double middle = interval(third - 1, 2 * third - 1), last = interval(2 * third - 1, count - 1);
  EXPECT_NEAR(last / middle, 1, 0.15);
  // In units of sqrt(g x height), the only speed scale of the row.
  const double speed = 0.4 / (middle / 60) / sqrt(k_gravity);
  ::testing::Test::RecordProperty("speed", ::testing::PrintToString(speed));
  EXPECT_GT(speed, 0.5);
  EXPECT_LT(speed, 2);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
