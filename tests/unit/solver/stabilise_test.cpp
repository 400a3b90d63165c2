#include "tests/unit/world/lab.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr Capacity k_room = {16, 64, 0};

DETENT_TEST(convergence, ends_the_sweeps_of_an_island_at_rest) {
  WorldDef def;
  def.iterations = 16;
  Lab lab(k_room, def);
  lab.add_ground();
  for (int i = 0; i < 3; ++i) lab.add_box(0.5, 0, 0.5 + i, 0);
  const StepReport first = lab.run(1);
  EXPECT_GT(first.substeps_max, 0u);
  const StepReport settled = lab.run(120);
  // There are two passes in a substep, of which all sweeps but the first few can be skipped.
  EXPECT_GT(settled.contacts.sweeps_saved, settled.substeps_max * 16);
  EXPECT_LE(settled.contacts.sweeps_saved, settled.substeps_max * 2 * 15);
  EXPECT_NEAR(lab.motion(next_body(lab.world, {2, 1})).position[1], 1.5, 0.02);
}

DETENT_TEST(convergence, is_the_worlds_own_and_goes_with_its_snapshot) {
  WorldDef strict, loose;
  strict.iterations = loose.iterations = 8;
  strict.convergence = 30;
  loose.convergence = 2;
  uint32_t saved[2] = {};
  int which = 0;
  for (const WorldDef& def : {strict, loose}) {
    Lab lab(k_room, def), other(k_room, {});
    lab.add_ground();
    for (int i = 0; i < 4; ++i) lab.add_box(0.5, 0.1 * i, 0.6 + 1.1 * i, 0);
    lab.run(20);
    std::vector<uint64_t> bytes = lab.snapshot();
    ASSERT_OK(load(other.world, bytes_of(bytes), byte_count(bytes)));
    for (int tick = 0; tick < 20; ++tick) {
      const StepReport one = lab.run(1), two = other.run(1);
      saved[which] += one.contacts.sweeps_saved;
      EXPECT_EQ(one.contacts.sweeps_saved, two.contacts.sweeps_saved);
    }
    EXPECT_EQ(digest(lab.world), digest(other.world));
    ++which;
  }
  EXPECT_LT(saved[0], saved[1]);
}

double energy_of(Lab& lab, BodyId id) {
  const Motion motion = lab.motion(id);
  double square = 0;
  for (int i = 0; i < 3; ++i) square += motion.linear_velocity[i] * motion.linear_velocity[i];
  return square / 2 + 9.81 * motion.position[1];
}

/// The fraction of its depth by which a box of 1 m leaves the ground in a substep.
double fraction_corrected(double depth) {
  WorldDef def;
  def.substeps = 1;
  Lab lab(k_room, def);
  lab.add_ground();
  const BodyId box = lab.add_box(0.5, 0, 0.5 - depth, 0);
  lab.run(1);
  return (lab.motion(box).position[1] - (0.5 - depth)) / depth;
}

DETENT_TEST(contact_solver, a_deep_contact_is_stiffer) {
  const double at_rest = fraction_corrected(1.0 / 128);
  EXPECT_NEAR(fraction_corrected(1.0 / 80), at_rest, 0.1 * at_rest);
  EXPECT_GT(fraction_corrected(1.0 / 32), 1.25 * at_rest);
  EXPECT_LT(fraction_corrected(1.0 / 32), 1);
}

DETENT_TEST(post_stabilisation, moves_bodies_apart_without_giving_them_speed) {
  WorldDef def;
  def.stabilisation = Stabilisation::post;
  Lab lab(k_room, def);
  lab.add_ground();
  const BodyId box = lab.add_box(0.5, 0, 0.48, 0);  // 2 cm within the ground
  double fastest = 0;
  for (int tick = 0; tick < 60; ++tick) {
    lab.run(1);
    fastest = std::max(fastest, std::abs(lab.motion(box).linear_velocity[1]));
  }
  EXPECT_LT(fastest, 1e-3) << "m/s";
  EXPECT_NEAR(lab.motion(box).position[1], 0.5, 1e-3);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(lab.motion(box).angular_velocity[i], 0, 1e-4);
}

DETENT_TEST(post_stabilisation, turns_a_body_that_overlaps_on_one_side) {
  WorldDef def;
  def.stabilisation = Stabilisation::post;
  Lab lab(k_room, def);
  lab.add_ground();
  const BodyId box = lab.add_box(0.5, 0, 0.5, 0);
  ASSERT_OK(set_pose(lab.world, box, position(0, 0.5, 0), {unit(0), unit(0), unit(0.01), unit(0.99995)}));
  lab.run(240);
  EXPECT_NEAR(lab.motion(box).position[1], 0.5, 2e-3);
  EXPECT_NEAR(energy_of(lab, box), 9.81 * 0.5, 0.05);
}

DETENT_TEST(post_stabilisation, lets_a_stack_stand) {
  WorldDef def;
  def.stabilisation = Stabilisation::post;
  def.iterations = 4;
  Lab lab(k_room, def);
  lab.add_ground();
  BodyId top;
  for (int i = 0; i < 4; ++i) top = lab.add_box(0.5, 0, 0.5 + i, 0);
  lab.run(300);
  EXPECT_NEAR(lab.motion(top).position[1], 3.5, 0.02);
  EXPECT_NEAR(lab.motion(top).position[0], 0, 0.01);
}

/// The overlap of a ball and the ground after one tick of one substep, by the formula of soft contacts.
double overlap_after(double overlap, double frequency, double damping_ratio) {
  const double phase = 2 * 3.14159265358979 * 2 * frequency;  // a static pair has twice the frequency
  const double sum = 2 * 0.5 * damping_ratio + phase;         // and half the damping ratio
  const double rate = phase / sum, softness = 1 / (phase * sum);
  return overlap * (1 - rate / (1 + softness));
}

DETENT_TEST(soft_contact, closes_an_overlap_as_a_damped_spring_does) {
  for (const double frequency : {1.0 / 64, 1.0 / 32, 0.14, 0.25}) {
    for (const double damping_ratio : {1.0, 2.0, 10.0, 40.0}) {
      WorldDef def = weightless(1);
      def.contact_frequency = real(frequency);
      def.damping_ratio = real(damping_ratio);
      Lab lab(k_room, def);
      lab.add_ground();
      BodyDef ball;
      ball.shape = sphere(real(0.5));
      ball.position = position(0, 0.49, 0);
      const BodyId id = lab.add(ball);
      double expected = 0.01;
      for (int tick = 0; tick < 10; ++tick) {
        lab.run(1);
        expected = overlap_after(expected, frequency, damping_ratio);
        EXPECT_NEAR(0.5 - lab.motion(id).position[1], expected, 1e-4) << frequency << ", " << damping_ratio;
      }
    }
  }
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
