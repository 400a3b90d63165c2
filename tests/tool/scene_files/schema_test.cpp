#include <cmath>
#include <nlohmann/json.hpp>

#include "play.h"

namespace detent_tool {
namespace {

using Json = nlohmann::ordered_json;

/// Whether `value` is what `schema` allows. JSON Schema as far as scene_schema() uses it; another keyword is a failure.
class Validator {
 public:
  explicit Validator(const Json& root) : root_(root) {}
  bool valid(const Json& value, const Json& schema) const {
    for (const auto& [keyword, wanted] : schema.items()) {
      if (!holds(value, schema, keyword, wanted)) return false;
    }
    return true;
  }

 private:
  bool holds(const Json& value, const Json& schema, const std::string& keyword, const Json& wanted) const {
    const bool number = value.is_number();
    if (keyword == "type") return is(value, wanted);
    if (keyword == "$ref") return valid(value, root_["$defs"][wanted.get<std::string>().substr(8)]);
    if (keyword == "const") return value == wanted;
    if (keyword == "enum") return std::find(wanted.begin(), wanted.end(), value) != wanted.end();
    if (keyword == "minimum") return !number || value.get<double>() >= wanted.get<double>();
    if (keyword == "exclusiveMinimum") return !number || value.get<double>() > wanted.get<double>();
    if (keyword == "maximum") return !number || value.get<double>() <= wanted.get<double>();
    if (keyword == "minItems") return !value.is_array() || value.size() >= wanted.get<size_t>();
    if (keyword == "maxItems") return !value.is_array() || value.size() <= wanted.get<size_t>();
    if (keyword == "items") return !value.is_array() || all_valid(value, wanted);
    if (keyword == "anyOf") return matches(value, wanted) >= 1;
    if (keyword == "oneOf") return matches(value, wanted) == 1;
    if (keyword == "required") return has_all(value, wanted);
    if (keyword == "properties") return !value.is_object() || properties_hold(value, wanted);
    if (keyword == "additionalProperties") return !value.is_object() || others_hold(value, schema, wanted);
    const bool words = keyword == "description" || keyword == "default" || keyword == "title" || keyword == "$schema" ||
                       keyword == "$defs";
    EXPECT_TRUE(words) << keyword;
    return words;
  }
  static bool is(const Json& value, const std::string& type) {
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "integer") return value.is_number() && std::floor(value.get<double>()) == value.get<double>();
    return type == "number" && value.is_number();
  }
  bool all_valid(const Json& values, const Json& schema) const {
    for (const Json& value : values) {
      if (!valid(value, schema)) return false;
    }
    return true;
  }
  uint32_t matches(const Json& value, const Json& schemas) const {
    uint32_t count = 0;
    for (const Json& schema : schemas) count += valid(value, schema) ? 1u : 0u;
    return count;
  }
  static bool has_all(const Json& value, const Json& keys) {
    for (const Json& key : keys) {
      if (!value.contains(key.get<std::string>())) return false;
    }
    return true;
  }
  bool properties_hold(const Json& value, const Json& properties) const {
    for (const auto& [key, schema] : properties.items()) {
      if (value.contains(key) && !valid(value[key], schema)) return false;
    }
    return true;
  }
  bool others_hold(const Json& value, const Json& schema, const Json& wanted) const {
    for (const auto& [key, member] : value.items()) {
      if (schema.contains("properties") && schema["properties"].contains(key)) continue;
      if (wanted.is_boolean() ? !wanted.get<bool>() : !valid(member, wanted)) return false;
    }
    return true;
  }

  const Json& root_;
};

Json schema() { return Json::parse(scene_schema(engines().front().scene_format())); }

TEST(scene_schema, is_the_same_in_every_configuration) {
  for (const Engine& engine : engines()) {
    EXPECT_EQ(scene_schema(engine.scene_format()), file_text(DETENT_ROOT "/docs/scene.schema.json")) << engine.config;
  }
}

TEST(scene_schema, allows_the_examples_the_zoo_and_every_key) {
  const Json root = schema();
  const Validator validator(root);
  uint32_t count = 0;
  for (const char* folder : {DETENT_ROOT "/examples/scenes", DETENT_ROOT "/tests/campaigns/zoo/scenes"}) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().extension() != ".json") continue;
      EXPECT_TRUE(validator.valid(Json::parse(file_text(entry.path().string())), root)) << entry.path();
      ++count;
    }
  }
  EXPECT_GE(count, 100u);
  EXPECT_TRUE(validator.valid(Json::parse(file_text(DETENT_ROOT "/tests/tool/scene_files/every.json")), root));
}

TEST(scene_schema, refuses_what_the_reader_refuses_by_itself) {
  const Json root = schema();
  const Validator validator(root);
  for (const char* text :
       {R"({})", R"({"format": 2})", R"({"format": 1, "bodys": []})", R"({"format": 1, "ticks": 1.5})",
        R"({"format": 1, "world": {"gravity": [0, 1]}})", R"({"format": 1, "world": {"tick": 1}})",
        R"({"format": 1, "bodies": [{}]})", R"({"format": 1, "bodies": [{"shape": {"type": "sphere", "radius": 0}}]})",
        R"({"format": 1, "bodies": [{"shape": {"type": "sphere", "radius": 1, "half_length": 1}}]})",
        R"({"format": 1, "bodies": [{"shape": "ball", "density": 0}]})",
        R"({"format": 1, "bodies": [{"shape": "ball", "rotation": {"axis": [0, 0, 1]}}]})",
        R"({"format": 1, "actions": [{"tick": 0, "call": "wake_body"}]})",
        R"({"format": 1, "actions": [{"tick": 0, "call": "fly", "body": "a"}]})"}) {
    EXPECT_FALSE(validator.valid(Json::parse(text), root)) << text;
    EXPECT_NE(play(text).problems, "") << text;
  }
}

}  // namespace
}  // namespace detent_tool
