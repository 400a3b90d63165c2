#pragma once
#include <detent/detail/scratch.h>

#include "ccd/spare_memory.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

/// Whether the event of pair `a` comes before that of pair `b`: at an earlier time, or at the same time with a lower
/// key. Range: both pairs have an event.
inline bool is_earlier(const ImpactPair& a, const ImpactPair& b) {
  return a.time < b.time || (a.time == b.time && a.key < b.key);
}

#if DETENT_TASKS
/// Finds the earliest event among the entries of ImpactStage::impacts. Stores, in spare memory, the earliest event of
/// each 16 successive entries. After an event, only those groups of 16 whose entries have changed are searched again.
class EventHeads {
 public:
  /// Takes the memory that is needed for `entries` entries. If there is too little memory, is_made() is false
  /// afterwards.
  void make(uint32_t entries, SpareMemory& spare) {
    heads_ = spare.take<Head>((entries + k_block - 1) / k_block);
    for (Head& head : heads_) head.entry = k_stale;
  }
  bool is_made() const { return heads_.count != 0; }
  /// To be called when the event of the entry `index` has changed.
  void touch(uint32_t index) {
    if (is_made()) heads_[index / k_block].entry = k_stale;
  }
  /// The entry with the earliest event; null if there is none. `has_event(entry)`: whether the entry has an event.
  template <class HasEvent>
  ImpactPair* earliest(Span<ImpactPair> entries, const HasEvent& has_event) {
    const Head* best = nullptr;
    for (uint32_t first = 0; first < entries.count; first += k_block) {
      Head& head = heads_[first / k_block];
      if (head.entry == k_stale) search(entries, first, has_event, head);
      if (head.entry == k_none) continue;
      if (best == nullptr || head.time < best->time || (head.time == best->time && head.key < best->key)) best = &head;
    }
    return best == nullptr ? nullptr : &entries[best->entry];
  }

 private:
  static constexpr uint32_t k_block = 16, k_stale = UINT32_MAX, k_none = UINT32_MAX - 1;
  struct Head {
    uint64_t key;
    Fraction time;
    uint32_t entry;
  };

  template <class HasEvent>
  static void search(Span<ImpactPair> entries, uint32_t first, const HasEvent& has_event, Head& head) {
    head.entry = k_none;
    const uint32_t last = entries.count - first < k_block ? entries.count : first + k_block;
    for (uint32_t i = first; i < last; ++i) {
      if (!has_event(entries[i])) continue;
      if (head.entry == k_none || is_earlier(entries[i], entries[head.entry])) head.entry = i;
    }
    if (head.entry == k_none) return;
    head.key = entries[head.entry].key;
    head.time = entries[head.entry].time;
  }

  Span<Head> heads_;
};
#endif

}  // namespace DETENT_NAMESPACE
}  // namespace detent
