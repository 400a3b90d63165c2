#include "verification.h"

#include <stdio.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "difference.h"
#include "file.h"
#include "progress.h"
#include "release.h"
#include "stream.h"
#include "text.h"
#include "workers.h"

namespace detent_tool {

namespace {

bool is_recording_name(const std::string& name) { return ends_with(name, ".rec") || ends_with(name, ".rec.zst"); }

/// Finds the recordings in a folder and its sub-folders, in the order of their names. Returns false if the folder
/// cannot be read.
bool find_recordings(const std::string& folder, std::vector<std::string>& paths) {
  std::error_code error;
  std::vector<std::string> found;
  for (std::filesystem::recursive_directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    if (at->is_regular_file(error) && is_recording_name(at->path().filename().string())) {
      found.push_back(at->path().string());
    }
  }
  std::sort(found.begin(), found.end());
  paths.insert(paths.end(), found.begin(), found.end());
  return !error && !found.empty();
}

/// Reads the non-empty lines of a file. Returns the problem; empty if none.
std::string read_lines(const std::string& path, std::vector<std::string>& lines) {
  std::vector<uint8_t> bytes;
  const std::string problem = path == "-" ? read_stream(stdin, k_whole_file_bytes_max, bytes) : read_file(path, bytes);
  for (auto at = bytes.begin(); problem.empty() && at != bytes.end();) {
    const auto end = std::find(at, bytes.end(), '\n');
    if (at != end) lines.emplace_back(at, end);
    at = end == bytes.end() ? end : end + 1;
  }
  return problem;
}

/// The files that an earlier run reported, and whether each was good; a later line replaces an earlier one. Unfinished
/// lines and other JSON are ignored.
std::map<std::string, bool> log_of(const std::vector<std::string>& lines) {
  std::map<std::string, bool> log;
  for (const std::string& line : lines) {
    const nlohmann::ordered_json json = nlohmann::ordered_json::parse(line, nullptr, false);
    if (!json.is_object()) continue;
    const auto name = json.find("file"), ok = json.find("ok");
    if (name == json.end() || ok == json.end() || !name->is_string() || !ok->is_boolean()) continue;
    log[name->get<std::string>()] = ok->get<bool>();
  }
  return log;
}

Outcome verify_here(const VerificationRequest& request, const ReadRequest& reading, const Progress& progress) {
  const std::optional<Versions> versions = versions_of(reading.path);
  const Engine& first = engines().front();
  if (!versions || versions->simulation == first.simulation_version || called_by_another_release()) {
    return by_its_engine([&](const Engine& engine) {
      Outcome outcome = engine.verify(reading, progress);
      // If a digest differs, the recording may tell more than the tick: the stage and the field that differ.
      if (outcome.digests_differ) {
        const Difference difference = engine.explain(reading, outcome.first_bad_tick);
        outcome.difference_text = difference_text(difference, "the recording", "this machine");
        outcome.difference = difference_json(difference);
      }
      return outcome;
    });
  }
  const std::string release = find_release(versions->simulation);
  if (!release.empty()) return verify_by_release(release, request.asset_paths, reading);
  Outcome outcome = by_its_engine([&](const Engine& engine) { return engine.verify(reading, progress); });
  if (outcome.verdict == Verdict::refused) {
    const std::string version = std::to_string(versions->simulation);
    outcome.problem = "recorded by simulation version " + version + "; this is " +
                      std::to_string(first.simulation_version) + ", and detent-" + version +
                      " is neither beside it nor on the PATH";
  }
  return outcome;
}

struct Total {
  uint64_t files = 0;
  uint64_t bad = 0;
  uint64_t passed_over = 0;
  uint64_t ticks = 0;
  double seconds = 0;  ///< summed over all cores

  void add(const Outcome& outcome) {
    ++files;
    bad += outcome.verdict == Verdict::good ? 0 : 1;
    ticks += outcome.ticks;
    seconds += outcome.seconds;
  }
};

}  // namespace

Verification verify_all(VerificationRequest request, const Report& report) {
  bool good = true;
  std::vector<std::string> paths;
  bool many = !request.list.empty() || request.paths.size() > 1;
  for (const std::string& path : request.paths) {
    std::error_code error;
    if (!std::filesystem::is_directory(path, error)) {
      paths.push_back(path);
      continue;
    }
    many = true;
    if (!find_recordings(path, paths)) good = report.problem(path, "no recordings in it, or it cannot be read");
  }
  if (!request.list.empty()) {
    const std::string problem = read_lines(request.list, paths);
    if (!problem.empty()) good = report.problem(request.list, problem);
  }
  if (paths.empty()) {
    if (!good) return Verification::bad;
    report.problem(request.list, "nothing to verify: the list names no recording");
    return Verification::nothing;
  }

  Total total;
  // A log that does not exist yet is empty.
  std::error_code error;
  if (!request.log.empty() && std::filesystem::exists(request.log, error)) {
    std::vector<std::string> lines;
    if (const std::string problem = read_lines(request.log, lines); !problem.empty()) {
      report.problem(request.log, problem);
      return Verification::bad;
    }
    const std::map<std::string, bool> log = log_of(lines);
    const auto known = [&](const std::string& path) {
      const auto entry = log.find(path);
      if (entry == log.end()) return false;
      ++total.passed_over;
      if (!entry->second) good = false;
      return true;
    };
    paths.erase(std::remove_if(paths.begin(), paths.end(), known), paths.end());
  }

  const auto verify = [&request](const std::string& path, const Progress& progress) {
    ReadRequest reading = request.reading;
    reading.path = path;
    return verify_here(request, reading, progress);
  };
  const auto done = [&](const std::string& path, const Outcome& outcome) {
    total.add(outcome);
    report.verified(path, outcome);
  };
  if (many && can_fork()) {
    verify_in_workers(paths, request.jobs, verify, done);
  } else {
    for (const std::string& path : paths) {
      Outcome outcome;
      {
        ProgressBar bar(path);
        outcome = verify(path, [&bar](uint64_t at, uint64_t all) { bar.show(at, all); });
      }
      done(path, outcome);
    }
  }
  if (many) report.verified_all(total.files, total.bad, total.passed_over, total.ticks, total.seconds);
  return good && total.bad == 0 ? Verification::good : Verification::bad;
}

}  // namespace detent_tool
