#pragma once
#include <vector>

#include "scene_format.h"
#include "scene_json.h"

/// Entries of a scene's lists that stand for many copies. Their keys are `repeat`, `step` and `revolve`, and their
/// names are templates.
namespace detent_tool {

/// Replaces each entry of `bodies`, `joints` and `actions` that has `repeat` by its copies, as if the file contained
/// the copies. The scene's readers see only the copies, with the line and the index of the entry. Adds problems to
/// `problems`, and leaves out the entries that have them.
void write_out_repeats(Node& scene, std::vector<Problem>& problems);

/// The keys of a repeating entry, and their objects, for the schema and the tables.
std::vector<FieldInfo> repeat_fields();
std::vector<ObjectInfo> repeat_objects();

}  // namespace detent_tool
