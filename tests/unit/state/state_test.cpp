#include <detent/joint.h>

#include <utility>

#include "base/bytes.h"
#include "motion/activity.h"
#include "state/fields.h"
#include "state/ranges.h"
#include "state/slots.h"
#include "state/snapshot.h"
#include "state/view.h"
#include "tests/unit/world/lab.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

DETENT_TEST(state, every_bit_of_it_is_in_the_digest) {
  Lab lab = make_pile();
  const uint64_t before = digest(lab.world);
  const uint32_t end = snapshot_bytes(get_info(lab.world).capacity);
  uint32_t unseen = 0;
  for (uint32_t byte = sizeof(BlockHeader); byte < end; ++byte) {
    for (int bit = 0; bit < 8; ++bit) {
      lab.block()[byte] ^= static_cast<uint8_t>(1 << bit);
      unseen += digest(lab.world) == before ? 1u : 0u;
      lab.block()[byte] ^= static_cast<uint8_t>(1 << bit);
    }
  }
  EXPECT_EQ(unseen, 0u);
  EXPECT_EQ(digest(lab.world), before);
}

DETENT_TEST(bytes, are_the_same_if_no_bit_of_them_differs) {
  constexpr uint32_t k_count = 40;
  uint8_t one[k_count], other[k_count + 1];
  for (uint32_t start = 0; start < 2; ++start) {  // at any alignment
    for (uint32_t count = 0; count <= k_count; ++count) {
      for (uint32_t i = 0; i < k_count; ++i) other[start + i] = one[i] = static_cast<uint8_t>(37 * i);
      EXPECT_TRUE(have_same_bytes(one, other + start, count));
      for (uint32_t bit = 0; bit < 8 * k_count; ++bit) {
        other[start + bit / 8] ^= static_cast<uint8_t>(1 << bit % 8);
        EXPECT_EQ(have_same_bytes(one, other + start, count), bit / 8 >= count) << count << " bytes, bit " << bit;
        other[start + bit / 8] ^= static_cast<uint8_t>(1 << bit % 8);
      }
    }
  }
}

DETENT_TEST(state, no_bit_of_a_snapshot_can_be_flipped_into_a_crash_and_those_of_the_header_are_refused) {
  Lab lab = make_pile();
  const uint64_t before = digest(lab.world);
  const std::vector<uint64_t> good = lab.snapshot();
  Lab other(get_info(lab.world).capacity);
  uint32_t loaded = 0;
  for (uint32_t bit = 0; bit < byte_count(good) * 8; ++bit) {
    std::vector<uint64_t> bytes = good;
    bytes_of(bytes)[bit / 8] ^= static_cast<uint8_t>(1 << (bit % 8));
    const Status status = load(other.world, bytes_of(bytes), byte_count(bytes));
    const bool features = bit / 32 == offsetof(BlockHeader, left_out) / 4;  // one that no body uses may be left out
    if (bit / 8 < sizeof(BlockHeader) && !(features && status == Status::ok && digest(other.world) == before)) {
      EXPECT_NE(status, Status::ok) << "bit " << bit;
    }
    if (status != Status::ok) continue;
    ++loaded;
    other.run(1);  // any state that is let in can be stepped
  }
  EXPECT_GT(loaded, 0u);
}

DETENT_TEST(state, a_refused_snapshot_changes_nothing) {
  Lab lab = make_pile();
  const uint64_t before = digest(lab.world);
  std::vector<uint64_t> bytes = lab.snapshot();
  std::vector<uint64_t> bad = bytes;
  view_of(bytes_of(bad), get_info(lab.world).capacity).world.body_count += 1;
  lab.run(1);
  const uint64_t later = digest(lab.world);
  if (!k_big_endian) {
    EXPECT_EQ(load(lab.world, bytes_of(bad), byte_count(bad)), Status::corrupt);
  }
  EXPECT_EQ(digest(lab.world), later);
  for (uint32_t count = 0; count < byte_count(bytes); count += 64) {
    std::vector<uint64_t> part = bytes;
    EXPECT_EQ(load(lab.world, bytes_of(part), count), Status::truncated);
    EXPECT_EQ(restore(lab.world, bytes_of(part), count), Status::truncated);
  }
  EXPECT_EQ(digest(lab.world), later);
  EXPECT_OK(load(lab.world, bytes_of(bytes), byte_count(bytes)));
  EXPECT_EQ(digest(lab.world), before);
}

using Spoil = void (*)(const StateView<uint8_t>& state);

/// Returns the status of load() for the state of a world that `spoil` has changed.
Status load_spoiled(Lab (*make)(), Spoil spoil) {
  Lab lab = make();
  spoil(view_of(lab.world));
  std::vector<uint64_t> bytes = lab.snapshot();
  Lab other(get_info(lab.world).capacity);
  const uint64_t before = digest(other.world);
  const Status status = load(other.world, bytes_of(bytes), byte_count(bytes));
  if (status != Status::ok) {
    EXPECT_EQ(digest(other.world), before);
  }
  return status;
}
/// The world is a pile: boxes in slots 1 to 4, a ball in slot 5, slot 6 free.
Status load_spoiled(Spoil spoil) { return load_spoiled(make_pile, spoil); }

DETENT_TEST(state, motions_beyond_their_range_are_refused) {
  EXPECT_OK(load_spoiled([](const auto& state) {
    state.motions[1].linear_velocity.x = state.motions[1].pending_velocity.y = k_speed_max;
    state.motions[1].angular_momentum.z = state.motions[1].pending_angular_momentum.x = -k_angular_velocity_work_max;
  }));
  const Spoil spoils[] = {
      [](const auto& state) { state.motions[1].linear_velocity.x = k_speed_max + Real(1.0); },
      [](const auto& state) { state.motions[2].linear_velocity.y = -k_speed_max - Real(1.0); },
      [](const auto& state) { state.motions[3].angular_momentum.z = k_angular_velocity_work_max + Real(1.0); },
      [](const auto& state) { state.motions[4].pending_velocity.x = k_speed_max + Real(1.0); },
      [](const auto& state) { state.motions[4].pending_velocity.z = -k_speed_max - Real(1.0); },
      [](const auto& state) { state.motions[5].pending_angular_momentum.y = k_angular_velocity_work_max + Real(1.0); },
      [](const auto& state) { state.motions[5].pending_angular_momentum.x = -k_angular_velocity_work_max - Real(1.0); },
      [](const auto& state) { state.motions[0].linear_velocity.x = Real(1.0); },
      [](const auto& state) { state.motions[0].pending_angular_momentum.y = Real(1.0); },
      [](const auto& state) { state.motions[6].linear_velocity.x = Real(1.0); },
  };
  for (const Spoil& spoil : spoils) EXPECT_EQ(load_spoiled(spoil), Status::corrupt) << &spoil - spoils;
}

DETENT_TEST(state, contacts_out_of_their_order_or_twice_are_refused) {
  const auto second = [](const StateView<uint8_t>& state) -> ContactState& {
    // Inserts a copy of the first contact.
    for (uint32_t i = state.world.contact_count; i > 0; --i) {
      state.contacts[i] = state.contacts[i - 1];
      state.manifolds[i] = state.manifolds[i - 1];
    }
    ++state.world.contact_count;
    return state.contacts[1];
  };
  static const auto k_second = second;
  EXPECT_OK(load_spoiled([](const auto& state) { k_second(state).part = 1; }));
  EXPECT_OK(load_spoiled([](const auto& state) { k_second(state).part = UINT32_MAX; }));
  const Spoil spoils[] = {
      [](const auto& state) { k_second(state); },
      [](const auto& state) { k_second(state), state.contacts[0].part = 1; },
      [](const auto& state) { k_second(state).part = state.contacts[0].part = 7; },
      [](const auto& state) {
        std::swap(state.contacts[0], state.contacts[1]);
        std::swap(state.manifolds[0], state.manifolds[1]);
      },
  };
  for (const Spoil& spoil : spoils) EXPECT_EQ(load_spoiled(spoil), Status::corrupt) << &spoil - spoils;
}

DETENT_TEST(state, contacts_that_no_step_produces_are_refused) {
  const Spoil spoils[] = {
      [](const auto& state) { state.contacts[0].body_b = state.contacts[0].body_a; },
      [](const auto& state) { std::swap(state.contacts[0].body_a, state.contacts[0].body_b); },
      [](const auto& state) { state.contacts[state.world.contact_count - 1].body_b = 6; },
      [](const auto& state) { state.contacts[state.world.contact_count - 1].body_b = 7; },
      [](const auto& state) { state.contacts[0].touching = 2; },
      [](const auto& state) { state.contacts[0].point_count = 0; },
      [](const auto& state) { state.contacts[0].point_count = k_manifold_points_max + 1; },
      [](const auto& state) { state.contacts[0].point_count = 3; },
      [](const auto& state) { state.contacts[0].feature[3] = 0; },
      [](const auto& state) { state.contacts[0].feature[3] = state.contacts[0].feature[0]; },
      [](const auto& state) { state.contacts[0].normal_impulse[0] = Real(-1.0); },
      [](const auto& state) { state.contacts[0].normal_impulse[3] = Real(131001.0); },
      [](const auto& state) { state.contacts[0].friction_impulse.x = Real(131001.0); },
      [](const auto& state) { state.contacts[0].angular_impulse.z = Real(-131001.0); },
      [](const auto& state) { state.contacts[0].load = Real(-1.0); },
      [](const auto& state) { state.contacts[state.world.contact_count].age = 1; },
      [](const auto& state) { state.world.contact_count = state.contacts.count + 1; },
      [](const auto& state) { --state.world.contact_count; },
  };
  for (const Spoil& spoil : spoils) EXPECT_EQ(load_spoiled(spoil), Status::corrupt) << &spoil - spoils;
  EXPECT_OK(load_spoiled([](const auto& state) {
    state.contacts[0].normal_impulse[3] = state.contacts[0].friction_impulse.y = Real(131000.0);
    state.contacts[0].angular_impulse.y = Real(-131000.0);
    state.contacts[0].load = k_real_max;
  }));
}

DETENT_TEST(state, slots_that_are_free_before_the_free_word_or_beyond_the_capacity_are_refused) {
  static constexpr uint32_t k_bodies = 70;  // in three words
  const auto load_with = [](Spoil spoil) {
    Lab lab({k_bodies, 1, 0});
    for (int i = 0; i < 66; ++i) lab.add_box(0.25, i, 0, 0);
    EXPECT_EQ(view_of(lab.world).world.free_word, 2u);
    spoil(view_of(lab.world));
    std::vector<uint64_t> bytes = lab.snapshot();
    Lab other({k_bodies, 1, 0});
    return load(other.world, bytes_of(bytes), byte_count(bytes));
  };
  EXPECT_OK(load_with([](const auto&) {}));
  EXPECT_OK(load_with([](const auto& state) { state.world.free_word = 1; }));
  const auto empty = [](const StateView<uint8_t>& state, uint32_t slot) {
    state.poses[slot] = {};
    state.motions[slot] = {};
    state.properties[slot] = {};
    state.properties[slot].generation = 1;
    state.activities[slot] = {};
    state.slots[slot / 32] &= ~(1u << slot % 32);
    --state.world.body_count;
  };
  static const auto k_empty = empty;
  EXPECT_OK(load_with([](const auto& state) {
    k_empty(state, 63);
    state.world.free_word = 1;
  }));
  const Spoil spoils[] = {
      [](const auto& state) { k_empty(state, 63); },
      [](const auto& state) { k_empty(state, 32); },
      [](const auto& state) { k_empty(state, 0); },
      [](const auto& state) { state.world.free_word = 3; },
      [](const auto& state) { state.slots[2] |= 1u << (k_bodies % 32); },
      [](const auto& state) { state.slots[2] |= 1u << 31; },
      [](const auto& state) { state.slots[2] |= 1u << 5; },
      [](const auto& state) { state.slots[1] ^= 1u << 31; },
  };
  for (const Spoil& spoil : spoils) EXPECT_EQ(load_with(spoil), Status::corrupt) << &spoil - spoils;
  Lab full({32, 1, 0}), other({32, 1, 0});
  for (int i = 0; i < 32; ++i) full.add_box(0.25, i, 0, 0);
  view_of(full.world).world.free_word = view_of(full.world).slots.count;
  std::vector<uint64_t> bytes = full.snapshot();
  EXPECT_EQ(load(other.world, bytes_of(bytes), byte_count(bytes)), Status::corrupt) << "there is no such word";
}

DETENT_TEST(state, counts_that_are_not_those_of_the_bodies_are_refused) {
  const Spoil spoils[] = {
      [](const auto& state) { --state.world.body_count; },
      [](const auto& state) { ++state.world.slots_used; },
      [](const auto& state) { --state.world.slots_used; },
      [](const auto& state) { ++state.world.slots_retired; },
      [](const auto& state) { ++state.world.joint_count; },
      [](const auto& state) { ++state.world.joints_used; },
      [](const auto& state) { ++state.world.sensor_count; },
      [](const auto& state) { ++state.world.sensed_count; },
      [](const auto& state) { state.world.idle = 1; },
      [](const auto& state) { state.world.idle = 2; },
      [](const auto& state) { state.world.sleeping = 2; },
      [](const auto& state) { state.world.continuous = 2; },
      [](const auto& state) { state.world.reduction = 99; },
      [](const auto& state) { state.world.stabilisation = 99; },
      [](const auto& state) { state.world.iterations = 0; },
      [](const auto& state) { state.world.gravity.x = Real(2000.0); },
      [](const auto& state) { state.properties[6].generation = k_generation_last; },
      [](const auto& state) { state.properties[6].user_data = 1; },
      [](const auto& state) { state.poses[6].position.x = Coord(1.0); },
      [](const auto& state) { state.activities[6].still_ticks = 1; },
      [](const auto& state) { state.assets[0].kind = 5; },
      [](const auto& state) { state.assets[0].byte_count = 1; },
      [](const auto& state) { state.assets[0].digest = 1; },
  };
  for (const Spoil& spoil : spoils) EXPECT_EQ(load_spoiled(spoil), Status::corrupt) << &spoil - spoils;
}

DETENT_TEST(state, bodies_that_no_call_makes_are_refused) {
  const Spoil spoils[] = {
      [](const auto& state) { state.properties[1].type = 4; },
      [](const auto& state) { state.properties[1].generation = 0; },
      [](const auto& state) { state.properties[1].sensor = 2; },
      [](const auto& state) { state.properties[1].shape = 99; },
      [](const auto& state) { state.properties[1].size_exponent = 16; },
      [](const auto& state) { state.properties[1].size_exponent = -15; },
      [](const auto& state) { state.properties[1].rotation_locks = k_rotation_locks_all + 1; },
      [](const auto& state) { state.properties[1].rotation_locks = 1; },
      [](const auto& state) { state.properties[1].asset = 1; },
      [](const auto& state) { state.properties[1].size.x = Unit(-0.25); },
      [](const auto& state) { state.properties[1].size.y = Unit(0.0); },
      [](const auto& state) { state.properties[1].size.z = Unit(0.0); },
      [](const auto& state) { state.properties[1].bounding_radius = Unit(0.75); },
      [](const auto& state) { state.properties[1].rounding = Unit(-0.125); },
      [](const auto& state) { state.properties[1].rounding = Unit(0x1p-17); },
      [](const auto& state) { state.properties[5].rounding = Unit(0x1p-3); },
      [](const auto& state) { state.properties[5].size.x = Unit(0.5), state.properties[5].size.y = Unit(0.25); },
      [](const auto& state) { state.properties[5].size.z = Unit(0.25); },
      [](const auto& state) { state.properties[1].mass = Scaled(0.0); },
      [](const auto& state) { state.properties[1].mass = Scaled(0x1p61); },
      [](const auto& state) { state.properties[1].mass = scaled_by_power(Scaled(1.0), -61); },
      [](const auto& state) { state.properties[1].inverse_inertia[0] = Scaled(0.5); },
      [](const auto& state) { state.properties[1].inverse_inertia[1] = Scaled(0.0); },
      [](const auto& state) { state.properties[1].inverse_inertia[2] = Scaled(0x1p31); },
      [](const auto& state) { state.properties[1].friction = Scaled(16.5); },
      [](const auto& state) { state.properties[1].friction = Scaled(-0.5); },
      [](const auto& state) { state.properties[1].restitution = Scaled(1.25); },
      [](const auto& state) { state.properties[1].restitution = Scaled(-0.25); },
      [](const auto& state) { state.properties[1].rolling_resistance = Scaled(16.25); },
      [](const auto& state) { state.properties[1].rolling_resistance = Scaled(-0.25); },
      [](const auto& state) { state.properties[1].linear_damping = Scaled(1025.0); },
      [](const auto& state) { state.properties[1].linear_damping = Scaled(-1.0); },
      [](const auto& state) { state.properties[1].angular_damping = Scaled(1025.0); },
      [](const auto& state) { state.properties[1].angular_damping = Scaled(-1.0); },
      [](const auto& state) { state.properties[1].gravity_scale = Scaled(1025.0); },
      [](const auto& state) { state.properties[1].gravity_scale = Scaled(-1025.0); },
      [](const auto& state) { state.properties[1].restitution_rule = 99; },
      [](const auto& state) { state.properties[0].size_exponent = 1; },
      [](const auto& state) { state.properties[0].size.x = Unit(0.5); },
      [](const auto& state) { state.properties[0].bounding_radius = Unit(0.5); },
      [](const auto& state) { state.properties[0].inverse_inertia[2] = Scaled(1.0); },
      [](const auto& state) { state.properties[0].type = static_cast<uint32_t>(BodyType::dynamic); },
      [](const auto& state) { state.poses[1].rotation.w = Unit(0.5); },
      [](const auto& state) { state.activities[0].still_ticks = 1; },
      [](const auto& state) { state.activities[1].substeps = 65; },
      [](const auto& state) { state.activities[1].calm_ticks = 61; },
      [](const auto& state) { state.activities[1].still_ticks = UINT16_MAX; },
      [](const auto& state) { state.activities[1].pending_event = 99; },
      [](const auto& state) { state.activities[1].pending_event = static_cast<uint16_t>(BodyEventType::fell_asleep); },
      [](const auto& state) { state.activities[1].asleep = 3; },
      [](const auto& state) { state.activities[1].asleep = 8; },
  };
  for (const Spoil& spoil : spoils) EXPECT_EQ(load_spoiled(spoil), Status::corrupt) << &spoil - spoils;
}

/// Three boxes in a row, held by two joints; a third joint slot is free.
Lab make_chain() {
  Lab lab({3, 8, 0, true, 3});
  JointDef def;
  def.type = JointType::wheel;  // its first motion is a length, its second an angle
  def.anchor_a = reals(0.75, 0, 0);
  def.anchor_b = reals(-0.75, 0, 0);
  for (int i = 0; i < 3; ++i) {
    const BodyId id = lab.add_box(0.5, 1.5 * i, 0, 0);
    def.a = def.b;
    def.b = id;
    JointId joint;
    if (i > 0) {
      EXPECT_OK(create_joint(lab.world, def, joint));
    }
  }
  lab.run(5);
  return lab;
}

DETENT_TEST(state, joints_that_no_call_makes_are_refused) {
  const auto load_with = [](Spoil spoil) { return load_spoiled(make_chain, spoil); };
  EXPECT_OK(load_with([](const auto&) {}));
  EXPECT_OK(load_with([](const auto& state) {
    JointState& joint = state.joints[1];
    joint.collide = joint.limited[0] = joint.limited[1] = 1;
    joint.anchor_a.x = joint.anchor_b.z = Real(-4096.0);
    joint.speed[0] = joint.speed[1] = Real(1024.0);
    joint.frequency[0] = Real(1024.0), joint.frequency[1] = Real(0x1p-10);
    joint.damping_ratio[0] = joint.damping_ratio[1] = Real(64.0);
    joint.force_max[1] = joint.friction[0] = joint.friction[1] = joint.break_force = joint.break_torque =
        Scaled(0x1p60);
    joint.impulse[0] = Real(-16384.0), joint.impulse[k_joint_rows_max - 1] = Real(16384.0);
  }));
  const Spoil spoils[] = {
      [](const auto& state) { --state.world.joint_count; },
      [](const auto& state) { ++state.world.joints_used; },
      [](const auto& state) { --state.world.joints_used; },
      [](const auto& state) { state.joints[2].user_data = 1; },
      [](const auto& state) { state.joints[2].generation = 1; },
      [](const auto& state) { state.joints[0].generation = 0; },
      [](const auto& state) { state.joints[0].type = static_cast<uint32_t>(k_joint_type_last) + 1; },
      [](const auto& state) { state.joints[0].body_b = state.joints[0].body_a; },
      [](const auto& state) { state.joints[0].body_a = 3; },
      [](const auto& state) { state.joints[0].body_b = 3; },
      [](const auto& state) { state.joints[1].collide = 2; },
      [](const auto& state) { state.joints[1].anchor_a.y = Real(4097.0); },
      [](const auto& state) { state.joints[1].anchor_b.x = Real(-4097.0); },
      [](const auto& state) { state.joints[1].frame_a.w = Unit(0.25); },
      [](const auto& state) { state.joints[1].frame_b.w = Unit(0.25); },
      [](const auto& state) { state.joints[1].limited[0] = 2; },
      [](const auto& state) { state.joints[1].limited[1] = 2; },
      [](const auto& state) { state.joints[1].lower[0] = state.joints[1].upper[0] + Real(1.0); },
      [](const auto& state) { state.joints[1].lower[1] = Real(-3.25); },
      [](const auto& state) { state.joints[1].upper[1] = Real(3.25); },
      [](const auto& state) { state.joints[1].target[1] = Real(3.25); },
      [](const auto& state) { state.joints[1].target[1] = Real(-3.25); },
      [](const auto& state) { state.joints[1].frequency[0] = Real(0x1p-11); },
      [](const auto& state) { state.joints[1].frequency[1] = Real(1025.0); },
      [](const auto& state) { state.joints[1].damping_ratio[0] = Real(-1.0); },
      [](const auto& state) { state.joints[1].damping_ratio[1] = Real(65.0); },
      [](const auto& state) { state.joints[1].speed[0] = Real(1025.0); },
      [](const auto& state) { state.joints[1].speed[1] = Real(-1025.0); },
      [](const auto& state) { state.joints[1].force_max[0] = Scaled(-1.0); },
      [](const auto& state) { state.joints[1].force_max[1] = Scaled(0x1p61); },
      [](const auto& state) { state.joints[1].break_force = Scaled(-1.0); },
      [](const auto& state) { state.joints[1].break_torque = Scaled(-1.0); },
      [](const auto& state) { state.joints[0].impulse[0] = Real(16385.0); },
      [](const auto& state) { state.joints[0].impulse[k_joint_rows_max - 1] = Real(-16385.0); },
  };
  for (const Spoil& spoil : spoils) EXPECT_EQ(load_with(spoil), Status::corrupt) << &spoil - spoils;
}

/// Balls in slots 0, 2 and 4; sensors in slots 1 and 3, each overlapping two of the balls.
Lab make_gates() {
  Lab lab({6, 8, 0, true, 0, 5});
  for (int i = 0; i < 5; ++i) {
    BodyDef def;
    def.type = BodyType::kinematic;
    def.shape = sphere(real(1));
    def.position = position(i, 0, 0);
    def.sensor = i % 2 == 1;
    lab.add(def);
  }
  lab.run(1);
  return lab;
}

DETENT_TEST(state, sensor_overlaps_that_no_step_produces_are_refused) {
  const auto load_with = [](Spoil spoil) { return load_spoiled(make_gates, spoil); };
  EXPECT_OK(load_with([](const auto& state) { EXPECT_EQ(state.world.sensed_count, 4u); }));
  const Spoil spoils[] = {
      [](const auto& state) { ++state.world.sensor_count; },
      [](const auto& state) { --state.world.sensor_count; },
      [](const auto& state) { --state.world.sensed_count; },
      [](const auto& state) { state.world.sensed_count = 6; },
      [](const auto& state) { state.world.sensed_count = 5; },
      [](const auto& state) { state.sensed[4].sensor = 3; },
      [](const auto& state) { state.sensed[4].body = 1; },
      [](const auto& state) { state.sensed[0].sensor = 0; },
      [](const auto& state) { state.sensed[3].sensor = 6; },
      [](const auto& state) { state.sensed[3].body = 6; },
      [](const auto& state) { state.sensed[3].body = 5; },
      [](const auto& state) { state.sensed[0].body = 1; },
      [](const auto& state) { state.sensed[0].body = 3; },
      [](const auto& state) { state.sensed[1].body = state.sensed[0].body; },
      [](const auto& state) { std::swap(state.sensed[1], state.sensed[2]); },
      [](const auto& state) { std::swap(state.sensed[0], state.sensed[1]); },
  };
  for (const Spoil& spoil : spoils) EXPECT_EQ(load_with(spoil), Status::corrupt) << &spoil - spoils;
}

DETENT_TEST(state, a_restored_world_goes_on_as_if_nothing_had_happened) {
  Lab lab = make_pile();
  const std::vector<uint64_t> seed = lab.snapshot();
  std::vector<uint64_t> expected;
  for (int i = 0; i < 60; ++i) {
    lab.run(1);
    expected.push_back(digest(lab.world));
  }
  Lab other(get_info(lab.world).capacity);
  for (int round = 0; round < 2; ++round) {
    std::vector<uint64_t> bytes = seed;
    ASSERT_OK(round == 0 ? restore(other.world, bytes_of(bytes), byte_count(bytes))
                         : load(other.world, bytes_of(bytes), byte_count(bytes)));
    for (const uint64_t want : expected) {
      other.run(1);
      ASSERT_EQ(digest(other.world), want);
    }
  }
}

DETENT_TEST(state, bodies_may_be_created_and_destroyed_between_a_snapshot_and_its_restore) {
  Lab lab = make_pile();
  const std::vector<uint64_t> seed = lab.snapshot();
  const auto play = [&] {
    const BodyId id = lab.add_box(0.25, 0, 6, 0);
    lab.run(10);
    EXPECT_OK(destroy_body(lab.world, next_body(lab.world, {})));
    EXPECT_OK(destroy_body(lab.world, id));
    lab.add_box(0.25, 1, 6, 0);
    lab.run(10);
    return digest(lab.world);
  };
  const uint64_t first = play();
  ASSERT_OK(restore(lab.world, reinterpret_cast<const uint8_t*>(seed.data()), byte_count(seed)));
  EXPECT_EQ(play(), first);
}

DETENT_TEST(state, the_digest_does_not_depend_on_the_capacity) {
  const auto run = [](Capacity capacity) {
    Lab lab(capacity);
    lab.add_ground();
    for (int i = 0; i < 3; ++i) lab.add_box(0.5, 0.1 * i, 0.5 + i, 0);
    lab.run(30);
    return digest(lab.world);
  };
  EXPECT_EQ(run({4, 8, 0}), run({100, 50, 3}));
}

DETENT_TEST(state, a_snapshot_of_another_kind_is_named) {
  Lab lab = make_pile();
  const std::vector<uint64_t> good = lab.snapshot();
  const auto altered = [&](uint32_t word) {
    std::vector<uint64_t> bytes = good;
    bytes_of(bytes)[word * 4 + 1] ^= 1;
    return load(lab.world, bytes_of(bytes), byte_count(bytes));
  };
  EXPECT_EQ(altered(0), Status::not_detent);
  EXPECT_EQ(altered(1), Status::format_unknown);
  EXPECT_EQ(altered(2), Status::simulation_differs);
  EXPECT_EQ(altered(3), Status::config_differs);
  EXPECT_EQ(altered(4), Status::capacity_differs);
  EXPECT_EQ(altered(5), Status::capacity_differs);
  EXPECT_EQ(altered(6), Status::capacity_differs);
}

DETENT_TEST(state, a_snapshot_reads_the_same_in_pieces_of_any_size) {
  Lab lab = make_pile();
  const std::vector<uint64_t> whole = lab.snapshot();
  for (const uint32_t piece : {1u, 7u, 64u, 250u}) {
    std::vector<uint8_t> parts(byte_count(whole));
    for (uint32_t at = 0; at < parts.size(); at += piece) {
      const uint32_t left = static_cast<uint32_t>(parts.size()) - at;
      ASSERT_TRUE(snapshot_read(lab.world, at, parts.data() + at, left < piece ? left : piece));
    }
    EXPECT_EQ(memcmp(parts.data(), whole.data(), parts.size()), 0);
  }
  uint8_t byte = 0;
  EXPECT_FALSE(snapshot_read(lab.world, byte_count(whole), &byte, 1));
}

DETENT_TEST(state, the_layout_is_the_same_on_every_target) {
  constexpr Capacity k_capacity = {10, 20, 3};
  bool fits = false;
  const uint32_t bytes_without_lanes = layout_of<false>(k_capacity, fits).bytes;
  EXPECT_EQ(world_bytes(k_capacity), layout_of(k_capacity, fits).bytes);
  EXPECT_EQ(world_bytes(k_capacity) > bytes_without_lanes, k_may_have_lanes);
#if defined(DETENT_FX64)
  EXPECT_EQ(snapshot_bytes(k_capacity), 7272u);
  EXPECT_EQ(bytes_without_lanes, 29760u);
#elif defined(DETENT_FX32)
  EXPECT_EQ(snapshot_bytes(k_capacity), 7232u);
  EXPECT_EQ(bytes_without_lanes, 29240u);
#elif defined(DETENT_F32)
  EXPECT_EQ(snapshot_bytes(k_capacity), 5472u);
  EXPECT_EQ(bytes_without_lanes, 23120u);
#else
  EXPECT_EQ(snapshot_bytes(k_capacity), 8752u);
  EXPECT_EQ(bytes_without_lanes, 39240u);
#endif
}

DETENT_TEST(state, assets_are_bound_by_content) {
  alignas(8) static const uint8_t content[] = {1, 2, 3, 4, 5}, other[] = {1, 2, 3, 4, 6};
  Lab lab({1, 1, 2});
  EXPECT_EQ(bind_asset(lab.world, 0), Status::asset_missing);
  const Asset table[] = {{content, sizeof content}, {other, sizeof other}};
  lab.world.hooks.assets = {table, 2};
  ASSERT_OK(bind_asset(lab.world, 1));
  EXPECT_EQ(bind_asset(lab.world, 2), Status::out_of_range);
  const std::vector<uint64_t> good = lab.snapshot();
  const auto load_with = [&](AssetTable assets) {
    Lab fresh({1, 1, 2});
    fresh.world.hooks.assets = assets;
    std::vector<uint64_t> bytes = good;
    return load(fresh.world, bytes_of(bytes), byte_count(bytes));
  };
  EXPECT_OK(load_with({table, 2}));
  EXPECT_EQ(load_with({table, 1}), Status::asset_missing);
  const Asset swapped[] = {table[1], table[0]};
  EXPECT_EQ(load_with({swapped, 2}), Status::asset_mismatch);
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
