#pragma once
#include <vector>

#include "scene_format.h"
#include "scene_json.h"

/// Entries of a scene's lists that stand for many copies: `repeat`, `step`, `revolve` and templates of names.
namespace detent_tool {

/// Replaces each entry of `bodies`, `joints` and `actions` that has `repeat` by its copies, as if they had been written
/// out. The scene's readers see only the copies, with the entry's line and index. Problems are added to `problems`, and
/// their entries are left out.
void write_out_repeats(Node& scene, std::vector<Problem>& problems);

/// The keys of a repeating entry, and their objects, for the schema and the tables.
std::vector<FieldInfo> repeat_fields();
std::vector<ObjectInfo> repeat_objects();

}  // namespace detent_tool
