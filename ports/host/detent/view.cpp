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

/// The problem, with the file's name; empty if the page was written.
std::string make(const ViewRequest& request, const Outcome& recording) {
  std::string page;
  const std::string from = find_template(recording.header.config);
  if (from.empty()) {
    if (find_template("fx64").empty())
      return "detent: this tool has no viewer: build it with ports/web/build, in a checkout of the same version";
    return request.path + ": this tool has no viewer of configuration " + recording.header.config;
  }
  std::vector<uint8_t> bytes;
  if (const std::string problem = read_file(from, bytes); !problem.empty()) return from + ": " + problem;
  page.assign(bytes.begin(), bytes.end());
  const size_t mark = page.find(k_mark);
  if (mark == std::string::npos) return from + ": is not a page of the viewer";

  bytes.clear();
  if (const std::string problem = read_recording(request.path, bytes); !problem.empty())
    return request.path + ": " + problem;
  Assets assets;
  if (const std::string problem = read_assets(request, recording, assets); !problem.empty()) return problem;
  const std::string name = std::filesystem::path(request.path).filename().string();
  std::string elements = element("recording", " data-name=\"" + attribute(name) + "\"", bytes.data(), bytes.size());
  for (const AssetBytes& asset : assets)
    elements += element("asset", "", reinterpret_cast<const uint8_t*>(asset.words.data()), asset.byte_count);
  page.replace(mark, std::string(k_mark).size(), elements);
  const std::string problem = write_file(request.output, {page.begin(), page.end()});
  return problem.empty() ? "" : request.output + ": " + problem;
}

}  // namespace

bool write_view(const ViewRequest& request) {
  const Outcome recording =
      by_its_engine([&](const Engine& engine) { return engine.info({request.path}, [](uint64_t, uint64_t) {}); });
  // Damage after the header is left to the page, which shows the ticks before it.
  const bool shown = recording.header_known && recording.verdict != Verdict::refused;
  std::string problem = shown ? make(request, recording) : request.path + ": " + recording.problem;
  const bool good = problem.empty();
  if (good && recording.verdict == Verdict::bad) problem = request.path + ": " + recording.problem;
  if (request.json) {
    nlohmann::ordered_json line = {{"file", request.path}, {"ok", good}};
    if (good) line["output"] = request.output;
    if (!problem.empty()) line["problem"] = problem;
    printf("%s\n", line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace).c_str());
    return good;
  }
  if (!problem.empty()) fprintf(stderr, "%s\n", printable(problem).c_str());
  if (good) {
    printf("%s\n", printable(request.output + ": " + std::to_string(recording.ticks) + " ticks of " + request.path +
                             "; open it in a browser")
                       .c_str());
  }
  return good;
}

}  // namespace detent_tool
