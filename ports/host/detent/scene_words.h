#pragma once
#include <string>
#include <vector>

namespace detent_tool {

/// The nearest of the names, if one is near: ", did you mean "radius"?"; otherwise all names if there are few.
std::string suggestion(const std::string& word, const std::vector<std::string>& names);

}  // namespace detent_tool
