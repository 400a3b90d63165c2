#pragma once
#include <stddef.h>
#include <stdint.h>

#include <string>
#include <string_view>
#include <vector>

/// JSON whose values know their line numbers in the file.
namespace detent_tool {

/// A problem with a scene, and its place.
struct Problem {
  uint32_t line = 0;  ///< from 1 on; 0: the file as a whole
  std::string path;   ///< for example bodies[3].shape.radius; empty: the whole scene
  std::string text;
};
inline constexpr size_t k_problems_max = 20;  // reported problems of a scene
/// "scene.json:14: bodies[3].shape.radius: 0 is not above 0"
std::string problem_text(const std::string& file, const Problem& problem);

enum class NodeKind : uint32_t { null, boolean, number, text, array, object };

/// A JSON value. In an object, `items[i]` has the name `keys[i]`; each name occurs once.
struct Node {
  NodeKind kind = NodeKind::null;
  uint32_t line = 0;
  bool boolean = false;
  double number = 0;  ///< the double nearest to the text, on every machine
  std::string text;
  std::vector<std::string> keys;
  std::vector<Node> items;
  /// If a repeat created this item (scene_repeat.h): the index, in the list of the file, of the entry that repeats.
  uint32_t entry = 0;
  /// The indices of the copy, such as "i=2, j=0"; empty: the entry does not repeat.
  std::string copy;
};

// Limits of a scene, so that the tool refuses a hostile file before the file uses up the memory.
inline constexpr size_t k_json_bytes_max = size_t{1} << 25;
inline constexpr uint32_t k_json_values_max = 1u << 20;
inline constexpr uint32_t k_json_depth_max = 16;

/// Parses the text. Returns false, with the first problem, if the text is no JSON, repeats a name in one object, or
/// exceeds the limits.
bool parse_json(std::string_view text, Node& root, Problem& problem);

}  // namespace detent_tool
