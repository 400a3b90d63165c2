#include "tests/bench/zoo/measure.h"

#include <time.h>

#include <algorithm>
#include <limits>

namespace detent_zoo {

namespace {

/// That the thread has had a core, s.
double core_seconds() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// One run, no more than its steps; each tick's least time so far, s.
void time_once(const Engine& engine, const std::string& path, std::vector<double>& least) {
  std::string problem;
  const std::unique_ptr<Play> play = engine.open(path, problem);
  if (play == nullptr) return;
  for (double& seconds : least) {
    play->call(problem);
    const double before = core_seconds();
    const double step = play->step().seconds;
    // Of a step during which another process had the core, the thread's own time.
    seconds = std::min({seconds, step, core_seconds() - before});
  }
}

}  // namespace

const Result* SceneResults::of(const std::string& engine) const {
  const auto found =
      std::find_if(results.begin(), results.end(), [&](const Result& result) { return result.engine == engine; });
  return found == results.end() ? nullptr : &*found;
}

SceneResults measure_scene(const Entry& entry, const std::vector<Engine>& engines, uint32_t repetitions,
                           const std::string& folder, const std::function<void(const std::string&)>& progress) {
  SceneResults scene;
  scene.entry = entry;
  std::vector<std::vector<double>> least;
  for (const Engine& engine : engines) {
    progress(entry.scene + ": " + engine.config);
    scene.results.push_back({engine.config, visit(entry, engine, folder), 0, 0});
    least.emplace_back(scene.results.back().verdict.figures.ticks, std::numeric_limits<double>::infinity());
  }
  for (uint32_t repetition = 0; repetition < repetitions; ++repetition) {
    for (size_t i = 0; i < engines.size(); ++i) {
      const size_t rotation_vector = (i + repetition) % engines.size();
      if (!scene.results[rotation_vector].played()) continue;
      progress(entry.scene + ": times, " + engines[rotation_vector].config);
      time_once(engines[rotation_vector], folder + "/" + entry.scene + ".json", least[rotation_vector]);
    }
  }
  for (size_t i = 0; i < engines.size(); ++i) {
    Result& result = scene.results[i];
    if (!result.played() || least[i].empty() || repetitions == 0) continue;
    double sum = 0;
    for (const double seconds : least[i]) sum += seconds;
    result.mean = 1e6 * sum / static_cast<double>(least[i].size());
    result.max = 1e6 * *std::max_element(least[i].begin(), least[i].end());
  }
  return scene;
}

}  // namespace detent_zoo
