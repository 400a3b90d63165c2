#include <stdio.h>

#include "difference.h"
#include "text.h"

namespace detent_tool {

namespace {

std::string decimal(uint64_t value) { return std::to_string(value); }

std::string decimal(double value, int digits) {
  char text[40];
  snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

/// Writes both numbers with as many digits as are needed to make them differ.
void write_numbers(double a, double b, std::string& text_a, std::string& text_b) {
  for (int digits = 6; digits <= 17; ++digits) {
    text_a = decimal(a, digits);
    text_b = decimal(b, digits);
    if (text_a != text_b) return;
  }
}

std::string name_of(const ElementName& element) {
  const auto body = [&element](size_t i) {
    const std::string generation =
        element.generations[i] == 0 ? "" : " (generation " + decimal(element.generations[i]) + ")";
    return decimal(element.slots[i]) + generation;
  };
  std::string name = element.kind;
  if (element.kind == "asset" && element.slots.size() == 1) return name + " " + decimal(element.slots[0]);
  if (element.slots.size() == 1) name += " " + body(0);
  if (element.slots.size() == 2) name += " of bodies " + body(0) + " and " + body(1);
  if (element.part != 0) name += ", part " + decimal(element.part);
  return name;
}

/// The name of the field. For values of the work space, it includes the name of the table, because a field of the state
/// may have the same name.
std::string place_of(const FieldDifference& field) {
  const bool work =
      field.part == "contact work" || field.part == "body work" || field.part == "sweep" || field.part == "bounds";
  std::string place = name_of(field.element);
  if (work) place += ", " + field.part;
  if (!field.field.empty()) place += (place.empty() ? "" : ", ") + field.field;
  return place;
}

std::string values_of(const FieldDifference& field, const std::string& a, const std::string& b) {
  if (!field.a.there) return "only in " + b;
  if (!field.b.there) return "only in " + a;
  if (field.a.raw.empty()) return "differs";
  std::string number_a, number_b;
  write_numbers(field.a.number, field.b.number, number_a, number_b);
  if (field.whole) return number_a + " and " + number_b;
  const std::string unit = field.measured_in.empty() ? "" : " " + field.measured_in;
  return field.a.raw + " (" + number_a + unit + ") and " + field.b.raw + " (" + number_b + unit + ")";
}

std::string line_of(const FieldDifference& field, const std::string& a, const std::string& b) {
  const std::string place = place_of(field);
  return place + (place.empty() ? "" : ": ") + values_of(field, a, b);
}

std::string line_of(const CallDifference& call, const std::string& a, const std::string& b) {
  std::string line = "call " + decimal(call.index) + " before tick " + decimal(call.tick) + ": ";
  if (call.a.empty() || call.b.empty()) {
    const bool in_a = call.b.empty();
    line += in_a ? call.a : call.b;
    for (const FieldDifference& field : call.fields) {
      const double number = in_a ? field.a.number : field.b.number;
      line += (&field == &call.fields.front() ? " (" : ", ") + field.field + " " + decimal(number, 6);
    }
    return line + (call.fields.empty() ? "" : ")") + ", only in " + (in_a ? a : b);
  }
  if (call.a != call.b) return line + call.a + " and " + call.b;
  line += call.a;
  for (const FieldDifference& field : call.fields) line += ", " + line_of(field, a, b);
  return line;
}

/// The first difference, for the first line; the lists do not repeat it.
std::string first_of(const Difference& difference, const std::string& a, const std::string& b) {
  if (!difference.calls.empty() && difference.stage == "calls") return line_of(difference.calls.front(), a, b);
  return difference.fields.empty() ? "" : line_of(difference.fields.front(), a, b);
}

std::string where(const Difference& difference) {
  if (difference.stage == "seed") return "their seeds differ";
  const std::string equal =
      difference.equal_to < difference.first ? "" : "equal up to tick " + decimal(difference.equal_to) + "; ";
  if (difference.after_last_tick) return equal + "what comes after the last tick differs";
  if (difference.tick == difference.equal_to + 1) return equal + "tick " + decimal(difference.tick) + " differs";
  return equal + "one of the ticks " + decimal(difference.equal_to + 1) + " to " + decimal(difference.tick) +
         " differs";
}

}  // namespace

std::string difference_text(const Difference& difference, const std::string& a, const std::string& b) {
  if (!difference.problem.empty()) return printable(difference.problem);
  std::string text_of;
  if (!difference.different) {
    text_of = difference.last < difference.first
                  ? "no tick to compare"
                  : "equal in ticks " + decimal(difference.first) + " to " + decimal(difference.last);
  } else {
    text_of = where(difference);
    const std::string first = first_of(difference, a, b);
    if (!difference.stage.empty() && difference.stage != "seed") text_of += ", first at stage " + difference.stage;
    if (!first.empty()) text_of += ": " + first;
    const bool by_call = !difference.calls.empty() && difference.stage == "calls";
    if (!difference.calls.empty() && !by_call) text_of += "\n  " + line_of(difference.calls.front(), a, b);
    const size_t told = by_call ? 0 : 1;
    for (size_t i = told; i < difference.fields.size(); ++i) text_of += "\n  " + line_of(difference.fields[i], a, b);
    if (difference.field_count > difference.fields.size())
      text_of += "\n  and " + decimal(difference.field_count - difference.fields.size()) + " more";
  }
  for (const std::string& note : difference.notes) text_of += "\n  " + printable(note);
  for (const std::string& command : difference.wanted)
    text_of += "\n  to know more, on the machine that recorded it: " + printable(command);
  return text_of;
}

}  // namespace detent_tool
