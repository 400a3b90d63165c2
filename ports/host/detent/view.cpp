#include "view.h"

#include <stdio.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "engine.h"
#include "file.h"
#include "stream.h"
#include "text.h"
#include "verification.h"
#include "view_page.h"
#include "view_scenes.h"

namespace detent_tool {

namespace {

/// Reads a recording whole, unpacked. Returns the problem; empty if none.
std::string read_recording(const std::string& path, std::vector<uint8_t>& bytes) {
  std::string problem;
  const std::unique_ptr<Input> input = Input::open(path, problem);
  if (input == nullptr) return problem;
  constexpr uint32_t k_piece_bytes = 65536;
  for (uint32_t got = k_piece_bytes; got == k_piece_bytes;) {
    const size_t at = bytes.size();
    if (at > k_whole_file_bytes_max) return "has more than " + std::to_string(k_whole_file_bytes_max) + " bytes";
    bytes.resize(at + k_piece_bytes);
    if (!input->read(bytes.data() + at, k_piece_bytes, got)) return input->problem;
    bytes.resize(at + got);
  }
  return "";
}

/// Reads the assets of the page: those that the request names, or else those of the built-in scenes, but no more than
/// the world has room for.
std::string read_assets(const ViewRequest& request, const Outcome& recording, Assets& assets) {
  for (const std::string& path : request.asset_paths) {
    assets.push_back({});
    if (const std::string problem = read_asset(path, assets.back()); !problem.empty()) return path + ": " + problem;
  }
  if (assets.empty()) assets = engines().front().scene_assets();
  if (assets.size() > recording.header.assets) assets.resize(recording.header.assets);
  return "";
}

/// The names of the recordings in the page: the file names; if these are equal, with their folders.
std::vector<std::string> names_of(const std::vector<std::string>& paths) {
  std::vector<std::string> names;
  for (const std::string& path : paths) names.push_back(std::filesystem::path(path).filename().string());
  return names.size() == 2 && names[0] == names[1] ? paths : names;
}

/// The problem, with the file's name; empty if the page was written.
std::string make(const ViewRequest& request, const Outcome& recording) {
  ViewPage page;
  std::string problem = page.open(request.paths.front(), recording.header.config);
  if (!problem.empty()) return problem;
  const std::vector<std::string> names = names_of(request.paths);
  for (size_t i = 0; i < names.size(); ++i) {
    std::vector<uint8_t> bytes;
    problem = read_recording(request.paths[i], bytes);
    if (!problem.empty()) return request.paths[i] + ": " + problem;
    page.add("recording", {{"name", names[i]}}, bytes.data(), bytes.size());
  }
  Assets assets;
  problem = read_assets(request, recording, assets);
  if (!problem.empty()) return problem;
  for (const AssetBytes& asset : assets)
    page.add("asset", {}, reinterpret_cast<const uint8_t*>(asset.words.data()), asset.byte_count);
  return page.write(request.output);
}

struct Written {
  bool good = false;
  std::string problem;  ///< also of a good page: the damage of a recording
  uint64_t ticks = 0;   ///< of the first recording or of all scenes
};

/// Writes the page. A recording that is damaged after its header is no problem here: the page shows the ticks before
/// the damage.
Written write(const ViewRequest& request) {
  Written written;
  std::vector<Outcome> recordings;
  for (const std::string& path : request.paths) {
    const Outcome recording =
        by_its_engine([&](const Engine& engine) { return engine.info({path}, [](uint64_t, uint64_t) {}); });
    const std::string problem = path + ": " + recording.problem;
    if (!recording.header_known || recording.verdict == Verdict::refused) return {false, problem, 0};
    if (recording.verdict == Verdict::bad && written.problem.empty()) written.problem = problem;
    recordings.push_back(recording);
    const std::string& config = recording.header.config;
    if (config != recordings.front().header.config)
      return {
          false,
          path + ": is of configuration " + config + ", not to be compared with " + recordings.front().header.config,
          0};
  }
  const std::string problem = make(request, recordings.front());
  written.good = problem.empty();
  if (!written.good) written.problem = problem;
  written.ticks = recordings.front().ticks;
  return written;
}

std::string listed(const std::vector<std::string>& paths) {
  if (paths.size() > 2) return std::to_string(paths.size()) + " scenes";
  return paths.size() == 1 ? paths[0] : paths[0] + " and " + paths[1];
}

bool are_scenes(const std::vector<std::string>& paths) {
  return std::all_of(paths.begin(), paths.end(), [](const std::string& path) { return ends_with(path, ".json"); });
}

Written write_any(const ViewRequest& request) {
  if (are_scenes(request.paths)) {
    if (!request.asset_paths.empty()) return {false, "--asset is for recordings: a scene names its files", 0};
    Written written;
    written.good = write_scenes(request, written.ticks, written.problem);
    return written;
  }
  if (request.paths.size() > 2)
    return {false, "a page shows one recording or two, or any number of scenes, whose names end in .json", 0};
  return write(request);
}

}  // namespace

bool write_view(const ViewRequest& request) {
  const auto [good, problem, ticks] = write_any(request);
  if (request.json) {
    nlohmann::ordered_json line = {{"file", request.paths.front()}};
    if (request.paths.size() == 2) line["second"] = request.paths[1];
    line["ok"] = good;
    if (good) line["output"] = request.output;
    if (!problem.empty()) line["problem"] = problem;
    printf("%s\n", line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace).c_str());
    return good;
  }
  if (!problem.empty()) fprintf(stderr, "%s\n", printable(problem).c_str());
  if (good) {
    printf("%s\n", printable(request.output + ": " + std::to_string(ticks) + " ticks of " + listed(request.paths) +
                             "; open it in a browser")
                       .c_str());
  }
  return good;
}

}  // namespace detent_tool
