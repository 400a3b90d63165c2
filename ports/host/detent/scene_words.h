#pragma once
#include <string>
#include <vector>

namespace detent_tool {

/// A suggestion for a misspelt word. If one of the names is near, for example: ", did you mean "radius"?". Otherwise a
/// list of all names, if there are few.
std::string suggestion(const std::string& word, const std::vector<std::string>& names);

}  // namespace detent_tool
