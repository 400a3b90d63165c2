#include "state/slots.h"
#include "state/view.h"
#include "tests/unit/world/lab.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

DETENT_TEST(pool, a_body_has_an_id_that_is_valid_until_it_is_destroyed) {
  Lab lab({2, 2, 0});
  const BodyId id = lab.add_box(0.5, 0, 0, 0);
  EXPECT_TRUE(is_valid(lab.world, id));
  EXPECT_OK(destroy_body(lab.world, id));
  EXPECT_FALSE(is_valid(lab.world, id));
  EXPECT_EQ(destroy_body(lab.world, id), Status::bad_id);
}

DETENT_TEST(pool, the_null_id_and_made_up_ids_are_refused_by_every_call) {
  Lab lab({2, 2, 0});
  lab.add_box(0.5, 0, 0, 0);
  const uint64_t before = digest(lab.world);
  const BodyId bad[] = {{}, {1, 2}, {1, 0}, {2, 1}, {3, 1}, {UINT32_MAX, 1}, {0, 1}};
  for (const BodyId id : bad) {
    Pose pose{};
    Vec3<Real> linear_velocity{}, angular_velocity{};
    Scaled mass{};
    uint32_t user_data = 7;
    EXPECT_FALSE(is_valid(lab.world, id));
    EXPECT_EQ(destroy_body(lab.world, id), Status::bad_id);
    EXPECT_EQ(set_pose(lab.world, id, position(0, 0, 0), {0.0, 0.0, 0.0, 1.0}), Status::bad_id);
    EXPECT_EQ(set_velocity(lab.world, id, reals(0, 0, 0), reals(0, 0, 0)), Status::bad_id);
    EXPECT_EQ(apply_force(lab.world, id, scaleds(1, 0, 0)), Status::bad_id);
    EXPECT_EQ(apply_torque(lab.world, id, scaleds(1, 0, 0)), Status::bad_id);
    EXPECT_EQ(apply_impulse(lab.world, id, scaleds(1, 0, 0)), Status::bad_id);
    EXPECT_EQ(apply_impulse_at(lab.world, id, scaleds(1, 0, 0), reals(0, 0, 0)), Status::bad_id);
    EXPECT_EQ(apply_angular_impulse(lab.world, id, scaleds(1, 0, 0)), Status::bad_id);
    EXPECT_EQ(set_user_data(lab.world, id, 1), Status::bad_id);
    EXPECT_EQ(get_pose(lab.world, id, pose), Status::bad_id);
    EXPECT_EQ(get_velocity(lab.world, id, linear_velocity, angular_velocity), Status::bad_id);
    EXPECT_EQ(get_mass(lab.world, id, mass), Status::bad_id);
    EXPECT_EQ(get_user_data(lab.world, id, user_data), Status::bad_id);
    EXPECT_EQ(user_data, 7u);
  }
  EXPECT_EQ(digest(lab.world), before);
}

DETENT_TEST(pool, a_full_pool_refuses_and_changes_nothing) {
  Lab lab({3, 2, 0});
  for (int i = 0; i < 3; ++i) lab.add_box(0.5, 2.0 * i, 0, 0);
  const uint64_t before = digest(lab.world);
  BodyId id = {77, 88};
  EXPECT_EQ(create_body(lab.world, BodyDef{}, id), Status::pool_full);
  EXPECT_EQ(id, (BodyId{77, 88}));
  EXPECT_EQ(digest(lab.world), before);
}

DETENT_TEST(pool, a_stale_id_stays_stale_when_its_slot_is_reused) {
  Lab lab({1, 1, 0});
  const BodyId first = lab.add_box(0.5, 0, 0, 0);
  ASSERT_OK(destroy_body(lab.world, first));
  const BodyId second = lab.add_box(0.5, 0, 0, 0);
  EXPECT_EQ(second.slot, first.slot);
  EXPECT_FALSE(is_valid(lab.world, first));
  EXPECT_TRUE(is_valid(lab.world, second));
}

DETENT_TEST(pool, ids_have_a_null_an_order_and_a_hash) {
  EXPECT_TRUE(is_null(BodyId{}));
  EXPECT_FALSE(is_null(BodyId{1, 1}));
  EXPECT_TRUE(is_null(JointId{}));
  EXPECT_TRUE((BodyId{1, 9} < BodyId{2, 1}));
  EXPECT_TRUE((BodyId{2, 1} < BodyId{2, 2}));
  EXPECT_FALSE((BodyId{2, 2} < BodyId{2, 2}));
  EXPECT_TRUE((JointId{1, 1} < JointId{1, 2}));
  EXPECT_NE(hash_of(BodyId{1, 2}), hash_of(BodyId{2, 1}));
  EXPECT_NE(hash_of(JointId{1, 2}), hash_of(JointId{1, 3}));
}

DETENT_TEST(pool, a_slot_whose_generations_are_used_up_is_retired_and_counted) {
  Lab lab({2, 1, 0});
  StateView<uint8_t> state = view_of(lab.world);
  const BodyId old = lab.add_box(0.5, 0, 0, 0);
  ASSERT_OK(destroy_body(lab.world, old));
  state.properties[0].generation = k_generation_last - 2;
  for (uint32_t generation = k_generation_last - 1; generation != 0; ++generation) {
    const BodyId id = lab.add_box(0.5, 0, 0, 0);
    ASSERT_EQ(id, (BodyId{1, generation}));
    ASSERT_EQ(get_info(lab.world).slots_retired, 0u);
    ASSERT_OK(destroy_body(lab.world, id));
  }
  EXPECT_EQ(get_info(lab.world).slots_retired, 1u);
  EXPECT_FALSE(is_valid(lab.world, (BodyId{1, k_generation_last})));
  EXPECT_EQ(lab.add_box(0.5, 0, 0, 0).slot, 2u);
  BodyId none;
  EXPECT_EQ(create_body(lab.world, BodyDef{}, none), Status::pool_full);
  std::vector<uint64_t> snapshot = lab.snapshot();
  EXPECT_OK(load(lab.world, bytes_of(snapshot), byte_count(snapshot)));
}

DETENT_TEST(pool, the_lowest_free_slot_is_given_out_whatever_was_destroyed_first) {
  Lab lab({100, 1, 0});
  std::vector<BodyId> ids;
  for (int i = 0; i < 100; ++i) ids.push_back(lab.add_box(0.5, 2.0 * i, 0, 0));
  for (const uint32_t slot : {70u, 3u, 40u}) ASSERT_OK(destroy_body(lab.world, ids[slot]));
  EXPECT_EQ(lab.add_box(0.5, 0, 0, 0).slot, 4u);
  EXPECT_EQ(lab.add_box(0.5, 0, 0, 0).slot, 41u);
  EXPECT_EQ(lab.add_box(0.5, 0, 0, 0).slot, 71u);
}

DETENT_TEST(pool, bodies_are_visited_in_slot_order) {
  Lab lab({10, 1, 0});
  std::vector<BodyId> ids;
  for (int i = 0; i < 5; ++i) ids.push_back(lab.add_box(0.5, 2.0 * i, 0, 0));
  ASSERT_OK(destroy_body(lab.world, ids[2]));
  ids.erase(ids.begin() + 2);
  BodyId at = next_body(lab.world, {});
  for (const BodyId id : ids) {
    EXPECT_EQ(at, id);
    at = next_body(lab.world, at);
  }
  EXPECT_EQ(at, BodyId{});
}

DETENT_TEST(pool, contacts_beyond_the_capacity_are_counted_and_the_same_ones_are_kept_every_time) {
  const auto run = [](uint32_t contacts) {
    Lab lab({9, contacts, 0});
    lab.add_ground();
    for (int i = 0; i < 8; ++i) lab.add_box(0.5, 3.0 * i, 0.5, 0);
    const StepReport report = lab.run(1);
    EXPECT_EQ(report.contacts.count + report.lost.contacts + report.lost.pairs, 8u);
    EXPECT_EQ(report.complete(), contacts >= 8);
    EXPECT_EQ(get_info(lab.world).contacts, report.contacts.count);
    for (const ContactState& contact : view_of(lab.world).contacts.first(report.contacts.count)) {
      EXPECT_EQ(contact.body_a, 0u);
      EXPECT_LE(contact.body_b, contacts) << "the lowest of equally deep pairs are kept";
    }
    return digest(lab.world);
  };
  EXPECT_EQ(run(5), run(5));
  run(2);
  run(0);
  run(8);
}

DETENT_TEST(pool, of_contacts_beyond_the_capacity_the_deepest_are_kept) {
  for (const bool deepest_first : {false, true}) {
    Lab lab({9, 3, 0});
    lab.add_ground();
    for (int i = 0; i < 8; ++i) lab.add_box(0.5, 3.0 * i, 0.5 - (deepest_first ? 7 - i : i) / 64.0, 0);
    const StepReport report = lab.run(1);
    // The capacity is six pairs.
    EXPECT_EQ(report.lost.pairs, 2u);
    EXPECT_EQ(report.lost.contacts, 3u);
    ASSERT_EQ(report.contacts.count, 3u);
    for (uint32_t i = 0; i < 3; ++i) EXPECT_EQ(view_of(lab.world).contacts[i].body_b, deepest_first ? 1 + i : 6 + i);
  }
}

DETENT_TEST(pool, of_pairs_beyond_the_capacity_those_high_above_the_ground_give_way) {
  for (const bool flying_first : {false, true}) {
    Lab lab({11, 2, 0});
    lab.add_ground();
    const auto add_flying = [&] {
      for (int i = 0; i < 6; ++i) lab.add_box(0.5, 3.0 * i, 50, 0);
    };
    if (flying_first) add_flying();
    const BodyId low = lab.add_box(0.5, 0, 0.5, 0), high = lab.add_box(0.5, 0, 1.5, 0);
    if (!flying_first) add_flying();
    const StepReport report = lab.run(1);
    EXPECT_EQ(report.contacts.pairs, 9u);
    EXPECT_EQ(report.lost.pairs, 5u);
    ASSERT_EQ(report.contacts.count, 2u);
    const Span<ContactState> contacts = view_of(lab.world).contacts;
    EXPECT_EQ(contacts[0].body_b, low.slot - 1);
    EXPECT_EQ(contacts[1].body_a, low.slot - 1);
    EXPECT_EQ(contacts[1].body_b, high.slot - 1);
  }
}

DETENT_TEST(pool, a_destroyed_body_takes_its_contacts_along) {
  Lab lab({4, 8, 0});
  lab.add_ground();
  const BodyId low = lab.add_box(0.5, 0, 0.5, 0);
  lab.add_box(0.5, 0, 1.5, 0);
  EXPECT_EQ(lab.run(2).contacts.count, 2u);
  ASSERT_OK(destroy_body(lab.world, low));
  EXPECT_EQ(get_info(lab.world).contacts, 0u);
  std::vector<uint64_t> snapshot = lab.snapshot();
  EXPECT_OK(load(lab.world, bytes_of(snapshot), byte_count(snapshot)));
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
