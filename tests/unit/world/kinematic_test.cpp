#include <detent/body.h>
#include <detent/world.h>
#include <math.h>

#include "tests/common/queries/random.h"
#include "tests/unit/world/lab.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

struct Errors {
  double position = 0, rotation = 0;
};

/// The distance of a body from its target after a step, for random displacements of up to `distance_max` m and
/// rotations of up to half a turn.
Errors errors_of(const Shape& shape, double distance_max, int count) {
  detent_queries::Random random(1);
  Lab lab({1, 1, 0});
  BodyDef def;
  def.type = BodyType::kinematic;
  def.shape = shape;
  const BodyId id = lab.add(def);
  Errors errors;
  double at[3] = {0, 0, 0};
  for (int i = 0; i < count; ++i) {
    for (double& x : at) x += random.uniform(-distance_max, distance_max);
    const auto q = random.rotation();
    const Position target = position(at[0], at[1], at[2]);
    EXPECT_OK(move_kinematic(lab.world, id, target, {unit(q[0]), unit(q[1]), unit(q[2]), unit(q[3])}));
    lab.run(1);
    Pose pose;
    EXPECT_OK(get_pose(lab.world, id, pose));
    const double off[3] = {coord_to_host(pose.position.x) - coord_to_host(target.x),
                           coord_to_host(pose.position.y) - coord_to_host(target.y),
                           coord_to_host(pose.position.z) - coord_to_host(target.z)};
    for (const double part : off) errors.position = fmax(errors.position, fabs(part));
    const double now[4] = {unit_to_host(pose.rotation.x), unit_to_host(pose.rotation.y), unit_to_host(pose.rotation.z),
                           unit_to_host(pose.rotation.w)};
    const double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    const double dot = now[0] * q[0] + now[1] * q[1] + now[2] * q[2] + now[3] * q[3];
    for (size_t k = 0; k < 4; ++k)
      errors.rotation = fmax(errors.rotation, fabs(now[k] * (dot < 0 ? -1 : 1) - q[k] / length));
  }
  return errors;
}

DETENT_TEST(kinematic, a_body_is_at_the_target_after_the_step) {
#if defined(DETENT_F32)
  const double relative = 0x1p-23, rotation = 0x1p-21, step = 0x1p-32;
#elif defined(DETENT_FX32)
  const double relative = 0, rotation = 0x1p-27, step = 0x1p-16;
#elif defined(DETENT_F64)
  const double relative = 0x1p-52, rotation = 0x1p-27, step = 0x1p-40;
#else
  const double relative = 0, rotation = 0x1p-27, step = 0x1p-32;
#endif
  const Shape shapes[] = {sphere(real(0.5)), box(reals(10, 0.25, 10)), box(reals(50, 10, 50))};
  const double reaches[] = {1e-3, 1, 100};
  for (int i = 0; i < 3; ++i) {
    const Errors errors = errors_of(shapes[i], reaches[i], 200);
    EXPECT_LE(errors.position, 0x1p-31 + step + relative * reaches[i]) << i;
    EXPECT_LE(errors.rotation, rotation) << i;
  }
}

DETENT_TEST(kinematic, a_target_that_is_the_pose_stops_the_body) {
  Lab lab({1, 1, 0});
  BodyDef def;
  def.type = BodyType::kinematic;
  def.linear_velocity = reals(1, 2, 3);
  def.angular_velocity = reals(1, 2, 3);
  const BodyId id = lab.add(def);
  lab.run(3);
  Pose pose;
  ASSERT_OK(get_pose(lab.world, id, pose));
  ASSERT_OK(move_kinematic(lab.world, id, pose.position, pose.rotation));
  lab.run(1);
  const Motion motion = lab.motion(id);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(motion.linear_velocity[i], 0, 2e-3) << "fx32 makes up for what the last step rounded";
    EXPECT_EQ(motion.angular_velocity[i], 0);
  }
  EXPECT_EQ(motion.position[0], coord_to_host(pose.position.x));
}

DETENT_TEST(kinematic, a_lift_carries_what_stands_on_it) {
  Lab lab({3, 8, 0});
  BodyDef def;
  def.type = BodyType::kinematic;
  def.shape = box(reals(2, 0.25, 2));
  const BodyId lift = lab.add(def);
  const BodyId rider = lab.add_box(0.5, 0, 0.75, 0);
  for (int tick = 1; tick <= 60; ++tick) {
    ASSERT_OK(move_kinematic(lab.world, lift, position(0.01 * tick, 0.02 * tick, 0), {0.0, 0.0, 0.0, 1.0}));
    lab.run(1);
  }
  EXPECT_NEAR(lab.motion(rider).position[1], 0.75 + 1.2, 0.02);
  EXPECT_NEAR(lab.motion(rider).position[0], 0.6, 0.05);
}

DETENT_TEST(kinematic, what_cannot_be_moved_there_is_refused) {
  Lab lab({3, 4, 0});
  const BodyId dynamic = lab.add_box(0.5, 0, 0, 0);
  BodyDef def;
  def.type = BodyType::kinematic;
  const BodyId id = lab.add(def);
  def.shape = half_space();
  const BodyId plane = lab.add(def);
  const uint64_t before = digest(lab.world);
  const Quat same = {0.0, 0.0, 0.0, 1.0}, turned = {0.0, 0.0, 1.0, 0.0};
  EXPECT_EQ(move_kinematic(lab.world, dynamic, position(1, 0, 0), same), Status::bad_argument);
  EXPECT_EQ(move_kinematic(lab.world, {}, position(1, 0, 0), same), Status::bad_id);
  EXPECT_EQ(move_kinematic(lab.world, id, position(1, 0, 0), {0.0, 0.0, 0.0, 0.5}), Status::not_normalised);
  EXPECT_EQ(move_kinematic(lab.world, id, position(1000, 0, 0), same), Status::out_of_range);
  EXPECT_EQ(move_kinematic(lab.world, id, position(30000, -30000, 0), same), Status::out_of_range);
  EXPECT_EQ(move_kinematic(lab.world, plane, position(1, 0, 0), turned), Status::bad_argument);
  EXPECT_EQ(digest(lab.world), before);
  EXPECT_OK(move_kinematic(lab.world, plane, position(0, -1, 0), same));
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
