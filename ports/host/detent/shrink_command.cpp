#include <stdio.h>
#include <string.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "progress.h"
#include "shrink.h"
#include "stream.h"
#include "text.h"
#include "verification.h"
#include "view.h"

namespace detent_tool {

namespace {

using Json = nlohmann::ordered_json;

std::string kind_text(const ShrinkRequest& request) { return k_fault_names[static_cast<size_t>(request.kind)]; }

Json json_of(const ShrinkSize& size) {
  return {{"ticks", size.ticks},
          {"bodies", size.bodies},
          {"joints", size.joints},
          {"calls", size.calls},
          {"bytes", size.bytes}};
}

void print_json(const ShrinkRequest& request, const Outcome& outcome, const Shrunk& shrunk) {
  Json json = {{"file", request.reading.path},
               {"ok", outcome.verdict == Verdict::good},
               {"while", kind_text(request)},
               {"replays", shrunk.replays}};
  if (outcome.verdict == Verdict::good) {
    json["output"] = request.output;
    json["fault"] = shrunk.fault;
    json["tick"] = shrunk.tick;
    json["tick_before"] = shrunk.tick_before;
    json["before"] = json_of(shrunk.before);
    json["after"] = json_of(shrunk.after);
    json["all_tried"] = !shrunk.limit_reached;
  } else {
    json["problem"] = outcome.problem;
  }
  printf("%s\n", json.dump(-1, ' ', false, Json::error_handler_t::replace).c_str());
}

void print_text(const ShrinkRequest& request, const Shrunk& shrunk) {
  std::string line = request.output + ": " + kind_text(request) + " at tick " + std::to_string(shrunk.tick) + ": " +
                     shrunk.fault + "; ";
  const auto add = [&line](uint64_t after, uint64_t before, const char* what) {
    line += std::to_string(after) + " of " + std::to_string(before) + " " + what + ", ";
  };
  add(shrunk.after.ticks, shrunk.before.ticks, "ticks");
  add(shrunk.after.bodies, shrunk.before.bodies, "bodies");
  add(shrunk.after.joints, shrunk.before.joints, "joints");
  add(shrunk.after.calls, shrunk.before.calls, "calls");
  add(shrunk.after.bytes, shrunk.before.bytes, "bytes");
  printf("%s\n", printable(line + std::to_string(shrunk.replays) + " replays").c_str());
  if (shrunk.limit_reached)
    fprintf(stderr, "%s: not everything was tried: raise --replays\n", printable(request.output).c_str());
}

/// What is wrong with the options for this kind of fault; empty if nothing is.
std::string misused_option(const ShrinkRequest& request) {
  const bool bounded = request.kind == FaultKind::opens || request.kind == FaultKind::penetrates;
  if (request.bound != 0 && !bounded) return "--bound is for opens and penetrates";
  if (request.body != 0 && !bounded && request.kind != FaultKind::tunnels)
    return "--body is for tunnels, opens and penetrates";
  if (request.kind == FaultKind::differs && (request.reading.from != 0 || request.lead_ticks != 0))
    return "--from and --lead are not for differs, which is found at its first tick";
  return "";
}

/// The file to write if none is named: match.small.rec for match.rec or match.rec.zst.
std::string shrunk_name(const std::string& path) {
  std::string name = path;
  for (const char* suffix : {k_compressed_suffix, ".rec"}) {
    if (ends_with(name, suffix)) name.resize(name.size() - strlen(suffix));
  }
  return name + ".small.rec";
}

}  // namespace

CLI::App* add_shrink_command(CLI::App& app, ShrinkCommand& command) {
  ShrinkRequest& request = command.request;
  CLI::App* const shrink = app.add_subcommand(
      "shrink", "Find the smallest recording that still shows a fault, to report it (docs/shrink.md)");
  shrink->add_option("file", request.reading.path, "A recording")->required();
  shrink
      ->add_option("--while", command.kind,
                   "The fault. tunnels: a body's centre passes the surface of a fixed body; opens: a joint's anchors "
                   "are apart; penetrates: two bodies overlap deeply; differs: it does not verify; lost: a step loses "
                   "or leaves undecided something; status: a call is refused")
      ->required()
      ->check(CLI::IsMember(std::vector<std::string>(k_fault_names.begin(), k_fault_names.end())));
  shrink->add_option("-o,--output", request.output,
                     "The recording to write; compressed if its name ends in .zst; NAME.small.rec if it is not given");
  shrink
      ->add_option("--bound", request.bound,
                   "opens: the gap, as a part of the smaller body's size (0.02 if it is not given); penetrates: the "
                   "depth, as a part of the thinner body's thickness (0.5)")
      ->check(CLI::PositiveNumber);
  shrink->add_option("--body", request.body, "tunnels, opens, penetrates: only faults of the body in this slot")
      ->check(CLI::PositiveNumber);
  shrink->add_option("--from", request.reading.from, "Only faults after this tick")->check(CLI::NonNegativeNumber);
  shrink->add_option("--lead", request.lead_ticks, "Keep so many ticks before the tick that shows the fault")
      ->check(CLI::Range(0u, 1000000000u));
  shrink->add_option("--replays", request.replays_max, "Replay at most so many candidates")
      ->check(CLI::Range(1u, 1000000000u))
      ->capture_default_str();
  shrink->add_option("--page", command.page, "Also write a page that draws the result, as view does");
  return shrink;
}

std::string take_shrink_options(ShrinkCommand& command) {
  ShrinkRequest& request = command.request;
  const auto name = std::find(k_fault_names.begin(), k_fault_names.end(), command.kind);
  request.kind = static_cast<FaultKind>(name - k_fault_names.begin());
  if (request.output.empty()) request.output = shrunk_name(request.reading.path);
  return misused_option(request);
}

bool shrink_file(const ShrinkCommand& command) {
  const ShrinkRequest& request = command.request;
  Shrunk shrunk;
  Outcome outcome;
  {
    ProgressBar bar(request.reading.path);
    outcome = by_its_engine([&](const Engine& engine) {
      return engine.shrink(request, shrunk, [&bar](uint64_t done, uint64_t total) { bar.show(done, total); });
    });
  }
  if (command.json)
    print_json(request, outcome, shrunk);
  else if (outcome.verdict == Verdict::good)
    print_text(request, shrunk);
  else
    fprintf(stderr, "%s\n", printable(request.reading.path + ": " + outcome.problem).c_str());
  if (outcome.verdict != Verdict::good || command.page.empty()) return outcome.verdict == Verdict::good;
  return write_view({{request.output}, "", command.page, command.asset_paths, command.json});
}

}  // namespace detent_tool
