#include "broad_phase/overflow.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

void Overflow::add(CapacityEventType type, uint32_t slot_a, uint32_t slot_b) {
  const CapacityEvent event = {
      type, {slot_a + 1, properties[slot_a].generation}, {slot_b + 1, properties[slot_b].generation}};
  const auto order = [](const CapacityEvent& a, const CapacityEvent& b) {  // below 0: a comes first
    if (a.type != b.type) return a.type < b.type ? -1 : 1;
    if (a.a.slot != b.a.slot) return a.a.slot < b.a.slot ? -1 : 1;
    return a.b.slot < b.b.slot ? -1 : a.b.slot == b.b.slot ? 0 : 1;
  };
  uint32_t place = count;
  while (place > 0 && order(event, events[place - 1]) < 0) --place;
  if (place == events.count || (place > 0 && order(event, events[place - 1]) == 0)) return;
  if (count < events.count) ++count;
  for (uint32_t i = count - 1; i > place; --i) events[i] = events[i - 1];
  events[place] = event;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
