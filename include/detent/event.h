#pragma once
#include <detent/id.h>
#include <detent/math.h>

/// @file
/// What a step tells of contacts, sensors, sleep, and of what it had no room for.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// What happened to a pair of bodies.
enum class ContactEventType : uint32_t {
  begin = 1,  ///< the bodies push each other, and did not in the last step
  touch = 2,  ///< they did, and still do
  end = 3,    ///< they do no longer
  hit = 4,    ///< they met faster than the world's restitution threshold, beside a begin or touch; or on their way in
              ///< the step (continuous collision), and then perhaps alone
};

/// What happened between two bodies in a step. Bodies that sleep raise none, nor do bodies that are destroyed.
struct ContactEvent {
  ContactEventType type = ContactEventType::begin;  ///< what happened
  BodyId a;                                         ///< the body of the lower slot
  BodyId b;                                         ///< the other
  Vec3<Unit> normal = {};                           ///< from A to B, world; zero for an end
  Position point = {};                              ///< the middle of the contact, m, world; zero for an end
  Real approach_speed = {};                         ///< of a hit: at which the surfaces met, m/s
};

/// Where a step puts its events, in the order of (a.slot, b.slot, type), two hits of a pair in the order of their
/// times. The caller's memory: it must outlive the world's use of it. Beyond `capacity` events are dropped, those of
/// the largest slots, and counted in the report.
struct ContactEventBuffer {
  ContactEvent* data = nullptr;  ///< room for `capacity` events; null: none are wanted
  uint32_t capacity = 0;         ///< of `data`
};

/// What happened between a sensor and a body.
enum class SensorEventType : uint32_t {
  enter = 1,  ///< the body came within the sensor
  leave = 2,  ///< it is no longer within; after its enter, if it passed through in this step
};

/// Who came and went. A body that leaves a sensor and is back before the step ends has not left. Bodies that are
/// destroyed raise none, nor does a body that becomes a sensor, or no longer is one.
struct SensorEvent {
  SensorEventType type = SensorEventType::enter;  ///< what happened
  BodyId sensor;                                  ///< the sensor
  BodyId body;                                    ///< who came or went
};

/// As ContactEventBuffer, in the order of (sensor.slot, body.slot, type).
struct SensorEventBuffer {
  SensorEvent* data = nullptr;  ///< room for `capacity` events; null: none are wanted
  uint32_t capacity = 0;        ///< of `data`
};

/// What became of a dynamic body.
enum class BodyEventType : uint32_t {
  fell_asleep = 1,  ///< at the end of the step, with all that it touched; put_to_sleep() raises none
  woke = 2,         ///< it was touched in the step, or woken by a call since the last one
};

/// Who fell asleep and who woke.
struct BodyEvent {
  BodyEventType type = BodyEventType::woke;  ///< what happened
  BodyId body;                               ///< to whom
};

/// As ContactEventBuffer, in the order of the bodies' slots.
struct BodyEventBuffer {
  BodyEvent* data = nullptr;  ///< room for `capacity` events; null: none are wanted
  uint32_t capacity = 0;      ///< of `data`
};

/// What a step had no room for.
enum class CapacityEventType : uint32_t {
  pair = 1,     ///< two bodies whose bounds overlap were not collided: twice Capacity::contacts
  contact = 2,  ///< the contact of two bodies: Capacity::contacts
  sensed = 3,   ///< a sensor, `a`, does not know of a body within it: Capacity::sensed
};

/// Whom it was lost for, for this step. All are counted in the report.
struct CapacityEvent {
  CapacityEventType type = CapacityEventType::contact;  ///< what was lost
  BodyId a;                                             ///< the body of the lower slot; or the sensor
  BodyId b;                                             ///< the other
};

/// As ContactEventBuffer, in the order of (type, a.slot, b.slot), each once; those beyond `capacity` are not counted
/// again.
struct CapacityEventBuffer {
  CapacityEvent* data = nullptr;  ///< room for `capacity` events; null: none are wanted
  uint32_t capacity = 0;          ///< of `data`
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
