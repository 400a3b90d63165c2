#include "tests/bench/measure.h"

#include <math.h>

#include <algorithm>

#include "tests/bench/timer.h"

namespace detent_bench {

using detent_queries::Query;

namespace {

struct Clock {
  double ns_per_tick = 1;
  uint64_t overhead = 0;  ///< ticks, of a measurement of nothing
};

class Nothing : public Prepared {
 public:
  void run(Answer& answer) override { answer = {}; }
};

uint64_t time_of(Prepared& prepared, Answer& answer) {
  const uint64_t start = ticks();
  prepared.run(answer);
  return ticks() - start;
}

Clock calibrated_clock() {
  constexpr uint64_t k_span = 50000000;  // ns
  Clock clock;
  const uint64_t start_ns = monotonic_ns(), start = ticks();
  while (monotonic_ns() - start_ns < k_span) {
  }
  clock.ns_per_tick = static_cast<double>(monotonic_ns() - start_ns) / static_cast<double>(ticks() - start);
  clock.overhead = UINT64_MAX;
  const std::unique_ptr<Prepared> nothing = std::make_unique<Nothing>();
  Answer answer;
  for (int i = 0; i < 10000; ++i) clock.overhead = std::min(clock.overhead, time_of(*nothing, answer));
  return clock;
}

}  // namespace

Query seen_by(const Engine& engine, const Query& query) {
  Query seen = query;
  if (engine.position_step == 0) return seen;
  for (detent_queries::Path* path : {&seen.path_a, &seen.path_b}) {
    for (double& coordinate : path->position)
      coordinate = round(coordinate / engine.position_step) * engine.position_step;
  }
  return seen;
}

std::vector<std::vector<Measured>> measure(const EngineList& engines, const std::vector<Query>& queries,
                                           uint32_t repetitions, const Progress& progress) {
  const Clock clock = calibrated_clock();
  const size_t count = engines.size();
  std::vector<std::vector<Measured>> all(count, std::vector<Measured>(queries.size()));
  std::vector<std::unique_ptr<Prepared>> prepared(count);
  std::vector<uint64_t> least(count);
  for (size_t q = 0; q < queries.size(); ++q) {
    for (size_t e = 0; e < count; ++e) {
      prepared[e] = engines[e].prepare(seen_by(engines[e], queries[q]));
      least[e] = UINT64_MAX;
    }
    for (uint32_t repetition = 0; repetition < repetitions; ++repetition) {
      for (size_t i = 0; i < count; ++i) {
        const size_t e = (i + q + repetition) % count;
        if (prepared[e] == nullptr) continue;
        prepared[e]->run(all[e][q].answer);
        least[e] = std::min(least[e], time_of(*prepared[e], all[e][q].answer));
      }
    }
    for (size_t e = 0; e < count; ++e) {
      if (prepared[e] == nullptr) continue;
      all[e][q].asked = true;
      all[e][q].ns = static_cast<double>(least[e] - std::min(least[e], clock.overhead)) * clock.ns_per_tick;
    }
    progress(q + 1, queries.size());
  }
  return all;
}

}  // namespace detent_bench
