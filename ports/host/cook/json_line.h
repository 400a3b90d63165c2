#pragma once
#include <stdio.h>

#include <nlohmann/json.hpp>

namespace detent_tool {

/// Prints a line. Strings need not be valid UTF-8, because a path need not be: invalid bytes are replaced.
inline void print_json_line(const nlohmann::ordered_json& json) {
  printf("%s\n", json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace).c_str());
}

}  // namespace detent_tool
