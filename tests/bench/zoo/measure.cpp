#include "tests/bench/zoo/measure.h"

#include <algorithm>

namespace detent_zoo {

namespace {

using detent_bench::Interruptions;
using detent_bench::LeastTimes;

/// One run, no more than its steps.
void time_once(const Engine& engine, const std::string& path, detent_test::Ground ground, uint32_t ticks,
               LeastTimes& least) {
  std::string problem;
  const std::unique_ptr<Play> play = engine.open(path, ground, problem);
  if (play == nullptr) return;
  Interruptions interruptions;
  for (uint32_t tick = 0; tick < ticks; ++tick) {
    play->call(problem);
    least.take(tick, interruptions.us_of([&play] { return 1e9 * play->step().seconds; }));
  }
}

}  // namespace

const Result* SceneResults::of(const std::string& engine) const {
  const auto found =
      std::find_if(results.begin(), results.end(), [&](const Result& result) { return result.engine == engine; });
  return found == results.end() ? nullptr : &*found;
}

void measure_scene(SceneResults& scene, const std::vector<Engine>& engines, uint32_t repetitions,
                   const std::string& folder, const std::function<void(const std::string&)>& progress) {
  const std::string& name = scene.entry.scene;
  std::vector<LeastTimes> least;
  for (const Engine& engine : engines) {
    progress(name + ": " + engine.config);
    Result result;
    result.engine = engine.config;
    result.verdict = visit(scene.entry, engine, folder, scene.ground);
    result.stages = detent_bench::stage_shares({}, result.verdict.stages);
    least.emplace_back(result.verdict.figures.ticks);
    scene.results.push_back(result);
  }
  for (uint32_t repetition = 0; repetition < repetitions; ++repetition) {
    for (size_t i = 0; i < engines.size(); ++i) {
      const size_t turn = (i + repetition) % engines.size();
      const Result& result = scene.results[turn];
      if (!result.played()) continue;
      progress(name + ": times, " + result.engine);
      time_once(engines[turn], folder + "/" + name + ".json", scene.ground, result.verdict.figures.ticks, least[turn]);
    }
  }
  for (size_t i = 0; i < engines.size(); ++i) scene.results[i].times = least[i].summary();
}

}  // namespace detent_zoo
