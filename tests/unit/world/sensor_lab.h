#pragma once
#include <detent/sensor.h>

#include "tests/unit/world/lab.h"

/// A world that collects the events of its sensors, and helpers that add bodies.
namespace detent {
inline namespace DETENT_NAMESPACE {

inline constexpr SensorEventType k_enter = SensorEventType::enter, k_leave = SensorEventType::leave;

inline BodyDef sensor_def(const Shape& shape, double x = 0, double y = 0, double z = 0,
                          BodyType type = BodyType::fixed) {
  BodyDef def;
  def.type = type;
  def.shape = shape;
  def.position = position(x, y, z);
  def.sensor = true;
  return def;
}

inline BodyDef ball_def(double radius, double x, double y, double z, const Vec3<Real>& linear_velocity = {}) {
  BodyDef def;
  def.shape = sphere(real(radius));
  def.position = position(x, y, z);
  def.linear_velocity = linear_velocity;
  return def;
}

struct Trap {
  Lab lab;
  std::vector<SensorEvent> buffer;
  StepReport report;

  explicit Trap(Capacity capacity, WorldDef def = weightless(), bool sleeping = false, uint32_t room = 32)
      : lab(capacity, def, sleeping), buffer(room) {
    lab.world.hooks.sensor_events = {buffer.data(), room};
  }
  std::vector<SensorEvent> run() {
    report = lab.run(1);
    return {buffer.data(), buffer.data() + report.events.sensor};
  }
  std::vector<BodyId> within(BodyId sensor) {
    BodyId bodies[16];
    uint32_t count = 0;
    EXPECT_OK(get_sensed(lab.world, sensor, bodies, 16, count));
    return {bodies, bodies + (count < 16 ? count : 16)};
  }
};

inline bool is_event(const SensorEvent& event, SensorEventType type, BodyId sensor, BodyId body) {
  return event.type == type && event.sensor == sensor && event.body == body;
}

inline Capacity room_for(uint32_t bodies, uint32_t sensed = 16) { return {bodies, 4 * bodies, 0, true, 0, sensed}; }

}  // namespace DETENT_NAMESPACE
}  // namespace detent
