#pragma once
#include <stdint.h>

#include <memory>
#include <vector>

#include "tests/common/queries/query.h"

/// What the benchmark asks of an engine: this library in one configuration, or a peer. No type here depends on one.
namespace detent_bench {

enum class Task { toi, distance };

enum class Outcome : uint32_t { clear, hit, undecided };

struct Answer {
  Outcome outcome = Outcome::clear;  ///< distance: hit if they overlap
  double time = 0;                   ///< of a hit
  double distance = 0;               ///< m
  uint32_t gjk_calls = 0;            ///< distance: support points asked for; 0 if the engine does not say
};

/// A query in an engine's own terms. All that could be kept with the bodies from step to step is done beforehand.
class Prepared {
 public:
  virtual ~Prepared() = default;
  virtual void run(Answer& answer) = 0;
};

struct Engine {
  Task task;
  const char* method;
  const char* config;
  double position_step;  ///< m; the positions it is asked about are rounded to this grid beforehand; 0: as they are
  double slack;          ///< m; what its positions' rounding may add to an error
  /// Null where the engine has no answer: a shape it does not know, a turn where it only casts, or out of its range.
  std::unique_ptr<Prepared> (*prepare)(const detent_queries::Query& query);
};

using EngineList = std::vector<Engine>;

/// What the module of a peer exports, under the name k_peer_symbol: it calls `add` for each of its engines. A module
/// has a heap of its own: what it makes, it frees.
using AddEngine = void (*)(const Engine& engine, void* list);
using PeerFunction = void (*)(AddEngine add, void* list);
inline constexpr const char* k_peer_symbol = "detent_bench_peer";

}  // namespace detent_bench
