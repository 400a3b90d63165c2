#pragma once
#include <stdint.h>

#include <string>
#include <vector>

/// Where two recordings, or a recording and this machine, part. The same in every configuration.
namespace detent_tool {

/// What one side holds.
struct SideValue {
  bool there = true;
  std::string raw;  ///< the bits; empty if only a digest of them is known
  double number = 0;
};

/// What a difference is in.
struct ElementName {
  std::string kind;                        ///< "body", "contact", "joint", "world" ...
  std::vector<uint32_t> slots = {};        ///< of the body, of both bodies of a contact, as in the ids of world.h
  std::vector<uint32_t> generations = {};  ///< 0: unknown
  uint32_t part = 0;                       ///< of a contact
};

inline constexpr size_t k_fields_told = 8;

struct FieldDifference {
  ElementName element;
  std::string part;  ///< the table that the field is of
  std::string
      field;  ///< "velocity.y"; empty: of the element only the digests are known, or one side has no such element
  std::string measured_in;
  bool whole = false;  ///< an integer
  SideValue a, b;
};

/// A call that only one side makes, or makes in another way.
struct CallDifference {
  uint64_t tick = 0;                    ///< that is completed after it
  uint32_t index = 0;                   ///< among the calls before it, from 1 on
  std::string a, b;                     ///< its name; empty: that side does not make it
  std::vector<FieldDifference> fields;  ///< that differ; of a call that only one side makes all, up to `k_fields_told`
  std::vector<uint8_t> record;          ///< of a call that only one side makes
};

struct Difference {
  std::string problem;        ///< why nothing can be said; empty if it can
  bool other_config = false;  ///< another engine may hold the first recording
  bool different = false;
  bool damaged = false;                 ///< a recording ends before its end; so does the comparison
  bool after_last_tick = false;         ///< the ticks are equal; what comes after them is not
  uint64_t first = 0, last = 0;         ///< ticks that both recordings have
  uint64_t equal_to = 0;                ///< this tick, and all before it
  uint64_t tick = 0;                    ///< the first that differs, if it is `equal_to` + 1; else one of those up to it
  std::string stage;                    ///< empty: unknown
  std::vector<FieldDifference> fields;  ///< the first of them
  uint64_t field_count = 0;             ///< of that stage
  std::vector<CallDifference> calls;    ///< the first, or none
  std::vector<std::string> notes;
  std::vector<std::string> wanted;  ///< commands that would tell more
};

/// One line, and what it leads to, without the files' names.
std::string difference_text(const Difference& difference, const std::string& a, const std::string& b);
/// One JSON object.
std::string difference_json(const Difference& difference);

}  // namespace detent_tool
