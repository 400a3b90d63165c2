#include <algorithm>

#include "call_difference.h"
#include "difference.h"
#include "own_replay.h"
#include "text.h"
#include "tick_reader.h"

namespace detent {
inline namespace DETENT_NAMESPACE {

using namespace detent_tool;

namespace {

constexpr uint64_t k_ticks_traced_max = 64;  ///< most ticks that are traced in the search for a difference

void no_progress(uint64_t, uint64_t) {}

/// One side of the comparison.
struct Side {
  Recorded recorded;
  bool here = false;  ///< the states of this side are those that this machine computes
};

/// The result of reading both sides in parallel.
struct Survey {
  std::string problem;
  bool other_config = false;
  bool states_differ = false;
  bool after_last_tick = false;
  bool traced = false;  ///< the state difference comes from two traces
  uint64_t first = 0, last = 0, equal_to = 0, tick = 0;
  TickTrace a, b;  ///< of `tick`
  /// first and last traced tick of each side after `equal_to`; 0: none
  uint64_t first_traced[2] = {}, last_traced[2] = {};
  bool same_start = false;
  Difference found;
};

void note_end(const TickReader& reader, const TickReader& other, const Side& side, Survey& survey) {
  if (!reader.problem.empty()) {
    survey.found.damaged = true;
    survey.found.notes.push_back(side.recorded.name + ": " + reader.problem);
  } else if (reader.finished && !other.finished) {
    survey.found.notes.push_back(side.recorded.name + " ends at tick " + std::to_string(reader.tick));
  }
}

void note_traces(int side, const TickReader& reader, Survey& survey) {
  if (!reader.trace.there) return;
  if (survey.first_traced[side] == 0) survey.first_traced[side] = reader.tick;
  survey.last_traced[side] = reader.tick;
}

void compare_calls(const TickReader& a, const TickReader& b, uint64_t tick, Survey& survey) {
  CallDifference call;
  if (!survey.found.calls.empty() || !find_call_difference(a.calls, b.calls, call)) return;
  call.tick = tick;
  survey.found.calls.push_back(call);
}

/// False once the states are known to differ.
bool compare_tick(const TickReader& a, const TickReader& b, Survey& survey) {
  survey.last = a.tick;
  const bool digests = a.compared && b.compared;
  survey.traced = find_difference(a.trace, b.trace, survey.found);
  if (survey.traced || (digests && a.digest != b.digest)) {
    survey.states_differ = true;
    if (digests && a.digest == b.digest)
      survey.found.notes.push_back("the states after this tick are equal all the same");
    survey.tick = a.tick;
    survey.a = a.trace;
    survey.b = b.trace;
    return false;
  }
  if (digests || (a.trace.there && b.trace.there)) {
    survey.equal_to = a.tick;
    survey.first_traced[0] = survey.first_traced[1] = survey.last_traced[0] = survey.last_traced[1] = 0;
  }
  return true;
}

Survey survey_of(const Side& side_a, const Side& side_b) {
  Survey survey;
  TickReader a(side_a.recorded), b(side_b.recorded);
  survey.other_config = a.other_config;
  if (!a.problem.empty())
    survey.problem = side_a.recorded.name + ": " + a.problem;
  else if (!b.problem.empty())
    survey.problem = side_b.recorded.name + ": " + b.problem;
  if (!survey.problem.empty()) return survey;
  survey.same_start = a.info().tick == b.info().tick;
  const uint64_t start = std::max(a.info().tick, b.info().tick);
  while (a.tick < start && a.next() && !a.finished) {
  }
  while (b.tick < start && b.next() && !b.finished) {
  }
  survey.first = start + 1;
  survey.last = survey.equal_to = start;
  if (a.tick != start || b.tick != start) {
    survey.problem = "they have no tick in common";
    return survey;
  }
  for (;;) {
    const bool more_a = a.next(), more_b = b.next();
    if (!more_a || !more_b || a.finished || b.finished) break;
    compare_calls(a, b, a.tick, survey);
    note_traces(0, a, survey);
    note_traces(1, b, survey);
    if (!compare_tick(a, b, survey)) return survey;
  }
  if (a.finished && b.finished && a.tick == b.tick) {
    if (!side_a.recorded.window && !side_b.recorded.window) compare_calls(a, b, a.tick + 1, survey);
    if (a.digest != b.digest) {
      survey.states_differ = true;
      survey.tick = a.tick;
      survey.after_last_tick = survey.equal_to == a.tick;
    } else {
      survey.equal_to = a.tick;
    }
  }
  note_end(a, b, side_a, survey);
  note_end(b, a, side_b, survey);
  return survey;
}

/// Finds the first differing fields of the two seeds. False if they are equal or cannot be loaded here.
bool compare_seeds(const Side& a, const Side& b, const Assets& assets, Difference& difference) {
  OwnReplay in_a(a.recorded, assets, {}), in_b(b.recorded, assets, {});
  if (!in_a.begin(0) || !in_b.begin(0)) return false;
  TickTrace of_a, of_b;
  of_a.take_end(in_a.world());
  of_b.take_end(in_b.world());
  Difference found;
  if (!find_difference(of_a, of_b, found)) return false;
  difference.stage = "seed";
  difference.fields = found.fields;
  difference.field_count = found.field_count;
  return true;
}

/// Replaces the side by a trace of these ticks that this machine computes. If this machine's states may not be those of
/// the recording, returns false and leaves the side unchanged.
bool trace_here(Side& side, uint64_t from, uint64_t to, const Assets& assets) {
  auto bytes = std::make_shared<std::vector<uint8_t>>();
  const auto keep = [](void* context, const uint8_t* piece, uint32_t count) {
    auto& to_bytes = *static_cast<std::vector<uint8_t>*>(context);
    to_bytes.insert(to_bytes.end(), piece, piece + count);
    return Status::ok;
  };
  const TraceMade made =
      trace_to(side.recorded, assets, {TraceLevel::full, from, to}, {keep, bytes.get()}, no_progress);
  if (!made.problem.empty() || made.last < to || (!side.here && made.first_other != 0)) return false;
  side.recorded.bytes = bytes;
  side.recorded.window = true;
  return true;
}

/// Finds the exact tick of the difference, if this machine can compute both sides' states.
void narrow(const Side& a, const Side& b, const Assets& assets, Survey& survey) {
  OwnReplay in_a(a.recorded, assets, {}), in_b(b.recorded, assets, {});
  if (!in_a.begin(survey.equal_to) || !in_b.begin(survey.equal_to)) return;
  uint64_t equal_to = survey.equal_to, tick = 0;
  while (in_a.tick < survey.tick) {
    if (!in_a.next() || !in_b.next()) return;
    const bool same = digest(in_a.world()) == digest(in_b.world());
    if (tick == 0 && same) equal_to = in_a.tick;
    if (tick == 0 && !same) tick = in_a.tick;
  }
  if (tick == 0 || (!a.here && !in_a.verified()) || (!b.here && !in_b.verified())) return;
  survey.equal_to = equal_to;
  if (survey.tick == tick) return;
  survey.tick = tick;
  survey.a = survey.b = {};
}

/// The state of a side at this tick, as a trace; empty if the side has no keyframe at this tick.
TickTrace keyframe_at(const Side& side, uint64_t tick, const Assets& assets) {
  TickTrace trace;
  std::string problem;
  const std::unique_ptr<Input> input = side.recorded.open(problem);
  if (input == nullptr) return trace;
  uint8_t buffer[k_recording_buffer_bytes];
  Player player(source_of(*input), buffer, sizeof buffer);
  ReplayWorld world;
  if (player.open() != Status::ok || !is_due(player.info().keyframe_interval, tick)) return trace;
  if (world.create(player.info(), *input, assets) != Status::ok) return trace;
  if (player.go_to(world.owned.world, tick) == Status::ok) trace.take_end(world.owned.world);
  return trace;
}

std::string traced_path(std::string path) {
  for (const char* suffix : {k_compressed_suffix, ".rec"}) {
    if (ends_with(path, suffix)) path.resize(path.size() - std::string(suffix).size());
  }
  return path + ".trace.rec";
}

void want_trace(const Side& side, const Survey& survey, Difference& difference) {
  if (side.here) return;
  const std::string& path = side.recorded.path;
  difference.wanted.push_back("detent trace " + path + " -o " + traced_path(path) + " --level 2 --from " +
                              std::to_string(survey.equal_to + 1) + " --to " + std::to_string(survey.tick));
}

/// Finds the stage and field where two digests differ.
void explain_states(Side a, Side b, const Assets& assets, Survey& survey) {
  if (!survey.traced && survey.tick - survey.equal_to > 1) narrow(a, b, assets, survey);
  uint64_t from = survey.equal_to + 1, to = survey.tick;
  if (to - from > 1) {  // if only one side has traces, the window is that of its traces
    for (const int other : {0, 1}) {
      if (survey.first_traced[other] == 0 || survey.first_traced[1 - other] != 0) continue;
      from = survey.first_traced[other];
      to = survey.last_traced[other];
    }
  }
  bool has_a = survey.a.full, has_b = survey.b.full;
  if (to - from < k_ticks_traced_max) {
    const bool gets_a = !has_a && trace_here(a, from, to, assets);
    const bool gets_b = !has_b && trace_here(b, from, to, assets);
    has_a = has_a || gets_a;
    has_b = has_b || gets_b;
    if (gets_a || gets_b) {
      Survey again = survey_of(a, b);
      if (again.traced) {
        again.first = survey.first;
        again.same_start = survey.same_start;
        again.found.notes.insert(again.found.notes.end(), survey.found.notes.begin(), survey.found.notes.end());
        if (again.found.calls.empty()) again.found.calls = survey.found.calls;
        survey = std::move(again);
      } else {
        survey.a = std::move(again.a);
        survey.b = std::move(again.b);
      }
    }
  }
  if (!survey.traced) {
    if (!survey.a.there) survey.a = keyframe_at(a, survey.tick, assets);
    if (!survey.b.there) survey.b = keyframe_at(b, survey.tick, assets);
    find_difference(survey.a, survey.b, survey.found);
  }
  const bool exact = survey.traced && survey.a.full && survey.b.full;
  if (exact) return;
  if (!has_a) want_trace(a, survey, survey.found);
  if (!has_b) want_trace(b, survey, survey.found);
}

/// If only one side makes a call, notes whether the other side makes it later.
void note_late_call(const Side& a, const Side& b, Difference& difference) {
  constexpr uint64_t k_ticks_late_max = 60;
  const CallDifference& call = difference.calls.front();
  if (!call.a.empty() && !call.b.empty()) return;
  const Side& other = call.a.empty() ? a : b;
  TickReader reader(other.recorded);
  while (reader.next() && !reader.finished && reader.tick <= call.tick + k_ticks_late_max) {
    if (reader.tick <= call.tick) continue;
    if (std::find(reader.calls.begin(), reader.calls.end(), call.record) == reader.calls.end()) continue;
    difference.notes.push_back(other.recorded.name + " makes this call before tick " + std::to_string(reader.tick));
    return;
  }
}

Difference compare(const Side& a, const Side& b, const Assets& assets) {
  Survey survey = survey_of(a, b);
  Difference difference;
  difference.problem = survey.problem;
  difference.other_config = survey.other_config;
  if (!survey.problem.empty()) return difference;
  const bool calls_differ = !survey.found.calls.empty();
  if (survey.states_differ || calls_differ) {
    if (survey.states_differ && calls_differ && survey.found.calls[0].tick > survey.equal_to &&
        survey.found.calls[0].tick < survey.tick) {
      survey.tick = survey.found.calls[0].tick;  // not every tick has a digest: the difference begins with this call
      survey.equal_to = survey.tick - 1;
      survey.a = survey.b = {};
    }
    Difference seeds;
    const bool seeds_differ = survey.same_start && compare_seeds(a, b, assets, seeds);
    if (seeds_differ) {
      survey.found.stage = seeds.stage;
      survey.found.fields = seeds.fields;
      survey.found.field_count = seeds.field_count;
    } else if (survey.states_differ && !survey.after_last_tick && !(survey.traced && survey.a.full && survey.b.full)) {
      explain_states(a, b, assets, survey);
    }
    const bool by_call =
        !seeds_differ && calls_differ && (!survey.states_differ || survey.found.calls[0].tick > survey.equal_to);
    if (by_call) {
      survey.tick = survey.found.calls[0].tick;
      survey.equal_to = survey.tick - 1;
      survey.after_last_tick = survey.tick > survey.last && !survey.states_differ;
      if (survey.found.stage.empty()) survey.found.stage = "calls";
      survey.found.wanted.clear();
      note_late_call(a, b, survey.found);
    }
    if (!survey.states_differ) survey.found.notes.push_back("the states are equal all the same");
  }
  difference = std::move(survey.found);
  difference.different = survey.states_differ || calls_differ;
  difference.after_last_tick = survey.after_last_tick;
  difference.first = survey.first;
  difference.last = survey.last;
  difference.equal_to = survey.equal_to;
  difference.tick = survey.tick;
  return difference;
}

Side side_of(const std::string& path) {
  Side side;
  side.recorded.name = side.recorded.path = path;
  return side;
}

}  // namespace

Difference diff(const DiffRequest& request) { return compare(side_of(request.a), side_of(request.b), request.assets); }

Difference diff(const Recorded& a, const Recorded& b, const Assets& assets) { return compare({a}, {b}, assets); }

Difference explain(const ReadRequest& request, uint64_t tick) {
  Side recorded = side_of(request.path), here = recorded;
  here.here = true;
  here.recorded.name = "this machine";
  Difference difference;
  uint64_t equal_to = 0;
  {
    const TickReader reader(recorded.recorded);
    difference.problem = reader.problem;
    if (!difference.problem.empty()) return difference;
    const uint32_t interval = reader.info().digest_interval;
    equal_to = std::max(reader.info().tick, interval == 0 ? 0 : (tick - 1) / interval * interval);
  }
  const uint64_t from = tick - equal_to > k_ticks_traced_max ? tick : equal_to + 1;
  if (tick <= equal_to || !trace_here(here, from, tick, request.assets)) {
    difference.problem = "this machine cannot trace tick " + std::to_string(tick);
    return difference;
  }
  return compare(recorded, here, request.assets);
}

}  // namespace DETENT_NAMESPACE
}  // namespace detent
