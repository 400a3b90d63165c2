#pragma once
#include <detent/config.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "difference.h"
#include "replay/trace_stream.h"

/// The trace of a tick in memory, and the comparison of two traces.
namespace detent {
inline namespace DETENT_NAMESPACE {

struct StageTrace {
  struct Element {
    std::vector<uint8_t> bytes;  ///< canonical bytes of the element; in a trace of digests only its key
    uint32_t digest = 0;
  };
  /// In a sorted part, the key of an element; in other parts, the index of the element.
  using Key = std::vector<uint32_t>;
  /// Replaces operator< of std::vector, which is wrong for multi-byte integers on big-endian machines in libstdc++ 12:
  /// it compares too few bytes.
  struct KeyOrder {
    bool operator()(const Key& a, const Key& b) const {
      return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
    }
  };
  std::map<Key, Element, KeyOrder> parts[k_trace_part_count];
  std::vector<Key> contacts;  ///< keys of the state's contacts, by their indices
  uint64_t digest = 0;
  bool there = false;
};

struct TickTrace {
  bool there = false;
  bool full = false;
  StageTrace stages[k_trace_stage_count];

  /// Reads the bytes of a trace. Returns false if they are not a valid trace.
  bool read(const std::vector<uint8_t>& bytes, bool full_trace);
  /// Takes the trace of a state between steps, as if it were the end of a tick.
  void take_end(const World& world);
};

/// Finds the first differences of the first differing stage that both traces have. False if there is none.
bool find_difference(const TickTrace& a, const TickTrace& b, detent_tool::Difference& difference);

inline bool is_whole(WordKind kind) { return kind == WordKind::unsigned_integer || kind == WordKind::signed_integer; }
/// Converts the canonical bytes of a number to the form in which the tool prints it. `width`: number of bytes in a
/// word.
detent_tool::SideValue side_value(WordKind kind, uint32_t width, const uint8_t* bytes);

}  // namespace DETENT_NAMESPACE
}  // namespace detent
