#include <detent/body.h>
#include <detent/world.h>
#include <math.h>

#include "math/rotation.h"
#include "motion/inverse_inertia.h"
#include "state/view.h"
#include "tests/unit/world/lab.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

BodyDef locked(uint32_t locks) {
  BodyDef def;
  def.shape = box(reals(0.3, 0.9, 0.5));
  def.rotation_locks = locks;
  return def;
}

Quat rotation_of(const World& world, BodyId id) {
  Pose pose;
  EXPECT_OK(get_pose(world, id, pose));
  return pose.rotation;
}

DETENT_TEST(locks, an_upright_body_stays_exactly_upright_however_it_is_hit) {
  Lab lab({12, 60, 0});
  lab.add_ground();
  BodyDef def = locked(k_rotation_lock_x | k_rotation_lock_z);
  def.position = position(0, 0.9, 0);
  const BodyId id = lab.add(def);
  for (int i = 0; i < 8; ++i) {
    BodyDef ball;
    ball.shape = sphere(real(0.2));
    ball.position = position(4 + 2 * i, 1.2, 0.3);
    ball.linear_velocity = reals(-20, 2, 0);
    ball.mass = scaled(200);
    lab.add(ball);
  }
  double turned = 0;
  for (int tick = 0; tick < 120; ++tick) {
    lab.run(1);
    const Quat q = rotation_of(lab.world, id);
    EXPECT_EQ(unit_to_host(q.x), 0);
    EXPECT_EQ(unit_to_host(q.z), 0);
    turned = fmax(turned, fabs(unit_to_host(q.y)));
  }
  EXPECT_GT(turned, 0.1) << "about the free axis it turns";
  std::vector<uint64_t> bytes = lab.snapshot();
  Lab other({12, 60, 0});
  ASSERT_OK(load(other.world, bytes_of(bytes), byte_count(bytes)));
  lab.run(3);
  other.run(3);
  EXPECT_EQ(digest(lab.world), digest(other.world));
}

DETENT_TEST(locks, a_body_with_all_axes_locked_never_turns) {
  Lab lab({3, 8, 0});
  lab.add_ground();
  BodyDef def = locked(k_rotation_locks_all);
  def.position = position(0, 3, 0);
  def.rotation = {Unit(0.5), Unit(0.5), Unit(-0.5), Unit(0.5)};
  def.linear_velocity = reals(5, 0, 2);
  def.angular_velocity = reals(1, 2, 3);
  const BodyId id = lab.add(def);
  const Quat before = rotation_of(lab.world, id);
  ASSERT_OK(apply_angular_impulse(lab.world, id, scaleds(100, 200, 300)));
  for (int tick = 0; tick < 120; ++tick) {
    lab.run(1);
    EXPECT_TRUE(rotation_of(lab.world, id) == before);
    for (const double angular_velocity : lab.motion(id).angular_velocity) EXPECT_EQ(angular_velocity, 0);
  }
}

DETENT_TEST(locks, one_locked_axis_keeps_no_momentum_and_the_others_turn) {
  WorldDef calm;
  calm.gravity = {0.0, 0.0, 0.0};
  Lab lab({1, 1, 0}, calm), free({1, 1, 0}, calm);
  BodyDef def = locked(k_rotation_lock_y);
  def.rotation = {Unit(0.5), Unit(0.5), Unit(-0.5), Unit(0.5)};
  const BodyId id = lab.add(def);
  def.rotation_locks = 0;
  const BodyId other = free.add(def);
  // This rotation takes the body's x, y, z axes to the world's -z, x and -y.
  ASSERT_OK(apply_angular_impulse(lab.world, id, scaleds(500, 0, 0)));
  for (const double angular_velocity : lab.motion(id).angular_velocity) EXPECT_NEAR(angular_velocity, 0, 1e-6);
  ASSERT_OK(apply_angular_impulse(lab.world, id, scaleds(0, 500, 0)));
  ASSERT_OK(apply_angular_impulse(free.world, other, scaleds(0, 500, 0)));
  EXPECT_NEAR(lab.motion(id).angular_velocity[1], free.motion(other).angular_velocity[1], 1e-5);
  EXPECT_GT(lab.motion(id).angular_velocity[1], 0.1);
  Vec3<Scaled> inertia{};
  ASSERT_OK(get_inertia(lab.world, id, inertia));
  EXPECT_EQ(scaled_to_host(inertia.y), 0);
  EXPECT_GT(scaled_to_host(inertia.z), 0);
}

DETENT_TEST(locks, can_be_set_and_taken_off_in_motion) {
  WorldDef calm;
  calm.gravity = {0.0, 0.0, 0.0};
  Lab lab({1, 1, 0}, calm);
  BodyDef def;
  def.shape = box(reals(0.5, 0.5, 0.5));
  def.angular_velocity = reals(1, 2, 3);
  const BodyId id = lab.add(def);
  ASSERT_OK(set_rotation_locks(lab.world, id, k_rotation_lock_x));
  EXPECT_EQ(lab.motion(id).angular_velocity[0], 0);
  EXPECT_NEAR(lab.motion(id).angular_velocity[1], 2, 1e-6);
  EXPECT_NEAR(lab.motion(id).angular_velocity[2], 3, 1e-6);
  ASSERT_OK(set_rotation_locks(lab.world, id, 0));
  EXPECT_EQ(lab.motion(id).angular_velocity[0], 0);
  EXPECT_NEAR(lab.motion(id).angular_velocity[1], 2, 1e-6);
  ASSERT_OK(set_rotation_locks(lab.world, id, k_rotation_locks_all));
  EXPECT_EQ(lab.motion(id).angular_velocity[2], 0);
  EXPECT_EQ(set_rotation_locks(lab.world, id, 8), Status::bad_argument);
}

DETENT_TEST(locks, what_pushed_about_a_locked_axis_is_not_stored_up) {
  Lab lab({2, 4, 0});
  BodyDef table;
  table.type = BodyType::fixed;
  table.shape = box(reals(1, 0.25, 1));
  lab.add(table);
  BodyDef def;
  def.shape = box(reals(0.75, 0.25, 0.25));
  def.position = position(1.25, 0.5, 0);  // its middle is beyond the edge
  for (const uint32_t locks : {k_rotation_lock_z, k_rotation_locks_all}) {
    def.rotation_locks = locks;
    const BodyId id = lab.add(def);
    lab.run(60);
    EXPECT_NEAR(lab.motion(id).position[1], 0.5, 0.02);
    ASSERT_OK(set_rotation_locks(lab.world, id, 0));
    for (const double angular_velocity : lab.motion(id).angular_velocity) EXPECT_NEAR(angular_velocity, 0, 1e-6);
    lab.run(30);
    EXPECT_LT(lab.motion(id).position[1], 0.4) << "and then it falls";
    ASSERT_OK(destroy_body(lab.world, id));
  }
}

DETENT_TEST(locks, leave_the_inverse_inertia_about_the_other_axes_as_precise_as_it_was) {
  Lab lab({2, 1, 0});
  lab.add(locked(0));
  lab.add(locked(k_rotation_lock_x | k_rotation_lock_z));
  const Span<BodyProperties> properties = view_of(lab.world).properties;
  const Matrix3 axes = matrix_from(k_identity);
  double about_y[2];
  for (size_t i = 0; i < 2; ++i) {
    const WorldInverseInertia inverse_inertia = world_inverse_inertia(properties[static_cast<uint32_t>(i)], axes);
    about_y[i] = ldexp(unit_to_host(inverse_inertia.row[1].y), inverse_inertia.exponent);
  }
  EXPECT_NEAR(about_y[1] / about_y[0], 1, 1e-6);
}

DETENT_TEST(locks, a_snapshot_whose_inverse_inertia_does_not_fit_its_locks_is_refused) {
  Lab lab({1, 1, 0});
  lab.add(locked(k_rotation_lock_y));
  Lab unlocked({1, 1, 0});
  unlocked.add(locked(0));
  const std::vector<uint64_t> a = lab.snapshot(), b = unlocked.snapshot();
  uint32_t differing = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    if (a[i] == b[i]) continue;
    ++differing;
    std::vector<uint64_t> mixed = a;
    mixed[i] = b[i];
    EXPECT_EQ(load(lab.world, bytes_of(mixed), byte_count(mixed)), Status::corrupt);
  }
  EXPECT_GE(differing, 2u);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
