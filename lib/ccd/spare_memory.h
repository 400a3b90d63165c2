#pragma once
#include "base/team.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

#if DETENT_TASKS
/// Memory of the world's block that nothing else uses during a stage of the step. It is taken piece by piece, by any
/// thread, until it is spent. Nothing is given back within a tick.
struct SpareMemory {
  Span<uint64_t> words;
  uint32_t taken = 0;  ///< words taken so far

  /// Takes memory for `count` elements, which are not initialised. Returns an empty span if there is too little memory.
  template <class T>
  Span<T> take(uint32_t count) {
    static_assert(alignof(T) <= 8);
    const uint64_t needed = (uint64_t{sizeof(T)} * count + 7) / 8;
    uint32_t before = __atomic_load_n(&taken, __ATOMIC_RELAXED);
    do {
      if (needed > words.count - before) return {};
    } while (!__atomic_compare_exchange_n(&taken, &before, before + static_cast<uint32_t>(needed), true,
                                          __ATOMIC_RELAXED, __ATOMIC_RELAXED));
    return {reinterpret_cast<T*>(words.data + before), count};
  }
};
#endif

}  // namespace DETENT_NAMESPACE
}  // namespace detent
