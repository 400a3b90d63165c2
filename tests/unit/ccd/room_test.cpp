#include <algorithm>

#include "tests/unit/ccd/impact_shots.h"

/// Rooms whose walls are much thinner than the bodies that fly in them.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

constexpr double k_half = 2;  ///< of a room, m

void add_walls(Lab& lab, double thickness, double restitution) {
  const double half = thickness / 2;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      double size[3] = {k_half + thickness, k_half + thickness, k_half + thickness}, at[3] = {0, 0, 0};
      size[axis] = half;
      at[axis] = side * (k_half + half);
      BodyDef def;
      def.type = BodyType::fixed;
      def.shape = box(reals(size[0], size[1], size[2]));
      def.position = position(at[0], at[1], at[2]);
      def.material.restitution = real(restitution);
      lab.add(def);
    }
  }
}

Shape any_shape(Samples& samples) {
  const double size = uniform(samples, 0.05, 0.25), other = size * uniform(samples, 0.3, 1);
  switch (static_cast<int>(uniform(samples, 0, 6))) {
    case 0:
      return sphere(real(size));
    case 1:
      return box(reals(size, other, size * uniform(samples, 0.3, 1)));
    case 2:
      return capsule(real(size / 2), real(other));
    case 3:
      return cylinder(real(size), real(other));
    case 4:
      return cone(real(size), real(size));
    default:
      return rounded(box(reals(0.6 * size, 0.6 * size, 0.6 * size)), real(0.2 * size));
  }
}

void expect_kept(uint64_t seed, uint32_t bodies, double speed, double thickness, double restitution) {
  Samples samples = {seed};
  for (uint32_t room = 0; room < detent_oracle::rounds(25); ++room) {
    Lab lab({6 + bodies, 256, 0}, {});
    add_walls(lab, thickness, restitution);
    std::vector<BodyId> ids;
    for (uint32_t i = 0; i < bodies; ++i) {
      BodyDef def;
      def.shape = any_shape(samples);
      def.rotation = rotation_near(any_rotation(samples));
      def.position = position(1.2 * (i % 3) - 1.2, 1.2 * (i / 3) - 1.2, uniform(samples, -1.2, 1.2));
      def.linear_velocity = reals_near(any_direction(samples) * speed);
      def.angular_velocity = reals_near(any_direction(samples) * 20);
      def.material.restitution = real(restitution);
      ids.push_back(lab.add(def));
    }
    for (int tick = 0; tick < 10; ++tick) {
      lab.run(1);
      for (const BodyId id : ids) {
        const Motion motion = lab.motion(id);
        for (const double at : motion.position) ASSERT_LT(fabs(at), k_half) << "room " << room << ", tick " << tick;
      }
    }
  }
}

/// The bodies fly from wall to wall many times in a tick.
DETENT_TEST(room, of_thin_walls_is_left_by_nothing_however_fast) {
  expect_kept(110, 8, 8000, 0.02, 0.8);
  expect_kept(111, 8, 8000, 0.02, 0.8);
  expect_kept(111, 8, 4000, 0.02, 0);
  expect_kept(132, 3, 16000, 0.1, 0.8);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
