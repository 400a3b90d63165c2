#include <algorithm>

#include "scene_actions.h"
#include "scene_play.h"
#include "scene_repeat.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

namespace {

std::string plain(double value) {
  char text[32];
  snprintf(text, sizeof text, "%.6g", value);
  return text;
}
std::string bracketed(const std::vector<double>& values) {
  std::string text = "[";
  for (const double value : values) text += (text.size() == 1 ? "" : ", ") + plain(value);
  return text + "]";
}
std::string quoted(const std::string& text) { return "\"" + text + "\""; }

/// Notes the keys that visit() passes, with the values of its argument as their initial values.
class ObjectDescriber {
 public:
  ObjectDescriber(std::vector<ObjectInfo>& objects, size_t variant) : objects_(objects), variant_(variant) {}

  bool given(const char*) const { return false; }
  void problem(const char*, const std::string&) {}
  void origin(SceneOrigin&) const {}
  void repeated() {
    for (const FieldInfo& info : repeat_fields()) fields.push_back(info);
    for (const ObjectInfo& object : repeat_objects()) add_once(object);
  }
  bool real(const SceneField& field, Real& value) { return add(field, FieldKind::number, plain(real_to_host(value))); }
  bool scaled(const SceneField& field, Scaled& value) {
    return add(field, FieldKind::number, plain(scaled_to_host(value)));
  }
  bool vector(const SceneField& field, Vec3<Real>& value) {
    return add(field, FieldKind::vector,
               bracketed({real_to_host(value.x), real_to_host(value.y), real_to_host(value.z)}));
  }
  bool scaleds(const SceneField& field, Vec3<Scaled>&) { return add(field, FieldKind::vector, ""); }
  bool position(const SceneField& field, Position&) { return add(field, FieldKind::vector, "[0, 0, 0]"); }
  bool rotation(const SceneField& field, Quat&) { return add(field, FieldKind::rotation, "[0, 0, 0, 1]"); }
  bool flag(const SceneField& field, bool& value) { return add(field, FieldKind::boolean, value ? "true" : "false"); }
  bool text(const SceneField& field, std::string&) { return add(field, FieldKind::text, ""); }
  bool body(const SceneField& field, std::string&) { return add(field, FieldKind::body, ""); }
  bool joint(const SceneField& field, std::string&) { return add(field, FieldKind::joint, ""); }
  void asset(Shape&) {
    add(required({"file", "cooked, from the scene's folder"}), FieldKind::text, "");
    add({"digest", "16 hexadecimal digits that its content must have"}, FieldKind::text, "");
  }
  template <class T>
  bool integer(const SceneField& field, T& value) {
    return add(field, FieldKind::integer, std::to_string(value));
  }
  bool counted(const SceneField& field, uint32_t&) { return add(field, FieldKind::integer, ""); }
  bool counted(const SceneField& field, bool& value) { return flag(field, value); }
  template <class T, size_t count>
  bool choice(const SceneField& field, T& value, const Choice<T> (&choices)[count]) {
    std::string initial;
    for (const Choice<T>& each : choices) initial = each.value == value ? quoted(each.name) : initial;
    add(field, FieldKind::choice, initial);
    note_names(choices);
    return false;
  }
  template <class T, size_t count>
  bool choices(const SceneField& field, T&, const Choice<T> (&choices)[count]) {
    add(field, FieldKind::choices, "[]");
    note_names(choices);
    return false;
  }
  template <class T, size_t count>
  bool tag(const SceneField& field, T& value, const Choice<T> (&choices)[count]) {
    tag_key = field.key;
    tag_doc = field.doc;
    variant_count = count;
    tag_value = choices[variant_].name;
    value = choices[variant_].value;
    common = fields.size();
    return true;
  }
  template <class T>
  bool object(const SceneField& field, T&) {
    return add_typed<T>(field, FieldKind::object);
  }
  template <class T>
  bool named(const SceneField& field, T&) {
    return add_typed<T>(field, FieldKind::named);
  }
  template <class T>
  void list(const SceneField& field, std::vector<T>&) {
    add_typed<T>(field, FieldKind::list);
  }
  template <class T>
  void dictionary(const SceneField& field, std::map<std::string, T>&) {
    add_typed<T>(field, FieldKind::dictionary);
  }
  template <class T>
  void changes(const SceneField& field, const Node*&) {
    add_typed<T>(field, FieldKind::object);
  }

  std::vector<FieldInfo> fields;
  std::string tag_key, tag_doc, tag_value;
  size_t variant_count = 1;
  size_t common = 0;  ///< number of fields before the tag

 private:
  bool add(const SceneField& field, FieldKind kind, const std::string& initial) {
    FieldInfo info = {field.key, field.doc, field.range, field.required, kind, "", {}, initial};
    if (field.required || !field.initial) info.initial.clear();
    fields.push_back(info);
    return false;
  }
  template <class T>
  bool add_typed(const SceneField& field, FieldKind kind);
  void add_once(const ObjectInfo& object) {
    const auto same = [&object](const ObjectInfo& known) { return known.name == object.name; };
    if (std::none_of(objects_.begin(), objects_.end(), same)) objects_.push_back(object);
  }
  template <class T, size_t count>
  void note_names(const Choice<T> (&choices)[count]) {
    for (const Choice<T>& each : choices) fields.back().names.push_back(each.name);
  }

  std::vector<ObjectInfo>& objects_;
  size_t variant_;
};

/// Adds the description of T, and after it the descriptions of its fields' types, each type only once.
template <class T>
void describe(std::vector<ObjectInfo>& objects) {
  const std::string name = TypeText<T>::k_name;
  for (const ObjectInfo& object : objects) {
    if (object.name == name) return;
  }
  const size_t index = objects.size();
  objects.push_back({name, TypeText<T>::k_doc, "", "", {}, {}});
  size_t variants = 1;
  for (size_t variant = 0; variant < variants; ++variant) {
    ObjectDescriber describer(objects, variant);
    T value = {};
    visit(describer, value);
    variants = describer.variant_count;
    ObjectInfo& object = objects[index];
    object.tag_key = describer.tag_key;
    object.tag_doc = describer.tag_doc;
    const auto end_of_common = describer.fields.begin() + static_cast<ptrdiff_t>(describer.common);
    object.common = {describer.fields.begin(), end_of_common};
    object.variants.push_back({describer.tag_value, {end_of_common, describer.fields.end()}});
  }
}

template <class T>
bool ObjectDescriber::add_typed(const SceneField& field, FieldKind kind) {
  add(field, kind, "");
  fields.back().type = TypeText<T>::k_name;
  describe<T>(objects_);
  return false;
}

}  // namespace

std::vector<ObjectInfo> describe_scene() {
  std::vector<ObjectInfo> objects;
  describe<SceneText>(objects);
  return objects;
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
