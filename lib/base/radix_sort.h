#pragma once
#include "base/span.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Sorts ascending by `digits` digits, the least first; equal elements keep their order. `digit_of(element, digit)` is
/// below 256. `spare` is work space of as many elements. 1 KB of stack; no recursion.
template <class T, class DigitOf>
void radix_sort(Span<T> items, Span<T> spare, const DigitOf& digit_of, int digits) {
  for (int digit = 0; digit < digits; ++digit) {
    uint32_t place[256] = {};
    for (const T& item : items) ++place[digit_of(item, digit)];
    uint32_t next = 0;
    for (uint32_t& count : place) {
      const uint32_t start = next;
      next += count;
      count = start;
    }
    for (const T& item : items) spare[place[digit_of(item, digit)]++] = item;
    for (uint32_t i = 0; i < items.count; ++i) items[i] = spare[i];
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
