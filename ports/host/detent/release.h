#pragma once
#include <optional>

#include "engine.h"

/// Recordings of other simulation versions are for the tools of other releases.
namespace detent_tool {

/// What every format version has in its first bytes.
struct Versions {
  uint32_t format = 0;
  uint32_t simulation = 0;
};
/// Nothing if the file is no recording, or cannot be read.
std::optional<Versions> versions_of(const std::string& path);

/// The path of `detent-<simulation version>`, beside this program or on the PATH; empty if there is none.
std::string find_release(uint32_t simulation_version);

/// `release verify --json`, and what it says. The release is not asked to look for a further one.
Outcome verify_by_release(const std::string& release, const std::vector<std::string>& asset_paths,
                          const ReadRequest& request);
/// Whether this program was called so.
bool called_by_another_release();

}  // namespace detent_tool
