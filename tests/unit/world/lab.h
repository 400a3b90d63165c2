#pragma once
#include <detent/numbers.h>
#include <detent/world.h>

#include <vector>

#include "tests/common/support/test.h"

/// A world for tests, in memory of its own, with conversions that fail the test instead of returning a status.
namespace detent {
inline namespace DETENT_NAMESPACE {

inline Real real(double value) {
  Real result{};
  EXPECT_OK(real_from_host(value, result));
  return result;
}
inline Coord coord(double value) {
  Coord result{};
  EXPECT_OK(coord_from_host(value, result));
  return result;
}
inline Unit unit(double value) {
  Unit result{};
  EXPECT_OK(unit_from_host(value, result));
  return result;
}
inline Scaled scaled(double value) {
  Scaled result{};
  EXPECT_OK(scaled_from_host(value, result));
  return result;
}
inline Vec3<Real> reals(double x, double y, double z) { return {real(x), real(y), real(z)}; }
inline Vec3<Scaled> scaleds(double x, double y, double z) { return {scaled(x), scaled(y), scaled(z)}; }
inline Position position(double x, double y, double z) { return {coord(x), coord(y), coord(z)}; }

inline WorldDef weightless(uint32_t substeps = 0) {
  WorldDef def;
  def.gravity = {0.0, 0.0, 0.0};
  def.substeps = substeps;
  return def;
}

struct Motion {
  double position[3], linear_velocity[3], angular_velocity[3];
};

class Lab {
 public:
  /// Bodies do not fall asleep unless `sleeping` is true.
  explicit Lab(Capacity capacity, WorldDef def = {}, bool sleeping = false) {
    def.capacity = capacity;
    def.sleeping = sleeping;
    words_.resize(world_bytes(capacity) / 8);
    EXPECT_OK(create_world(block(), world_bytes(capacity), def, {}, world));
  }
  uint8_t* block() { return reinterpret_cast<uint8_t*>(words_.data()); }

  BodyId add(const BodyDef& def) {
    BodyId id;
    EXPECT_OK(create_body(world, def, id));
    return id;
  }
  BodyId add_ground(double friction = 0.6) {
    BodyDef ground;
    ground.type = BodyType::fixed;
    ground.shape = half_space();
    ground.material.friction = real(friction);
    return add(ground);
  }
  BodyId add_box(double half, double x, double y, double z) {
    BodyDef def;
    def.shape = box(reals(half, half, half));
    def.position = position(x, y, z);
    return add(def);
  }
  StepReport run(uint32_t ticks) {
    StepReport report;
    for (uint32_t i = 0; i < ticks; ++i) report = step(world);
    return report;
  }
  Motion motion(BodyId id) {
    Pose pose;
    Vec3<Real> linear_velocity, angular_velocity;
    EXPECT_OK(get_pose(world, id, pose));
    EXPECT_OK(get_velocity(world, id, linear_velocity, angular_velocity));
    return {{coord_to_host(pose.position.x), coord_to_host(pose.position.y), coord_to_host(pose.position.z)},
            {real_to_host(linear_velocity.x), real_to_host(linear_velocity.y), real_to_host(linear_velocity.z)},
            {real_to_host(angular_velocity.x), real_to_host(angular_velocity.y), real_to_host(angular_velocity.z)}};
  }
  std::vector<uint64_t> snapshot() {
    std::vector<uint64_t> bytes(snapshot_bytes(get_info(world).capacity) / 8);
    EXPECT_OK(save(world, reinterpret_cast<uint8_t*>(bytes.data()), static_cast<uint32_t>(bytes.size() * 8)));
    return bytes;
  }

  World world;

 private:
  std::vector<uint64_t> words_;
};

inline uint8_t* bytes_of(std::vector<uint64_t>& words) { return reinterpret_cast<uint8_t*>(words.data()); }
inline uint32_t byte_count(const std::vector<uint64_t>& words) { return static_cast<uint32_t>(words.size() * 8); }

/// Checks that the world continues in the same way here, loaded into `other`, and restored here. Returns the snapshot.
inline std::vector<uint64_t> expect_one_way_on(Lab& lab, Lab& other) {
  constexpr uint32_t k_ticks = 60;
  std::vector<uint64_t> saved = lab.snapshot(), copy = saved;
  lab.run(k_ticks);
  const uint64_t expected = digest(lab.world);
  EXPECT_OK(load(other.world, bytes_of(copy), byte_count(copy)));
  other.run(k_ticks);
  EXPECT_EQ(digest(other.world), expected);
  EXPECT_OK(restore(lab.world, bytes_of(saved), byte_count(saved)));
  lab.run(k_ticks);
  EXPECT_EQ(digest(lab.world), expected);
  return saved;
}

/// Four boxes stacked on the ground, touching, and a ball beside them, after a few ticks.
inline Lab make_pile() {
  Lab lab({7, 15, 1});  // odd, so that arrays are followed by fill
  lab.add_ground();
  for (int i = 0; i < 4; ++i) lab.add_box(0.5, 0.05 * i, 0.5 + i, 0);
  BodyDef ball;
  ball.shape = sphere(real(0.25));
  ball.position = position(2, 0.25, 0);
  ball.linear_velocity = reals(1, 0, 0.5);
  ball.angular_velocity = reals(0, 3, 0);
  ball.user_data = 0xfeedbeef;
  lab.add(ball);
  lab.run(20);
  return lab;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
