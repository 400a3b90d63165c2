#pragma once
#include "base/span.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Sorts `items` in ascending order of digit_of(element), which is below 256. Elements with equal digits keep their
/// order. `spare` is work space of the same length. Range: `items` is not empty. Uses 1 KB of stack. radix_sort() does
/// not call this function for short spans, so a small world does not need this stack.
template <class T, class DigitOf>
__attribute__((noinline)) void sort_by_digit(Span<T> items, Span<T> spare, const DigitOf& digit_of) {
  uint32_t place[256] = {};
  for (const T& item : items) ++place[digit_of(item)];
  if (place[digit_of(items[0])] == items.count) return;  // all digits are equal
  uint32_t next = 0;
  for (uint32_t& count : place) {
    const uint32_t start = next;
    next += count;
    count = start;
  }
  for (const T& item : items) spare[place[digit_of(item)]++] = item;
  for (uint32_t i = 0; i < items.count; ++i) items[i] = spare[i];
}

/// Sorts `items` in ascending order of keys of `digits` digits. Elements with equal keys keep their order.
/// digit_of(element, digit) is below 256; digit 0 is the least significant. `spare` is work space of the same length.
/// The function is not recursive.
template <class T, class DigitOf>
void radix_sort(Span<T> items, Span<T> spare, const DigitOf& digit_of, int digits) {
  constexpr uint32_t k_few = 32;
  if (items.count > k_few) {
    for (int digit = 0; digit < digits; ++digit)
      sort_by_digit(items, spare, [&](const T& item) { return digit_of(item, digit); });
    return;
  }
  const auto precedes = [&](const T& a, const T& b) {
    int digit = digits - 1;
    while (digit > 0 && digit_of(a, digit) == digit_of(b, digit)) --digit;
    return digit_of(a, digit) < digit_of(b, digit);
  };
  for (uint32_t i = 1; i < items.count; ++i) {
    const T item = items[i];
    uint32_t hole = i;
    for (; hole > 0 && precedes(item, items[hole - 1]); --hole) items[hole] = items[hole - 1];
    items[hole] = item;
  }
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
