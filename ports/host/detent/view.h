#pragma once
#include <string>
#include <vector>

namespace detent_tool {

/// The page of a recording, of two to compare, or of scenes that go on live, to be written.
struct ViewRequest {
  std::vector<std::string> paths;  ///< one recording or two, or scenes
  std::string config;              ///< of the scenes
  std::string output;
  std::vector<std::string> asset_paths;
  bool json = false;
};

/// Writes a page that replays, verifies, draws and compares the recordings (docs/view.md), and prints what it has
/// written. A recording that is damaged after its header gets a page, too: the page names the tick. False on a problem,
/// which is printed.
bool write_view(const ViewRequest& request);

}  // namespace detent_tool
