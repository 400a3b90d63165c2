#pragma once
#include <string>
#include <vector>

namespace detent_tool {

/// ", did you mean "radius"?": the nearest of the names, if one is near; or what there is, if that is little.
std::string suggestion(const std::string& word, const std::vector<std::string>& names);

}  // namespace detent_tool
