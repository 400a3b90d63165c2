#pragma once
#include "scene_actions.h"

/// Reads definitions from JSON.
namespace detent {
inline namespace DETENT_NAMESPACE {

/// A name that must exist in the scene.
struct SceneReference {
  SceneOrigin origin;
  std::string name;
  bool joint = false;
  bool action = false;  ///< the name may be that of an object that an action creates
};

/// The results and problems collected while a scene is read.
struct SceneReading {
  std::vector<Problem> problems;
  std::vector<SceneAsset> assets;
  std::vector<SceneReference> references;
  SceneText scene;

  /// Whether k_problems_max problems have been found: further problems are dropped.
  bool is_full() const { return problems.size() >= k_problems_max; }
  void problem(const SceneOrigin& origin, const std::string& text);
  void problem(const Node& node, const std::string& path, const std::string& text);
};

/// Reads the whole scene. The scene is good if `reading` then has no problems. `root` must outlive `reading`.
void read_scene(const Node& root, SceneReading& reading);

/// Reads the keys of one object. A wrong value is reported as a problem. If the value is wrong or the key is missing,
/// the member stays unchanged. The functions that return a bool, except tag(), return whether the key is present.
class ObjectReader {
 public:
  ObjectReader(SceneReading& reading, const Node& node, const std::string& path);

  bool given(const char* key) const { return index_of(key) < node_.keys.size(); }
  void problem(const char* key, const std::string& text);
  /// Reports keys of a repeat as problems. They are misplaced if they are still here: write_out_repeats()
  /// (scene_repeat.h) has already removed them from the entries of lists.
  void repeated();
  void origin(SceneOrigin& origin) const { origin = {node_.line, path_}; }
  bool real(const SceneField& field, Real& value);
  bool scaled(const SceneField& field, Scaled& value);
  bool vector(const SceneField& field, Vec3<Real>& value);
  bool scaleds(const SceneField& field, Vec3<Scaled>& value);
  bool position(const SceneField& field, Position& value);
  bool rotation(const SceneField& field, Quat& value);
  bool flag(const SceneField& field, bool& value);
  bool text(const SceneField& field, std::string& value);
  bool body(const SceneField& field, std::string& value) { return name(field, value, false); }
  bool joint(const SceneField& field, std::string& value) { return name(field, value, true); }
  /// Reads the asset of a shape whose type is known.
  void asset(Shape& shape);

  template <class T>
  bool integer(const SceneField& field, T& value) {
    double number = 0;
    const Node* const node = take(field);
    if (node != nullptr && whole_number(field, *node, number)) value = static_cast<T>(number);
    return node != nullptr;
  }
  bool counted(const SceneField& field, uint32_t& value) { return integer(field, value); }
  bool counted(const SceneField& field, bool& value) { return flag(field, value); }

  template <class T, size_t count>
  bool choice(const SceneField& field, T& value, const Choice<T> (&choices)[count]) {
    const Node* const node = take(field);
    if (node == nullptr) return false;
    const size_t found = find_choice(*node, path_of(field.key), names_of(choices));
    if (found < count) value = choices[found].value;
    return true;
  }
  template <class T, size_t count>
  bool choices(const SceneField& field, T& value, const Choice<T> (&choices)[count]) {
    const Node* const node = take(field);
    if (node == nullptr || !is(*node, NodeKind::array, path_of(field.key))) return node != nullptr;
    value = 0;
    for (size_t i = 0; i < node->items.size(); ++i) {
      const size_t found = find_choice(node->items[i], path_of(field.key, i), names_of(choices));
      if (found < count) value |= choices[found].value;
    }
    return true;
  }
  /// Returns false if the key is missing or its value is wrong: then the keys that depend on the tag cannot be checked.
  template <class T, size_t count>
  bool tag(const SceneField& field, T& value, const Choice<T> (&choices)[count]) {
    const Node* const node = take(required(field));
    const size_t found = node == nullptr ? count : find_choice(*node, path_of(field.key), names_of(choices));
    if (found < count) value = choices[found].value;
    judged_ = judged_ && found < count;
    return found < count;
  }

  template <class T>
  bool object(const SceneField& field, T& value) {
    const Node* const node = take(field);
    if (node != nullptr) read(reading_, *node, path_of(field.key), value);
    return node != nullptr;
  }
  template <class T>
  bool named(const SceneField& field, T& value) {
    const Node* const node = take(field);
    if (node == nullptr) return false;
    if (node->kind != NodeKind::text) {
      read(reading_, *node, path_of(field.key), value);
      return true;
    }
    const std::map<std::string, T>& table = dictionary_of(static_cast<const T*>(nullptr));
    const auto found = table.find(node->text);
    if (found != table.end()) {
      value = found->second;
    } else {
      reading_.problem(*node, path_of(field.key),
                       "no " + std::string(TypeText<T>::k_name) + " has the name " + quoted(node->text));
    }
    return true;
  }
  template <class T>
  void list(const SceneField& field, std::vector<T>& values) {
    const Node* const node = take(field);
    if (node == nullptr || !is(*node, NodeKind::array, path_of(field.key))) return;
    size_t problems = 0;
    // A definition takes a kilobyte of memory, but a wrong definition takes only three letters of the file. Without the
    // limit of problems, a hostile file would use up all memory.
    for (size_t i = 0; i < node->items.size() && !reading_.is_full(); ++i) {
      const Node& item = node->items[i];
      // A problem with one copy is a problem with all copies, so it is reported once.
      const bool again = i > 0 && !item.copy.empty() && item.entry == node->items[i - 1].entry;
      if (again && reading_.problems.size() != problems) continue;
      problems = reading_.problems.size();
      values.emplace_back();
      const std::string copy = item.copy.empty() ? "" : "{" + item.copy + "}";
      read(reading_, item, path_of(field.key, item.entry) + copy, values.back());
    }
  }
  template <class T>
  void dictionary(const SceneField& field, std::map<std::string, T>& values) {
    const Node* const node = take(field);
    if (node == nullptr || !is(*node, NodeKind::object, path_of(field.key))) return;
    for (size_t i = 0; i < node->items.size(); ++i) {
      read(reading_, node->items[i], path_of(field.key) + "." + node->keys[i], values[node->keys[i]]);
    }
  }
  /// Checks the changed fields of a definition now. When the action is executed, it applies them to the definition that
  /// the object has then.
  template <class T>
  void changes(const SceneField& field, const Node*& kept) {
    T scratch;
    if (object(field, scratch)) kept = &node_.items[index_of(field.key)];
  }

  template <class T>
  static void read(SceneReading& reading, const Node& node, const std::string& path, T& value) {
    ObjectReader reader(reading, node, path);
    if (node.kind != NodeKind::object) return reading.problem(node, path, "is not an object");
    visit(reader, value);
    reader.judge_keys();
  }
  static std::string quoted(const std::string& text) { return "\"" + text + "\""; }

 private:
  size_t index_of(const char* key) const;
  std::string path_of(const char* key) const { return path_.empty() ? key : path_ + "." + key; }
  std::string path_of(const char* key, size_t index) const { return path_of(key) + "[" + std::to_string(index) + "]"; }
  SceneOrigin origin_of(const char* key) const;
  const Node* take(const SceneField& field);
  bool is(const Node& node, NodeKind kind, const std::string& path);
  bool number(const SceneField& field, const Node& node, const std::string& path, double& value);
  bool whole_number(const SceneField& field, const Node& node, double& value);
  bool numbers(const SceneField& field, const Node& node, const std::string& path, double* values, size_t count);
  bool name(const SceneField& field, std::string& value, bool joint);
  void turned(const Node& node, const std::string& path, Quat& value);
  template <class T>
  bool three(const SceneField& field, Vec3<T>& value, Status (*convert)(double, T&));
  template <class T>
  void convert_one(const SceneField& field, T& value, Status (*convert)(double, T&), const Node* node);
  size_t find_choice(const Node& node, const std::string& path, const std::vector<const char*>& names);
  void judge_keys();

  template <class T, size_t count>
  static std::vector<const char*> names_of(const Choice<T> (&choices)[count]) {
    std::vector<const char*> names;
    for (const Choice<T>& each : choices) names.push_back(each.name);
    return names;
  }
  const std::map<std::string, Material>& dictionary_of(const Material*) const { return reading_.scene.materials; }
  const std::map<std::string, Shape>& dictionary_of(const Shape*) const { return reading_.scene.shapes; }
  const std::map<std::string, Filter>& dictionary_of(const Filter*) const { return reading_.scene.filters; }

  SceneReading& reading_;
  const Node& node_;
  std::string path_;
  std::vector<std::string> known_;
  bool judged_ = true;
};

}  // namespace DETENT_NAMESPACE
}  // namespace detent
