#include "tests/bench/heap.h"

#include <errno.h>
#include <malloc.h>
#include <stddef.h>

namespace {

detent_bench::HeapUse use;  // of the one thread that the benchmark has

void* counted(void* memory) {
  if (memory != nullptr) {
    ++use.calls;
    use.bytes += malloc_usable_size(memory);
  }
  return memory;
}

void* aligned(size_t alignment, size_t bytes);

}  // namespace

/// The C library's own, under the names that it keeps for this.
extern "C" {
void* __libc_malloc(size_t bytes);
void* __libc_calloc(size_t count, size_t bytes);
void* __libc_realloc(void* memory, size_t bytes);
void* __libc_memalign(size_t alignment, size_t bytes);
void __libc_free(void* memory);

void* malloc(size_t bytes) noexcept { return counted(__libc_malloc(bytes)); }
void* calloc(size_t count, size_t bytes) noexcept { return counted(__libc_calloc(count, bytes)); }
void* realloc(void* memory, size_t bytes) noexcept {
  const uint64_t before = malloc_usable_size(memory);
  void* const moved = __libc_realloc(memory, bytes);
  if (moved != nullptr || bytes == 0) use.bytes -= before;
  return counted(moved);
}
void free(void* memory) noexcept {
  use.bytes -= malloc_usable_size(memory);
  __libc_free(memory);
}
void* memalign(size_t alignment, size_t bytes) noexcept { return aligned(alignment, bytes); }
void* aligned_alloc(size_t alignment, size_t bytes) noexcept { return aligned(alignment, bytes); }
int posix_memalign(void** memory, size_t alignment, size_t bytes) noexcept {
  void* const made = aligned(alignment, bytes);
  if (made == nullptr) return ENOMEM;
  *memory = made;
  return 0;
}
}

namespace {

void* aligned(size_t alignment, size_t bytes) { return counted(__libc_memalign(alignment, bytes)); }

}  // namespace

namespace detent_bench {

HeapUse heap_use() { return use; }

}  // namespace detent_bench
