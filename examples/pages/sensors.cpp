#include <detent/numbers.h>
#include <detent/sensor.h>

#include "examples/pages/check.h"

using namespace detent;

int main() {
  static WorldStorage<Capacity{.bodies = 8, .contacts = 16, .sensed = 8}> storage;
  World world;
  static SensorEvent sensed[8];
  static BodyEvent slept[8];
  static CapacityEvent lost[8];
  const WorldHooks hooks = {
      .sensor_events = {sensed, 8},
      .body_events = {slept, 8},
      .capacity_events = {lost, 8},
  };
  check(storage.create({}, hooks, world));

  BodyId ground, gate, room, bullet, crate;
  check(create_body(world, {.type = BodyType::fixed, .shape = half_space()}, ground));
  const Shape pane = box({Real(0.005), 1.0, 1.0});
  check(
      create_body(world, {.type = BodyType::fixed, .position = {2.0, 1.0, 0.0}, .shape = pane, .sensor = true}, gate));
  const Shape hall = box({1.0, 1.0, 1.0});
  check(
      create_body(world, {.type = BodyType::fixed, .position = {0.0, 1.0, 9.0}, .shape = hall, .sensor = true}, room));
  check(create_body(
      world, {.position = {0.0, 1.0, 0.0}, .linear_velocity = {500.0, 0.0, 0.0}, .shape = sphere(Real(0.01))}, bullet));
  check(create_body(world, {.position = {0.0, 0.5, 9.0}, .shape = box({0.5, 0.5, 0.5})}, crate));

  StepReport report = step(world);
  for (uint32_t i = 0; i < report.events.sensor; ++i) {
    const SensorEvent& event = sensed[i];
    const bool enter = event.type == SensorEventType::enter;
    printf("body %u %s sensor %u\n", static_cast<unsigned>(event.body.slot), enter ? "enters" : "leaves",
           static_cast<unsigned>(event.sensor.slot));
  }
  check(report.events.sensor == 3);  // the bullet in and out of the gate, the crate into the room

  BodyId within[4];
  uint32_t count = 0;
  check(get_sensed(world, room, within, 4, count));
  check(count == 1 && within[0] == crate);

  check(destroy_body(world, bullet));
  uint32_t asleep = 0;
  for (int tick = 0; tick < 120; ++tick) {
    report = step(world);
    for (uint32_t i = 0; i < report.events.body; ++i) asleep += slept[i].type == BodyEventType::fell_asleep ? 1 : 0;
    check(report.events.sensor == 0);
  }
  check(asleep == 1);
  check(get_sensed(world, room, within, 4, count));
  check(count == 1);  // asleep, and still there

  for (uint32_t i = 0; i < report.events.capacity; ++i) {
    if (lost[i].type == CapacityEventType::contact)
      printf("body %u lost a contact\n", static_cast<unsigned>(lost[i].b.slot));
  }
  check(report.events.capacity == 0);
}
