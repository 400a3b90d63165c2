#pragma once
#include "cook.h"

/// The tool's commands on hulls.
namespace detent_tool {

struct CookRequest {
  std::string input;
  std::string output;
  uint32_t index = 0;  ///< of the cloud, in a file of many
  detent_cook::CookOptions options;
};

/// Reads the points, cooks them, writes the .hull and says what it is. False if any of that failed; nothing is then
/// written but a line to standard error.
bool cook_file(const CookRequest& request, bool json);

/// Whether the file begins as a .hull does.
bool is_hull_file(const std::string& path);
/// Says what the .hull holds. False if the library refuses it.
bool describe_hull_file(const std::string& path, bool json);

}  // namespace detent_tool
