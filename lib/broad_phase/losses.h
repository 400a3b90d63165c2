#pragma once
#include <detent/detail/state.h>
#include <detent/event.h>

#include "base/span.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Whom a step had no room for, in the caller's buffer: sorted, each once, the first as many as fit.
struct Losses {
  Span<const BodyTraits> traits;
  Span<CapacityEvent> events;
  uint32_t count = 0;

  void add(CapacityEventType type, uint32_t slot_a, uint32_t slot_b);
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
