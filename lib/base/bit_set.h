#pragma once
#include "base/span.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// A set of bits in words of 32 bits; bit 0 is the lowest bit of the first word. Bits are visited in ascending order.
struct BitSet {
  Span<uint32_t> words;

  bool has(uint32_t bit) const { return (words[bit / 32] >> bit % 32 & 1) != 0; }
  void set(uint32_t bit) const { words[bit / 32] |= 1u << bit % 32; }
  void clear(uint32_t bit) const { words[bit / 32] &= ~(1u << bit % 32); }

  /// Calls visit(bit) for each set bit. A bit that `visit` itself sets is visited if it comes after the current bit.
  template <class Visit>
  void for_each(const Visit& visit) const {
    while_each(0, [&](uint32_t bit) {
      visit(bit);
      return true;
    });
  }

  /// As for_each(), for the bits of the words [first, last).
  template <class Visit>
  void for_each_in(uint32_t first, uint32_t last, const Visit& visit) const {
    BitSet{{words.data + first, last - first}}.for_each([&](uint32_t bit) { visit(first * 32 + bit); });
  }

  /// As for_each(), but starts at bit `first` and stops when `visit` returns false.
  template <class Visit>
  void while_each(uint32_t first, const Visit& visit) const {
    uint32_t later = UINT32_MAX << first % 32;
    for (uint32_t word = first / 32; word < words.count; ++word) {
      while ((words[word] & later) != 0) {
        const uint32_t bit = static_cast<uint32_t>(__builtin_ctz(words[word] & later));
        later = bit == 31 ? 0 : UINT32_MAX << (bit + 1);
        if (!visit(word * 32 + bit)) return;
      }
      later = UINT32_MAX;
    }
  }
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
