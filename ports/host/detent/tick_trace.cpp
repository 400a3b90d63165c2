#include "tick_trace.h"

#include <detent/numbers.h>
#include <string.h>

#include <algorithm>

#include "base/digest.h"
#include "text.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

using namespace detent_tool;

namespace {

uint64_t word_at(const uint8_t* bytes, uint32_t width) {
  uint64_t word = 0;
  for (uint32_t i = 0; i < width; ++i) word |= uint64_t{bytes[i]} << (8 * i);
  return word;
}

uint32_t index_of(const TracePart& part) { return static_cast<uint32_t>(&part - k_trace_parts); }

void add(StageTrace& stage, const TracePart& part, uint32_t place, const uint8_t* bytes, bool full) {
  StageTrace::Key words;
  for (uint32_t i = 0; i < part.key_words; ++i) words.push_back(static_cast<uint32_t>(word_at(bytes + 4 * i, 4)));
  if (part.number == 7) stage.contacts.push_back(words);
  const uint32_t key_bytes = 4 * part.key_words;
  StageTrace::Element& element = stage.parts[index_of(part)][part.sorted ? words : StageTrace::Key{place}];
  element.bytes.assign(bytes, bytes + (full ? part.element_bytes : key_bytes));
  element.digest = full ? digest_fold(trace_digest(part, place, bytes))
                        : static_cast<uint32_t>(word_at(bytes + key_bytes, k_trace_digest_bytes));
}

/// Converts the bits of a number to a double, by the library's own conversions.
double number_of(WordKind kind, uint32_t width, const uint8_t* bytes) {
  const uint64_t word = word_at(bytes, width);
  switch (kind) {
    case WordKind::signed_integer: {
      const uint32_t unused = 64 - 8 * width;
      return static_cast<double>(static_cast<int64_t>(word << unused) >> unused);
    }
#if DETENT_FIXED
    case WordKind::coord:
      return coord_to_host(Coord::from_raw(static_cast<Coord::Raw>(word)));
    case WordKind::real:
      return real_to_host(Real::from_raw(static_cast<int64_t>(word)));
    case WordKind::unit:
      return unit_to_host(Unit::from_raw(static_cast<int32_t>(word)));
    case WordKind::scaled: {
      const int32_t exponent = static_cast<int32_t>(word_at(bytes + 4, 4));
      if (exponent < -256 || exponent > 256) return 0;  // no valid number: damaged bytes
      return scaled_to_host(Scaled::from_parts(static_cast<int32_t>(word), exponent));
    }
#elif defined(DETENT_F32)
    case WordKind::coord:
      return coord_to_host(Coord::from_raw(static_cast<int64_t>(word)));
    case WordKind::real:
      return real_to_host(__builtin_bit_cast(float, static_cast<uint32_t>(word)));
#else
    case WordKind::real:
      return __builtin_bit_cast(double, word);
#endif
    case WordKind::fraction:
      return fraction_to_host(Fraction::from_raw(static_cast<int64_t>(word)));
    default:
      return static_cast<double>(word);
  }
}

std::string name_of(const Field& field, uint32_t number) {
  constexpr const char* k_components[] = {".x", ".y", ".z", ".w"};
  const uint32_t words = field.kind == WordKind::scaled ? 2 : 1;
  std::string name = field.name;
  const uint32_t numbers = field.count / words;
  if (numbers > field.components) name += "[" + std::to_string(number / field.components) + "]";
  if (field.components != 1) name += k_components[number % field.components];
  return name;
}

/// Names the elements of a stage, by the slots and generations of either side.
class Names {
 public:
  Names(const StageTrace& a, const StageTrace& b) : sides_{&a, &b} {}

  ElementName of(const TracePart& part, const StageTrace::Key& key) const {
    ElementName name;
    switch (part.kind) {
      case TraceKind::world:
        name.kind = "world";
        break;
      case TraceKind::body:
        name.kind = "body";
        add_body(key[0], name);
        break;
      case TraceKind::slot_word:
        name.kind = "free slots";
        break;
      case TraceKind::contact:
        return contact(part.sorted ? key : contact_at(key[0]));
      case TraceKind::asset:
        name.kind = "asset";
        name.slots.push_back(key[0]);
        break;
      case TraceKind::joint:
        name.kind = "joint";
        name.slots.push_back(key[0] + 1);
        name.generations.push_back(second_word(part, key[0]));
        break;
      case TraceKind::sensed:
        name = contact({key[0], key[1], 0});
        name.kind = "sensor";
        break;
    }
    return name;
  }

 private:
  ElementName contact(const StageTrace::Key& key) const {
    ElementName name;
    name.kind = "contact";
    if (key.size() < 3) return name;
    add_body(key[0], name);
    add_body(key[1], name);
    name.part = key[2];
    return name;
  }
  StageTrace::Key contact_at(uint32_t place) const {
    return place < sides_[0]->contacts.size() ? sides_[0]->contacts[place] : StageTrace::Key{};
  }
  void add_body(uint32_t slot, ElementName& name) const {
    name.slots.push_back(slot + 1);
    name.generations.push_back(second_word(k_trace_parts[3], slot));  // from the table of body properties
  }
  uint32_t second_word(const TracePart& part, uint32_t place) const {
    for (const StageTrace* side : sides_) {
      const auto& elements = side->parts[index_of(part)];
      const auto found = elements.find({place});
      if (found != elements.end() && found->second.bytes.size() >= 8)
        return static_cast<uint32_t>(word_at(found->second.bytes.data() + 4, 4));
    }
    return 0;
  }

  const StageTrace* sides_[2];
};

/// Adds the differences of one element to the list; a null pointer: that side has no such element.
void compare_element(const TracePart& part, const ElementName& name, const StageTrace::Element* a,
                     const StageTrace::Element* b, bool full, Difference& difference) {
  const auto tell = [&](FieldDifference&& field) {
    ++difference.field_count;
    if (difference.fields.size() >= k_fields_told) return;
    field.element = name;
    field.part = part.name;
    difference.fields.push_back(std::move(field));
  };
  const std::vector<uint8_t> zeros(part.element_bytes, 0);
  const bool both = (a != nullptr && b != nullptr) || !part.sorted;  // if not sorted, a missing element is zero
  if (!full || !both) {
    if (a != nullptr && b != nullptr && a->digest == b->digest) return;
    FieldDifference field;
    field.a.there = a != nullptr || !part.sorted;
    field.b.there = b != nullptr || !part.sorted;
    return tell(std::move(field));
  }
  const uint8_t* const bytes_a = a != nullptr ? a->bytes.data() : zeros.data();
  const uint8_t* const bytes_b = b != nullptr ? b->bytes.data() : zeros.data();
  for (uint32_t i = 0; i < part.field_count; ++i) {
    const Field& field = part.fields[i];
    const uint32_t words = field.kind == WordKind::scaled ? 2 : 1, bytes = words * field.width;
    for (uint32_t number = 0; number < field.count / words; ++number) {
      const uint32_t at = field.offset + number * bytes;
      if (memcmp(bytes_a + at, bytes_b + at, bytes) == 0) continue;
      FieldDifference found;
      found.field = name_of(field, number);
      found.measured_in = field.measured_in;
      found.whole = is_whole(field.kind);
      found.a = side_value(field.kind, field.width, bytes_a + at);
      found.b = side_value(field.kind, field.width, bytes_b + at);
      tell(std::move(found));
    }
  }
}

/// Whether a stage differs; adds the differences to the list.
bool compare_stages(const StageTrace& a, const StageTrace& b, bool full, Difference& difference) {
  const Names names(a, b);
  const uint64_t before = difference.field_count;
  for (uint32_t i = 0; i < k_trace_part_count; ++i) {
    const auto &of_a = a.parts[i], &of_b = b.parts[i];
    std::vector<StageTrace::Key> keys;
    for (const auto& entry : of_a) keys.push_back(entry.first);
    for (const auto& entry : of_b) keys.push_back(entry.first);
    std::sort(keys.begin(), keys.end(), StageTrace::KeyOrder{});
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    for (const StageTrace::Key& key : keys) {
      const auto in_a = of_a.find(key), in_b = of_b.find(key);
      const StageTrace::Element* const element_a = in_a == of_a.end() ? nullptr : &in_a->second;
      const StageTrace::Element* const element_b = in_b == of_b.end() ? nullptr : &in_b->second;
      compare_element(k_trace_parts[i], names.of(k_trace_parts[i], key), element_a, element_b, full, difference);
    }
  }
  // Two different states may have equal digests of 32 bits by chance.
  if (difference.field_count != before || a.digest == b.digest || full) return difference.field_count != before;
  FieldDifference field;
  field.element.kind = "some element";
  difference.fields.push_back(field);
  return ++difference.field_count, true;
}

std::string name_of(uint32_t stage) {
  if (stage == static_cast<uint32_t>(TraceStage::calls)) return "calls";
  if (stage == static_cast<uint32_t>(TraceStage::end)) return "end";
  return stage_name(static_cast<StepStage>(stage - static_cast<uint32_t>(TraceStage::find_pairs)));
}

}  // namespace

SideValue side_value(WordKind kind, uint32_t width, const uint8_t* bytes) {
  SideValue value;
  value.raw = "0x" + hexadecimal(word_at(bytes, width)).substr(16 - 2 * width);
  if (kind == WordKind::scaled) value.raw += " x 2^" + std::to_string(static_cast<int32_t>(word_at(bytes + 4, 4)));
  value.number = number_of(kind, width, bytes);
  return value;
}

bool TickTrace::read(const std::vector<uint8_t>& bytes, bool full_trace) {
  there = true;
  full = full_trace;
  TraceReader reader(bytes.data(), static_cast<uint32_t>(bytes.size()), full);
  for (TraceElement element; reader.next(element);) {
    StageTrace& stage = stages[static_cast<uint32_t>(element.stage)];
    stage.there = true;
    if (element.part == nullptr)
      stage.digest = word_at(element.bytes, k_trace_stage_end_bytes);
    else
      add(stage, *element.part, element.place, element.bytes, full);
  }
  return reader.whole();
}

void TickTrace::take_end(const World& world) {
  there = full = true;
  StageTrace& stage = stages[static_cast<uint32_t>(TraceStage::end)];
  stage.there = true;
  const auto take = [](void* context, const TracePart& part, uint32_t place, const uint8_t* bytes) {
    add(*static_cast<StageTrace*>(context), part, place, bytes, true);
  };
  visit_trace(world, TraceStage::end, 0, {take, &stage});
  for (uint32_t i = 0; i < k_trace_part_count; ++i) {
    for (const auto& entry : stage.parts[i]) {
      const uint32_t place = k_trace_parts[i].sorted ? 0 : entry.first[0];
      stage.digest += trace_digest(k_trace_parts[i], place, entry.second.bytes.data());
    }
  }
}

bool find_difference(const TickTrace& a, const TickTrace& b, Difference& difference) {
  if (!a.there || !b.there) return false;
  for (uint32_t i = 0; i < k_trace_stage_count; ++i) {
    if (!a.stages[i].there || !b.stages[i].there) continue;
    if (!compare_stages(a.stages[i], b.stages[i], a.full && b.full, difference)) continue;
    difference.stage = name_of(i);
    return true;
  }
  return false;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
