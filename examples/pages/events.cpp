#include <detent/numbers.h>
#include <detent/world.h>

#include "examples/pages/check.h"

using namespace detent;

namespace {

uint32_t heard[5];  ///< events by type

/// A game's reaction to an event.
void hear(const World& world, const ContactEvent& event) {
  ++heard[static_cast<uint32_t>(event.type)];
  if (event.type != ContactEventType::hit) return;
  uint32_t who = 0;
  check(get_user_data(world, event.b, who));  // the game's number of this object
  const double speed = real_to_host(event.approach_speed);
  printf("thing %u hit the ground at %.2f m/s\n", static_cast<unsigned>(who), speed);
  check(who == 2 && speed < 6.0);
}

}  // namespace

int main() {
  static WorldStorage<Capacity{.bodies = 2, .contacts = 4}> storage;
  World world;
  static ContactEvent events[8];
  check(storage.create({}, {.contact_events = {events, 8}}, world));

  BodyId ground, ball;
  check(create_body(world, {.type = BodyType::fixed, .shape = half_space(), .user_data = 1}, ground));
  BodyDef def = {.position = {0.0, 2.0, 0.0}, .shape = sphere(0.5), .user_data = 2};
  def.material.restitution = 0.5;
  check(create_body(world, def, ball));

  for (int tick = 0; tick < 300; ++tick) {
    const StepReport report = step(world);
    for (uint32_t i = 0; i < report.events.contact; ++i) hear(world, events[i]);
    if (report.events.contact_dropped != 0) return 1;  // the buffer was too small
  }
  const uint32_t begins = heard[static_cast<uint32_t>(ContactEventType::begin)];
  const uint32_t ends = heard[static_cast<uint32_t>(ContactEventType::end)];
  const uint32_t hits = heard[static_cast<uint32_t>(ContactEventType::hit)];
  check(hits >= 2 && begins >= 2 && ends == begins - 1);

  bool awake = true;
  check(is_awake(world, ball, awake));
  check(!awake);

  world.hooks.contact_events = {};  // no buffer: no events
  check(wake_body(world, ball));
  check(step(world).events.contact == 0);
}
