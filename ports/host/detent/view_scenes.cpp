#include "view_scenes.h"

#include <algorithm>
#include <filesystem>

#include "engine.h"
#include "file.h"
#include "run.h"
#include "view_page.h"

namespace detent_tool {

namespace {

/// A scene in the page: its recording, and the indices of its assets in SharedAssets.
struct PlayedScene {
  std::string name, description, asset_indices;
  std::vector<uint8_t> recording;
  uint64_t ticks = 0;
};

/// The assets of all scenes, without duplicates.
struct SharedAssets {
  std::vector<std::string> digests;
  Assets assets;

  std::string take(const std::string& path, const std::string& digest, size_t& index) {
    const auto found = std::find(digests.begin(), digests.end(), digest);
    index = static_cast<size_t>(found - digests.begin());
    if (found != digests.end()) return "";
    AssetBytes asset;
    if (const std::string problem = read_asset(path, asset); !problem.empty()) return path + ": " + problem;
    digests.push_back(digest);
    assets.push_back(std::move(asset));
    return "";
  }
};

/// "card_house_of_2_rows.json" is "card house of 2 rows".
std::string title_of(const std::filesystem::path& path) {
  std::string title = path.stem().string();
  std::replace(title.begin(), title.end(), '_', ' ');
  return title;
}

std::string play(const Engine& engine, const std::string& path, const std::string& output, SharedAssets& shared,
                 PlayedScene& scene) {
  Node root;
  Problem problem;
  if (!read_scene_file(path, root, problem)) return problem_text(path, problem);
  RunRequest request;
  request.path = path;
  request.root = &root;
  request.recorded = &scene.recording;
  const RunOutcome outcome = engine.run(
      request, [](const RunLine&) {}, [](uint64_t, uint64_t) {});
  if (!outcome.problems.empty()) return problem_text(path, outcome.problems.front());
  scene.name = title_of(path);
  scene.description = outcome.description;
  scene.ticks = outcome.ticks;
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  for (size_t i = 0; i < outcome.assets.size(); ++i) {
    size_t index = 0;
    const std::string file = (folder / outcome.assets[i]).string();
    if (is_same_file(file, output)) return path + ": " + outcome.assets[i] + " would be written over by the page";
    if (const std::string why = shared.take(file, outcome.asset_digests[i], index); !why.empty()) return why;
    scene.asset_indices += (i == 0 ? "" : " ") + std::to_string(index);
  }
  return "";
}

}  // namespace

bool write_scenes(const ViewRequest& request, uint64_t& ticks, std::string& problem) {
  const auto engine = std::find_if(engines().begin(), engines().end(),
                                   [&](const Engine& each) { return request.config == each.config; });
  ViewPage page;
  problem = page.open(request.paths.front(), request.config);
  SharedAssets shared;
  for (const std::string& path : request.paths) {
    if (!problem.empty()) return false;
    PlayedScene scene;
    problem = play(*engine, path, request.output, shared, scene);
    ticks += scene.ticks;
    page.add("scene", {{"name", scene.name}, {"text", scene.description}, {"assets", scene.asset_indices}},
             scene.recording.data(), scene.recording.size());
  }
  for (const AssetBytes& asset : shared.assets)
    page.add("asset", {}, reinterpret_cast<const uint8_t*>(asset.words.data()), asset.byte_count);
  if (problem.empty()) problem = page.write(request.output);
  return problem.empty();
}

}  // namespace detent_tool
