#include <stdlib.h>

#include "desk.h"

namespace detent_web {

namespace {
double* desk = nullptr;
uint32_t desk_capacity = 0;
}  // namespace

double* desk_room(uint32_t count) {
  if (count <= desk_capacity) return desk;
  const uint32_t wanted = count < 1024 ? 1024 : count + count / 2;
  if (wanted < count || wanted > UINT32_MAX / sizeof(double)) return nullptr;
  double* moved = static_cast<double*>(realloc(desk, wanted * sizeof(double)));
  if (moved == nullptr) return nullptr;
  desk = moved;
  desk_capacity = wanted;
  return desk;
}

DETENT_WEB(desk_room) double* exported_desk_room(uint32_t count) { return desk_room(count); }
/// Memory for bytes that JavaScript passes, aligned to 8; null if there is none.
DETENT_WEB(allocate) void* allocate(uint32_t bytes) { return malloc(bytes == 0 ? 1 : bytes); }
DETENT_WEB(release) void release(void* memory) { free(memory); }
DETENT_WEB(simulation_version) uint32_t simulation_version() { return k_simulation_version; }
DETENT_WEB(status_text) const char* text_of_status(uint32_t status) { return status_text(static_cast<Status>(status)); }

}  // namespace detent_web
