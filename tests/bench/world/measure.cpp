#include "tests/bench/world/measure.h"

#include <math.h>

#include <algorithm>
#include <memory>

#include "tests/bench/clock.h"
#include "tests/bench/world/watch.h"

namespace detent_bench {

namespace {

using detent_test::Ground;

constexpr uint32_t k_sample_ticks = 30;

class Nothing : public WorldRun {
 public:
  void step() override {}
  uint32_t contact_points() const override { return 0; }
  uint64_t losses() const override { return 0; }
  void read(BodyState*) const override {}
  uint64_t bytes() const override { return 0; }
  const char* settings() const override { return ""; }
};

uint64_t time_of(WorldRun& run) {
  const uint64_t start = ticks();
  run.step();
  return ticks() - start;
}

Clock clock_of_steps() {
  const std::unique_ptr<WorldRun> nothing = std::make_unique<Nothing>();
  return calibrated_clock([&nothing] { return time_of(*nothing); });
}

/// A contestant in the scene that is being measured.
struct Entry {
  Contestant contestant;
  std::vector<WorldRow> rows;     ///< a window each
  std::vector<LeastTimes> times;  ///< a window each
};

/// What a run that is not timed tells about a window.
struct Samples {
  uint64_t points = 0, count = 0;
  double error_squares = 0;
  uint32_t compared = 0;
  detent_test::StageTimes stages_before;
};

class Course {
 public:
  Course(const WorldScene& scene, const WorldPlan& plan, const WorldProgress& progress)
      : played_(on_ground(scene.stage(), plan.ground)),
        judged_(on_ground(played_, plan.ground == Ground::own ? Ground::own : Ground::box)),
        start_(states_at_start(judged_)),
        depths_(judged_),
        plan_(plan),
        progress_(progress) {
    for (Window window : scene.windows) {  // none begins before another ends
      window.end = std::min(window.end, plan.ticks_max);
      if (window.first >= window.end) continue;
      windows_.push_back(window);
      end_ = std::max(end_, window.end);
    }
  }

  WorldFindings run(const std::vector<Contestant>& contestants) {
    if (windows_.empty()) {
      findings_.left_out.push_back("measurements: none begins before tick " + std::to_string(plan_.ticks_max));
      return std::move(findings_);
    }
    total_ = uint64_t{plan_.repetitions + 1} * contestants.size() * end_;
    for (const Contestant& contestant : contestants) enter(contestant);
    total_ = done_ + uint64_t{plan_.repetitions} * entries_.size() * end_;
    const Clock clock = clock_of_steps();
    for (uint32_t repetition = 0; repetition < plan_.repetitions; ++repetition) {
      for (size_t i = 0; i < entries_.size(); ++i) time_once(entries_[(i + repetition) % entries_.size()], clock);
    }
    for (size_t window = 0; window < windows_.size(); ++window) {
      for (Entry& entry : entries_) {
        entry.rows[window].times = entry.times[window].summary();
        findings_.rows.push_back(std::move(entry.rows[window]));
      }
    }
    return std::move(findings_);
  }

 private:
  std::unique_ptr<WorldRun> make(const Contestant& contestant, const char*& problem) const {
    problem = nullptr;
    return std::unique_ptr<WorldRun>(contestant.engine.make(played_, contestant.effort, problem));
  }

  void advance(uint32_t ticks_done) {
    done_ += ticks_done;
    progress_(done_, total_);
  }

  void enter(const Contestant& contestant) {
    const char* problem = nullptr;
    const std::unique_ptr<WorldRun> run = make(contestant, problem);
    if (run == nullptr) {
      findings_.left_out.push_back(std::string(contestant.engine.engine) + " " + contestant.engine.config + ": " +
                                   (problem != nullptr ? problem : "cannot"));
      return;
    }
    Entry entry;
    entry.contestant = contestant;
    for (const Window& window : windows_) {
      WorldRow row;
      row.scene = window.row;
      row.ground = has_ground(played_) ? detent_test::ground_name(plan_.ground) : "own";
      row.engine = contestant.engine.engine;
      row.config = contestant.engine.config;
      row.effort = contestant.effort;
      row.settings = run->settings();
      row.bodies = static_cast<uint32_t>(std::count_if(played_.bodies.begin(), played_.bodies.end(),
                                                       [](const StageBody& b) { return b.role == Role::dynamic; }));
      entry.rows.push_back(row);
      entry.times.emplace_back(window.end - window.first);
    }
    if (plan_.measures) take_measures(*run, entry);
    entries_.push_back(std::move(entry));
  }

  /// The run that is not timed.
  void take_measures(WorldRun& run, Entry& entry) {
    States states(judged_.bodies.size());
    Watch watch(judged_, depths_);
    read(run, states);
    watch.begin(states);
    run.start_profile();
    std::vector<Samples> samples(windows_.size());
    for (uint32_t tick = 0; tick < end_; ++tick) {
      for (size_t i = 0; i < windows_.size(); ++i) {
        if (tick == windows_[i].first) samples[i].stages_before = run.stages();
      }
      run.step();
      read(run, states);
      watch.tick(states, tick);
      for (size_t i = 0; i < windows_.size(); ++i) {
        if (tick >= windows_[i].first && tick < windows_[i].end)
          take_tick(run, states, tick, windows_[i], watch, samples[i], entry.rows[i]);
      }
      advance(1);
    }
  }

  void take_tick(const WorldRun& run, const States& states, uint32_t tick, const Window& window, Watch& watch,
                 Samples& samples, WorldRow& row) const {
    if (plan_.reference != nullptr && tick < plan_.reference->states.size()) {
      samples.error_squares += pow(state_error(judged_, states, plan_.reference->states[tick]), 2);
      ++samples.compared;
    }
    if (tick == window.first) watch.begin_window();
    const bool last = tick + 1 == window.end;
    if (!last && (tick - window.first) % k_sample_ticks != 0) return;
    watch.sample(states);
    samples.points += run.contact_points();
    ++samples.count;
    if (!last) return;
    row.contacts = static_cast<uint32_t>((samples.points + samples.count / 2) / samples.count);
    row.bytes = run.bytes();
    row.losses = run.losses();
    row.stages = stage_shares(samples.stages_before, run.stages());
    row.measures = watch.measures(states);
    if (samples.compared == 0) return;
    row.measures.emplace_back("error", sqrt(samples.error_squares / samples.compared));
    row.measures.emplace_back("reference", plan_.reference->uncertainty);
  }

  /// What does not move is where the stage has it: a half-space has no pose in every engine.
  void read(const WorldRun& run, States& states) const {
    run.read(states.data());
    for (size_t i = 0; i < states.size(); ++i) {
      if (judged_.bodies[i].role == Role::fixed) states[i] = start_[i];
    }
  }

  void time_once(Entry& entry, const Clock& clock) {
    const char* problem = nullptr;
    const std::unique_ptr<WorldRun> run = make(entry.contestant, problem);
    uint32_t tick = 0;
    for (size_t i = 0; i < windows_.size(); ++i) {
      for (; tick < windows_[i].first; ++tick) run->step();
      const uint64_t allocations = entry.contestant.engine.heap().calls;
      for (; tick < windows_[i].end; ++tick) {
        entry.times[i].take(tick - windows_[i].first,
                            findings_.interruptions.us_of([&] { return clock.ns(time_of(*run)); }));
      }
      WorldRow& row = entry.rows[i];
      row.allocs = std::max(row.allocs, entry.contestant.engine.heap().calls - allocations);
      if (plan_.measures) continue;
      row.contacts = run->contact_points();
      row.bytes = run->bytes();
      row.losses = run->losses();
    }
    advance(end_);
  }

  const Stage played_;
  const Stage judged_;  ///< on a box where there is a ground: a half-space is no convex shape
  const States start_;
  const detent_stress::DepthMeter depths_;
  const WorldPlan& plan_;
  const WorldProgress& progress_;
  std::vector<Window> windows_;
  uint32_t end_ = 0;
  std::vector<Entry> entries_;
  WorldFindings findings_;
  uint64_t done_ = 0, total_ = 1;
};

}  // namespace

WorldFindings measure_world(const WorldScene& scene, const std::vector<Contestant>& contestants, const WorldPlan& plan,
                            const WorldProgress& progress) {
  return Course(scene, plan, progress).run(contestants);
}

}  // namespace detent_bench
