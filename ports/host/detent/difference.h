#pragma once
#include <stdint.h>

#include <string>
#include <vector>

/// The first difference of two recordings, or of a recording and its replay on this machine. The types do not depend on
/// the configuration.
namespace detent_tool {

/// The value on one side.
struct SideValue {
  bool there = true;
  std::string raw;  ///< the bits of the value; empty if only their digest is known
  double number = 0;
};

/// The element that contains a difference.
struct ElementName {
  std::string kind;  ///< "body", "contact", "joint", "world" ...
  /// Slots of the body, or of both bodies of a contact, as in the ids of world.h.
  std::vector<uint32_t> slots = {};
  std::vector<uint32_t> generations = {};  ///< 0: unknown
  uint32_t part = 0;                       ///< Contact::part of a contact
};

inline constexpr size_t k_fields_told = 8;

struct FieldDifference {
  ElementName element;
  std::string part;  ///< the array of the state or of the work space that contains the field
  /// For example "velocity.y". Empty: only the digests of the element are known, or one side has no such element.
  std::string field;
  std::string measured_in;
  bool whole = false;  ///< the value is an integer
  SideValue a, b;
};

/// A call that only one side makes, or a call that both sides make with different arguments.
struct CallDifference {
  uint64_t tick = 0;   ///< the tick that follows the call
  uint32_t index = 0;  ///< its number among the calls before that tick, from 1 on
  std::string a, b;    ///< the call's name; empty: that side does not make it
  /// The fields that differ. For a call that only one side makes: all fields, up to `k_fields_told`.
  std::vector<FieldDifference> fields;
  std::vector<uint8_t> record;  ///< of a call that only one side makes
};

struct Difference {
  std::string problem;        ///< why the comparison is impossible; empty if it is possible
  bool other_config = false;  ///< the first recording has another configuration: try its engine
  bool different = false;
  bool damaged = false;          ///< a recording is incomplete, so the comparison ends early
  bool after_last_tick = false;  ///< all ticks are equal, but what follows the last tick differs
  uint64_t first = 0, last = 0;  ///< the ticks that both recordings contain
  uint64_t equal_to = 0;         ///< everything is equal up to and including this tick
  /// A tick that differs. The first tick that differs is in [`equal_to` + 1, `tick`].
  uint64_t tick = 0;
  std::string stage;                    ///< empty: unknown
  std::vector<FieldDifference> fields;  ///< the first differing fields
  uint64_t field_count = 0;             ///< number of differing fields of that stage
  std::vector<CallDifference> calls;    ///< the first differing call, or none
  std::vector<std::string> notes;
  std::vector<std::string> wanted;  ///< commands that give more details
};

/// One line and its details, without the files' names.
std::string difference_text(const Difference& difference, const std::string& a, const std::string& b);
/// Returns the difference as one JSON object.
std::string difference_json(const Difference& difference);

}  // namespace detent_tool
