#pragma once
#include <detent/body.h>
#include <detent/numbers.h>

/// @file
/// Events of a step: contacts, sensors, sleep, and full pools.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// The type of a contact event.
enum class ContactEventType : uint32_t {
  begin = 1,  ///< the bodies push each other; in the last step they did not
  touch = 2,  ///< the bodies push each other, as in the last step
  end = 3,    ///< the bodies pushed each other in the last step, and no longer do
  /// An impact, in one of two cases. First, the bodies have a begin or touch event, and they approached at the
  /// restitution threshold (WorldDef) or faster. Second, continuous collision resolved an impact of the bodies within
  /// the step; they may have approached more slowly, and may have no begin or touch event.
  hit = 4,
};

/// An event between two bodies in a step. Contacts between sleeping bodies cause no events. destroy_body() causes no
/// events.
struct ContactEvent {
  ContactEventType type = ContactEventType::begin;  ///< what happened
  BodyId a;                                         ///< the body with the lower slot
  BodyId b;                                         ///< the body with the higher slot
  Vec3<Unit> normal = {};                           ///< from A to B, world; zero if `type` is `end`
  /// The middle of the contact points or the point of impact, m, world; zero if `type` is `end`.
  Position point = {};
  Real approach_speed = {};  ///< for a hit: closing speed of the surfaces, m/s; else 0
};

/// The buffer to which a step writes its contact events, in the order of (a.slot, b.slot, type); several hits of a pair
/// are in the order of their times. The memory is the caller's, and must stay valid as long as the world uses it. If
/// there are more than `capacity` events, the step drops the last ones in this order, and the report counts them.
struct ContactEventBuffer {
  ContactEvent* data = nullptr;  ///< room for `capacity` events; null: no events are written
  uint32_t capacity = 0;         ///< the number of events that `data` has room for
};

/// The type of a sensor event.
enum class SensorEventType : uint32_t {
  enter = 1,  ///< the body came within the sensor
  leave = 2,  ///< the body left the sensor; comes after its enter if the body passed through in this step
};

/// An event between a sensor and a body. A body that leaves a sensor and returns in the same step causes no event.
/// destroy_body() and set_sensor() cause no events.
struct SensorEvent {
  SensorEventType type = SensorEventType::enter;  ///< what happened
  BodyId sensor;                                  ///< the sensor
  BodyId body;                                    ///< the body that entered or left
};

/// The buffer to which a step writes its sensor events, in the order of (sensor.slot, body.slot, type). The rules
/// for its memory, and for events beyond `capacity`, are those of ContactEventBuffer.
struct SensorEventBuffer {
  SensorEvent* data = nullptr;  ///< room for `capacity` events; null: no events are written
  uint32_t capacity = 0;        ///< the number of events that `data` has room for
};

/// The type of a body event.
enum class BodyEventType : uint32_t {
  fell_asleep = 1,  ///< the body fell asleep at the end of the step, with its island; sleep_body() causes no event
  woke = 2,         ///< a contact or a joint woke the body in the step, or a call woke it since the last step
};

/// A dynamic body fell asleep or woke.
struct BodyEvent {
  BodyEventType type = BodyEventType::woke;  ///< what happened
  BodyId body;                               ///< the body that fell asleep or woke
};

/// The buffer to which a step writes its body events, in the order of the bodies' slots. The rules for its memory, and
/// for events beyond `capacity`, are those of ContactEventBuffer.
struct BodyEventBuffer {
  BodyEvent* data = nullptr;  ///< room for `capacity` events; null: no events are written
  uint32_t capacity = 0;      ///< the number of events that `data` has room for
};

/// Which pool of a step was full.
enum class CapacityEventType : uint32_t {
  pair = 1,     ///< bodies with overlapping bounds were not tested for contact; the limit is 2 x Capacity::contacts
  contact = 2,  ///< the contact of two bodies was dropped; the limit is Capacity::contacts
  sensed = 3,   ///< the sensor `a` does not report the body `b` within it; the limit is Capacity::sensed
};

/// A pair, contact or sensed body that a step dropped because a pool was full. It is missing in this step only: the
/// next step searches for it again. The report counts all dropped pairs, contacts and sensed bodies.
struct CapacityEvent {
  CapacityEventType type = CapacityEventType::contact;  ///< which pool was full
  BodyId a;                                             ///< the body with the lower slot; for `sensed` the sensor
  BodyId b;                                             ///< the other body
};

/// The buffer to which a step writes its capacity events, in the order of (type, a.slot, b.slot), without duplicates.
/// The rules for its memory are those of ContactEventBuffer. Events beyond `capacity` are dropped; the report does not
/// count them.
struct CapacityEventBuffer {
  CapacityEvent* data = nullptr;  ///< room for `capacity` events; null: no events are written
  uint32_t capacity = 0;          ///< the number of events that `data` has room for
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
