#pragma once
#include "scene_json.h"

/// Rotates values of a scene. Computes with sums, products, quotients and roots of doubles only, so the results are the
/// same on every machine.
namespace detent_tool {

/// A right-handed rotation about the line through `about` along `axis`. The length of `axis` may be any but 0.
struct SceneRevolution {
  double about[3] = {0, 0, 0};
  double axis[3] = {0, 0, 0};
  double degrees = 0;
};

/// Rotates an entry's `position`, `point`, `rotation`, `frame`, `linear_velocity` and `angular_velocity`, if
/// present. A `point` without a frame gets one, and a `position` without a rotation gets one. Malformed values stay
/// unchanged; the reader refuses them later.
void revolve_entry(Node& entry, const SceneRevolution& revolution);

/// The member of that name, or null.
Node* member_of(Node& object, const char* key);
const Node* member_of(const Node& object, const char* key);
/// Whether the node is a list of `count` numbers.
bool is_numbers(const Node& node, size_t count);

}  // namespace detent_tool
