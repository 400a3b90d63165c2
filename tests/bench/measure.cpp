#include "tests/bench/measure.h"

#include <math.h>

#include <algorithm>

#include "tests/bench/clock.h"

namespace detent_bench {

using detent_queries::Query;

namespace {

class Nothing : public Prepared {
 public:
  void run(Answer& answer) override { answer = {}; }
};

uint64_t time_of(Prepared& prepared, Answer& answer) {
  const uint64_t start = ticks();
  prepared.run(answer);
  return ticks() - start;
}

Clock clock_of_queries() {
  const std::unique_ptr<Prepared> nothing = std::make_unique<Nothing>();
  Answer answer;
  return calibrated_clock([&] { return time_of(*nothing, answer); });
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
  const Clock clock = clock_of_queries();
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
      all[e][q].ns = clock.ns(least[e]);
    }
    progress(q + 1, queries.size());
  }
  return all;
}

}  // namespace detent_bench
