#pragma once
#include <vector>

#include "scene_format.h"
#include "scene_json.h"

/// Entries of a scene's lists that stand for many: `repeat`, `step`, `revolve` and templates of names.
namespace detent_tool {

/// Puts the copies of each entry of `bodies`, `joints`, `actions` with `repeat` in its place, as if they had been
/// written out: what reads the scene sees them alone, and their line and entry. What is wrong is added to `problems`,
/// and its entry is left out.
void write_out_repeats(Node& scene, std::vector<Problem>& problems);

/// The keys of an entry that repeats, and their objects, for the schema and the tables.
std::vector<FieldInfo> repeat_fields();
std::vector<ObjectInfo> repeat_objects();

}  // namespace detent_tool
