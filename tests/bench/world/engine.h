#pragma once
#include <stdint.h>

#include <vector>

#include "tests/bench/heap.h"
#include "tests/campaigns/stress/stage.h"
#include "tests/common/support/stage_time.h"

/// What the benchmark of the whole step asks of an engine: this library in one configuration, or a peer. No type here
/// depends on one. A module has a heap of its own: what it makes it frees, and nothing else.
namespace detent_bench {

using detent_stress::BodyState;
using detent_stress::Role;
using detent_stress::Solid;
using detent_stress::Stage;
using detent_stress::StageBody;
using detent_stress::StageJoint;

/// How hard an engine tries. 0: as it does by default, a peer as it is recommended.
struct Effort {
  uint32_t substeps = 0;  ///< a peer has none: it makes so many steps of a part of the tick
  uint32_t iterations = 0;
  uint32_t penetration = 0;  ///< this library: WorldDef::resting_penetration is 1 / penetration

  bool is_default() const { return substeps == 0 && iterations == 0 && penetration == 0; }
};

/// A stage in an engine's own terms.
class WorldRun {
 public:
  virtual ~WorldRun() = default;
  /// One tick. Nothing else is timed.
  virtual void step() = 0;
  /// Of the last step.
  virtual uint32_t contact_points() const = 0;
  /// Contacts, values and whatever else was lost to a full pool since the start.
  virtual uint64_t losses() const = 0;
  /// One for each body of the stage, in its order.
  virtual void read(BodyState* states) const = 0;
  /// Of memory that the world takes now.
  virtual uint64_t bytes() const = 0;
  /// What tells these settings from others: this library's digest of them, a peer's in words.
  virtual const char* settings() const = 0;
  /// From here on stages() counts; that takes some clock readings a step.
  virtual void start_profile() {}
  virtual detent_test::StageTimes stages() const { return {}; }
};

struct WorldEngine {
  const char* engine;
  const char* config;
  /// Null where the engine cannot: `problem` is then one line that says why.
  WorldRun* (*make)(const Stage& stage, const Effort& effort, const char*& problem);
  HeapUse (*heap)();
};

using WorldEngineList = std::vector<WorldEngine>;

/// What a peer's module exports, under the name k_world_peer_symbol.
using AddWorldEngine = void (*)(const WorldEngine& engine, void* list);
using WorldPeerFunction = void (*)(AddWorldEngine add, void* list);
inline constexpr const char* k_world_peer_symbol = "detent_bench_world_peer";

}  // namespace detent_bench
