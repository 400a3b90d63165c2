#pragma once
#include <functional>

#include "tests/bench/engine.h"

/// Runs the engines on the queries and takes the times.
namespace detent_bench {

/// What one engine made of one query.
struct Measured {
  bool asked = false;  ///< the engine has an answer to this query
  Answer answer;
  double ns = 0;  ///< the least of all repetitions, less the clock's own time
};

/// The query with its positions on the engine's grid.
detent_queries::Query seen_by(const Engine& engine, const detent_queries::Query& query);

using Progress = std::function<void(size_t done, size_t total)>;

/// [engine][query]. Query by query all engines take turns, in an order that rotates. Just before each run that is timed
/// comes one that is not, for an engine's time must not depend on which other, perhaps of the same code, came before
/// it.
std::vector<std::vector<Measured>> measure(const EngineList& engines, const std::vector<detent_queries::Query>& queries,
                                           uint32_t repetitions, const Progress& progress);

}  // namespace detent_bench
