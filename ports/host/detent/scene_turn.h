#pragma once
#include "scene_json.h"

/// Turns of what a scene says in doubles. Sums, products, quotients and roots alone: the same on every machine.
namespace detent_tool {

/// About a line through `about` along `axis`, of any length but 0, by the right hand.
struct SceneTurn {
  double about[3] = {0, 0, 0};
  double axis[3] = {0, 0, 0};
  double degrees = 0;
};

/// Turns what an entry has of `position`, `point`, `rotation`, `frame`, `velocity`, `spin`. A `point` without a frame
/// gets one, a `position` a rotation. What has not the form of such a value is left for the reader to refuse.
void turn_entry(Node& entry, const SceneTurn& turn);

/// The member of that name, or null.
Node* member_of(Node& object, const char* key);
const Node* member_of(const Node& object, const char* key);
/// Whether it is a list of that many numbers.
bool is_numbers(const Node& node, size_t count);

}  // namespace detent_tool
