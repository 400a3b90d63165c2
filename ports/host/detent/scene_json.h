#pragma once
#include <stddef.h>
#include <stdint.h>

#include <string>
#include <string_view>
#include <vector>

/// JSON whose every value knows its line.
namespace detent_tool {

/// What is wrong with a scene, and where.
struct Problem {
  uint32_t line = 0;  ///< from 1 on; 0: of the file as a whole
  std::string path;   ///< bodies[3].shape.radius; empty: the whole
  std::string text;
};
inline constexpr size_t k_problems_max = 20;  // of a scene that are told at once
/// "scene.json:14: bodies[3].shape.radius: 0 is not above 0"
std::string problem_text(const std::string& file, const Problem& problem);

enum class NodeKind : uint32_t { null, boolean, number, text, array, object };

/// A value. Of an object `items[i]` has the name `keys[i]`; no name is there twice.
struct Node {
  NodeKind kind = NodeKind::null;
  uint32_t line = 0;
  bool boolean = false;
  double number = 0;  ///< the nearest to what is written, on every machine
  std::string text;
  std::vector<std::string> keys;
  std::vector<Node> items;
  uint32_t entry = 0;  ///< of a list's item that was written out (scene_repeat.h): its place in the file
  std::string copy;    ///< and which of its copies: "i=2, j=0"; empty: it does not repeat
};

// What a scene may take, so that a hostile one is refused before it takes all memory.
inline constexpr size_t k_json_bytes_max = size_t{1} << 25;
inline constexpr uint32_t k_json_values_max = 1u << 20;
inline constexpr uint32_t k_json_depth_max = 16;

/// False, and what is wrong first, if the text is no JSON, has a name twice in one object, or goes beyond the limits.
bool parse_json(std::string_view text, Node& root, Problem& problem);

}  // namespace detent_tool
