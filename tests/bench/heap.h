#pragma once
#include <stdint.h>

/// The heap of the program or module that heap.cpp is linked into, its libraries included: heap.cpp stands before the C
/// library's malloc and its kin, and operator new comes to it through them.
namespace detent_bench {

struct HeapUse {
  uint64_t calls = 0;  ///< that gave memory, since the start
  uint64_t bytes = 0;  ///< in use now, as malloc_usable_size has them
};

HeapUse heap_use();

}  // namespace detent_bench
