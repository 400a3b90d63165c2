#pragma once
#include <detent/id.h>
#include <detent/math.h>

/// @file
/// What a step tells of contacts.
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

}  // namespace DETENT_NAMESPACE
}  // namespace detent
