#include "contact/contact_cache.h"

#include "contact/terrain_manifolds.h"
#include "tests/common/oracle/bodies.h"

/// Tests that the contacts of the parts of a pair keep their keys and impulses from tick to tick.
namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

struct Last {
  ContactState contact[3] = {};
  uint32_t index[3] = {0, 1, 2};
  PairBefore pair = {contact, index, 0};

  void add(uint32_t part, uint32_t first, uint32_t second) {
    ContactState& made = contact[pair.count++];
    made.part = part;
    made.point_count = 2;
    made.feature[0] = first;
    made.feature[1] = second;
  }
};

void add(TerrainContacts& contacts, uint32_t key, uint32_t first, uint32_t second) {
  TerrainContact& made = contacts.contact[contacts.count++];
  made = {};
  made.key = key;
  made.geometry.count = 2;
  made.geometry.point[0].feature = first;
  made.geometry.point[1].feature = second;
}

DETENT_TEST(contact_cache, a_contact_with_a_new_key_goes_on_with_that_whose_features_it_shares) {
  Last last;
  last.add(10, 1, 2);
  last.add(20, 3, 4);
  last.add(30, 5, 6);
  TerrainContacts found;
  add(found, 11, 4, 3);  // all of 20's
  add(found, 15, 7, 8);  // nothing of any
  add(found, 30, 1, 2);  // 30 is there, whatever its features are
  continue_keys(last.pair, found);
  ASSERT_EQ(found.count, 3u);
  EXPECT_EQ(found.contact[0].key, 15u);
  EXPECT_EQ(found.contact[1].key, 20u);
  EXPECT_EQ(found.contact[1].geometry.point[0].feature, 4u);
  EXPECT_EQ(found.contact[2].key, 30u);
}

DETENT_TEST(contact_cache, two_contacts_do_not_go_on_with_one) {
  Last last;
  last.add(10, 1, 2);
  TerrainContacts found;
  add(found, 11, 1, 9);
  add(found, 12, 1, 2);
  continue_keys(last.pair, found);
  EXPECT_EQ(found.contact[0].key, 10u);
  EXPECT_EQ(found.contact[1].key, 12u);
}

DETENT_TEST(contact_cache, what_a_contact_bore_that_ends_is_borne_by_another_at_the_same_points) {
  Last last;
  last.add(10, 1, 2);
  last.add(20, 2, 3);
  last.add(30, 4, 5);
  for (uint32_t i = 0; i < 3; ++i) {
    last.contact[i].normal_impulse[0] = real_near(1 + i);
    last.contact[i].normal_impulse[1] = real_near(0.25);
    last.contact[i].friction_impulse = reals_near({{0.5, 0, static_cast<double>(i)}});
    last.contact[i].load = real_near(8 * (1 + i));
  }
  TerrainContacts found;
  add(found, 10, 1, 2);
  add(found, 30, 3, 2);
  EXPECT_EQ(heir_of(last.contact[0], found), UINT32_MAX) << "it goes on";
  EXPECT_EQ(heir_of(last.contact[1], found), 0u);
  EXPECT_EQ(heir_of(last.contact[2], found), UINT32_MAX) << "it goes on, with other points";
  found.contact[1].key = 40;
  EXPECT_EQ(heir_of(last.contact[2], found), UINT32_MAX) << "no contact has its points";
  ContactState heir = continued_contact(1, 2, 10, found.contact[0].geometry, &last.contact[0]);
  take_impulses(last.contact[1], heir);
  EXPECT_EQ(real_to_host(heir.normal_impulse[0]), 1);
  EXPECT_EQ(real_to_host(heir.normal_impulse[1]), 0.25 + 2);
  EXPECT_TRUE(heir.friction_impulse == reals_near({{0.5, 0, 0}}));
  EXPECT_EQ(real_to_host(heir.load), 8);
  heir.normal_impulse[1] = k_real_max;
  take_impulses(last.contact[1], heir);
  EXPECT_TRUE(heir.normal_impulse[1] == k_real_max) << "no overflow";
}

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
