#include "report.h"

#include <stdio.h>

#include <nlohmann/json.hpp>

#include "text.h"

namespace detent_tool {

namespace {

using Json = nlohmann::ordered_json;

double rate(const Outcome& outcome) {
  return outcome.seconds > 0 ? static_cast<double>(outcome.ticks) / outcome.seconds : 0;
}

std::string text(uint64_t value) { return std::to_string(value); }

/// Prints a line and flushes it at once, so that an aborted run leaves a log of the finished files.
void put(const std::string& line) {
  printf("%s\n", line.c_str());
  fflush(stdout);
}

void print(const std::string& line) { put(printable(line)); }

void print_problem(const std::string& path, const Outcome& outcome) {
  const std::string more = outcome.difference_text.empty() ? "" : "; " + outcome.difference_text;
  fprintf(stderr, "%s\n", (printable(path + ": " + outcome.problem) + more).c_str());
}

/// A path need not be valid UTF-8: invalid bytes are replaced.
void print_json(const Json& json) { put(json.dump(-1, ' ', false, Json::error_handler_t::replace)); }

Json json_of(const std::string& path, const Outcome& outcome) {
  Json json;
  json["file"] = path;
  json["ok"] = outcome.verdict == Verdict::good;
  json["status"] = outcome.verdict == Verdict::good ? "ok" : outcome.status;
  if (!outcome.release.empty()) json["release"] = outcome.release;
  if (outcome.verdict != Verdict::good) {
    json["problem"] = outcome.problem;
    if (outcome.first_bad_tick != 0) json["first_bad_tick"] = outcome.first_bad_tick;
    if (!outcome.field.empty()) {
      json["field"] = outcome.field;
      json["offset"] = outcome.offset;
      json["tick"] = outcome.tick;
    }
    if (!outcome.difference.empty()) json["difference"] = Json::parse(outcome.difference, nullptr, false);
  }
  if (outcome.header_known) {
    const Header& header = outcome.header;
    json["config"] = header.config;
    json["format_version"] = header.format_version;
    json["simulation_version"] = header.simulation_version;
    json["capacity"] = {{"bodies", header.bodies}, {"contacts", header.contacts}, {"assets", header.assets}};
    json["trace_level"] = header.trace_level;
    json["digest_interval"] = header.digest_interval;
    json["keyframe_interval"] = header.keyframe_interval;
    json["first_tick"] = header.first_tick;
    json["snapshot_bytes"] = header.snapshot_bytes;
  }
  json["file_bytes"] = outcome.file_bytes;
  json["ticks"] = outcome.ticks;
  json["digests"] = outcome.digests;
  if (outcome.verdict == Verdict::good) json["digest"] = hexadecimal(outcome.digest);
  return json;
}

Json timed_json_of(const std::string& path, const Outcome& outcome) {
  Json json = json_of(path, outcome);
  json["seconds"] = outcome.seconds;
  json["ticks_per_second"] = rate(outcome);
  return json;
}

}  // namespace

void Report::recorded(const RecordRequest& request, const Outcome& outcome) const {
  if (json) {
    Json object = timed_json_of(request.path, outcome);
    object["scene"] = request.scene;
    print_json(object);
  } else if (outcome.verdict != Verdict::good) {
    print_problem(request.path, outcome);
  } else {
    print(request.path + ": " + outcome.header.config + ", " + text(outcome.ticks) + " ticks of " + request.scene +
          ", " + text(outcome.file_bytes) + " bytes, final digest " + hexadecimal(outcome.digest));
  }
}

void Report::verified(const std::string& path, const Outcome& outcome) const {
  if (json) return print_json(timed_json_of(path, outcome));
  if (outcome.verdict != Verdict::good) {
    print_problem(path, outcome);
    if (outcome.digests_differ)
      fprintf(stderr, "%s\n%s\n", printable("  a page that draws it: detent view " + path).c_str(),
              printable("  the smallest recording that differs: detent shrink " + path + " --while differs").c_str());
    return;
  }
  const std::string ticks = outcome.digests == outcome.ticks
                                ? text(outcome.ticks) + " ticks equal"
                                : text(outcome.ticks) + " ticks, " + text(outcome.digests) + " digests equal";
  print(path + ": " + outcome.header.config + ", " + ticks + ", final digest " + hexadecimal(outcome.digest) + ", " +
        text(static_cast<uint64_t>(rate(outcome))) + " ticks/s");
}

void Report::verified_all(uint64_t files, uint64_t bad, uint64_t passed_over, uint64_t ticks, double seconds) const {
  const double rate = seconds > 0 ? static_cast<double>(ticks) / seconds : 0;
  std::string line = text(files) + (files == 1 ? " recording, " : " recordings, ") + text(bad) + " bad, " +
                     text(ticks) + " ticks, " + text(static_cast<uint64_t>(rate)) + " ticks/s a core";
  if (passed_over != 0) line += ", " + text(passed_over) + " passed over as the log has them";
  fprintf(json ? stderr : stdout, "%s\n", line.c_str());
}

void Report::recovered(const std::string& from, const std::string& to, const Outcome& outcome) const {
  if (json) {
    Json object = json_of(from, outcome);
    object["output"] = to;
    if (!outcome.lost.empty()) object["lost"] = outcome.lost;
    return print_json(object);
  }
  if (outcome.verdict != Verdict::good) return print_problem(from, outcome);
  print(to + ": " + outcome.header.config + ", " + text(outcome.ticks) + " ticks of " + from + ", final digest " +
        hexadecimal(outcome.digest) + (outcome.lost.empty() ? "; it was whole" : "; " + outcome.lost));
}

void Report::traced(const TraceRequest& request, const Outcome& outcome) const {
  const std::string& path = request.reading.path;
  if (json) {
    Json object = {{"file", path}, {"ok", outcome.verdict == Verdict::good}, {"output", request.output}};
    if (outcome.verdict != Verdict::good) object["problem"] = outcome.problem;
    object["ticks"] = outcome.ticks;
    object["tick"] = outcome.tick;
    if (outcome.first_bad_tick != 0) object["first_bad_tick"] = outcome.first_bad_tick;
    object["digest"] = hexadecimal(outcome.digest);
    return print_json(object);
  }
  if (outcome.verdict != Verdict::good) return print_problem(path, outcome);
  print(request.output + ": " + text(outcome.ticks) + " ticks of " + path + " up to tick " + text(outcome.tick) +
        ", as this machine makes them, " + text(outcome.file_bytes) + " bytes" +
        (outcome.first_bad_tick == 0 ? ""
                                     : "; the recorded digest of tick " + text(outcome.first_bad_tick) + " differs"));
}

bool Report::compared(const std::string& a, const std::string& b, const Difference& difference) const {
  const bool good = difference.problem.empty();
  if (json) {
    Json object = {{"files", {a, b}}};
    object.update(Json::parse(difference_json(difference), nullptr, false));
    print_json(object);
    return good;
  }
  if (!good) return fprintf(stderr, "%s\n", printable(difference.problem).c_str()), false;
  put(printable(a + " and " + b + ": ") + difference_text(difference, printable(a), printable(b)));
  return true;
}

void Report::compressed(const std::string& from, const std::string& to, uint64_t before, uint64_t after) const {
  if (json) return print_json({{"file", from}, {"ok", true}, {"output", to}, {"before", before}, {"after", after}});
  print(to + ": " + text(after) + " bytes of " + text(before));
}

void Report::state(const std::string& path, const Outcome& outcome, const std::vector<BodyLine>& bodies) const {
  if (json) {
    Json object = json_of(path, outcome);
    if (outcome.verdict != Verdict::good) return print_json(object);
    object["tick"] = outcome.tick;
    object["bodies"] = Json::array();
    for (const BodyLine& body : bodies) {
      object["bodies"].push_back({{"slot", body.slot},
                                  {"generation", body.generation},
                                  {"type", body.type},
                                  {"awake", body.awake},
                                  {"position", body.position},
                                  {"rotation", body.rotation},
                                  {"linear_velocity", body.linear_velocity},
                                  {"angular_velocity", body.angular_velocity}});
    }
    return print_json(object);
  }
  if (outcome.verdict != Verdict::good) return print_problem(path, outcome);
  print(path + ": " + outcome.header.config + ", tick " + text(outcome.tick) + ", " + text(bodies.size()) +
        " bodies, digest " + hexadecimal(outcome.digest));
  print(
      "slot:gen  type       position, m                     rotation x y z w                    velocity, m/s"
      "                   angular velocity, rad/s");
  for (const BodyLine& body : bodies) {
    const double *p = body.position, *r = body.rotation, *v = body.linear_velocity, *w = body.angular_velocity;
    printf("%4u:%-4u %-9s %c %10.5f %10.5f %10.5f  %8.5f %8.5f %8.5f %8.5f  %10.5f %10.5f %10.5f  %9.5f %9.5f %9.5f\n",
           static_cast<unsigned>(body.slot), static_cast<unsigned>(body.generation), body.type.c_str(),
           body.awake ? '*' : ' ', p[0], p[1], p[2], r[0], r[1], r[2], r[3], v[0], v[1], v[2], w[0], w[1], w[2]);
  }
}

bool Report::problem(const std::string& path, const std::string& problem) const {
  Outcome outcome;
  outcome.verdict = Verdict::bad;
  outcome.problem = outcome.status = problem;
  if (json)
    print_json(json_of(path, outcome));
  else
    print_problem(path, outcome);
  return false;
}

void Report::described(const std::string& path, const Outcome& outcome) const {
  if (json) {
    Json object = json_of(path, outcome);
    object["calls"] = outcome.calls;
    return print_json(object);
  }
  if (outcome.header_known) {
    const Header& header = outcome.header;
    print(path + ":");
    print("  configuration       " + header.config);
    print("  simulation version  " + text(header.simulation_version));
    print("  format version      " + text(header.format_version));
    print("  capacity            " + text(header.bodies) + " bodies, " + text(header.contacts) + " contacts, " +
          text(header.assets) + " assets");
    print("  trace level         " + text(header.trace_level));
    print("  digest interval     " + text(header.digest_interval));
    print("  keyframe interval   " + text(header.keyframe_interval));
    print("  first tick          " + text(header.first_tick));
    print("  size                " + text(outcome.file_bytes) + " bytes, seed " + text(header.snapshot_bytes));
    if (outcome.verdict == Verdict::good) {
      print("  content             " + text(outcome.ticks) + " ticks, " + text(outcome.digests) + " digests, " +
            text(outcome.calls) + " calls");
      print("  final digest        " + hexadecimal(outcome.digest));
    }
  }
  fflush(stdout);
  if (outcome.verdict != Verdict::good) print_problem(path, outcome);
}

void Report::scene(const SceneLine& line) const {
  if (json) {
    Json object;
    object["name"] = line.name;
    object["description"] = line.description;
    object["ticks"] = line.ticks;
    object["capacity"] = {{"bodies", line.bodies}, {"contacts", line.contacts}};
    return print_json(object);
  }
  printf("%-12s %6u ticks  %s\n", line.name.c_str(), static_cast<unsigned>(line.ticks), line.description.c_str());
}

}  // namespace detent_tool
