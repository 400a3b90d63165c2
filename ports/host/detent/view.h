#pragma once
#include <string>
#include <vector>

namespace detent_tool {

/// The page of a recording, to be written.
struct ViewRequest {
  std::string path;
  std::string output;
  std::vector<std::string> asset_paths;
  bool json = false;
};

/// Writes a page that replays, verifies and draws the recording (docs/view.md), and prints what it has written. A
/// recording that is damaged after its header gets a page, too: the page names the tick. False on a problem, which is
/// printed.
bool write_view(const ViewRequest& request);

}  // namespace detent_tool
