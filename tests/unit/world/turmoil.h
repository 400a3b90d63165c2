#pragma once
#include <detent/body.h>
#include <detent/joint.h>
#include <detent/world.h>

#include "tests/campaigns/sequences/draw.h"
#include "tests/unit/replay/match.h"

/// Ticks in which bodies, shapes and joints are created and destroyed. The calls depend only on a seed and the state of
/// the world: the same state gives the same ticks.
namespace detent {
inline namespace DETENT_NAMESPACE {

inline constexpr Capacity k_turmoil_capacity = {9, 25, 3, true, 4, 5};  // odd, so that arrays are followed by fill

inline WorldDef turmoil_settings(uint64_t seed, Capacity capacity = k_turmoil_capacity) {
  WorldDef def;
  def.capacity = capacity;
  def.sleeping = seed % 2 == 0;
  def.contact_recycle_distance = seed % 3 == 0 ? Real(0.0) : Real(1.0 / 256);
  return def;
}

inline BodyId random_body(const World& world, Draw& draw) {
  BodyId id = next_body(world, {});
  for (uint32_t i = draw.below(get_info(world).bodies + 1); i != 0; --i) id = next_body(world, id);
  return id;
}

/// A refused call changes nothing, and is an acceptable outcome.
inline void ignore(Status) {}

inline void create_any_body(World& world, Draw& draw) {
  bool wrong = false;
  BodyDef def;
  def.shape = draw.shape(wrong);
  def.type = draw.type(wrong);
  def.position = draw.place();
  def.rotation = draw.rotation(wrong);
  def.linear_velocity = draw.vector(5, wrong);
  def.sensor = draw.chance(0.1);
  BodyId id;
  ignore(create_body(world, def, id));
}

inline void create_any_joint(World& world, Draw& draw) {
  bool wrong = false;
  JointDef def = draw.joint(wrong);
  def.a = random_body(world, draw);
  def.b = random_body(world, draw);
  draw.joint_place(def, wrong);
  JointId id;
  ignore(create_joint(world, def, id));
}

/// One random call on bodies, shapes or joints.
inline void call_anything(World& world, Draw& draw) {
  bool wrong = false;
  const BodyId id = random_body(world, draw);
  switch (draw.below(12)) {
    case 0:
    case 1:
    case 2:
      return create_any_body(world, draw);
    case 3:
      return ignore(destroy_body(world, id));
    case 4:
      return ignore(set_shape(world, id, draw.shape(wrong)));
    case 5:
      return ignore(set_type(world, id, draw.type(wrong)));
    case 6:
    case 7:
      return create_any_joint(world, draw);
    case 8: {
      const uint32_t slot = draw.below(5), generation = 1 + draw.below(6);
      return ignore(destroy_joint(world, {slot, generation}));
    }
    case 9:
      return ignore(set_pose(world, id, draw.place(), draw.rotation(wrong)));
    case 10:
      return ignore(sleep_body(world, id));
    default:
      return ignore(apply_impulse(world, id, draw.push(500)));
  }
}

inline void make_turmoil(World& world, uint64_t seed) {
  Draw draw(seed * 1000003 + get_info(world).tick, false);
  for (uint32_t calls = draw.below(3); calls != 0; --calls) call_anything(world, draw);
  step(world);
}

/// A world after `ticks` ticks of this kind.
inline OwnedWorld make_turmoiled(uint64_t seed, uint32_t ticks, Capacity capacity = k_turmoil_capacity) {
  OwnedWorld owned(turmoil_settings(seed, capacity));
  for (uint32_t i = 0; i < 3; ++i) EXPECT_OK(bind_asset(owned.world, i));
  BodyDef ground;
  ground.type = BodyType::fixed;
  ground.shape = half_space();
  BodyId id;
  EXPECT_OK(create_body(owned.world, ground, id));
  for (uint32_t tick = 0; tick < ticks; ++tick) make_turmoil(owned.world, seed);
  return owned;
}

inline std::vector<uint64_t> save_all(const World& world) {
  std::vector<uint64_t> bytes(snapshot_bytes(get_info(world).capacity) / 8);
  EXPECT_OK(save(world, bytes_of(bytes), byte_count(bytes)));
  return bytes;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
