#pragma once
#include <optional>

#include "engine.h"

/// Finds and runs the tools of other releases, which verify recordings of other simulation versions.
namespace detent_tool {

/// The versions in the header of a recording. Every format stores them at the same place in its first bytes.
struct Versions {
  uint32_t format = 0;
  uint32_t simulation = 0;
};
/// The versions of a recording. Empty if the file is no recording or cannot be read.
std::optional<Versions> versions_of(const std::string& path);

/// The path of `detent-<simulation version>`, beside this program or on the PATH; empty if there is none.
std::string find_release(uint32_t simulation_version);

/// Runs `release verify --json` and returns its result. A tool that runs in this way does not search for further tools.
Outcome verify_by_release(const std::string& release, const std::vector<std::string>& asset_paths,
                          const ReadRequest& request);
/// Whether another release started this program.
bool called_by_another_release();

}  // namespace detent_tool
