#pragma once
#include <string>

namespace detent_bench {

/// Writes the JSON to `name` in the folder, which it makes, and draws it there by plot.py. False if that failed.
bool draw(const std::string& folder, const std::string& name, const std::string& json);

}  // namespace detent_bench
