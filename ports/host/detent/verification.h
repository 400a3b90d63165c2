#pragma once
#include "report.h"

/// Many recordings, on many cores.
namespace detent_tool {

struct VerificationRequest {
  std::vector<std::string> paths = {};  ///< recordings, and folders of them
  std::string list = {};                ///< a file with a path a line; "-": standard input; empty: none
  std::string log = {};                 ///< the JSON lines of an earlier run: what it names is passed over
  std::vector<std::string> asset_paths = {};
  ReadRequest reading = {};  ///< but for the path
  uint32_t jobs = 1;
};

enum class Verification : uint32_t {
  good,
  bad,      ///< a recording failed, now or in the log, or something could not be read
  nothing,  ///< there was no recording to verify
};
/// Reports each file as soon as it is done, and the sum of all.
Verification verify_all(VerificationRequest request, const Report& report);

/// By the engine whose configuration the header names; by the first that can say anything if none holds it.
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
