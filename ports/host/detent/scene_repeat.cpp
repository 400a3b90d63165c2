#include "scene_repeat.h"

#include <math.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

#include "scene_revolve.h"
#include "scene_words.h"

namespace detent_tool {

namespace {

constexpr size_t k_letters = 3;
constexpr const char* k_letter_names[k_letters] = {"i", "j", "k"};
constexpr Range k_counts = between(1, 4096);
constexpr uint32_t k_copies_max = 65536;
constexpr Range k_degrees = within(36000), k_axis = within(1e6);

using Index = std::array<uint32_t, k_letters>;

/// The repeat keys of an entry.
struct Repeat {
  bool given[k_letters] = {};
  Index counts = {1, 1, 1};
  bool stepped = false, turned = false;
  double step[k_letters][3] = {};
  SceneRevolution revolution[k_letters];

  uint64_t copies() const { return uint64_t{counts[0]} * counts[1] * counts[2]; }
  /// For example ", i=2, j=0".
  std::string text(const Index& index) const {
    std::string result;
    for (size_t i = 0; i < k_letters; ++i) {
      if (given[i])
        result += std::string(result.empty() ? "" : ", ") + k_letter_names[i] + "=" + std::to_string(index[i]);
    }
    return result;
  }
};

/// The size of a part of a scene.
struct Amount {
  uint64_t copies = 0;
  uint64_t values = 0;
  uint64_t bytes = 0;  ///< of texts and keys

  void add(const Node& node) {
    ++values;
    bytes += node.text.size();
    for (const std::string& key : node.keys) bytes += key.size();
    for (const Node& item : node.items) add(item);
  }
};

/// Reads one repeating entry and writes its copies; stops at the first problem.
class Writer {
 public:
  Writer(std::vector<Problem>& problems, const std::string& path, bool joints)
      : problems_(problems), path_(path), joints_(joints) {}

  bool read(Node& entry, Repeat& repeat) {
    const Node counts = take(entry, "repeat"), steps = take(entry, "step"), turns = take(entry, "revolve");
    if (!each_letter(counts, "repeat", [&](size_t letter, const Node& node, const std::string& path) {
          double count = 0;
          if (!number(node, path, k_counts, count)) return false;
          if (count != floor(count)) return fail(node, path, "is not a whole number");
          repeat.given[letter] = true;
          repeat.counts[letter] = static_cast<uint32_t>(count);
          return true;
        })) {
      return false;
    }
    if (counts.keys.empty()) return fail(counts, "repeat", "has no letter: i, j or k");
    if (repeat.copies() > k_copies_max) {
      return fail(counts, "repeat", "is more than " + std::to_string(k_copies_max) + " copies");
    }
    const auto is_repeated = [&](size_t letter, const Node& node, const std::string& path) {
      return repeat.given[letter] || fail(node, path, "has no count in `repeat`");
    };
    repeat.stepped = steps.kind != NodeKind::null;
    repeat.turned = turns.kind != NodeKind::null;
    return (!repeat.stepped || each_letter(steps, "step",
                                           [&](size_t letter, const Node& node, const std::string& path) {
                                             return is_repeated(letter, node, path) &&
                                                    vector(node, path, k_any, repeat.step[letter]);
                                           })) &&
           (!repeat.turned ||
            each_letter(turns, "revolve", [&](size_t letter, const Node& node, const std::string& path) {
              return is_repeated(letter, node, path) && read_turn(node, path, repeat.revolution[letter]);
            }));
  }

  bool copy(const Node& entry, const Repeat& repeat, const Index& index, Node& made) {
    made = entry;
    made.copy = repeat.text(index);
    if (!fill_templates(made, "", repeat, index)) return false;
    if (!repeat.stepped && !repeat.turned) return true;
    Node* placed = &made;
    for (const char* key : {"body", "joint"}) {  // for an action that creates one
      Node* const inner = member_of(made, key);
      if (inner != nullptr && inner->kind == NodeKind::object) placed = inner;
    }
    return place(*placed, repeat, index);
  }

 private:
  bool fail(const Node& node, const std::string& path, const std::string& text) {
    problems_.push_back({node.line, path_ + (path.empty() ? "" : "." + path), text});
    return false;
  }
  /// Takes the member out of the entry; returns a null node if it is missing.
  static Node take(Node& entry, const char* key) {
    Node* const node = member_of(entry, key);
    if (node == nullptr) return {};
    const auto index = node - entry.items.data();
    Node taken = std::move(*node);
    entry.items.erase(entry.items.begin() + index);
    entry.keys.erase(entry.keys.begin() + index);
    return taken;
  }
  template <class F>
  bool each_letter(const Node& node, const std::string& key, const F& visit) {
    if (node.kind != NodeKind::object) return fail(node, key, "is not an object");
    for (size_t i = 0; i < node.keys.size(); ++i) {
      const auto found = std::find(std::begin(k_letter_names), std::end(k_letter_names), node.keys[i]);
      const std::string path = key + "." + node.keys[i];
      if (found == std::end(k_letter_names)) return fail(node.items[i], path, "is unknown here; there are: i, j, k");
      if (!visit(static_cast<size_t>(found - k_letter_names), node.items[i], path)) return false;
    }
    return true;
  }
  bool number(const Node& node, const std::string& path, const Range& range, double& value) {
    if (node.kind != NodeKind::number) return fail(node, path, "is not a number");
    if (!(node.number >= range.low && node.number <= range.high)) {
      return fail(node, path, "is not in [" + plain(range.low) + ", " + plain(range.high) + "]");
    }
    value = node.number;
    return true;
  }
  bool vector(const Node& node, const std::string& path, const Range& range, double (&value)[3]) {
    if (node.kind != NodeKind::array || node.items.size() != 3) return fail(node, path, "is not a list of 3 numbers");
    for (size_t i = 0; i < 3; ++i) {
      if (!number(node.items[i], path + "[" + std::to_string(i) + "]", range, value[i])) return false;
    }
    return true;
  }
  bool read_turn(const Node& node, const std::string& path, SceneRevolution& revolution) {
    if (node.kind != NodeKind::object) return fail(node, path, "is not an object");
    for (size_t i = 0; i < node.keys.size(); ++i) {
      const std::string &key = node.keys[i], inner = path + "." + key;
      if (key != "axis" && key != "degrees" && key != "about") {
        return fail(node.items[i], inner, "is unknown here" + suggestion(key, {"axis", "degrees", "about"}));
      }
      if (!(key == "degrees" ? number(node.items[i], inner, k_degrees, revolution.degrees)
                             : vector(node.items[i], inner, key == "axis" ? k_axis : k_any,
                                      key == "axis" ? revolution.axis : revolution.about))) {
        return false;
      }
    }
    for (const char* key : {"axis", "degrees"}) {
      if (member_of(node, key) == nullptr) return fail(node, path + "." + key, "is missing");
    }
    const double(&a)[3] = revolution.axis;
    return a[0] * a[0] + a[1] * a[1] + a[2] * a[2] >= 1e-12 || fail(node, path + ".axis", "has no direction");
  }

  /// The number that a template stands for. `text`: the text between its braces.
  static std::optional<int64_t> value_of(const std::string& text, const Repeat& repeat, const Index& index) {
    const auto letter = std::find_if(std::begin(k_letter_names), std::end(k_letter_names),
                                     [&](const char* name) { return text.compare(0, 1, name) == 0; });
    if (letter == std::end(k_letter_names) || !repeat.given[letter - k_letter_names]) return std::nullopt;
    const int64_t value = index[static_cast<size_t>(letter - k_letter_names)];
    if (text.size() == 1) return value;
    uint32_t added = 0;
    const char* const end = text.data() + text.size();
    const auto [read, error] = std::from_chars(text.data() + std::min<size_t>(2, text.size()), end, added);
    if ((text[1] != '+' && text[1] != '-') || error != std::errc() || read != end) return std::nullopt;
    return text[1] == '+' ? value + added : value - int64_t{added};
  }
  bool fill_templates(Node& node, const std::string& path, const Repeat& repeat, const Index& index) {
    if (node.kind == NodeKind::text && node.text.find('{') != std::string::npos) {
      std::string filled;
      for (size_t at = 0; at < node.text.size();) {
        if (node.text[at] != '{') {
          filled += node.text[at++];
          continue;
        }
        const size_t end = node.text.find('}', at);
        const auto value =
            end == std::string::npos ? std::nullopt : value_of(node.text.substr(at + 1, end - at - 1), repeat, index);
        if (!value) {
          return fail(node, path, "\"" + node.text + "\": in braces is a letter of `repeat`, or one + or - a number");
        }
        filled += std::to_string(*value);
        at = end + 1;
      }
      node.text = filled;
    }
    for (size_t i = 0; i < node.items.size(); ++i) {
      std::string inner = path + "[" + std::to_string(i) + "]";
      if (node.kind == NodeKind::object) inner = (path.empty() ? "" : path + ".") + node.keys[i];
      if (!fill_templates(node.items[i], inner, repeat, index)) return false;
    }
    return true;
  }

  bool place(Node& entry, const Repeat& repeat, const Index& index) {
    Node* point = member_of(entry, "point");
    if (point == nullptr) point = member_of(entry, "position");
    if (point == nullptr && (joints_ || member_of(entry, "shape") == nullptr)) {
      return fail(entry, repeat.stepped ? "step" : "revolve", "moves nothing: there is no point or position");
    }
    if (point == nullptr) {  // a body without a position is at the origin
      entry.keys.push_back("position");
      Node& added = entry.items.emplace_back();
      added.kind = NodeKind::array;
      added.line = entry.line;
      added.items.resize(3);
      for (Node& item : added.items) {
        item.kind = NodeKind::number;
        item.line = entry.line;
      }
      point = &added;
    }
    if (is_numbers(*point, 3)) {  // otherwise the reader refuses it
      for (size_t i = 0; i < 3; ++i) {
        double& value = point->items[i].number;
        for (size_t letter = 0; letter < k_letters; ++letter) value += index[letter] * repeat.step[letter][i];
      }
    }
    for (size_t letter = 0; letter < k_letters; ++letter) {
      SceneRevolution revolution = repeat.revolution[letter];
      revolution.degrees *= index[letter];
      revolve_entry(entry, revolution);
    }
    return true;
  }
  static std::string plain(double value) {
    char text[32];
    snprintf(text, sizeof text, "%.6g", value);
    return text;
  }

  std::vector<Problem>& problems_;
  std::string path_;
  bool joints_;
};

/// Appends the copies of a repeating entry.
void write_out(const std::string& list, uint32_t number, Node& entry, Amount& taken, std::vector<Node>& written,
               std::vector<Problem>& problems) {
  const std::string path = list + "[" + std::to_string(number) + "]";
  const uint32_t line = entry.line;
  Writer writer(problems, path, list == "joints");
  Repeat repeat;
  if (!writer.read(entry, repeat)) return;
  Amount more;
  more.add(entry);
  taken.copies += repeat.copies();
  taken.values += more.values * repeat.copies();
  taken.bytes += more.bytes * repeat.copies();
  const std::string most = taken.copies > k_copies_max        ? std::to_string(k_copies_max) + " copies"
                           : taken.values > k_json_values_max ? std::to_string(k_json_values_max) + " values"
                           : taken.bytes > k_json_bytes_max   ? std::to_string(k_json_bytes_max) + " bytes of text"
                                                              : "";
  if (!most.empty()) {
    problems.push_back({line, path + ".repeat", "the scene would have more than " + most});
    return;
  }
  const Index& counts = repeat.counts;
  for (uint32_t i = 0; i < counts[0]; ++i) {
    for (uint32_t j = 0; j < counts[1]; ++j) {
      for (uint32_t k = 0; k < counts[2]; ++k) {
        Node& made = written.emplace_back();
        if (!writer.copy(entry, repeat, {i, j, k}, made)) {
          written.pop_back();
          return;
        }
        made.entry = number;
      }
    }
  }
}

void write_out_list(Node& list, const std::string& name, Amount& taken, std::vector<Problem>& problems) {
  const auto repeats = [](const Node& entry) { return member_of(entry, "repeat") != nullptr; };
  const bool any = std::any_of(list.items.begin(), list.items.end(), repeats);
  std::vector<Node> written;
  for (uint32_t number = 0; number < list.items.size(); ++number) {
    Node& entry = list.items[number];
    entry.entry = number;
    if (!any || problems.size() >= k_problems_max) continue;
    if (repeats(entry)) {
      write_out(name, number, entry, taken, written, problems);
    } else {
      written.push_back(std::move(entry));
    }
  }
  if (any) list.items = std::move(written);
}

FieldInfo field(const char* key, const char* doc, FieldKind kind, const Range& range = k_any) {
  return {key, doc, range, false, kind, "", {}, ""};
}
FieldInfo object_field(const char* key, const char* doc, const char* type) {
  FieldInfo info = field(key, doc, FieldKind::object);
  info.type = type;
  return info;
}
FieldInfo needed(FieldInfo info) {
  info.required = true;
  return info;
}

/// An object with one field for each letter.
ObjectInfo lettered(const char* name, const char* doc, const FieldInfo& value) {
  ObjectInfo object = {name, doc, "", "", {}, {{"", {}}}};
  const char* const docs[k_letters] = {"the outermost", "the next", "the innermost, which counts fastest"};
  for (size_t i = 0; i < k_letters; ++i) {
    FieldInfo info = value;
    info.key = k_letter_names[i];
    info.doc = docs[i];
    object.variants.front().fields.push_back(info);
  }
  return object;
}

}  // namespace

void write_out_repeats(Node& scene, std::vector<Problem>& problems) {
  Amount taken;
  taken.add(scene);
  for (const char* name : {"bodies", "joints", "actions"}) {
    Node* const list = member_of(scene, name);
    if (list != nullptr && list->kind == NodeKind::array) write_out_list(*list, name, taken, problems);
  }
}

std::vector<FieldInfo> repeat_fields() {
  return {object_field("repeat", "number of copies of the entry, see Repeats", "repeat"),
          object_field("step", "with `repeat`: from copy to copy", "step"),
          object_field("revolve", "with `repeat`: a rotation, applied after the steps", "revolve")};
}

std::vector<ObjectInfo> repeat_objects() {
  ObjectInfo revolution = {"revolution", "A rotation from copy to copy, about a line in the world.", "", "", {},
                           {{"", {}}}};
  revolution.variants.front().fields = {
      needed(field("axis", "of any length; right-handed", FieldKind::vector, k_axis)),
      needed(field("degrees", "from one copy to the next", FieldKind::number, k_degrees)),
      field("about", "a point of the line, m, world", FieldKind::vector)};
  revolution.variants.front().fields.back().initial = "[0, 0, 0]";
  return {
      lettered("repeat", "The number of copies of an entry for each letter; at least one letter is needed.",
               field("", "", FieldKind::integer, k_counts)),
      lettered("step", "The displacement of a copy from the one before, m, world.", field("", "", FieldKind::vector)),
      lettered("revolve", "How a copy is rotated from the one before.", object_field("", "", "revolution")),
      revolution};
}

}  // namespace detent_tool
