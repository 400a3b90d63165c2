#include <nlohmann/json.hpp>

#include "difference.h"

namespace detent_tool {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const SideValue& value) {
  if (!value.there) return nullptr;
  if (value.raw.empty()) return Json::object();
  return {{"raw", value.raw}, {"value", value.number}};
}

Json json_of(const FieldDifference& field) {
  Json json;
  if (!field.element.kind.empty()) {
    json["element"] = field.element.kind;
    if (!field.element.slots.empty()) {
      json["slots"] = field.element.slots;
      if (!field.element.generations.empty()) json["generations"] = field.element.generations;
    }
    if (field.element.part != 0) json["element_part"] = field.element.part;
    json["table"] = field.part;
  }
  if (!field.field.empty()) json["field"] = field.field;
  if (!field.measured_in.empty()) json["unit"] = field.measured_in;
  json["a"] = json_of(field.a);
  json["b"] = json_of(field.b);
  return json;
}

Json json_of(const std::vector<FieldDifference>& fields) {
  Json list = Json::array();
  for (const FieldDifference& field : fields) list.push_back(json_of(field));
  return list;
}

}  // namespace

std::string difference_json(const Difference& difference) {
  Json json;
  if (!difference.problem.empty()) {
    json["problem"] = difference.problem;
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
  }
  json["equal"] = !difference.different;
  json["damaged"] = difference.damaged;
  json["first_tick"] = difference.first;
  json["last_tick"] = difference.last;
  json["equal_to"] = difference.equal_to;
  if (difference.different) {
    json["tick"] = difference.tick;
    json["after_last_tick"] = difference.after_last_tick;
    if (!difference.stage.empty()) json["stage"] = difference.stage;
    json["field_count"] = difference.field_count;
    json["fields"] = json_of(difference.fields);
    for (const CallDifference& call : difference.calls) {
      json["call"] = {{"tick", call.tick}, {"index", call.index}};
      json["call"]["a"] = call.a.empty() ? Json() : Json(call.a);
      json["call"]["b"] = call.b.empty() ? Json() : Json(call.b);
      json["call"]["fields"] = json_of(call.fields);
    }
  }
  if (!difference.notes.empty()) json["notes"] = difference.notes;
  if (!difference.wanted.empty()) json["wanted"] = difference.wanted;
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace detent_tool
