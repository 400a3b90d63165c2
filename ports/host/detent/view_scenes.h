#pragma once
#include "view.h"

namespace detent_tool {

/// Plays the scene files, and writes a page in which each of them goes on live. Sets `ticks` to the number of
/// ticks of all scenes together. Returns false on a problem.
bool write_scenes(const ViewRequest& request, uint64_t& ticks, std::string& problem);

}  // namespace detent_tool
