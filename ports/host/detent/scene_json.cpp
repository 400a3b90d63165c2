#include "scene_json.h"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <nlohmann/json.hpp>

#include "text.h"

namespace detent_tool {

namespace {

using Json = nlohmann::json;

/// The parser's position in the text.
class Place {
 public:
  explicit Place(const char* begin) : read_(begin), counted_(begin) {}
  void read_one(const char* character) { read_ = character + 1; }
  /// The line of the last character read. The parser reads one character beyond a number, so a line end counts to the
  /// line that it ends.
  uint32_t line() {
    const char* const last = read_ == counted_ ? read_ : read_ - 1;
    line_ += static_cast<uint32_t>(std::count(counted_, last, '\n'));
    counted_ = last;
    return line_;
  }

 private:
  const char* read_;
  const char* counted_;
  uint32_t line_ = 1;
};

/// An iterator over the text that reports its position.
struct Reading {
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  const char* at;
  Place* place;
  const char& operator*() const { return *at; }
  Reading& operator++() {
    place->read_one(at);
    ++at;
    return *this;
  }
  bool operator==(const Reading& other) const { return at == other.at; }
  bool operator!=(const Reading& other) const { return at != other.at; }
};

/// Makes nodes of the parser's events. An event that returns false ends the parse.
class Builder {
 public:
  Builder(Place& place, Node& root, Problem& problem) : place_(place), root_(root), problem_(problem) {}

  bool null() { return add(NodeKind::null) != nullptr; }
  bool boolean(bool value) {
    Node* const node = add(NodeKind::boolean);
    if (node != nullptr) node->boolean = value;
    return node != nullptr;
  }
  bool number_integer(int64_t value) { return number(static_cast<double>(value)); }
  bool number_unsigned(uint64_t value) { return number(static_cast<double>(value)); }
  /// Converts the text of the number, because the result of the C library's conversion depends on the machine.
  bool number_float(double, const std::string& text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc::result_out_of_range) value = 0;  // too small; values that are too large were refused before
    return number(value);
  }
  bool string(std::string& text) {
    Node* const node = add(NodeKind::text);
    if (node != nullptr) node->text = text;
    return node != nullptr;
  }
  bool binary(Json::binary_t&) { return false; }
  bool start_object(size_t) { return open(NodeKind::object); }
  bool key(std::string& name) {
    open_.back()->keys.push_back(name);
    key_line_ = place_.line();
    return true;
  }
  bool end_object() {
    const Node& node = *open_.back();
    std::vector<uint32_t> order(node.keys.size());
    for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&node](uint32_t a, uint32_t b) {
      const int names = node.keys[a].compare(node.keys[b]);
      return names < 0 || (names == 0 && a < b);
    });
    for (size_t i = 1; i < order.size(); ++i) {
      const std::string& name = node.keys[order[i]];
      if (name != node.keys[order[i - 1]]) continue;
      return fail(node.items[order[i]].line,
                  "\"" + name + "\" is here twice, first in line " + std::to_string(node.items[order[i - 1]].line));
    }
    open_.pop_back();
    return true;
  }
  bool start_array(size_t) { return open(NodeKind::array); }
  bool end_array() {
    open_.pop_back();
    return true;
  }
  bool parse_error(size_t, const std::string&, const Json::exception& error) {
    const std::string text = error.what();
    const size_t plain = text.find("syntax error");
    const size_t code = text.find("] ");
    return fail(place_.line(), plain != std::string::npos  ? text.substr(plain)
                               : code != std::string::npos ? text.substr(code + 2)
                                                           : text);
  }

 private:
  bool fail(uint32_t line, const std::string& text) {
    problem_ = {line, "", text};
    return false;
  }
  bool number(double value) {
    Node* const node = add(NodeKind::number);
    if (node != nullptr) node->number = value;
    return node != nullptr;
  }
  Node* add(NodeKind kind) {
    const uint32_t line = place_.line();
    if (++values_ > k_json_values_max) {
      fail(line, "more than " + std::to_string(k_json_values_max) + " values");
      return nullptr;
    }
    Node* const node = open_.empty() ? &root_ : &open_.back()->items.emplace_back();
    node->kind = kind;
    node->line = line;
    return node;
  }
  bool open(NodeKind kind) {
    // An object gets the line of its name, because people look for the object there.
    if (open_.size() == k_json_depth_max) {
      return fail(place_.line(), "nested deeper than " + std::to_string(k_json_depth_max));
    }
    Node* const node = add(kind);
    if (node == nullptr) return false;
    if (!open_.empty() && open_.back()->kind == NodeKind::object) node->line = key_line_;
    open_.push_back(node);
    return true;
  }

  Place& place_;
  Node& root_;
  Problem& problem_;
  std::vector<Node*> open_;  ///< the pointers stay valid: a parent takes no child while one is open
  uint32_t key_line_ = 0;
  uint32_t values_ = 0;
};

}  // namespace

std::string problem_text(const std::string& file, const Problem& problem) {
  std::string text = file;
  if (problem.line != 0) text += ":" + std::to_string(problem.line);
  if (!problem.path.empty()) text += ": " + problem.path;
  text += ": " + problem.text;
  text = printable(text);
  constexpr size_t k_length_max = 1000;
  return text.size() <= k_length_max ? text : text.substr(0, k_length_max) + "...";
}

bool parse_json(std::string_view text, Node& root, Problem& problem) {
  if (text.size() > k_json_bytes_max) {
    problem = {0, "", "more than " + std::to_string(k_json_bytes_max) + " bytes"};
    return false;
  }
  Place place(text.data());
  Builder builder(place, root, problem);
  return Json::sax_parse(Reading{text.data(), &place}, Reading{text.data() + text.size(), &place}, &builder);
}

}  // namespace detent_tool
