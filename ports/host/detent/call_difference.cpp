#include "call_difference.h"

#include "replay/query_command.h"
#include "tick_trace.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

using namespace detent_tool;

namespace {

/// Reads a record's fields from its bytes, with the field lists that wrote them.
class FieldList final : public Archive {
 public:
  struct Item {
    std::string name;
    WordKind kind;
    std::vector<uint8_t> bytes;  ///< of a Scaled: mantissa and exponent
  };
  FieldList(const uint8_t* bytes, uint32_t count) : Archive(k_operations), bytes_(bytes), count_(count) {}
  std::vector<Item> items;

 private:
  static void list(Archive& archive, const char* name, uint64_t& value, uint32_t byte_count) {
    FieldList& to = static_cast<FieldList&>(archive);
    value = 0;
    if (byte_count > to.count_ - to.at_) return;  // impossible: the player has read it
    const uint8_t* const bytes = to.bytes_ + to.at_;
    for (uint32_t i = 0; i < byte_count; ++i) value |= uint64_t{bytes[i]} << (8 * i);
    to.at_ += byte_count;
    const bool exponent = to.kind == WordKind::scaled && to.mantissa_;
    to.mantissa_ = to.kind == WordKind::scaled && !exponent;
    if (exponent) return to.items.back().bytes.insert(to.items.back().bytes.end(), bytes, bytes + byte_count), void();
    to.items.push_back({name, to.kind, {bytes, bytes + byte_count}});
  }
  static constexpr Operations k_operations = {list, nullptr, false};

  const uint8_t* bytes_;
  uint32_t count_;
  uint32_t at_ = 0;
  bool mantissa_ = false;  ///< the last word was a mantissa
};

/// Adds a suffix to the name of each component of a vector or rotation, because all components have the same name.
void name_components(std::vector<FieldList::Item>& items) {
  constexpr const char* k_components[] = {".x", ".y", ".z", ".w"};
  for (size_t first = 0; first < items.size();) {
    size_t last = first + 1;
    while (last < items.size() && last - first < 4 && items[last].name == items[first].name) ++last;
    if (last - first > 1) {
      for (size_t i = first; i < last; ++i) items[i].name += k_components[i - first];
    }
    first = last;
  }
}

std::vector<FieldList::Item> fields_of(const std::vector<uint8_t>& record) {
  FieldList list(record.data() + 1, static_cast<uint32_t>(record.size()) - 1);
  const RecordTag tag = static_cast<RecordTag>(record[0]);
  if (tag == RecordTag::query) {
    uint64_t length = 0, kind = 0;
    list.bits("query length", length, 2);
    list.bits("query kind", kind, 1);
    alignas(8) uint8_t command[k_query_command_bytes] = {};
    if (const QueryCode* const code = find_query(kind)) code->visit(list, command);
  } else if (const CommandCode* const code = find_command(tag)) {
    alignas(8) uint8_t command[k_command_bytes_max] = {};
    code->visit(list, command);
  }
  name_components(list.items);
  return list.items;
}

std::string name_of(const std::vector<uint8_t>& record) { return record_name(static_cast<RecordTag>(record[0])); }

SideValue value_of(const FieldList::Item& item) {
  const uint32_t bytes = static_cast<uint32_t>(item.bytes.size());
  return side_value(item.kind, item.kind == WordKind::scaled ? bytes / 2 : bytes, item.bytes.data());
}

void compare_fields(const std::vector<uint8_t>& a, const std::vector<uint8_t>& b, CallDifference& difference) {
  const std::vector<FieldList::Item> in_a = fields_of(a), in_b = fields_of(b);
  for (size_t i = 0; i < in_a.size() && i < in_b.size(); ++i) {
    if (in_a[i].bytes == in_b[i].bytes || in_a[i].name != in_b[i].name) continue;
    FieldDifference field;
    field.field = in_a[i].name;
    field.whole = is_whole(in_a[i].kind);
    field.a = value_of(in_a[i]);
    field.b = value_of(in_b[i]);
    difference.fields.push_back(field);
  }
}

/// Lists the fields of a call that only one side makes.
void list_fields(const std::vector<uint8_t>& record, bool in_a, CallDifference& difference) {
  difference.record = record;
  for (const FieldList::Item& item : fields_of(record)) {
    if (difference.fields.size() == k_fields_told) return;
    FieldDifference field;
    field.field = item.name;
    field.whole = is_whole(item.kind);
    (in_a ? field.a : field.b) = value_of(item);
    (in_a ? field.b : field.a).there = false;
    difference.fields.push_back(field);
  }
}

}  // namespace

bool find_call_difference(const CallRecords& a, const CallRecords& b, CallDifference& difference) {
  size_t i = 0;
  while (i < a.size() && i < b.size() && a[i] == b[i]) ++i;
  if (i == a.size() && i == b.size()) return false;
  difference.index = static_cast<uint32_t>(i + 1);
  // One side has an additional call i if the other side has no call i, or if the other side has fewer calls and its
  // call i equals the next call of the first side.
  const bool only_a = i < a.size() && (i == b.size() || (a.size() > b.size() && a[i + 1] == b[i]));
  const bool only_b = i < b.size() && (i == a.size() || (b.size() > a.size() && b[i + 1] == a[i]));
  if (!only_b) difference.a = name_of(a[i]);
  if (!only_a) difference.b = name_of(b[i]);
  if (only_a || only_b) list_fields(only_a ? a[i] : b[i], only_a, difference);
  if (!only_a && !only_b && a[i][0] == b[i][0]) compare_fields(a[i], b[i], difference);
  return true;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
