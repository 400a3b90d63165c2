#pragma once
#include "base/span.h"

/// Binary max-heaps in a span, for sorting in place and for finding the k smallest elements of a stream. The functions
/// use no extra memory and no recursion. `less` must be a strict total order, so that the result depends on the
/// elements alone.
namespace detent {
inline namespace DETENT_NAMESPACE {

template <class T, class Less>
void heap_sift_down(Span<T> heap, uint32_t hole, const T& value, const Less& less) {
  for (;;) {
    uint32_t child = 2 * hole + 1;
    if (child >= heap.count) break;
    if (child + 1 < heap.count && less(heap[child], heap[child + 1])) ++child;
    if (!less(value, heap[child])) break;
    heap[hole] = heap[child];
    hole = child;
  }
  heap[hole] = value;
}

template <class T, class Less>
void heap_make(Span<T> items, const Less& less) {
  for (uint32_t i = items.count / 2; i-- > 0;) {
    const T value = items[i];
    heap_sift_down(items, i, value, less);
  }
}

/// Sorts `items` in ascending order.
template <class T, class Less>
void heap_sort(Span<T> items, const Less& less) {
  heap_make(items, less);
  for (uint32_t end = items.count; end > 1; --end) {
    const T last = items[end - 1];
    items[end - 1] = items[0];
    heap_sift_down(items.first(end - 1), 0, last, less);
  }
}

/// Collects the `storage.count` smallest of the added values. The set of collected values does not depend on the order
/// in which they were added, but their order in `storage` does: sort them with heap_sort().
template <class T, class Less>
struct SmallestOf {
  Span<T> storage;
  Less less;
  uint32_t count = 0;
  uint32_t dropped = 0;

  void add(const T& value) {
    T lost;
    add(value, lost);
  }
  /// Adds a value. If the storage is full, drops the largest value (which may be `value`), stores it in `lost` and
  /// returns true.
  bool add(const T& value, T& lost) {
    if (count < storage.count) {
      storage[count++] = value;
      if (count == storage.count) heap_make(storage, less);
      return false;
    }
    ++dropped;
    lost = value;
    if (count != 0 && less(value, storage[0])) {
      lost = storage[0];
      heap_sift_down(storage, 0, value, less);
    }
    return true;
  }
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
