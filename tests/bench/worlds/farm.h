#pragma once
#include <string>

#include "tests/bench/worlds/engine.h"

/// The tool as a replay farm: `detent verify` of a folder of recordings.
namespace detent_bench {

/// Whether this build has the tool.
bool has_tool();

/// Recordings in a folder, which is removed in the end.
class Farm {
 public:
  explicit Farm(const Recordings& recordings);
  ~Farm();
  Farm(const Farm&) = delete;
  Farm& operator=(const Farm&) = delete;

  /// Verifies the folder by the tool of this build. False if a tick differs, or the folder cannot be written.
  bool verify(uint32_t jobs, WorldsVerification& result) const;

 private:
  std::string path_;
  double count_;
};

}  // namespace detent_bench
