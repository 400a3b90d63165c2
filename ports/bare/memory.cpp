#include <ports/bare/memory.h>
#include <ports/machine.h>

namespace {
constexpr uint32_t k_paint = 0xC5C5C5C5u;

uint32_t bytes_between(const volatile void* low, const volatile void* high) {
  return static_cast<uint32_t>(reinterpret_cast<uintptr_t>(high) - reinterpret_cast<uintptr_t>(low));
}
}  // namespace

void paint_stack() {
  // Volatile keeps this a loop: a call to memset would have its frame in the memory that it fills.
  volatile uint32_t* const bottom = reinterpret_cast<volatile uint32_t*>(link_bss_end);
  volatile uint32_t* const here = static_cast<volatile uint32_t*>(__builtin_frame_address(0));
  constexpr uint32_t k_own_frame_words = 32;
  for (volatile uint32_t* word = bottom; word < here - k_own_frame_words; ++word) *word = k_paint;
}

uint32_t machine_stack_used() {
  const volatile uint32_t* word = reinterpret_cast<const volatile uint32_t*>(link_bss_end);
  const volatile uint32_t* const top = reinterpret_cast<const volatile uint32_t*>(link_stack_top);
  while (word < top && *word == k_paint) ++word;
  return bytes_between(word, top);
}

MachineMemory machine_memory() {
  return {static_cast<uint32_t>(reinterpret_cast<uintptr_t>(link_flash_bytes)),
          static_cast<uint32_t>(reinterpret_cast<uintptr_t>(link_ram_bytes)),
          bytes_between(link_bss_end, link_stack_top)};
}
