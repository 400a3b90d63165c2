#pragma once
#include <string>

#include "engine.h"

/// What the tool says about a file: one line for a reader, or one JSON object on one line. Good news and JSON go to
/// standard output, problems to standard error.
namespace detent_tool {

struct Report {
  bool json = false;

  void recorded(const RecordRequest& request, const Outcome& outcome) const;
  void verified(const std::string& path, const Outcome& outcome) const;
  void described(const std::string& path, const Outcome& outcome) const;
  void scene(const SceneLine& line) const;
};

}  // namespace detent_tool
