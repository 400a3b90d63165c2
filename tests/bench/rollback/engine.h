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

/// Sparse rollback and rollback of all bodies. In arrays of two, the sparse one comes first.
struct SparseRow {
  const char* config = "";
  const char* scene = "";
  double bodies = 0;                ///< simulated in a tick that is made again
  double whole = 0;                 ///< fraction of these ticks in which all bodies are simulated
  double again[2] = {};             ///< us, of going back eight ticks and making them again; medians
  double forward[2] = {};           ///< us, of making a new tick
  uint32_t bytes_per_tick[2] = {};  ///< of the session's memory
  uint64_t allocations = 0;
  bool exact = true;
};

struct RollbackEngine {
  const char* config;
  /// The pit with so many bodies, settled; null in `problem` unless it cannot be made.
  RollbackRow (*measure)(uint32_t bodies, uint32_t repetitions, const Clock& clock, const char*& problem);
  SparseRow (*measure_sparse)(bool apart, uint32_t repetitions, const Clock& clock);
};
using RollbackEngineList = std::vector<RollbackEngine>;

/// Every configuration of this build.
RollbackEngineList all_rollback_engines();

}  // namespace detent_bench
