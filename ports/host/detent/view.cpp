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

namespace detent_tool {

namespace {

constexpr const char* k_mark = "<!--recording-->";  // where ports/web/view/page.html takes the recording

std::string base64(const uint8_t* bytes, size_t count) {
  constexpr const char* k_letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((count + 2) / 3 * 4);
  for (size_t i = 0; i < count; i += 3) {
    const size_t left = std::min<size_t>(count - i, 3);
    const uint32_t group = static_cast<uint32_t>(bytes[i]) << 16 |
                           (left > 1 ? static_cast<uint32_t>(bytes[i + 1]) << 8 : 0u) |
                           (left > 2 ? static_cast<uint32_t>(bytes[i + 2]) : 0u);
    for (size_t k = 0; k < 4; ++k) text += k <= left ? k_letters[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

/// The name in an attribute of the page: a file may be called anything.
std::string attribute(const std::string& text) {
  std::string safe;
  for (const char letter : printable(text)) {
    const auto unsafe = std::string("&<>\"'").find(letter) != std::string::npos;
    safe += unsafe ? "&#" + std::to_string(static_cast<int>(letter)) + ";" : std::string(1, letter);
  }
  return safe;
}

/// The page of a configuration without a recording, as ports/web/build makes it: installed with the tool, or in the
/// build folder beside that of the tool. Empty if there is none.
std::string find_template(const std::string& config) {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  const std::string name = config + ".html";
  for (const char* folder : {"../share/detent/view", "../../../../web/view"}) {
    const std::filesystem::path candidate = self / folder / name;
    if (std::filesystem::is_regular_file(candidate, error)) return candidate.string();
  }
  return "";
}

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

std::string element(const char* kind, const std::string& more, const uint8_t* bytes, size_t count) {
  return std::string("<script class=\"") + kind + "\" type=\"text/plain\"" + more + ">" + base64(bytes, count) +
         "</script>\n";
}

/// The assets of the page: those that are named, or those of the built-in scenes; no more than the world has room for.
std::string read_assets(const ViewRequest& request, const Outcome& recording, Assets& assets) {
  for (const std::string& path : request.asset_paths) {
    assets.push_back({});
    if (const std::string problem = read_asset(path, assets.back()); !problem.empty()) return path + ": " + problem;
  }
  if (assets.empty()) assets = engines().front().scene_assets();
  if (assets.size() > recording.header.assets) assets.resize(recording.header.assets);
  return "";
}

/// Reads the page of this configuration without a recording. Returns the problem; empty if none.
std::string read_template(const std::string& path, const std::string& config, std::string& page, size_t& mark) {
  const std::string from = find_template(config);
  if (from.empty()) {
    if (find_template("fx64").empty())
      return "detent: this tool has no viewer: build it with ports/web/build, in a checkout of the same version";
    return path + ": this tool has no viewer of configuration " + config;
  }
  std::vector<uint8_t> bytes;
  if (const std::string problem = read_file(from, bytes); !problem.empty()) return from + ": " + problem;
  page.assign(bytes.begin(), bytes.end());
  mark = page.find(k_mark);
  return mark == std::string::npos ? from + ": is not a page of the viewer" : "";
}

/// The names of the recordings in the page: those of the files, with their folders if they are equal.
std::vector<std::string> names_of(const std::vector<std::string>& paths) {
  std::vector<std::string> names;
  for (const std::string& path : paths) names.push_back(std::filesystem::path(path).filename().string());
  return names.size() == 2 && names[0] == names[1] ? paths : names;
}

/// The problem, with the file's name; empty if the page was written.
std::string make(const ViewRequest& request, const Outcome& recording) {
  std::string page;
  size_t mark = 0;
  std::string problem = read_template(request.paths.front(), recording.header.config, page, mark);
  if (!problem.empty()) return problem;
  const std::vector<std::string> names = names_of(request.paths);
  std::string elements;
  for (size_t i = 0; i < names.size(); ++i) {
    std::vector<uint8_t> bytes;
    problem = read_recording(request.paths[i], bytes);
    if (!problem.empty()) return request.paths[i] + ": " + problem;
    elements += element("recording", " data-name=\"" + attribute(names[i]) + "\"", bytes.data(), bytes.size());
  }
  Assets assets;
  problem = read_assets(request, recording, assets);
  if (!problem.empty()) return problem;
  for (const AssetBytes& asset : assets)
    elements += element("asset", "", reinterpret_cast<const uint8_t*>(asset.words.data()), asset.byte_count);
  page.replace(mark, std::string(k_mark).size(), elements);
  problem = write_file(request.output, {page.begin(), page.end()});
  return problem.empty() ? "" : request.output + ": " + problem;
}

}  // namespace

namespace {

struct Written {
  bool good = false;
  std::string problem;  ///< also of a good page: the damage of a recording
  uint64_t ticks = 0;   ///< of the first recording
};

/// Damage after a header is left to the page, which shows the ticks before it.
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
  return paths.size() == 1 ? paths[0] : paths[0] + " and " + paths[1];
}

}  // namespace

bool write_view(const ViewRequest& request) {
  const auto [good, problem, ticks] = write(request);
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
