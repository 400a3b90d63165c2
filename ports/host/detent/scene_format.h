#pragma once
#include <limits>
#include <string>
#include <vector>

/// The parts of the scene format, as data. The reader, the schema and the tables of docs/scene.md use them. They do not
/// depend on the configuration.
namespace detent_tool {

/// The range of a value x: low <= x <= high; if `above`: low < x <= high.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool above = false;  ///< low itself is excluded
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
  bool initial = true;  ///< if the key is missing, the member keeps its initial value
};
constexpr SceneField required(SceneField field) {
  field.required = true;
  return field;
}
/// A field whose absence has a meaning of its own.
constexpr SceneField optional(SceneField field) {
  field.initial = false;
  return field;
}

enum class FieldKind : unsigned {
  number,
  integer,
  boolean,
  text,
  body,        ///< the name of a body
  joint,       ///< the name of a joint
  vector,      ///< three numbers
  rotation,    ///< a quaternion, an axis and an angle, or three angles
  choice,      ///< one of the given names
  choices,     ///< any number of the given names
  object,      ///< an object of the type
  named,       ///< an object of the type, or the name of such an object
  list,        ///< a list of objects of the type
  dictionary,  ///< names with objects of the type
};

struct FieldInfo {
  std::string key;
  std::string doc;
  Range range;
  bool required = false;
  FieldKind kind = FieldKind::number;
  std::string type;                ///< an ObjectInfo's name
  std::vector<std::string> names;  ///< of a choice
  std::string initial;             ///< the value if the key is missing, as JSON; empty: no value
};

/// The fields of an object for one value of its tag.
struct VariantInfo {
  std::string tag;
  std::vector<FieldInfo> fields;
};

struct ObjectInfo {
  std::string name;
  std::string doc;
  std::string tag_key;  ///< empty: one variant without a tag
  std::string tag_doc;
  std::vector<FieldInfo> common;  ///< the fields of every variant
  std::vector<VariantInfo> variants;
};

}  // namespace detent_tool
