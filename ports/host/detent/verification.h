#pragma once
#include "report.h"

/// Verifies many recordings on many cores.
namespace detent_tool {

struct VerificationRequest {
  std::vector<std::string> paths = {};  ///< recordings, and folders of them
  std::string list = {};                ///< a file with one path a line; "-": standard input; empty: none
  std::string log = {};                 ///< the JSON lines of an earlier run; files in it are skipped
  std::vector<std::string> asset_paths = {};
  ReadRequest reading = {};  ///< `path` is not used
  uint32_t jobs = 1;
};

enum class Verification : uint32_t {
  good,
  bad,      ///< a recording failed, now or in the log, or something could not be read
  nothing,  ///< there was no recording to verify
};
/// Verifies the recordings. Reports each file as soon as it is done, and then the sums over all files.
Verification verify_all(VerificationRequest request, const Report& report);

/// Calls `read` with the engine of the configuration in the header, or with the first engine if no engine has that
/// configuration.
template <class Read>
Outcome by_its_engine(const Read& read) {
  Outcome outcome;
  for (const Engine& engine : engines()) {
    outcome = read(engine);
    if (!outcome.other_config) return outcome;
  }
  return outcome;
}

}  // namespace detent_tool
