#pragma once
#include <detent/config.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "difference.h"
#include "replay/trace_stream.h"

/// The trace of a tick in memory, and what differs between two.
namespace detent {
inline namespace DETENT_NAMESPACE {

struct StageTrace {
  struct Element {
    std::vector<uint8_t> bytes;  ///< its canonical bytes, or those of its key
    uint32_t digest = 0;
  };
  /// The key of a sorted part; of others the place.
  using Key = std::vector<uint32_t>;
  /// Of vectors of integers of several bytes, libstdc++ 12's own order is wrong on big-endian machines: it compares too
  /// few bytes.
  struct KeyOrder {
    bool operator()(const Key& a, const Key& b) const {
      return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
    }
  };
  std::map<Key, Element, KeyOrder> parts[k_trace_part_count];
  std::vector<Key> contacts;  ///< of the state, by their places
  uint64_t digest = 0;
  bool there = false;
};

struct TickTrace {
  bool there = false;
  bool full = false;
  StageTrace stages[k_trace_stage_count];

  /// False if the bytes are no trace.
  bool read(const std::vector<uint8_t>& bytes, bool full_trace);
  /// Of a state between steps, as if it were the end of a tick.
  void take_end(const World& world);
};

/// The first differences of the first stage that differs among those that both have. False if there is none.
bool find_difference(const TickTrace& a, const TickTrace& b, detent_tool::Difference& difference);

inline bool is_whole(WordKind kind) { return kind == WordKind::unsigned_integer || kind == WordKind::signed_integer; }
/// A number from its canonical bytes, of `width` each word, as the tool tells it.
detent_tool::SideValue side_value(WordKind kind, uint32_t width, const uint8_t* bytes);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
