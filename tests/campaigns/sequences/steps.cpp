#include <cmath>
#include <set>

#include "tests/campaigns/sequences/game.h"

namespace detent {
inline namespace DETENT_NAMESPACE {
namespace {

/// Whether a load exceeds what a joint bears, but for rounding.
bool exceeds(const Vec3<Scaled>& load, Scaled most) {
  const double bound = scaled_to_host(most);
  const double x = scaled_to_host(load.x), y = scaled_to_host(load.y), z = scaled_to_host(load.z);
  return bound > 0 && std::sqrt(x * x + y * y + z * z) > bound * (1 - 1e-5);
}

}  // namespace

/// A step: what breaks has borne too much, and nothing touches that may not.
void Game::step_once() {
  const uint64_t tick = get_info(world()).tick;
  const StepReport report = recorder_->step();
  EXPECT_EQ(report.tick, tick + 1);
  EXPECT_EQ(report.bodies, model_.bodies.size());
  EXPECT_LE(report.contacts.count, get_info(world()).contacts);  // which has those asleep as well
  EXPECT_LE(get_info(world()).contacts, capacity().contacts);
  EXPECT_LE(report.contacts.points, 4 * report.contacts.count);
  for (const uint64_t count :
       {uint64_t{report.awake}, uint64_t{report.islands}, report.contacts.substeps, uint64_t{report.contacts.pairs},
        uint64_t{report.lost.contacts}, uint64_t{report.saturations}, uint64_t{report.ccd.impacts},
        uint64_t{report.events.contact}, uint64_t{report.joints.broken}}) {
    note(count);
  }
  check_broken(report.events.joint);
  EXPECT_EQ(report.events.joint, report.joints.broken);
  check_events(report);
  check_sensors(report);
  check_lost(report);
  check_contacts(report.ccd.impacts != 0);
  note(digest(world()));
}

void Game::check_broken(uint32_t count) {
  ASSERT_LE(count, k_joints);
  for (uint32_t i = 0; i < count; ++i) {
    const JointEvent& event = broken_[i];
    const JointDef* known = model_.find(event.joint);
    ASSERT_NE(known, nullptr);
    EXPECT_TRUE(event.a == known->a && event.b == known->b && event.user_data == known->user_data);
    EXPECT_TRUE(exceeds(event.reaction.force, known->break_force) ||
                exceeds(event.reaction.torque, known->break_torque));
    EXPECT_TRUE(i == 0 || broken_[i - 1].joint.slot < event.joint.slot);
    note(event.reaction.force);
    note(event.reaction.torque);
    model_.forget(event.joint);
  }
}

/// Whether their filters and joints let them.
bool Game::may_touch(BodyId a, BodyId b) {
  const Filter &of_a = model_.find(a)->filter, &of_b = model_.find(b)->filter;
  for (const auto& [slot, joint] : model_.joints) {
    const JointDef& def = joint.second;
    if (!def.collide && ((def.a == a && def.b == b) || (def.a == b && def.b == a))) return false;
  }
  const bool same_group = of_a.group != 0 && of_a.group == of_b.group;
  if (same_group ? of_a.group < 0 : (of_a.category & of_b.mask) == 0 || (of_b.category & of_a.mask) == 0) return false;
  const FilterBody own = {model_.find(a)->user_data, of_a}, other = {model_.find(b)->user_data, of_b};
  return (of_a.rule == 0 || may_meet(own, other)) && (of_b.rule == 0 || may_meet(other, own));
}

/// `woken_late`: an impact on the way may have woken some, when contacts had been found.
void Game::check_contacts(bool woken_late) {
  for (uint32_t i = 0; i < get_info(world()).contacts; ++i) {
    Contact contact;
    ASSERT_OK(get_contact(world(), i, contact));
    ASSERT_TRUE(model_.find(contact.a) != nullptr && model_.find(contact.b) != nullptr);
    EXPECT_LE(contact.point_count, 4u);
    EXPECT_LT(contact.a.slot, contact.b.slot);
    EXPECT_FALSE(model_.find(contact.a)->sensor || model_.find(contact.b)->sensor);
    for (uint32_t point = 0; point < contact.point_count; ++point) {
      EXPECT_GE(scaled_to_host(contact.point[point].normal_impulse), 0);
      note_number(contact.point[point].separation);
      note(uint64_t{contact.point[point].feature});
    }
    note(contact.a);
    note(contact.b);
    note_number(contact.normal_force);
    bool awake_a = false, awake_b = false;
    EXPECT_OK(is_awake(world(), contact.a, awake_a));
    EXPECT_OK(is_awake(world(), contact.b, awake_b));
    const auto dynamic = [&](BodyId id) { return model_.find(id)->type == BodyType::dynamic; };
    // Put to sleep before the step that would have ended it; and what moves by itself wakes nobody that it may not
    // touch.
    if (!(awake_a && dynamic(contact.a)) && !(awake_b && dynamic(contact.b))) continue;
    EXPECT_TRUE(may_touch(contact.a, contact.b));
    if (!woken_late && dynamic(contact.a) && dynamic(contact.b)) {
      EXPECT_EQ(awake_a, awake_b) << "who is touched wakes, and who touches falls asleep together";
    }
  }
}

/// Events are in their order, of bodies that may touch, and say of each pair that pushes that it does.
void Game::check_events(const StepReport& report) {
  const uint32_t room = world().hooks.contact_events.capacity;
  ASSERT_LE(report.events.contact, room);
  // Of the hits on bodies' ways as many are kept as contacts.
  EXPECT_TRUE(report.events.contact_dropped == 0 || report.events.contact == room ||
              report.events.contact_dropped + report.events.contact > capacity().contacts);
  std::set<std::pair<uint32_t, uint32_t>> pushing;
  for (uint32_t i = 0; i < report.events.contact; ++i) {
    const ContactEvent& event = events_[i];
    ASSERT_TRUE(model_.find(event.a) != nullptr && model_.find(event.b) != nullptr);
    EXPECT_LT(event.a.slot, event.b.slot);
    if (event.type != ContactEventType::end) {
      EXPECT_TRUE(may_touch(event.a, event.b));
    }
    if (event.type == ContactEventType::begin || event.type == ContactEventType::touch) {
      EXPECT_TRUE(pushing.emplace(event.a.slot, event.b.slot).second) << "a pair begins or goes on once";
    }
    if (i != 0) {
      const ContactEvent& last = events_[i - 1];
      const auto key = [](const ContactEvent& of) { return std::tuple(of.a.slot, of.b.slot, of.type); };
      EXPECT_TRUE(key(last) < key(event) || (event.type == ContactEventType::hit && key(last) == key(event)));
    }
    note(event.a);
    note(event.b);
    note(static_cast<uint64_t>(event.type));
    note_number(event.approach_speed);
  }
}

/// Sensors tell of bodies that are none, and bodies of their sleep, in the order of their slots.
void Game::check_sensors(const StepReport& report) {
  const uint32_t room = world().hooks.sensor_events.capacity;
  ASSERT_TRUE(report.events.sensor <= room && report.events.body <= room);
  EXPECT_TRUE(report.events.sensor_dropped == 0 || report.events.sensor == room);
  EXPECT_TRUE(report.events.body_dropped == 0 || report.events.body == room);
  for (uint32_t i = 0; i < report.events.sensor; ++i) {
    const SensorEvent& event = sensor_events_[i];
    const Known *sensor = model_.find(event.sensor), *body = model_.find(event.body);
    ASSERT_TRUE(sensor != nullptr && body != nullptr);
    EXPECT_TRUE(sensor->sensor && !body->sensor);
    const auto key = [](const SensorEvent& of) { return std::tuple(of.sensor.slot, of.body.slot, of.type); };
    EXPECT_TRUE(i == 0 || key(sensor_events_[i - 1]) < key(event));
    note(event.sensor);
    note(event.body);
    note(static_cast<uint64_t>(event.type));
  }
  for (uint32_t i = 0; i < report.events.body; ++i) {
    const BodyEvent& event = body_events_[i];
    const Known* body = model_.find(event.body);
    ASSERT_NE(body, nullptr);
    EXPECT_EQ(body->type, BodyType::dynamic);
    EXPECT_TRUE(i == 0 || body_events_[i - 1].body.slot <= event.body.slot);
    note(event.body);
    note(static_cast<uint64_t>(event.type));
  }
  note(uint64_t{get_info(world()).sensed});
  EXPECT_LE(get_info(world()).sensed, capacity().sensed);
}

/// Whom there was no room for is named, in order and once, where anything was lost and only there.
void Game::check_lost(const StepReport& report) {
  ASSERT_LE(report.events.capacity, world().hooks.capacity_events.capacity);
  EXPECT_EQ(report.events.capacity != 0,
            report.lost.pairs != 0 || report.lost.contacts != 0 || report.lost.sensed != 0);
  for (uint32_t i = 0; i < report.events.capacity; ++i) {
    const CapacityEvent& event = lost_[i];
    const Known *a = model_.find(event.a), *b = model_.find(event.b);
    ASSERT_TRUE(a != nullptr && b != nullptr);
    if (event.type == CapacityEventType::sensed) {
      EXPECT_TRUE(a->sensor && !b->sensor);
    } else {
      EXPECT_LT(event.a.slot, event.b.slot);
      EXPECT_TRUE(event.type == CapacityEventType::pair || !(a->sensor || b->sensor));
    }
    const auto key = [](const CapacityEvent& of) { return std::tuple(of.type, of.a.slot, of.b.slot); };
    EXPECT_TRUE(i == 0 || key(lost_[i - 1]) < key(event));
    note(static_cast<uint64_t>(event.type));
    note(event.a);
    note(event.b);
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
