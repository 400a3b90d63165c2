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

}  // namespace
}  // namespace DETENT_NAMESPACE
}  // namespace detent
