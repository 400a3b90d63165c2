#include <detent/body.h>
#include <detent/world.h>
#include <stdio.h>

#include <algorithm>

#include "examples/ragdoll/ragdoll.h"
#include "tests/common/oracle/effort.h"
#include "tests/common/queries/random.h"
#include "tests/unit/joint/joint_lab.h"

/// Figures thrown onto the ground at speeds that occur in games.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

using Random = detent_queries::Random;

constexpr uint32_t k_ticks = 360;
constexpr double k_speed_max = 60, k_energy_gain = 1.1, k_gap = 0.01 * ragdoll::k_height;

/// A vector of random direction and of a length up to `most`.
Vector any_vector(Random& random, double most) {
  const detent_queries::Triple displacement = random.direction();
  const double size = random.uniform(0, most);
  return {displacement[0] * size, displacement[1] * size, displacement[2] * size};
}
Vec3<Real> reals_of(Vector v) { return reals(v.x, v.y, v.z); }

/// Gives the figure a random pose and throws it as one rigid body.
void throw_any_way(Lab& lab, const ragdoll::Ragdoll& figure, Random& random) {
  const Vector rotation_vector = any_vector(random, 3.1), linear_velocity = any_vector(random, 20),
               angular_velocity = any_vector(random, 10);
  EXPECT_OK(ragdoll::throw_figure(lab.world, figure, reals_of(rotation_vector), reals_of(linear_velocity)));
  const auto place = [&](BodyId id) { return joint_end(lab.world, id, reals(0, 0, 0), BodyDef().rotation).anchor; };
  const Vector middle = place(figure.part[0]);
  for (const BodyId id : figure.part) {
    const Vector with_angular_velocity = linear_velocity + cross(angular_velocity, place(id) - middle);
    EXPECT_OK(set_velocity(lab.world, id, reals_of(with_angular_velocity), reals_of(angular_velocity)));
  }
}

/// The energy of a figure, J, with height measured from the ground, and the speed of its fastest part, m/s.
struct Energy {
  double sum = 0, fastest = 0;

  Energy(Lab& lab, const ragdoll::Ragdoll& figure) {
    for (const BodyId id : figure.part) {
      const Motion motion = lab.motion(id);
      Scaled mass;
      Vec3<Scaled> inertia;
      EXPECT_OK(get_mass(lab.world, id, mass));
      EXPECT_OK(get_inertia(lab.world, id, inertia));
      const JointEnd axes = joint_end(lab.world, id, reals(0, 0, 0), BodyDef().rotation);
      const Vector linear_velocity = {motion.linear_velocity[0], motion.linear_velocity[1], motion.linear_velocity[2]};
      const Vector angular_velocity = {motion.angular_velocity[0], motion.angular_velocity[1],
                                       motion.angular_velocity[2]};
      const double moment[3] = {scaled_to_host(inertia.x), scaled_to_host(inertia.y), scaled_to_host(inertia.z)};
      sum += scaled_to_host(mass) * (dot(linear_velocity, linear_velocity) / 2 + 9.81 * motion.position[1]);
      for (int i = 0; i < 3; ++i)
        sum += moment[i] * dot(angular_velocity, axes.axis[i]) * dot(angular_velocity, axes.axis[i]) / 2;
      fastest = std::max(fastest, length(linear_velocity));
    }
  }
};

struct Throw {
  double fastest = 0;  ///< m/s, over all parts
  double energy = 0;   ///< greatest energy over that at the start
  double gap = 0;      ///< greatest of all joints, m
  double gap_at_end = 0;
  uint32_t saturations = 0, undecided = 0;
};

Throw throw_one(uint64_t seed) {
  Lab lab(Capacity{1 + ragdoll::k_parts, 64, 0, true, ragdoll::k_joints});
  lab.add_ground();
  ragdoll::Ragdoll figure;
  EXPECT_OK(ragdoll::make(lab.world, position(0, 1, 0), figure));
  Random random(seed);
  throw_any_way(lab, figure, random);
  const double start = Energy(lab, figure).sum;
  Throw result;
  for (uint32_t tick = 0; tick < k_ticks; ++tick) {
    const StepReport report = lab.run(1);
    const Energy now(lab, figure);
    result.fastest = std::max(result.fastest, now.fastest);
    result.energy = std::max(result.energy, now.sum / start);
    result.saturations += report.saturations;
    result.undecided += report.joints.undecided;
    result.gap_at_end = 0;
    for (const JointId id : figure.joint)
      result.gap_at_end = std::max(result.gap_at_end, length(joint_ends(lab.world, id).gap()));
    result.gap = std::max(result.gap, result.gap_at_end);
  }
  return result;
}

DETENT_TEST(ragdoll, thrown_onto_the_ground_stays_whole_and_gains_no_energy) {
  const uint32_t count = detent_oracle::rounds(50);
  Throw worst;
  for (uint32_t seed = 1; seed <= count; ++seed) {
    const Throw one = throw_one(seed);
    EXPECT_LE(one.fastest, k_speed_max) << "seed " << seed;
    EXPECT_LE(one.energy, k_energy_gain) << "seed " << seed;
    EXPECT_LE(one.gap_at_end, k_gap) << "seed " << seed;
    EXPECT_EQ(one.saturations, 0u) << "seed " << seed;
    worst.fastest = std::max(worst.fastest, one.fastest);
    worst.energy = std::max(worst.energy, one.energy);
    worst.gap = std::max(worst.gap, one.gap);
    worst.gap_at_end = std::max(worst.gap_at_end, one.gap_at_end);
    worst.undecided += one.undecided;
  }
  printf(
      "%u throws: fastest part %.1f m/s, energy %.3f of the start's, joints off by %.2f mm at most, %.2f mm at the "
      "end, %u substeps undecided\n",
      count, worst.fastest, worst.energy, 1000 * worst.gap, 1000 * worst.gap_at_end, worst.undecided);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
