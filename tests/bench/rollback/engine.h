#pragma once
#include <stdint.h>

#include <vector>

#include "tests/bench/clock.h"

/// What the benchmark of rollback asks of a configuration.
namespace detent_bench {

struct RollbackRow {
  const char* config = "";
  uint32_t bodies = 0;          ///< that move
  uint32_t contacts = 0;        ///< at the end
  uint32_t bytes = 0;           ///< kept of a tick: what is in use
  uint32_t snapshot_bytes = 0;  ///< of a whole snapshot, of the capacity
  uint32_t delta_bytes = 0;     ///< of a snapshot against that of the tick before; the mean
  // us; medians.
  double step = 0, save = 0, restore = 0, resim8 = 0;
  double whole_save = 0, whole_restore = 0, save_delta = 0, restore_delta = 0, digest = 0;
  uint64_t allocations = 0;  ///< in all that was timed
  bool exact = true;         ///< whether every state that was made again, restored or copied was the same
};

struct RollbackEngine {
  const char* config;
  /// The pit with so many bodies, settled; null in `problem` unless it cannot be made.
  RollbackRow (*measure)(uint32_t bodies, uint32_t repetitions, const Clock& clock, const char*& problem);
};
using RollbackEngineList = std::vector<RollbackEngine>;

/// Every configuration of this build.
RollbackEngineList all_rollback_engines();

}  // namespace detent_bench
