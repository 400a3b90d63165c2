#pragma once
#include <optional>

#include "engine.h"

/// Recordings of other simulation versions are verified by the tools of other releases.
namespace detent_tool {

/// The versions, which every format version stores in its first bytes.
struct Versions {
  uint32_t format = 0;
  uint32_t simulation = 0;
};
/// Empty if the file is no recording or cannot be read.
std::optional<Versions> versions_of(const std::string& path);

/// The path of `detent-<simulation version>`, beside this program or on the PATH; empty if there is none.
std::string find_release(uint32_t simulation_version);

/// Runs `release verify --json` and returns its result. That release does not search for a further one.
Outcome verify_by_release(const std::string& release, const std::vector<std::string>& asset_paths,
                          const ReadRequest& request);
/// Whether another release started this program.
bool called_by_another_release();

}  // namespace detent_tool
