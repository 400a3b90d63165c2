#include <math.h>

#include "tests/unit/joint/joint_lab.h"
#include "tests/unit/math/samples.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// The least number of substeps whose square is at least this. 0: too close to a border to decide.
uint32_t substeps_for(double squared) {
  for (const uint32_t n : {2u, 3u, 4u, 6u, 8u, 12u, 16u, 24u, 32u}) {
    if (n > 2 && fabs(squared / (n * n) - 1) < 0.01) return 0;
    if (squared <= n * n) return n;
  }
  return 32;
}

/// The measure of lib/joint/joint_substeps.cpp in doubles, for bodies whose unit of length is 1 m; motions are those
/// of a tick.
double bend_of(JointType type, const Vector (&linear_velocity)[2], const Vector (&angular_velocity)[2],
               const Vector (&anchor)[2], double length) {
  const auto size = [](Vector v) { return fabs(v.x) + fabs(v.y) + fabs(v.z); };
  double bend = 8 * size(cross(angular_velocity[0], angular_velocity[1]));
  for (int i = 0; i < 2; ++i) bend += size(cross(angular_velocity[i], cross(angular_velocity[i], anchor[i])));
  const bool holds_anchors =
      type == JointType::ball || type == JointType::hinge || type == JointType::fixed || type == JointType::cone_twist;
  if (type != JointType::distance && !holds_anchors) return bend;
  const Vector apart = (linear_velocity[1] + cross(angular_velocity[1], anchor[1])) -
                       (linear_velocity[0] + cross(angular_velocity[0], anchor[0]));
  const double swing = size(apart) / (holds_anchors ? 1 : length);
  return fmax(bend, swing * swing);
}

DETENT_TEST(joint, substeps_are_those_that_the_bends_of_its_ways_ask_for) {
  Samples samples = {77};
  const auto draw = [&](double most) { return most * unit_to_host(samples.uniform()); };
  const auto vector = [&](double most) {
    const double x = draw(most), y = draw(most), z = draw(most);
    return Vector{x, y, z};
  };
  for (const JointType type : k_joint_types) {
    uint32_t seen[33] = {};
    for (uint32_t round = 0; round < 120; ++round) {
      // Some pairs have one velocity, joints at the centres, or no angular velocity.
      const double fast = exp2(-static_cast<double>(round % 6));
      Vector linear_velocity[2] = {vector(4 * fast), vector(4 * fast)},
             angular_velocity[2] = {vector(6 * fast), vector(6 * fast)};
      Vector anchor[2] = {vector(0.3), vector(0.3)};
      if (round % 5 == 0) linear_velocity[1] = linear_velocity[0];
      if (round % 7 == 0) anchor[0] = anchor[1] = {0, 0, 0};
      if (round % 10 == 0) angular_velocity[0] = angular_velocity[1] = {0, 0, 0};
      const double length = 0.5 + fabs(draw(2));
      WorldDef def = weightless();
      def.tick = real(0.25);
      Lab lab(room(2, 1), def);
      JointDef joint;
      joint.type = type;
      joint.axis.limited = type == JointType::distance;
      joint.axis.upper = real(joint.axis.limited ? length : 0);
      for (int i = 0; i < 2; ++i) {
        BodyDef body;
        body.shape = box(reals(0.5, 0.5, 0.5));
        body.position = position(1.5 * i, 0, 0);
        body.linear_velocity = reals(linear_velocity[i].x, linear_velocity[i].y, linear_velocity[i].z);
        body.angular_velocity = reals(angular_velocity[i].x, angular_velocity[i].y, angular_velocity[i].z);
        (i == 0 ? joint.a : joint.b) = lab.add(body);
        (i == 0 ? joint.anchor_a : joint.anchor_b) = reals(anchor[i].x, anchor[i].y, anchor[i].z);
        linear_velocity[i] = linear_velocity[i] * 0.25;
        angular_velocity[i] = angular_velocity[i] * 0.25;
      }
      JointId id;
      ASSERT_OK(create_joint(lab.world, joint, id));
      const uint32_t expected = substeps_for(25 * bend_of(type, linear_velocity, angular_velocity, anchor, length));
      const uint32_t taken = lab.run(1).substeps_max;
      if (expected != 0) {
        EXPECT_EQ(taken, expected) << static_cast<int>(type) << " " << round;
        ++seen[expected];
      }
    }
    for (const uint32_t n : {2u, 4u, 8u}) EXPECT_GT(seen[n], 0u) << static_cast<int>(type) << " " << n;
  }
}

DETENT_TEST(joint, substeps_are_those_that_its_springs_its_loops_and_contacts_ask_for) {
  constexpr Real k_softs[] = {0.125, 0.25, 0.5};
  for (const Real soft : k_softs) {
    for (uint32_t which = 0; which < 2; ++which) {
      WorldDef def = weightless();
      def.tick = real(0.25);
      Lab lab(room(2, 1), def);
      JointDef joint;
      (which == 0 ? joint.axis : joint.second).frequency = soft;
      add_joint(lab, JointType::wheel, add_shape(lab, box(reals(0.5, 0.5, 0.5)), 0, 0, 0),
                add_shape(lab, box(reals(0.5, 0.5, 0.5)), 2, 0, 0), 1, 0, 0, joint);
      const double phase = 2 * k_pi * real_to_host(soft) * 0.25;
      EXPECT_EQ(lab.run(1).substeps_max, substeps_for(fmin(25 * phase * phase, 15.9))) << which;
    }
  }
  const auto chain = [](int links, bool hung_twice, bool touching) {
    Lab lab(room(5, 4), weightless());
    BodyId last = add_shape(lab, box(reals(0.1, 0.1, 0.1)), 0, 0, 0, BodyType::fixed);
    for (int i = 0; i < links; ++i) {
      const BodyId next = add_shape(lab, box(reals(0.4, 0.1, 0.1)), 0.5 + i, 0, 0);
      add_joint(lab, JointType::ball, last, next, i, 0, 0);
      last = next;
    }
    const double end = links;
    if (hung_twice)
      add_joint(lab, JointType::ball, last, add_shape(lab, box(reals(0.1, 0.1, 0.1)), end, 0, 0, BodyType::fixed), end,
                0, 0);
    if (touching) add_shape(lab, box(reals(0.1, 0.1, 0.1)), end - 0.5, 0.1999, 0);
    return lab.run(1).substeps_max;
  };
  EXPECT_EQ(chain(2, false, false), 2u);
  EXPECT_EQ(chain(2, true, false), 3u);
  EXPECT_EQ(chain(2, false, true), 4u);
}

/// The number falls at once to the fewest that are needed, not entry by entry: the rule against alternating numbers is
/// for contacts only.
DETENT_TEST(joint, substeps_are_as_few_as_are_needed_once_fewer_have_done_for_8_ticks) {
  Lab lab(room(2, 1), weightless());
  const BodyId hub = add_shape(lab, box(reals(0.1, 0.1, 0.1)), 0, 0, 0, BodyType::fixed);
  const BodyId arm = add_shape(lab, box(reals(0.4, 0.1, 0.1)), 0.5, 0, 0);
  add_joint(lab, JointType::ball, hub, arm, 0, 0, 0);
  ASSERT_OK(set_velocity(lab.world, arm, reals(0, 20, 0), reals(0, 0, 40)));
  const uint32_t fast = lab.run(1).substeps_max;
  EXPECT_GE(fast, 4u);
  ASSERT_OK(set_velocity(lab.world, arm, reals(0, 0.05, 0), reals(0, 0, 0.1)));
  for (int tick = 0; tick < 7; ++tick) EXPECT_EQ(lab.run(1).substeps_max, fast) << tick;
  EXPECT_EQ(lab.run(1).substeps_max, 2u);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
