#include "tests/bench/world/measure.h"

#include <math.h>
#include <time.h>

#include <algorithm>
#include <memory>

#include "tests/bench/clock.h"
#include "tests/bench/world/watch.h"

namespace detent_bench {

namespace {

constexpr uint32_t k_sample_ticks = 30;
/// Of shorter steps the core's time is not taken, for that takes its time too; they are interrupted as seldom.
constexpr double k_asked_ns = 100000;
constexpr double k_interruption_ns = 20000;

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

/// ns that the thread has had a core.
uint64_t core_ns() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<uint64_t>(now.tv_sec) * 1000000000u + static_cast<uint64_t>(now.tv_nsec);
}

/// The value that `share` of all lie at or below.
double quantile(const std::vector<double>& sorted, double share) {
  const double index = ceil(share * static_cast<double>(sorted.size())) - 1;
  return sorted[static_cast<size_t>(std::max(index, 0.0))];
}

/// A contestant in the scene that is being measured.
struct Entry {
  Contestant contestant;
  std::vector<WorldRow> rows;              ///< a window each
  std::vector<std::vector<double>> times;  ///< us; a window each
};

class Course {
 public:
  Course(const WorldScene& scene, uint32_t repetitions, uint32_t ticks_max, const WorldProgress& progress)
      : stage_(scene.stage()), depths_(stage_), repetitions_(repetitions), progress_(progress) {
    for (Window window : scene.windows) {  // none begins before another ends
      window.end = std::min(window.end, ticks_max);
      if (window.first >= window.end) continue;
      windows_.push_back(window);
      end_ = std::max(end_, window.end);
    }
  }

  WorldFindings run(const std::vector<Contestant>& contestants) {
    total_ = uint64_t{repetitions_ + 1} * contestants.size() * end_;
    for (const Contestant& contestant : contestants) enter(contestant);
    total_ = done_ + uint64_t{repetitions_} * entries_.size() * end_;
    const Clock clock = calibrated_clock([] {
      const std::unique_ptr<WorldRun> nothing = std::make_unique<Nothing>();
      return time_of(*nothing);
    });
    for (uint32_t repetition = 0; repetition < repetitions_; ++repetition) {
      for (size_t i = 0; i < entries_.size(); ++i) time_once(entries_[(i + repetition) % entries_.size()], clock);
    }
    for (size_t window = 0; window < windows_.size(); ++window) {
      for (Entry& entry : entries_) {
        std::vector<double>& times = entry.times[window];
        std::sort(times.begin(), times.end());
        WorldRow& row = entry.rows[window];
        row.us_median = quantile(times, 0.5);
        row.us_p99 = quantile(times, 0.99);
        row.us_max = times.back();
        findings_.rows.push_back(std::move(row));
      }
    }
    return std::move(findings_);
  }

 private:
  std::unique_ptr<WorldRun> make(const Contestant& contestant, const char*& problem) const {
    problem = nullptr;
    return std::unique_ptr<WorldRun>(contestant.engine.make(stage_, contestant.effort, problem));
  }

  void advance(uint32_t ticks_done) {
    done_ += ticks_done;
    progress_(done_, total_);
  }

  /// The run that is not timed.
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
    entry.times.resize(windows_.size());
    States states(stage_.bodies.size());
    Watch watch(stage_, depths_);
    run->read(states.data());
    watch.begin(states);
    std::vector<uint64_t> points(windows_.size()), samples(windows_.size());
    entry.rows.resize(windows_.size());
    for (uint32_t tick = 0; tick < end_; ++tick) {
      run->step();
      run->read(states.data());
      watch.tick(states, tick);
      for (size_t i = 0; i < windows_.size(); ++i) {
        const Window& window = windows_[i];
        if (tick < window.first || tick >= window.end) continue;
        if (tick == window.first) watch.begin_window();
        const bool last = tick + 1 == window.end;
        if (!last && (tick - window.first) % k_sample_ticks != 0) continue;
        watch.sample(states);
        points[i] += run->contact_points();
        ++samples[i];
        if (!last) continue;
        WorldRow& row = entry.rows[i];
        row.scene = window.row;
        row.engine = contestant.engine.engine;
        row.config = contestant.engine.config;
        row.effort = contestant.effort;
        row.contacts = static_cast<uint32_t>((points[i] + samples[i] / 2) / samples[i]);
        row.bytes = run->bytes();
        row.losses = run->losses();
        row.settings = run->settings();
        row.measures = watch.measures(states);
      }
      advance(1);
    }
    entries_.push_back(std::move(entry));
  }

  void time_once(Entry& entry, const Clock& clock) {
    const char* problem = nullptr;
    const std::unique_ptr<WorldRun> run = make(entry.contestant, problem);
    uint32_t tick = 0;
    for (size_t i = 0; i < windows_.size(); ++i) {
      entry.times[i].reserve(entry.times[i].size() + windows_[i].end);  // not while its allocations are counted
      for (; tick < windows_[i].first; ++tick) run->step();
      std::vector<double>& times = entry.times[i];
      const uint64_t allocations = entry.contestant.engine.heap().calls;
      bool asked = true;
      for (tick = windows_[i].first; tick < windows_[i].end; ++tick) {
        const uint64_t core_before = asked ? core_ns() : 0;
        double ns = clock.ns(time_of(*run));
        if (asked) {
          const double own = static_cast<double>(core_ns() - core_before);
          ++findings_.asked;
          if (ns > own + k_interruption_ns) {
            ++findings_.interrupted;
            ns = own;
          }
        }
        asked = ns > k_asked_ns;
        times.push_back(ns / 1000);
      }
      WorldRow& row = entry.rows[i];
      row.allocs = std::max(row.allocs, entry.contestant.engine.heap().calls - allocations);
    }
    advance(end_);
  }

  const Stage stage_;
  const detent_stress::DepthMeter depths_;
  const uint32_t repetitions_;
  const WorldProgress& progress_;
  std::vector<Window> windows_;
  uint32_t end_ = 0;
  std::vector<Entry> entries_;
  WorldFindings findings_;
  uint64_t done_ = 0, total_ = 1;
};

}  // namespace

WorldFindings measure_world(const WorldScene& scene, const std::vector<Contestant>& contestants, uint32_t repetitions,
                            uint32_t ticks_max, const WorldProgress& progress) {
  return Course(scene, repetitions, ticks_max, progress).run(contestants);
}

}  // namespace detent_bench
