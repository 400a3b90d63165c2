#include "tests/oracle/bodies.h"
#include "tests/world/lab.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

Quaternion rotation_of(const Lab& lab, BodyId id) {
  Pose pose;
  EXPECT_OK(get_pose(lab.world, id, pose));
  return normalised(host(pose.rotation));
}

struct SpinState {
  double local[3];  ///< spin about the body's axes, rad/s
  Vector momentum;  ///< over the mass, world
  double energy;    ///< over the mass
};

/// Of a box of these half extents.
SpinState spin_of_box(Lab& lab, BodyId id, const Vector& half) {
  const Quaternion rotation = rotation_of(lab, id);
  const Motion motion = lab.motion(id);
  const Vector spin = {{motion.spin[0], motion.spin[1], motion.spin[2]}};
  SpinState state = {{0, 0, 0}, {{0, 0, 0}}, 0};
  for (int i = 0; i < 3; ++i) {
    const Vector axis = detent_oracle::axis_of(rotation, i);
    const double inertia = (half[(i + 1) % 3] * half[(i + 1) % 3] + half[(i + 2) % 3] * half[(i + 2) % 3]) / 3;
    state.local[i] = dot(spin, axis);
    state.momentum = state.momentum + axis * (inertia * state.local[i]);
    state.energy += inertia * state.local[i] * state.local[i] / 2;
  }
  return state;
}

/// The spinning racket: a box thrown about its middle axis turns over again and again. 74 turns in 10,000 ticks is what
/// a fourth-order integration of Euler's equations with a thousandth of the step gives.
DETENT_TEST(spin, about_the_middle_axis_flips_as_often_as_euler_says) {
  const Vector half = {{0.5, 0.2, 0.05}};
  WorldDef world;
  world.gravity = {0.0, 0.0, 0.0};
  Lab lab({1, 1, 0}, world);
  BodyDef def;
  def.shape = box(reals_near(half));
  def.spin = reals(0.01, 10, 0.01);
  const BodyId id = lab.add(def);
  const SpinState start = spin_of_box(lab, id, half);
  int flips = 0, side = 1;
  double energy_error = 0, momentum_error = 0;
  for (int tick = 0; tick < 10000; ++tick) {
    lab.run(1);
    const SpinState now = spin_of_box(lab, id, half);
    if (now.local[1] * side < -5) {
      ++flips;
      side = -side;
    }
    energy_error = fmax(energy_error, fabs(now.energy / start.energy - 1));
    momentum_error = fmax(momentum_error, length(now.momentum - start.momentum) / length(start.momentum));
  }
  ::testing::Test::RecordProperty("flips", ::testing::PrintToString(flips));
  // How long a flip waits depends on the logarithm of how exactly the spin lies along the axis: a float's rounding, a
  // millionth of the momentum, shortens it, to 101 flips.
  EXPECT_NEAR(flips, 74, sizeof(Real) == 4 ? 30 : 0);
  EXPECT_LT(energy_error, 1e-4);
  EXPECT_LT(momentum_error, 1e-4);
}

DETENT_TEST(spin, is_read_back_as_it_was_set_whatever_the_size) {
  for (int power = -12; power <= 12; ++power) {
    Lab lab({2, 1, 0});
    for (const double radius : {ldexp(1.0, power), ldexp(1.5, power)}) {
      BodyDef def;
      def.shape = sphere(real(radius));
      const double faster = fmin(1, 500 / radius);
      def.spin = reals(3 * faster, -20 * faster, 7 * faster);
      const Motion motion = lab.motion(lab.add(def));
      EXPECT_NEAR(motion.spin[0], 3 * faster, 1e-5 * faster) << radius;
      EXPECT_NEAR(motion.spin[1], -20 * faster, 1e-5 * faster) << radius;
      EXPECT_NEAR(motion.spin[2], 7 * faster, 1e-5 * faster) << radius;
    }
  }
}

DETENT_TEST(spin, of_a_ball_never_changes) {
  WorldDef world;
  world.gravity = {0.0, 0.0, 0.0};
  Lab lab({1, 1, 0}, world);
  BodyDef def;
  def.shape = sphere(real(0.5));
  def.spin = reals(3, -20, 7);
  const BodyId id = lab.add(def);
  const Motion before = lab.motion(id);
  lab.run(1000);
  const Motion after = lab.motion(id);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(after.spin[i], before.spin[i]);
}

DETENT_TEST(spin, about_an_axis_of_symmetry_turns_the_body_by_spin_times_time) {
  WorldDef world;
  world.gravity = {0.0, 0.0, 0.0};
  Lab lab({1, 1, 0}, world);
  BodyDef def;
  def.shape = capsule(real(0.25), real(0.5));
  def.spin = reals(0, 5, 0);
  const BodyId id = lab.add(def);
  lab.run(600);
  const Quaternion right = detent_oracle::rotation_by({{0, 50, 0}});
  const Quaternion got = rotation_of(lab, id);
  EXPECT_NEAR(fabs(got.y * right.y + got.w * right.w), 1, sizeof(Real) == 4 ? 1e-8 : 1e-11);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
