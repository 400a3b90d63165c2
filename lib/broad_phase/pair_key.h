#pragma once
#include <detent/detail/shared.h>
#include <detent/detail/state.h>

#include "base/binary_search.h"
#include "base/span.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// The key of a pair of body slots: a word for sorting, with the lower slot in the high half.
constexpr uint64_t pair_key(uint32_t low, uint32_t high) { return (uint64_t{low} << 32) | high; }
constexpr uint32_t pair_low(uint64_t key) { return static_cast<uint32_t>(key >> 32); }
constexpr uint32_t pair_high(uint64_t key) { return static_cast<uint32_t>(key); }

/// The key of a pair whose slots are given in either order.
constexpr uint64_t key_of_pair(uint32_t a, uint32_t b) { return a < b ? pair_key(a, b) : pair_key(b, a); }

inline uint64_t key_of(const ContactState& contact) { return pair_key(contact.body_a, contact.body_b); }

/// Whether a sorted list contains the key.
DETENT_SHARED inline bool has_pair(Span<const uint64_t> keys, uint64_t key) {
  const uint32_t at = partition_point(keys.count, [&](uint32_t i) { return keys[i] < key; });
  return at < keys.count && keys[at] == key;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
