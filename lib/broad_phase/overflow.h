#pragma once
#include <detent/detail/state.h>
#include <detent/event.h>

#include "base/span.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The capacity events of a step (a pool was full), in the caller's buffer, sorted and without duplicates. If the
/// buffer has no room for all events, it keeps the first ones in sort order.
struct Overflow {
  Span<const BodyProperties> properties;
  Span<CapacityEvent> events;
  uint32_t count = 0;

  void add(CapacityEventType type, uint32_t slot_a, uint32_t slot_b);
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
