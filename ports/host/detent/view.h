#pragma once
#include <string>
#include <vector>

namespace detent_tool {

/// A request for a page. The page shows one recording, or two recordings to compare, or scenes that go on live.
struct ViewRequest {
  std::vector<std::string> paths;  ///< one recording or two, or scenes
  std::string config;              ///< of the scenes
  std::string output;
  std::vector<std::string> asset_paths;
  bool json = false;
};

/// Writes a page that replays, verifies, draws and compares the recordings (docs/view.md), and prints what was written.
/// A recording that is damaged after its header gets a page, too; the page names the tick of the damage. Returns false
/// on a problem, and prints it.
bool write_view(const ViewRequest& request);

}  // namespace detent_tool
