#pragma once
#include <limits>
#include <string>
#include <vector>

/// What the scene format consists of, as data: the reader, the schema and the tables of docs/scene.md come from it.
/// Independent of the configuration.
namespace detent_tool {

/// low <= x <= high; or low < x.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool above = false;  ///< low itself is left out
};
constexpr Range k_any;
constexpr Range between(double low, double high) { return {low, high, false}; }
constexpr Range within(double high) { return {-high, high, false}; }
constexpr Range at_least(double low) { return {low, k_any.high, false}; }
constexpr Range above(double low) { return {low, k_any.high, true}; }
constexpr Range k_word = {0, 4294967295.0, false};

/// One key of an object.
struct SceneField {
  const char* key;
  const char* doc;
  Range range = k_any;
  bool required = false;
  bool initial = true;  ///< if it is left out, it is what its member is by itself
};
constexpr SceneField required(SceneField field) {
  field.required = true;
  return field;
}
/// To leave it out means something else.
constexpr SceneField optional(SceneField field) {
  field.initial = false;
  return field;
}

enum class FieldKind : unsigned {
  number,
  integer,
  boolean,
  text,
  body,        ///< the name of one
  joint,       ///< likewise
  vector,      ///< three numbers
  rotation,    ///< a quaternion, an axis and an angle, or three angles
  choice,      ///< one of the names
  choices,     ///< any of the names
  object,      ///< of the type
  named,       ///< likewise, or the name of one
  list,        ///< of objects of the type
  dictionary,  ///< names and objects of the type
};

struct FieldInfo {
  std::string key;
  std::string doc;
  Range range;
  bool required = false;
  FieldKind kind = FieldKind::number;
  std::string type;                ///< an ObjectInfo's name
  std::vector<std::string> names;  ///< of choices
  std::string initial;             ///< what it is if it is left out, as JSON; empty: nothing
};

/// What an object consists of where its tag has one of its values.
struct VariantInfo {
  std::string tag;
  std::vector<FieldInfo> fields;
};

struct ObjectInfo {
  std::string name;
  std::string doc;
  std::string tag_key;  ///< empty: there is one variant, without a tag
  std::string tag_doc;
  std::vector<FieldInfo> common;  ///< of every variant
  std::vector<VariantInfo> variants;
};

}  // namespace detent_tool
