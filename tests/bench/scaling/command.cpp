#include "tests/bench/scaling/command.h"

#include <stdio.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/bench/scaling/schedule.h"
#include "tests/campaigns/stress/scenes.h"

namespace detent_bench {

namespace {

constexpr const char* k_help =
    R"(What several threads bring (docs/threads.md). For each scene, on this machine:
  one       ms, median tick on one thread
  shared    % of the tick in loops that threads share
  2, 3 ...  how many times as fast a tick is on so many threads, as measured
  bound     the same for 2 to 64 threads, computed: the parts of the loops, timed on one thread, are scheduled greedily; a
            loop and a group of loops cost what they cost here, a loop once for each doubling of the threads
Then, of the scene S4-rays, rays of 10 m through the heap of S4, awake and asleep, in thousands a second (least time of 51): a
call for each ray, and batches on 1, 2 and more threads.
Then, of the scenes break-1000, impacts-S8, fast-5000, fast-5000-sparse and rocks-300, the stage advance in each order of the
impacts (docs/threads.md): mean ms in ticks with an impact; how many times as fast as the global order on one thread it is,
measured and computed as above; and of Time Warp the ticks for which groups were tried, runs of groups, runs that were
rolled back, rounds, and ticks that returned to the global order.
All digests are compared: exit code 1 if one differs.)";

constexpr uint32_t k_bounds[] = {2, 4, 8, 16, 32, 64};

std::vector<ScalingScene> scaling_scenes() {
  using namespace detent_stress;
  return {{"S1", [] { return pyramid(20); }, 60, 60},
          {"S4", [] { return pit(1000, 1); }, 450, 30},
          {"S4-falling", [] { return pit(1000, 1); }, 100, 60},
          {"S4-8000", [] { return pit(8000, 1, 23); }, 240, 10},
          {"S8", [] { return dominoes(200); }, 120, 60},
          {"S10", [] { return sleep_stacks(1000, 5, false); }, 60, 10}};
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0 : values[values.size() / 2];
}

double median_bound(const ScalingRow& row, uint32_t threads, const SharingCost& cost) {
  std::vector<double> ns;
  for (const TickRecord& tick : row.ticks) ns.push_back(tick.ns / scheduled_ns(tick, threads, cost));
  return median(ns);
}

template <class Names>
bool is_wanted(const Names& names, const std::string& name) {
  return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

nlohmann::ordered_json report(const ScalingRow& row, const std::vector<uint32_t>& threads, const SharingCost& cost) {
  std::vector<double> part;
  for (const TickRecord& tick : row.ticks) part.push_back(shared_part(tick));
  nlohmann::ordered_json json = {{"config", row.config},     {"scene", row.scene},
                                 {"contacts", row.contacts}, {"one_thread_ms", row.measured[0] / 1e6},
                                 {"shared", median(part)},   {"same", row.same}};
  printf("%-5s %-10s %6u %8.3f %6.1f ", row.config.c_str(), row.scene.c_str(), row.contacts, row.measured[0] / 1e6,
         100 * median(part));
  for (size_t i = 1; i < threads.size(); ++i) {
    const double times = row.measured[0] / row.measured[i];
    json["measured"][std::to_string(threads[i])] = times;
    printf("%6.2f", times);
  }
  printf("  ");
  for (const uint32_t count : k_bounds) {
    const double times = median_bound(row, count, cost);
    json["bound"][std::to_string(count)] = times;
    printf("%6.2f", times);
  }
  printf("%s\n", row.same ? "" : "  DIGESTS DIFFER");
  fflush(stdout);
  return json;
}

nlohmann::ordered_json report(const ImpactRow& row, const ImpactRow& global, const std::vector<uint32_t>& threads,
                              const SharingCost& cost) {
  nlohmann::ordered_json json = {{"config", row.config},
                                 {"scene", row.scene},
                                 {"order", row.order},
                                 {"impacts", row.impacts},
                                 {"one_thread_ms", row.measured[0] / 1e6},
                                 {"warp_ticks", row.warp_ticks},
                                 {"speculations", row.speculations},
                                 {"rollbacks", row.rollbacks},
                                 {"rounds", row.rounds},
                                 {"returns", row.returns},
                                 {"same", row.same}};
  printf("%-5s %-17s %-12s %7u %8.3f ", row.config.c_str(), row.scene.c_str(), row.order.c_str(), row.impacts,
         row.measured[0] / 1e6);
  for (size_t i = 1; i < threads.size(); ++i) {
    const double times = global.measured[0] / row.measured[i];
    json["measured"][std::to_string(threads[i])] = times;
    printf("%6.2f", times);
  }
  printf("  ");
  double alone = 0;
  for (const TickRecord& tick : global.ticks) alone += tick.ns;
  for (const uint32_t count : k_bounds) {
    double shared = 0;
    for (const TickRecord& tick : row.ticks) shared += scheduled_ns(tick, count, cost);
    const double times = shared > 0 ? alone / shared : 0;
    json["bound"][std::to_string(count)] = times;
    printf("%6.2f", times);
  }
  printf(" %6u %7u %6u %5u %4u%s\n", row.warp_ticks, row.speculations, row.rollbacks, row.rounds, row.returns,
         row.same ? "" : "  DIGESTS DIFFER");
  fflush(stdout);
  return json;
}

nlohmann::ordered_json report(const RayRow& row, const std::vector<uint32_t>& threads) {
  const auto rate = [&](double ns) { return row.rays / ns * 1e6; };
  nlohmann::ordered_json json = {{"config", row.config}, {"scene", row.scene}, {"asleep", row.asleep},
                                 {"rays", row.rays},     {"same", row.same},   {"single_krays_s", rate(row.single_ns)}};
  printf("%-5s %-7s %-6s %5u %9.1f ", row.config.c_str(), row.scene.c_str(), row.asleep ? "asleep" : "awake", row.rays,
         rate(row.single_ns));
  for (size_t i = 0; i < threads.size(); ++i) {
    json["batch_krays_s_on_" + std::to_string(threads[i])] = rate(row.batch_ns[i]);
    printf("%8.1f", rate(row.batch_ns[i]));
  }
  printf("%s\n", row.same ? "" : "  ANSWERS DIFFER");
  fflush(stdout);
  return json;
}

}  // namespace

CLI::App* add_scaling_command(CLI::App& app, ScalingOptions& options) {
  CLI::App* command = app.add_subcommand("scaling", k_help);
  command->add_option("--scenes", options.scenes, "Only these")->delimiter(',');
  command->add_option("--configs", options.configs, "Only these")
      ->delimiter(',')
      ->check(CLI::IsMember({"fx64", "fx32", "f32", "f64"}));
  command->add_option("--threads", options.threads, "Numbers of threads to measure; the machine's, if none are given")
      ->delimiter(',')
      ->check(CLI::Range(2, 64));
  command->add_option("--json", options.json, "Write the rows to this file");
  return command;
}

int run_scaling(const ScalingOptions& options) {
  std::vector<uint32_t> threads = {1};
  threads.insert(threads.end(), options.threads.begin(), options.threads.end());
  if (threads.size() == 1) threads.push_back(std::max(2u, std::thread::hardware_concurrency()));
  const SharingCost cost = measure_sharing_cost();
  printf("sharing costs %.2f us a loop and %.1f us a group of loops, on two threads\n", cost.loop / 1e3,
         cost.group / 1e3);
  printf("%-5s %-10s %6s %8s %6s ", "", "", "cont.", "one, ms", "shared");
  for (size_t i = 1; i < threads.size(); ++i) printf("%6u", threads[i]);
  printf("  ");
  for (const uint32_t count : k_bounds) printf("%6u", count);
  printf(" (bound)\n");
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  bool same = true;
  for (const ScalingScene& scene : scaling_scenes()) {
    if (!is_wanted(options.scenes, scene.name)) continue;
    for (const ScalingEngine& engine : all_scaling_engines()) {
      if (!is_wanted(options.configs, engine.config)) continue;
      const ScalingRow row = engine.measure(scene, threads);
      same = same && row.same;
      rows.push_back(report(row, threads, cost));
    }
  }
  const ScalingScene rays = {"S4-rays", [] { return detent_stress::pit(1000, 1); }, 450, 0};
  printf("thousands of rays a second: single calls; batches on");
  for (const uint32_t count : threads) printf(" %u", count);
  printf(" threads\n");
  for (const ScalingEngine& engine : all_scaling_engines()) {
    if (!is_wanted(options.scenes, rays.name) || !is_wanted(options.configs, engine.config)) continue;
    for (const RayRow& row : engine.measure_rays(rays, threads)) {
      same = same && row.same;
      rows.push_back(report(row, threads));
    }
  }
  printf(
      "impacts: order, number, ms; times as fast as the global order on one thread; ticks in groups, runs, rolled "
      "back, "
      "rounds, returns\n");
  for (const char* scene : k_impact_scenes) {
    if (!is_wanted(options.scenes, scene)) continue;
    for (const ScalingEngine& engine : all_scaling_engines()) {
      if (!is_wanted(options.configs, engine.config)) continue;
      const std::vector<ImpactRow> all = engine.measure_impacts(scene, threads);
      for (const ImpactRow& row : all) {
        same = same && row.same;
        rows.push_back(report(row, all[0], threads, cost));
      }
    }
  }
  if (!same) fprintf(stderr, "bench: digests differ\n");
  if (!options.json.empty() && !(std::ofstream(options.json) << rows.dump(1) << "\n")) {
    fprintf(stderr, "bench: %s cannot be written\n", options.json.c_str());
    return 1;
  }
  return same ? 0 : 1;
}

}  // namespace detent_bench
