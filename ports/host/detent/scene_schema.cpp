#include <cmath>
#include <nlohmann/json.hpp>

#include "run.h"

namespace detent_tool {

namespace {

using Json = nlohmann::ordered_json;

Json reference_to(const std::string& name) { return {{"$ref", "#/$defs/" + name}}; }

/// Writes an integer without a decimal point.
Json number_json(double value) {
  if (value == std::floor(value) && std::fabs(value) < 1e15) return static_cast<int64_t>(value);
  return value;
}

Json ranged(const char* type, const Range& range) {
  Json json = {{"type", type}};
  if (std::isfinite(range.low)) json[range.above ? "exclusiveMinimum" : "minimum"] = number_json(range.low);
  if (std::isfinite(range.high)) json["maximum"] = number_json(range.high);
  return json;
}

Json list_of(const Json& item, size_t count) {
  return {{"type", "array"}, {"items", item}, {"minItems", count}, {"maxItems", count}};
}

Json schema_of(const FieldInfo& field) {
  switch (field.kind) {
    case FieldKind::number:
      return ranged("number", field.range);
    case FieldKind::integer:
      return ranged("integer", field.range);
    case FieldKind::boolean:
      return {{"type", "boolean"}};
    case FieldKind::text:
    case FieldKind::body:
    case FieldKind::joint:
      return {{"type", "string"}};
    case FieldKind::vector:
      return list_of(ranged("number", field.range), 3);
    case FieldKind::rotation:
      return reference_to("rotation");
    case FieldKind::choice:
      return {{"enum", field.names}};
    case FieldKind::choices:
      return {{"type", "array"}, {"items", {{"enum", field.names}}}};
    case FieldKind::object:
      return reference_to(field.type);
    case FieldKind::named:
      return {{"anyOf", {{{"type", "string"}}, reference_to(field.type)}}};
    case FieldKind::list:
      return {{"type", "array"}, {"items", reference_to(field.type)}};
    default:  // a dictionary
      return {{"type", "object"}, {"additionalProperties", reference_to(field.type)}};
  }
}

Json rotation_schema() {
  const Json angle = ranged("number", within(36000));
  const Json rotation_vector = {
      {"type", "object"},
      {"properties", {{"axis", list_of(ranged("number", within(1e6)), 3)}, {"degrees", angle}}},
      {"required", {"axis", "degrees"}},
      {"additionalProperties", false}};
  const Json euler = {{"type", "object"},
                      {"properties", {{"euler_degrees", list_of(angle, 3)}}},
                      {"required", {"euler_degrees"}},
                      {"additionalProperties", false}};
  return {{"description", "A quaternion x, y, z, w of length 1; or a turn about an axis; or turns about x, y, z."},
          {"anyOf", {list_of(ranged("number", within(1)), 4), rotation_vector, euler}}};
}

Json schema_of(const ObjectInfo& object, const VariantInfo& variant) {
  Json properties = Json::object();
  Json needed = Json::array();
  const auto take = [&](const FieldInfo& field) {
    Json schema = schema_of(field);
    schema["description"] = field.doc;
    if (!field.initial.empty()) schema["default"] = Json::parse(field.initial);
    properties[field.key] = schema;
    if (field.required) needed.push_back(field.key);
  };
  for (const FieldInfo& field : object.common) take(field);
  if (!object.tag_key.empty()) {
    properties[object.tag_key] = {{"const", variant.tag}, {"description", object.tag_doc}};
    needed.push_back(object.tag_key);
  }
  for (const FieldInfo& field : variant.fields) take(field);
  Json schema = {{"type", "object"}, {"properties", properties}};
  if (!needed.empty()) schema["required"] = needed;
  schema["additionalProperties"] = false;
  return schema;
}

std::string text_of(const Range& range) {
  const auto number = [](double value) { return number_json(value).dump(); };
  const bool low = std::isfinite(range.low), high = std::isfinite(range.high);
  if (!low && !high) return "";
  if (low && high && range.low == range.high) return number(range.low);
  if (low && high && -range.low == range.high) return "within " + number(range.high);
  if (low && high) return number(range.low) + " to " + number(range.high);
  if (high) return "up to " + number(range.high);
  return (range.above ? "above " : "from ") + number(range.low);
}

std::string kind_text(const FieldInfo& field) {
  std::string names;
  for (const std::string& name : field.names) names += (names.empty() ? "`" : ", `") + name + "`";
  switch (field.kind) {
    case FieldKind::number:
      return "number";
    case FieldKind::integer:
      return "whole number";
    case FieldKind::boolean:
      return "true or false";
    case FieldKind::text:
      return "text";
    case FieldKind::body:
      return "a body's name";
    case FieldKind::joint:
      return "a joint's name";
    case FieldKind::vector:
      return "three numbers";
    case FieldKind::rotation:
      return "[rotation](#rotations)";
    case FieldKind::choice:
      return names;
    case FieldKind::choices:
      return "list of " + names;
    case FieldKind::object:
      return "[" + field.type + "](#" + field.type + ")";
    case FieldKind::named:
      return "[" + field.type + "](#" + field.type + "), or a name";
    case FieldKind::list:
      return "list: [" + field.type + "](#" + field.type + ")";
    default:
      return "names: [" + field.type + "](#" + field.type + ")";
  }
}

std::string row(const std::string& key, const FieldInfo& field) {
  const std::string range = text_of(field.range);
  return "| " + key + " | " + kind_text(field) + (range.empty() ? "" : ", " + range) + " | " +
         (field.required ? "**needed**" : field.initial) + " | " + field.doc + " |\n";
}

/// Writes a value on one line if it fits.
std::string laid_out(const Json& json, const std::string& indentation) {
  constexpr size_t k_line_max = 120;
  const std::string flat = json.dump();
  if (!json.is_structured() || flat.size() + indentation.size() <= k_line_max) return flat;
  const std::string inner = indentation + "  ";
  std::string text;
  for (const auto& [key, value] : json.items()) {
    text += (text.empty() ? "\n" : ",\n") + inner + (json.is_object() ? Json(key).dump() + ": " : "") +
            laid_out(value, inner);
  }
  return (json.is_object() ? "{" : "[") + text + "\n" + indentation + (json.is_object() ? "}" : "]");
}

}  // namespace

std::string scene_schema(const std::vector<ObjectInfo>& objects) {
  Json definitions = Json::object();
  definitions["rotation"] = rotation_schema();
  for (size_t i = 1; i < objects.size(); ++i) {
    const ObjectInfo& object = objects[i];
    Json schema = {{"description", object.doc}};
    if (object.tag_key.empty()) {
      schema.update(schema_of(object, object.variants.front()));
    } else {
      schema["oneOf"] = Json::array();
      for (const VariantInfo& variant : object.variants) schema["oneOf"].push_back(schema_of(object, variant));
    }
    definitions[object.name] = schema;
  }
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "Detent scene"}};
  schema.update(schema_of(objects.front(), objects.front().variants.front()));
  schema["$defs"] = definitions;
  return laid_out(schema, "") + "\n";
}

std::string scene_tables(const std::vector<ObjectInfo>& objects) {
  std::string text;
  for (const ObjectInfo& object : objects) {
    text += "\n### " + object.name + "\n\n" + object.doc + "\n\n| key | value | if left out | |\n|---|---|---|---|\n";
    for (const FieldInfo& field : object.common) text += row("`" + field.key + "`", field);
    if (!object.tag_key.empty()) {
      text += "| `" + object.tag_key + "` | one of those below | **needed** | " + object.tag_doc + " |\n";
    }
    for (const VariantInfo& variant : object.variants) {
      const std::string tag = variant.tag.empty() ? "" : "`" + variant.tag + "`: ";
      if (!variant.tag.empty() && variant.fields.empty()) text += "| " + tag + "| | | |\n";
      for (const FieldInfo& field : variant.fields) text += row(tag + "`" + field.key + "`", field);
    }
  }
  return text;
}

}  // namespace detent_tool
