#pragma once
#include <detent/world.h>

#include <vector>

#include "tests/common/support/test.h"

/// Compares two steps that must be equal.
namespace detent {
inline namespace DETENT_NAMESPACE {

inline void expect_equal(const StepReport& a, const StepReport& b) {
  EXPECT_EQ(a.contacts.pairs, b.contacts.pairs);
  EXPECT_EQ(a.contacts.count, b.contacts.count);
  EXPECT_EQ(a.contacts.points, b.contacts.points);
  EXPECT_EQ(a.contacts.recycled, b.contacts.recycled);
  EXPECT_EQ(a.contacts.capped, b.contacts.capped);
  EXPECT_EQ(a.contacts.sweeps_saved, b.contacts.sweeps_saved);
  EXPECT_EQ(a.contacts.substeps, b.contacts.substeps);
  EXPECT_EQ(a.contacts.colour_overflows, b.contacts.colour_overflows);
  EXPECT_EQ(a.joints.count, b.joints.count);
  EXPECT_EQ(a.joints.broken, b.joints.broken);
  EXPECT_EQ(a.joints.undecided, b.joints.undecided);
  EXPECT_EQ(a.ccd.impacts, b.ccd.impacts);
  EXPECT_EQ(a.ccd.tests, b.ccd.tests);
  EXPECT_EQ(a.ccd.skipped, b.ccd.skipped);
  EXPECT_EQ(a.ccd.kept_apart, b.ccd.kept_apart);
  EXPECT_EQ(a.ccd.undecided, b.ccd.undecided);
  EXPECT_EQ(a.ccd.bodies_stopped, b.ccd.bodies_stopped);
  EXPECT_EQ(a.ccd.overlaps_left, b.ccd.overlaps_left);
  EXPECT_TRUE(a.ccd.lost_time == b.ccd.lost_time);
  EXPECT_EQ(a.lost.pairs, b.lost.pairs);
  EXPECT_EQ(a.lost.contacts, b.lost.contacts);
  EXPECT_EQ(a.lost.contact_parts, b.lost.contact_parts);
  EXPECT_EQ(a.lost.impacts, b.lost.impacts);
  EXPECT_EQ(a.lost.joint_couplings, b.lost.joint_couplings);
  EXPECT_EQ(a.lost.sensed, b.lost.sensed);
  EXPECT_EQ(a.lost.sensed_undecided, b.lost.sensed_undecided);
  EXPECT_EQ(a.events.contact, b.events.contact);
  EXPECT_EQ(a.events.contact_dropped, b.events.contact_dropped);
  EXPECT_EQ(a.events.joint, b.events.joint);
  EXPECT_EQ(a.events.sensor, b.events.sensor);
  EXPECT_EQ(a.events.body, b.events.body);
  EXPECT_EQ(a.events.capacity, b.events.capacity);
  EXPECT_EQ(a.islands, b.islands);
  EXPECT_EQ(a.awake, b.awake);
  EXPECT_EQ(a.woke, b.woke);
  EXPECT_EQ(a.fell_asleep, b.fell_asleep);
  EXPECT_EQ(a.substeps_max, b.substeps_max);
  EXPECT_EQ(a.saturations, b.saturations);
}

inline void expect_equal(const std::vector<ContactEvent>& all_a, const std::vector<ContactEvent>& all_b,
                         uint32_t count) {
  for (uint32_t i = 0; i < count; ++i) {
    const ContactEvent &a = all_a[i], &b = all_b[i];
    ASSERT_TRUE(a.type == b.type && a.a == b.a && a.b == b.b && a.normal == b.normal && a.point.x == b.point.x &&
                a.point.y == b.point.y && a.point.z == b.point.z && a.approach_speed == b.approach_speed)
        << "event " << i;
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
